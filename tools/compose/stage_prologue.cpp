#include "compose/stage_prologue.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "compose/specialized_counts.hpp"

namespace gobo {
namespace {

/// The macros of the features that the stage mentions, or that the text of another one does.
std::vector<std::string> macros_of(const Family& family, Dialect dialect, const Placement& placement,
                                   const Mentions& mentions, const PieceLibrary& library,
                                   const std::map<int, int>& specialized) {
    std::vector<std::string> definitions(family.features.size());
    std::set<std::string, std::less<>> mentioned;  // by texts
    for (bool goes_on = true; std::exchange(goes_on, false);) {
        for (std::size_t i = 0; i < definitions.size(); ++i) {
            const Feature& feature = family.features[i];
            const bool is_in_stage =
                feature.stages.empty() || std::ranges::count(feature.stages, name_of(placement.stage)) > 0;
            if (library.is_subroutine(feature.macro)) continue;
            if (feature.macro.empty() || !definitions[i].empty() || !is_in_stage) continue;
            if (!mentions(feature.macro) && !mentioned.contains(feature.macro)) continue;
            const std::optional<std::string> text = feature.text_of(placement.key[i]);
            if (!text) continue;
            definitions[i] = fmt::format("#define {}{}{}\n", feature.macro, text->empty() ? "" : " ", *text);
            if (feature.is_specialized && is_spirv(dialect)) {
                const auto id = specialized.find(static_cast<int>(i));
                definitions[i] = count_text(
                    feature, *text, id == specialized.end() ? std::nullopt : std::optional(id->second));
            }
            for (const std::string_view name : identifiers_of(*text))
                goes_on = mentioned.emplace(name).second || goes_on;
        }
    }
    return definitions;
}

}  // namespace

std::string stage_prologue(const Family& family, Dialect dialect, const Placement& placement,
                           const Mentions& mentions, const PieceLibrary& library,
                           const std::map<int, int>& specialized) {
    std::vector<DescriptorPlace> places;
    for (const StatedBinding& stated : library.bindings(placement.placed))
        places.push_back(descriptor_place(family, stated.name, stated.binding, stated.is_sampler));
    std::string text = dialect_prologue(
        dialect, placement.stage, placement.version.empty() ? placement.version_beside : placement.version,
        placement.extensions, mentions, places);
    for (const std::string& definition :
         macros_of(family, dialect, placement, mentions, library, specialized))
        text += definition;
    return text;
}
}  // namespace gobo
