// What the functions of a module do with its variables.
#pragma once

#include <set>
#include <utility>

#include "spirv/module.hpp"

namespace gobo::spirv {

/// A variable, or one member of it where it is a struct or a block; kWhole for all of it.
using Part = std::pair<Id, int>;

/// Only of functions that main() calls, directly or not: glslang keeps no others.
struct Usage {
    std::set<Part> read;
    std::set<Part> written;
    /// Outputs of which every path through main() that returns writes something.
    std::set<Part> always_written;
    bool discards = false;

    [[nodiscard]] bool reads(Id variable) const;
    [[nodiscard]] bool writes(Id variable) const;
};

[[nodiscard]] Usage usage_of(const Module& module);

/// The output that is this built-in variable: of its own, or a member of gl_PerVertex; Id::none where the
/// module declares none.
[[nodiscard]] Part built_in_output(const Module& module, spv::BuiltIn built_in);

}  // namespace gobo::spirv
