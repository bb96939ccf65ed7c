// The constraints of a family as calls of a generated header's check().
#pragma once

#include <optional>
#include <string>

#include "emit/sections.hpp"
#include "family/constraint.hpp"

namespace gobo {

/// A call, within a loop for each index.
struct ConstraintCall {
    std::string text;
    bool is_counted = false;  ///< the loops end at `count`, where the other block ends in the array
};

/// The call that checks the constraint between members of `block` and of `other`, which may be the same: one
/// side must stand in each. The structs' names in the text are "block" and "other". Nothing where no members
/// are so named, or none that the constraint can be said of.
[[nodiscard]] std::optional<ConstraintCall> constraint_call(const Constraint& constraint,
                                                            const CppBlock& block, const CppBlock& other);

}  // namespace gobo
