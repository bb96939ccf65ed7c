#include "family/open_paths.hpp"

#include <cstddef>

namespace gobo {

OpenPaths::OpenPaths(const KeySpace& space) : space_(space), key_(space.feature_count(), -1) {
    for (std::size_t level = 0; level <= space.feature_count(); ++level)
        from_root_.emplace_back(space.level(level).size(), 1);
    to_end_ = from_root_;
}

std::vector<char> OpenPaths::allowed(std::size_t feature) const {
    const auto values = static_cast<std::size_t>(space_.value_count(feature));
    std::vector<char> result(values, 0);
    const std::vector<KeySpace::Node>& nodes = space_.level(feature);
    const std::vector<char>& below = to_end_[feature + 1];
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        if (from_root_[feature][node] == 0) continue;
        for (std::size_t value = 0; value < values; ++value) {
            const int next = nodes[node].next[value];
            if (next != KeySpace::dead && below[static_cast<std::size_t>(next)] != 0) result[value] = 1;
        }
    }
    return result;
}

void OpenPaths::decide(std::size_t feature, int value) {
    key_[feature] = value;
    spread_down(feature);
    spread_up(feature);
}

/// Makes out again which nodes below a level are reached from it, until nothing changes any more.
void OpenPaths::spread_down(std::size_t from) {
    for (std::size_t level = from; level < key_.size(); ++level) {
        const std::vector<KeySpace::Node>& nodes = space_.level(level);
        std::vector<char> reached(from_root_[level + 1].size(), 0);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            if (from_root_[level][node] == 0) continue;
            const std::vector<int>& next = nodes[node].next;
            const std::size_t first = key_[level] < 0 ? 0 : static_cast<std::size_t>(key_[level]);
            const std::size_t end = key_[level] < 0 ? next.size() : first + 1;
            for (std::size_t value = first; value < end; ++value)
                if (next[value] != KeySpace::dead) reached[static_cast<std::size_t>(next[value])] = 1;
        }
        if (reached == from_root_[level + 1]) return;
        from_root_[level + 1] = std::move(reached);
    }
}

/// Makes out again from which nodes of a level and above the end is reached, until nothing changes any more.
void OpenPaths::spread_up(std::size_t from) {
    for (std::size_t level = from + 1; level-- > 0;) {
        const std::vector<KeySpace::Node>& nodes = space_.level(level);
        const std::vector<char>& below = to_end_[level + 1];
        std::vector<char> reaching(nodes.size(), 0);
        for (std::size_t node = 0; node < nodes.size(); ++node) {
            const std::vector<int>& next = nodes[node].next;
            const std::size_t first = key_[level] < 0 ? 0 : static_cast<std::size_t>(key_[level]);
            const std::size_t end = key_[level] < 0 ? next.size() : first + 1;
            for (std::size_t value = first; value < end && reaching[node] == 0; ++value)
                reaching[node] =
                    next[value] != KeySpace::dead && below[static_cast<std::size_t>(next[value])] != 0;
        }
        if (reaching == to_end_[level]) return;
        to_end_[level] = std::move(reaching);
    }
}

}  // namespace gobo
