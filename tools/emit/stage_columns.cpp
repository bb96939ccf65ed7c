#include "emit/stage_columns.hpp"

#include <algorithm>
#include <set>

namespace gobo {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Where the numbers of a list stand in `line`, each as early as can be; fewer where the line lacks one.
Numbers places_in(const Numbers& line, const Numbers& list) {
    Numbers places;
    auto at = line.begin();
    for (const std::size_t number : list) {
        at = std::find(at, line.end(), number);
        if (at == line.end()) break;
        places.push_back(static_cast<std::size_t>(at++ - line.begin()));
    }
    return places;
}

/// A shortest line that holds the numbers of both, each in its order (by the longest that they have in
/// common).
Numbers joined(const Numbers& left, const Numbers& right) {
    // A line may be long, but few of its numbers matter to one list.
    const std::set<std::size_t> in_right(right.begin(), right.end());
    Numbers places;
    for (std::size_t place = 0; place < left.size(); ++place)
        if (in_right.contains(left[place])) places.push_back(place);

    const std::size_t width = right.size() + 1;
    Numbers common((places.size() + 1) * width);  // of what is left of each
    for (std::size_t i = places.size(); i-- > 0;)
        for (std::size_t j = right.size(); j-- > 0;)
            common[i * width + j] = left[places[i]] == right[j]
                                        ? common[(i + 1) * width + j + 1] + 1
                                        : std::max(common[(i + 1) * width + j], common[i * width + j + 1]);

    Numbers line;
    std::size_t from_left = 0;
    std::size_t from_right = 0;
    const auto copy_to = [&line](const Numbers& numbers, std::size_t& from, std::size_t to) {
        for (; from < to; ++from) line.push_back(numbers[from]);
    };
    for (std::size_t i = 0, j = 0; i < places.size() && j < right.size();) {
        if (left[places[i]] == right[j]) {
            copy_to(left, from_left, places[i]);
            copy_to(right, from_right, j);
            copy_to(left, from_left, places[i] + 1);
            from_right = j + 1;
            ++i;
            ++j;
        } else if (common[(i + 1) * width + j] >= common[i * width + j + 1]) {
            ++i;
        } else {
            ++j;
        }
    }
    copy_to(left, from_left, left.size());
    copy_to(right, from_right, right.size());
    return line;
}

}  // namespace

StageColumns columns_of(const std::vector<Numbers>& lists, std::size_t most) {
    Numbers line;
    for (const Numbers& list : lists)
        if (places_in(line, list).size() < list.size()) line = joined(line, list);

    StageColumns table;
    table.rows.resize(lists.size());
    std::vector<Numbers> places;  // of each list, in `line`
    for (const Numbers& list : lists) places.push_back(places_in(line, list));
    Numbers begins(lists.size());  // of each list, where the column under way begins in its places
    Numbers ends(lists.size());
    Numbers choices(lists.size());
    std::size_t count = 1;  // of choices
    const auto close_column = [&] {
        std::vector<Numbers>& column = table.columns.emplace_back(count);
        for (std::size_t i = 0; i < lists.size(); ++i) {
            table.rows[i].push_back(choices[i]);
            const auto first = lists[i].begin();
            column[choices[i]].assign(first + static_cast<std::ptrdiff_t>(begins[i]),
                                      first + static_cast<std::ptrdiff_t>(ends[i]));
        }
        begins = ends;
        std::ranges::fill(choices, std::size_t{0});
        count = 1;
    };
    for (std::size_t place = 0; place < line.size();) {
        // Each choice stays one where all its lists have the number here, or none has; else it becomes two.
        Numbers widened(2 * count, kNone);
        std::size_t wide_count = 0;
        const auto has = [&](std::size_t i) {
            return ends[i] < places[i].size() && places[i][ends[i]] == place;
        };
        for (std::size_t i = 0; i < lists.size(); ++i) {
            std::size_t& choice = widened[2 * choices[i] + (has(i) ? 1 : 0)];
            if (choice == kNone) choice = wide_count++;
        }
        if (wide_count > most) {
            close_column();
            continue;
        }
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const bool is_here = has(i);
            choices[i] = widened[2 * choices[i] + (is_here ? 1 : 0)];
            if (is_here) ++ends[i];
        }
        count = wide_count;
        ++place;
    }
    if (!line.empty()) close_column();
    return table;
}

}  // namespace gobo
