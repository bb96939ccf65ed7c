#include "compose/dialect.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include <fmt/format.h>

#include "compose/rewrite.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// A macro of the prologue.
struct Macro {
    std::string_view name;
    std::string_view parameters;
    std::optional<StageKind> stage;  ///< the only one that has it, if so
    std::string_view glsl450;
    std::string_view glsl330;
    std::string_view es300;
    std::string_view vulkan;
};

constexpr std::string_view kBoundBlock = "layout(std140, binding = binding_) uniform name_";
constexpr std::string_view kPlainBlock = "layout(std140) uniform name_";
constexpr std::string_view kBoundSampler = "layout(binding = binding_) uniform type_";
constexpr std::string_view kInput = "layout(location = location_) in";
constexpr std::string_view kOutput = "layout(location = location_) out";
constexpr std::string_view kDepth = "layout(qualifier_)";
// Places are macros of the prologue: by the block's name, by the sampler's number.
constexpr std::string_view kPlacedBlock = "layout(std140, PLACE_##name_) uniform name_";
constexpr std::string_view kPlacedSampler = "layout(PLACE_OF_SAMPLER_##binding_) uniform type_";
constexpr Macro kMacros[] = {
    {"BLOCK", "binding_, name_", {}, kBoundBlock, kPlainBlock, kPlainBlock, kPlacedBlock},
    {"VARYING", "location_", StageKind::vertex, kOutput, "out", "out", kOutput},
    {"VARYING", "location_", StageKind::fragment, kInput, "in", "in", kInput},
    {"ATTRIBUTE", "location_", {}, kInput, kInput, kInput, kInput},
    {"OUTPUT", "location_", {}, kOutput, kOutput, kOutput, kOutput},
    {"SAMPLER", "binding_, type_", {}, kBoundSampler, "uniform type_", "uniform highp type_", kPlacedSampler},
    {"DEPTH", "qualifier_", {}, kDepth, kDepth, kDepth, kDepth},
};

struct DialectRow {
    Dialect dialect;
    std::string_view name;
    std::string_view version;
    std::string_view Macro::*spelling;
};

constexpr DialectRow kDialects[] = {
    {Dialect::glsl450, "450", "450 core", &Macro::glsl450},
    {Dialect::glsl330, "330", "330 core", &Macro::glsl330},
    {Dialect::es300, "es300", "300 es", &Macro::es300},
    {Dialect::vulkan, "vulkan", "450", &Macro::vulkan},
    {Dialect::gl_spirv, "gl_spirv", "450 core", &Macro::glsl450},
};

/// That of Dialect::own is 450's.
const DialectRow& row_of(Dialect dialect) {
    const auto* const row = std::ranges::find(kDialects, dialect, &DialectRow::dialect);
    return row == std::end(kDialects) ? kDialects[0] : *row;
}

/// The extension that the DEPTH macro's qualifiers need before 4.2, where they became core.
std::string_view depth_extension(Dialect dialect, const Mentions& mentions) {
    if (dialect == Dialect::glsl450 || is_spirv(dialect) || !mentions("DEPTH")) return "";
    if (mentions("early_fragment_tests")) return "GL_ARB_shader_image_load_store";
    return dialect == Dialect::es300 ? "GL_EXT_conservative_depth" : "GL_ARB_conservative_depth";
}

/// Where vertex stages before 1.30 mention texture2DLod and its kin, which GLSL 1.20, 8.7, has there of
/// itself: glslang wants the extension that brings them to fragment stages. Drivers without it but warn of
/// `enable`.
bool needs_lod_extension(StageKind stage, std::string_view version_line, const Mentions& mentions) {
    const GlslVersion version = version_of(version_line);
    return stage == StageKind::vertex && !version.es && version.number < 130 &&
           std::ranges::any_of(lookups_of_level(), mentions);
}

/// The dialect whose macros suit a version line: explicit bindings and locations came with 4.2.
Dialect spelling_of(std::string_view version_line) {
    const GlslVersion version = version_of(version_line);
    if (version.profile == "es") return Dialect::es300;
    return version.number < 420 ? Dialect::glsl330 : Dialect::glsl450;
}

/// What stands behind #version: of SPIR-V the dialect's or a later one, which has all that it has.
std::string version_text(Dialect dialect, std::string_view own_version) {
    const std::string_view text = row_of(dialect).version;
    if (own_version.empty()) return std::string(text);
    if (dialect == Dialect::own) return std::string(own_version);
    const GlslVersion own = version_of(fmt::format("#version {}", own_version));
    const GlslVersion least = version_of(fmt::format("#version {}", text));
    if (!is_spirv(dialect) || own.es || own.number <= least.number) return std::string(text);
    return fmt::format("{}{}{}", own.number, least.profile.empty() ? "" : " ", least.profile);
}

}  // namespace

