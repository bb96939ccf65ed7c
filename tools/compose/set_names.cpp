#include "compose/set_names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/piece_marks.hpp"
#include "compose/scan_piece.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

struct Named {
    std::string name;
    Place place;
};

std::vector<Named> names_of(const Family& family) {
    std::vector<Named> names;
    for (const DescriptorSet& set : family.descriptor_sets)
        for (const std::string& name : set.holds)
            if (set.holds_place.file == family.path) names.push_back({name, set.holds_place});
    return names;
}

/// Whether a macro of the text's own declares a block, sampler or image.
bool declares_by_macros(std::string_view text) {
    bool declares = false;
    for_each_line(text, [&](std::string_view line) {
        const std::vector<std::string_view> tokens = tokens_of(line);
        if (tokens.size() < 3 || tokens[0] != "#" || tokens[1] != "define") return true;
        for (const std::string_view word : {"uniform", "buffer", "BLOCK", "SAMPLER"})
            declares = declares || std::ranges::find(tokens, word) != tokens.end();
        return !declares;
    });
    return declares;
}

/// Adds the names of the blocks, samplers and images that the text declares.
void add_resources(std::string_view text, std::set<std::string, std::less<>>& names) {
    const std::vector<std::string_view> tokens = tokens_of(text);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "BLOCK" && i + 4 < tokens.size()) names.emplace(tokens[i + 4]);  // BLOCK(0, Lights)
        if (tokens[i] != "uniform" && tokens[i] != "buffer" && tokens[i] != "SAMPLER") continue;
        std::string_view last;
        int depth = 0;  // of brackets: of a layout, or an array's size
        for (++i; i < tokens.size(); ++i) {
            const std::string_view token = tokens[i];
            const bool ends = token == ";" || token == "{";
            if (depth == 0 && !last.empty() && (ends || token == "," || token == "[")) names.emplace(last);
            if (ends) break;
            if (token == "(" || token == "[") ++depth;
            if (token == ")" || token == "]") --depth;
            if (depth == 0 && is_identifier(token)) last = token;
        }
    }
}

}  // namespace

bool joins_names(std::string_view text) {
    for (std::size_t at = text.find("##"); at != std::string_view::npos; at = text.find("##", at + 2)) {
        const std::string_view before = text.substr(0, at);
        if (!before.ends_with("PLACE_") && !before.ends_with("PLACE_OF_SAMPLER_")) return true;
    }
    return false;
}

Diagnostics unknown_set_names(const Family& family, const SearchPath& search,
                              const Composition& composition) {
    std::vector<Named> names = names_of(family);
    std::set<std::string, std::less<>> identifiers;
    std::set<std::string, std::less<>> resources;
    bool are_resources_known = true;
    const auto add = [&](std::string_view text) {
        for (const std::string_view name : identifiers_of(text)) identifiers.emplace(name);
        are_resources_known = are_resources_known && !declares_by_macros(text);
        add_resources(text, resources);
    };
    const auto drop_known = [&] {
        const auto& known = are_resources_known ? resources : identifiers;
        std::erase_if(names, [&](const Named& named) { return known.contains(named.name); });
    };
    std::set<int> prologues;
    for (const Stage& stage : composition.stages) prologues.insert(stage.pieces.front());
    // What joins names by ## or replaces them has them nowhere in its text.
    bool is_rewritten = std::ranges::any_of(
        family.features, [](const Feature& feature) { return !feature.substituted.empty(); });
    for (std::size_t i = 0; i < composition.pieces.size(); ++i) {
        const std::string& text = composition.pieces[i].text;
        is_rewritten = is_rewritten || joins_names(text);
        if (!prologues.contains(static_cast<int>(i)))
            add(text);
        else
            for (const std::string_view name : identifiers_of(text)) identifiers.emplace(name);
    }
    drop_known();
    if (names.empty() || is_rewritten) return {};
    for (const std::string& text : texts_of_all_keys(family, search, composition.dialect)) add(text);
    drop_known();
    Diagnostics errors;
    std::ranges::stable_sort(names, {}, [](const Named& named) { return named.place.line; });
    for (const auto& [name, place] : names) {
        const auto& candidates = are_resources_known ? resources : identifiers;
        std::vector<std::string> known(candidates.begin(), candidates.end());
        std::stable_partition(known.begin(), known.end(),
                              [first = name[0]](const std::string& one) { return one[0] == first; });
        const auto near = nearest(name, known);
        append(errors, fail(place, "",
                            fmt::format("'{}' under [[descriptor_sets]] is {}", name,
                                        identifiers.contains(name)
                                            ? "no block, sampler or image, which alone have a set"
                                            : "in none of the shaders"),
                            near ? fmt::format("did you mean '{}'?", *near)
                                 : "gobo reflect lists the names that there are")
                           .value());
    }
    return errors;
}

}  // namespace gobo
