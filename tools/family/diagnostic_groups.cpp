#include "family/diagnostic_groups.hpp"

#include <fmt/format.h>

#include "family/key.hpp"

namespace gobo {

void DiagnosticGroups::add(const Diagnostic& diagnostic, const Key& key) {
    const auto identity = std::tuple(diagnostic.place.file, diagnostic.place.line, diagnostic.message);
    const auto [position, is_new] = positions_.try_emplace(identity, groups_.size());
    if (is_new) groups_.push_back({diagnostic, &key, nullptr, 0});
    Group& group = groups_[position->second];
    if (group.last == &key) return;
    ++group.keys;
    group.last = &key;
}

Diagnostics DiagnosticGroups::result() const {
    Diagnostics diagnostics;
    for (const Group& group : groups_) {
        diagnostics.push_back(group.diagnostic);
        std::string& subject = diagnostics.back().subject;
        subject = key_text(family_, *group.first);
        if (group.keys == 2) subject += ", and 1 more key";
        if (group.keys > 2) subject += fmt::format(", and {} more keys", group.keys - 1);
    }
    return diagnostics;
}

}  // namespace gobo
