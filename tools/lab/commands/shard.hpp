// Part of a selection: what one of several test jobs takes.
#pragma once

#include "gobo/command.hpp"

namespace gobo {

/// Every n-th key of the selection, from the i-th on (1 to n), for `text` "i/n"; all keys where it is empty.
/// The shards of a selection together hold each key once. Fault::usage for another text.
[[nodiscard]] Result<std::vector<Key>> shard_of(std::vector<Key> keys, const std::string& text);

}  // namespace gobo
