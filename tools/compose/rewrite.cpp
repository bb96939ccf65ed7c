#include "compose/rewrite.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <span>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view kLegacy = "legacy_";

/// The line with one blank for each run of them, and none at its ends and behind a `#`.
std::string folded(std::string_view line) {
    std::string result;
    for (const char character : trim(line)) {
        const bool is_blank = character == ' ' || character == '\t';
        if (is_blank && (result.ends_with(' ') || result == "#")) continue;
        result += is_blank ? ' ' : character;
    }
    return result;
}

/// What stands for the rule's `*` in a folded line; nothing but an empty text where the rule has none.
std::optional<std::string_view> name_in(std::string_view line, const IncludeRule& rule) {
    const std::string pattern = folded(rule.line);
    const auto star = std::min(pattern.find('*'), pattern.size());
    if (!line.starts_with(std::string_view(pattern).substr(0, star))) return std::nullopt;
    line.remove_prefix(star);
    const bool has_star = star < pattern.size();
    const std::string_view end = std::string_view(pattern).substr(has_star ? star + 1 : star);
    const auto at = !has_star ? 0 : end.empty() ? std::min(line.find(' '), line.size()) : line.find(end);
    if (at == std::string_view::npos || (at == 0 && has_star)) return std::nullopt;
    const std::string_view behind = trim(line.substr(at + end.size()));
    const bool is_over =
        behind.empty() || behind == ";" || behind.starts_with("//") || behind.starts_with("/*");
    return is_over ? std::optional(line.substr(0, at)) : std::nullopt;
}

bool is_of_family(std::string_view line, const Family& family) {
    constexpr std::string_view begin = "#include <";
    if (!line.starts_with(begin)) return false;
    const std::string_view name = line.substr(begin.size(), line.find_first_of("/>") - begin.size());
    const std::optional<int> index = family.index_of(name);
    return name == "varyings" || (index && family.features[static_cast<std::size_t>(*index)].macro.empty());
}

/// The identifier that ends at `end`, blanks behind it aside.
std::string_view word_before(std::string_view text, std::size_t end) {
    while (end > 0 && std::isspace(static_cast<unsigned char>(text[end - 1])) != 0) --end;
    std::size_t begin = end;
    while (begin > 0 && is_identifier_part(text[begin - 1])) --begin;
    return text.substr(begin, end - begin);
}

}  // namespace

std::string without_redeclarations(std::string text) {
    constexpr std::array kQualifiers = {"varying", "in",    "out",     "centroid",
                                        "smooth",  "highp", "mediump", "lowp"};
    constexpr std::string_view name = "legacy_TexCoord";
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::string_view all = text;
        std::string_view word = word_before(all, at);
        const std::size_t end = all.find_first_not_of(" \t\n", at + name.size());
        if (word != "vec4" || end == std::string_view::npos || all[end] != '[') continue;
        const std::size_t last = all.find_first_of(";{}", end);
        if (last == std::string_view::npos || all[last] != ';') continue;
        auto begin = static_cast<std::size_t>(word.data() - all.data());
        for (word = word_before(all, begin); std::ranges::find(kQualifiers, word) != kQualifiers.end();
             word = word_before(all, begin))
            begin = static_cast<std::size_t>(word.data() - all.data());
        for (std::size_t i = begin; i <= last; ++i)
            if (text[i] != '\n') text[i] = ' ';
    }
    return text;
}

