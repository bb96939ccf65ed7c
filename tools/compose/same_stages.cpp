#include "compose/same_stages.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "family/key.hpp"

namespace gobo {

Diagnostics same_stages(const Family& family, const Composition& composition) {
    std::map<std::pair<int, int>, const Permutation*> first_of;
    std::string example;
    int more = -1;
    for (const Permutation& permutation : composition.permutations) {
        const auto [at, is_new] =
            first_of.try_emplace({permutation.vertex, permutation.fragment}, &permutation);
        if (is_new) continue;
        if (++more > 0) continue;
        example = fmt::format("the keys '{}' and '{}' compose to the same stages",
                              key_text(family, at->second->key), key_text(family, permutation.key));
    }
    if (example.empty()) return {};
    Diagnostic diagnostic;
    diagnostic.severity = Severity::warning;
    diagnostic.place.file = family.path;
    diagnostic.message = more == 0 ? example : fmt::format("{}; so do {} more", example, more);
    diagnostic.help =
        "add a rule: when = \"...\" with default = [...] for the feature that cannot matter there";
    return {diagnostic};
}

}  // namespace gobo
