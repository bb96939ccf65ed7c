// What inputs may hold, as intervals.
#pragma once

#include "lab/prove/range.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::prove {

/// What a component of an input may hold. Unless `has_tiny_inputs`, what is nearer to 0 than
/// sanitize::kSmallest is 0, as in all that the sanitizer draws, where it is no bound of the domain.
[[nodiscard]] Range range_of(const sanitize::InputField& field, std::size_t component, bool has_tiny_inputs);

/// The whole numbers of a domain as the signed ones with the same bits, as all integers are held here.
[[nodiscard]] Range whole_numbers(gobo::Scalar scalar, double low, double high);

}  // namespace gobo::prove