const std::vector<std::string>& legacy_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = {"attribute",       "varying",           "ftransform",
                                        "texture2DLodEXT", "textureCubeLodEXT", "textureCube",
                                        "textureCubeLod",  "textureCubeGradARB"};
        for (const char* lookup : {"texture1D", "texture2D", "texture3D", "shadow1D", "shadow2D"})
            for (const char* kind : {"", "Proj", "Lod", "ProjLod", "GradARB", "ProjGradARB"})
                all.push_back(fmt::format("{}{}", lookup, kind));
        for (const char* lookup : {"texture2DRect", "shadow2DRect"})
            for (const char* kind : {"", "Proj"}) all.push_back(fmt::format("{}{}", lookup, kind));
        for (const char* matrix :
             {"ModelViewMatrix", "ProjectionMatrix", "ModelViewProjectionMatrix", "TextureMatrix"})
            for (const char* kind : {"", "Inverse", "Transpose", "InverseTranspose"})
                all.push_back(fmt::format("{}{}{}", kLegacy, matrix, kind));
        for (const char* plane : {"EyePlane", "ObjectPlane"})
            for (const char coordinate : {'S', 'T', 'R', 'Q'})
                all.push_back(fmt::format("{}{}{}", kLegacy, plane, coordinate));
        for (const char* name : {"NormalMatrix",
                                 "NormalScale",
                                 "Vertex",
                                 "Normal",
                                 "Color",
                                 "SecondaryColor",
                                 "FogCoord",
                                 "MultiTexCoord0",
                                 "MultiTexCoord1",
                                 "MultiTexCoord2",
                                 "MultiTexCoord3",
                                 "MultiTexCoord4",
                                 "MultiTexCoord5",
                                 "MultiTexCoord6",
                                 "MultiTexCoord7",
                                 "FrontColor",
                                 "FrontSecondaryColor",
                                 "BackColor",
                                 "BackSecondaryColor",
                                 "TextureEnvColor",
                                 "TexCoord",
                                 "FogFragCoord",
                                 "Point",
                                 "ClipPlane",
                                 "FragData",  // before FragColor, which is then its first element
                                 "FragColor",
                                 "LightSource",
                                 "LightModel",
                                 "FrontMaterial",
                                 "BackMaterial",
                                 "FrontLightModelProduct",
                                 "FrontLightProduct",
                                 "BackLightModelProduct",
                                 "BackLightProduct",
                                 "Fog"})
            all.push_back(fmt::format("{}{}", kLegacy, name));
        return all;
    }();
    return names;
}

std::span<const std::string_view> lookups_of_level() {
    static constexpr std::array<std::string_view, 11> names = {
        "texture1DLod",    "texture1DProjLod", "texture2DLod",   "texture2DProjLod",
        "texture3DLod",    "texture3DProjLod", "textureCubeLod", "shadow1DLod",
        "shadow1DProjLod", "shadow2DLod",      "shadow2DProjLod"};
    return names;
}

std::string name_in_files(std::string_view name) {
    return name.starts_with(kLegacy) ? fmt::format("gl_{}", name.substr(kLegacy.size())) : std::string(name);
}

std::string legacy_name(std::string_view name_in_files) {
    return name_in_files.starts_with("gl_") ? fmt::format("{}{}", kLegacy, name_in_files.substr(3)) : "";
}

std::string legacy_piece(const std::string& name) {
    return fmt::format("{}/{}.glsl", kLegacyFolder,
                       name.starts_with(kLegacy) ? name.substr(kLegacy.size()) : name);
}

namespace {

Substitutions longest_first(Substitutions substitutions) {
    std::ranges::stable_sort(substitutions, std::ranges::greater(),
                             [](const auto& substitution) { return substitution.first.size(); });
    return substitutions;
}

}  // namespace

Substitutions substitutions_of(const Family& family, const Key& key) {
    Substitutions substitutions(family.substitutions.begin(), family.substitutions.end());
    for (std::size_t i = 0; i < key.size(); ++i)
        if (const Feature& feature = family.features[i]; !feature.substituted.empty())
            substitutions.emplace_back(feature.substituted, feature.text_of(key[i]).value_or("0"));
    return longest_first(std::move(substitutions));
}

Substitutions legacy_substitutions(StageKind stage) {
    Substitutions substitutions;
    for (const std::string& name : legacy_names()) {
        if (!name.starts_with(kLegacy)) continue;
        const std::string plain = name.substr(kLegacy.size());
        // To the fragment stage its color is what the vertex stage calls the front's.
        const bool is_color = stage == StageKind::fragment && (plain == "Color" || plain == "SecondaryColor");
        substitutions.emplace_back("gl_" + plain, is_color ? fmt::format("{}Front{}", kLegacy, plain) : name);
    }
    substitutions.emplace_back("gl_MaxTextureCoords", "8");  // as many as compatibility.glsl declares
    return longest_first(std::move(substitutions));
}

std::string substituted(std::string_view text, const Substitutions& substitutions) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto fits = [&](const auto& substitution) {
            const std::string_view name = substitution.first;
            if (text.compare(i, name.size(), name) != 0) return false;
            const bool begins =
                i == 0 || !is_identifier_part(name.front()) || !is_identifier_part(text[i - 1]);
            const std::size_t end = i + name.size();
            return begins &&
                   (end == text.size() || !is_identifier_part(name.back()) || !is_identifier_part(text[end]));
        };
        const auto found = std::ranges::find_if(substitutions, fits);
        result += found == substitutions.end() ? text.substr(i, 1) : std::string_view(found->second);
        i += found == substitutions.end() ? 1 : found->first.size();
    }
    return result;
}

