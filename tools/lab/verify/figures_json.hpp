// The figures of a verification for other programs: docs/models.md is made of them.
#pragma once

#include <string>

#include "lab/verify/verify.hpp"

namespace gobo::verify {

/// The family's name and `permutations`, in the report's order: for each its key's text, how many points it
/// was tried at, and its largest fp32 and fp64 errors, relative to the largest term of the light
/// (docs/formats.md). An error that is no finite number is null. A newline ends the text.
[[nodiscard]] std::string figures_json(const Family& family, const VerifyReport& report);

}  // namespace gobo::verify
