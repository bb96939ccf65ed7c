// What texture functions and derivatives must not be given.
#pragma once

#include <string_view>
#include <vector>

#include "lab/sanitize/trap_rules.hpp"

namespace gobo::sanitize {

inline constexpr std::string_view kParted = "derivatives where neighbouring pixels go another way";
inline constexpr std::string_view kPartedByDiscard = "derivatives after neighbouring pixels were discarded";

struct ImageFault {
    std::string_view message;
    Lanes lanes = 0;
};

/// Those of a step that is a texture function or takes a derivative. Operands stand ready. What depends on a
/// texture's size is judged where that is stated. `callers` are the lanes that are invocations at all.
[[nodiscard]] std::vector<ImageFault> image_faults(const evaluate::Step<float>& step,
                                                   const evaluate::Invocations& invocations, Lanes callers);

}  // namespace gobo::sanitize
