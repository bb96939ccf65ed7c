// Keys that differ in name only.
#pragma once

#include "compose/composition.hpp"

namespace gobo {

/// One warning where several keys compose to the same two stages: the first two of them and how many more
/// there are. The family lacks a rule then by which what cannot matter stands at its default.
[[nodiscard]] Diagnostics same_stages(const Family& family, const Composition& composition);

}  // namespace gobo
