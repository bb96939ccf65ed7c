// The part of a generated header that holds a block against its domain at run time.
#pragma once

#include <string>
#include <vector>

#include "emit/struct_section.hpp"

namespace gobo {

/// `check(block)` for each block: what of it lies outside the ranges that the family declares. Where the
/// block ends in an array, `check(block, count)` looks at no more elements of it.
[[nodiscard]] std::string check_section(const std::vector<NamedBlock>& blocks,
                                        const std::vector<Domain>& domains);

}  // namespace gobo
