#include "lab/commands/shard.hpp"

#include <charconv>

#include <fmt/format.h>

namespace gobo {
namespace {

struct Shard {
    std::size_t number = 0;
    std::size_t count = 0;
};

Result<Shard> read_shard(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
        const auto count = std::from_chars(number.ptr + 1, end, shard.count);
        if (count.ec == std::errc() && count.ptr == end && shard.number >= 1 && shard.number <= shard.count)
            return shard;
    }
    return fail(Fault::usage, fmt::format("'{}' is no shard", text),
                "write its number and how many there are, such as 2/4");
}

}  // namespace

Result<std::vector<Key>> shard_of(std::vector<Key> keys, const std::string& text) {
    if (text.empty()) return keys;
    const Result<Shard> shard = read_shard(text);
    if (!shard) return tl::unexpected(shard.error());
    std::vector<Key> part;
    for (std::size_t i = shard->number - 1; i < keys.size(); i += shard->count) part.push_back(keys[i]);
    return part;
}

}  // namespace gobo