std::optional<LoopHead> loop_head(const std::string& text) {
    static const std::regex form(
        R"(for\s*\(\s*int\s+(\w+)\s*=\s*(\d{1,4})\s*;\s*(\w+)\s*<\s*([^;{}]*[^;{}\s])\s*;\s*(?:(\w+)\s*\+\+|\+\+\s*(\w+))\s*\)\s*\{)");
    // std::regex recurses once per character of a run: a longer head exhausts the stack.
    constexpr std::size_t kLongestHead = 4000;
    const std::string head = text.substr(0, kLongestHead);
    std::smatch match;
    if (!std::regex_search(head, match, form)) return std::nullopt;
    const std::string index = match[1];
    if (match[3] != index || match[5].str() + match[6].str() != index) return std::nullopt;
    return LoopHead{static_cast<std::size_t>(match.position()), static_cast<std::size_t>(match.length()),
                    index, std::stoi(match[2]), match[4]};
}

bool is_loop_alone(std::string_view code, const LoopHead& head) {
    int braces = 1;
    std::size_t at = head.begin + head.size;
    for (; at < code.size() && braces > 0; ++at) braces += code[at] == '{' ? 1 : code[at] == '}' ? -1 : 0;
    const std::string_view rest = trim(code.substr(std::min(at, code.size())));
    return trim(code.substr(0, head.begin)).empty() && braces == 0 &&
           (rest.empty() || (rest.starts_with('#') && rest.find('\n') == std::string_view::npos));
}

std::optional<Jump> jump_of_loop(std::string_view code, const LoopHead& head) {
    constexpr std::array<std::string_view, 4> nesting = {"for", "while", "do", "switch"};
    struct Nested {
        bool is_switch;
        int depth;  ///< of braces before it
    };
    std::vector<Nested> nested;
    int braces = 0;
    int brackets = 0;
    const std::vector<std::string_view> tokens = tokens_of(code.substr(head.begin + head.size));
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string_view token = tokens[i];
        if (std::ranges::find(nesting, token) != nesting.end()) nested.push_back({token == "switch", braces});
        if (token == "(") ++brackets;
        if (token == ")") --brackets;
        if (token == "{") ++braces;
        if (token == "}" && --braces < 0) break;
        const bool is_outside = std::ranges::all_of(
            nested, [&](const Nested& around) { return around.is_switch && token == "continue"; });
        if (is_outside && (token == "break" || token == "continue")) {
            const auto before = code.substr(0, static_cast<std::size_t>(token.data() - code.data()));
            return Jump{std::string(token), 1 + static_cast<int>(std::ranges::count(before, '\n'))};
        }
        const bool has_else = i + 1 < tokens.size() && tokens[i + 1] == "else";
        if (brackets == 0 && (token == "}" || token == ";") && !has_else)
            while (!nested.empty() && nested.back().depth >= braces) nested.pop_back();
    }
    return std::nullopt;
}

std::string round_of_loop(const std::string& text, const LoopHead& head, int index) {
    const std::string old_head = text.substr(head.begin, head.size);
    std::string body = text.substr(head.begin + head.size);
    body = substituted(body.substr(0, body.rfind('}') + 1), {{"UNROLLED_LOOP_INDEX", std::to_string(index)}});
    // The lines of the head stay, and what stands behind the loop is its #pragma.
    return fmt::format("{}{}{{ const int {} = {};{}\n", text.substr(0, head.begin),
                       std::string(static_cast<std::size_t>(std::ranges::count(old_head, '\n')), '\n'),
                       head.index, index, body);
}

std::string with_includes(std::string_view text, const Family& family) {
    std::string result;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        std::string written(line);
        const std::string compared = folded(line);
        for (const IncludeRule& rule : family.include_rules) {
            const std::optional<std::string_view> name = name_in(compared, rule);
            if (!name || is_of_family(compared, family)) continue;
            std::string path = rule.path;
            if (const auto star = path.find('*'); star != std::string::npos) path.replace(star, 1, *name);
            written = fmt::format("#include \"{}\"", path);
            break;
        }
        result += written;
        if (line.size() < text.size()) result += '\n';
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return result;
}

}  // namespace gobo