std::string_view name_of(Dialect dialect) {
    return row_of(dialect).name;
}

std::string dialect_words() {
    std::vector<std::string> words;
    for (const DialectRow& row : kDialects) words.emplace_back(row.name);
    return join(words, "|");
}

DescriptorPlace descriptor_place(const Family& family, std::string name, int number, bool is_sampler) {
    for (std::size_t set = 0; set < family.descriptor_sets.size(); ++set) {
        const std::vector<std::string>& holds = family.descriptor_sets[set].holds;
        const auto found = std::ranges::find(holds, name);
        if (found != holds.end())
            return {std::move(name), number, is_sampler, static_cast<int>(set),
                    static_cast<int>(found - holds.begin())};
    }
    return {std::move(name), number, is_sampler, 0, number};
}

std::optional<Dialect> dialect_of(std::string_view name) {
    for (const DialectRow& row : kDialects)
        if (row.name == name) return row.dialect;
    return std::nullopt;
}

GlslVersion version_of(std::string_view source) {
    GlslVersion version;
    constexpr std::string_view directive = "#version ";
    const auto found = source.find(directive);
    if (found == std::string_view::npos) return version;
    const std::string_view rest = source.substr(found + directive.size());
    const std::string_view line = trim(rest.substr(0, rest.find('\n')));
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), version.number);
    version.profile = trim(line.substr(static_cast<std::size_t>(parsed.ptr - line.data())));
    version.es = version.profile == "es" || version.number == 100;
    return version;
}

std::vector<std::string> version_macros(const GlslVersion& version) {
    std::vector<std::string> macros = {fmt::format("__VERSION__ {}", version.number)};
    if (version.es)
        macros.emplace_back("GL_ES 1");
    else if (version.number >= 150)
        macros.push_back(
            fmt::format("GL_{}_profile 1", version.profile == "compatibility" ? "compatibility" : "core"));
    return macros;
}

bool add_extension(Extensions& extensions, const std::string& name, Extension extension) {
    constexpr std::array<std::string_view, 4> by_strength = {"disable", "warn", "enable", "require"};
    const auto strength_of = [&](const Extension& one) {
        return std::ranges::find(by_strength, one.behavior);
    };
    if (strength_of(extension) == by_strength.end()) return false;
    const auto [held, is_new] = extensions.try_emplace(name, extension);
    if (strength_of(held->second) < strength_of(extension)) held->second = std::move(extension);
    return true;
}

std::string dialect_prologue(Dialect dialect, StageKind stage, std::string_view own_version,
                             Extensions extensions, const Mentions& mentions,
                             const std::vector<DescriptorPlace>& places) {
    const bool is_own = dialect == Dialect::own && !own_version.empty();
    std::string text = fmt::format("#version {}\n", version_text(dialect, own_version));
    const DialectRow& row = row_of(is_own ? spelling_of(text) : dialect);
    if (const std::string needed(depth_extension(row.dialect, mentions)); !needed.empty())
        extensions.try_emplace(needed, Extension{"enable"});
    if (needs_lod_extension(stage, text, mentions))
        extensions.try_emplace("GL_ARB_shader_texture_lod", Extension{"enable"});
    const auto of_all = extensions.extract("all");  // it would undo those before it
    if (of_all) text += fmt::format("#extension all : {}\n", of_all.mapped().behavior);
    for (const auto& [name, extension] : extensions)
        text += fmt::format("#extension {} : {}\n", name, extension.behavior);
    if (dialect == Dialect::es300) text += "precision highp float;\nprecision highp int;\n";
    std::set<std::string> defined;  // two samplers may state one number: their places are compared later
    for (const DescriptorPlace& place : places) {
        const std::string macro = place.is_sampler ? fmt::format("PLACE_OF_SAMPLER_{}", place.number)
                                                   : fmt::format("PLACE_{}", place.name);
        if (dialect == Dialect::vulkan && defined.insert(macro).second)
            text += fmt::format("#define {} set = {}, binding = {}\n", macro, place.set, place.binding);
    }
    for (const Macro& macro : kMacros)
        if (macro.stage.value_or(stage) == stage && mentions(macro.name))
            text += fmt::format("#define {}({}) {}\n", macro.name, macro.parameters, macro.*row.spelling);
    return text;
}

}  // namespace gobo
