// Which keys of a family are meant: named ones, all, a cover.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/whole_number.hpp"
#include "family/family.hpp"

namespace gobo {

/// No selection enumerates more keys than this.
constexpr std::uint64_t most_keys = 1'000'000;

/// The selected keys: canonical, valid in the dialect, sorted, each once. Where the selection names nothing,
/// the family's declared default set; where it declares none, all keys if they are at most 256, else a 2-way
/// cover. Fault::usage for unknown features and values, forbidden keys (with the reason), and more than
/// `most_keys`.
[[nodiscard]] Result<std::vector<Key>> select(const Family& family, const Selection& selection,
                                              std::string_view dialect);

/// How many keys select() would give, without enumerating where only `all` is asked for.
[[nodiscard]] Result<WholeNumber> count_selected(const Family& family, const Selection& selection,
                                                 std::string_view dialect);

/// The keys of a text, one a line; blank lines and what follows `#` are left out.
[[nodiscard]] std::vector<NamedKey> keys_of_text(std::string_view text, const std::string& path);

}  // namespace gobo
