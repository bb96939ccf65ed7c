// Which names a depfile can hold: make and ninja read different ones.
#pragma once

#include <set>
#include <string>

#include "core/diagnostic.hpp"

namespace gobo {

/// Whether make reads the name as emit_depfile() writes it.
[[nodiscard]] bool make_reads(const std::string& name);

/// A warning where emit_depfile() leaves files out, or where the output cannot be said, and one where ninja
/// misreads a name and so builds every time.
[[nodiscard]] Diagnostics check_depfile_names(const std::string& output, const std::set<std::string>& files);

}  // namespace gobo
