#include "gobo/shader_files.hpp"

#include <algorithm>
#include <array>

#include "compose/rewrite.hpp"
#include "compose/subroutines.hpp"
#include "compose/tokens.hpp"

namespace gobo {
namespace {

template <class Test>
bool any_token(const Composition& composition, const Test& test) {
    return std::ranges::any_of(composition.pieces, [&](const Piece& piece) {
        const auto tokens = tokens_of(piece.text);
        return std::ranges::any_of(tokens, test);
    });
}

/// What every version up to 1.20 has, and is read without help.
bool is_of_all_old_versions(std::string_view name) {
    return name == "gl_FragColor" || name == "gl_FragData";
}

bool is_legacy(std::string_view token) {
    if (token == "ftransform") return true;
    return !is_of_all_old_versions(token) && std::ranges::count(legacy_names(), legacy_name(token)) > 0;
}

}  // namespace

bool is_for_vulkan(const Composition& composition) {
    constexpr std::array<std::string_view, 6> kWords = {"push_constant",  "input_attachment_index",
                                                        "subpassInput",   "subpassInputMS",
                                                        "gl_VertexIndex", "gl_InstanceIndex"};
    for (const Piece& piece : composition.pieces) {
        bool is_in_layout = false;
        std::string_view last;
        for (const std::string_view token : tokens_of(piece.text)) {
            if (std::ranges::count(kWords, token) > 0) return true;
            if (is_in_layout && last == "set" && token == "=") return true;
            if (last == "uniform" && token.starts_with("texture")) return true;
            if (last == "layout" || token == ")") is_in_layout = last == "layout";
            last = token;
        }
    }
    return false;
}

bool read_as_legacy(const Composition& composition, Family& family) {
    const bool states_version = std::ranges::any_of(composition.pieces, [](const Piece& piece) {
        return piece.file_text.find("#version") != std::string::npos;
    });
    const bool is_old = !states_version && any_token(composition, [](std::string_view token) {
        return token == "varying" || token == "attribute" || is_of_all_old_versions(token);
    });
    if (is_old) family.version = "110";
    family.compatibility = any_token(composition, is_legacy);
    if (family.compatibility && !states_version) family.version = "110";
    return is_old || family.compatibility;
}

bool add_subroutines(const Composition& composition, Family& family) {
    for (const Piece& piece : composition.pieces)
        for (const SubroutineUniform& uniform : subroutine_uniforms(piece.text)) {
            const bool is_known = index_of(family.features, uniform.name).has_value();
            if (is_known || uniform.functions.empty()) continue;
            Feature& feature = family.features.emplace_back();
            feature.name = feature.macro = uniform.name;
            feature.values = uniform.functions;
            feature.place = {piece.path, 0, 0};
        }
    return !family.features.empty();
}

std::vector<Key> keys_with_every_value(const Family& family) {
    std::size_t most = 1;
    for (const Feature& feature : family.features) most = std::max(most, feature.values.size());
    std::vector<Key> keys;
    for (std::size_t number = 0; number < most; ++number) {
        Key& key = keys.emplace_back();
        for (const Feature& feature : family.features)
            key.push_back(static_cast<int>(std::min(number, feature.values.size() - 1)));
    }
    return keys;
}

}  // namespace gobo
