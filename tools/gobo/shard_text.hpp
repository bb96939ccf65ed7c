// A shard's results, with what gobo merge needs to know of them.
#pragma once

#include <string>

#include "core/diagnostic.hpp"

namespace gobo {

struct Shard {
    std::string path;
    std::string number;  ///< "1/2"
    std::string run;     ///< run_of_shards()
    std::string text;    ///< the results: a JSON document that begins with "{\n", or a CSV table
};

/// The results with number, run and a checksum of all: the first members of a JSON document, or a last line
/// of its own behind a CSV table. They alone where `number` is empty.
[[nodiscard]] std::string text_of_shard(std::string results, const std::string& number,
                                        const std::string& run);

/// The shard at `path` whose text_of_shard() is given; an error where it is none, or another than was
/// written.
[[nodiscard]] Result<Shard> read_shard(const std::string& path, std::string_view text);

}  // namespace gobo
