// What an input or uniform may hold, and hard values within it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lab/evaluate/program.hpp"
#include "family/family.hpp"
#include "lab/sanitize/random.hpp"

namespace gobo::sanitize {

/// Numbers nearer to 0 than this are drawn only where a domain's own bounds are: coordinates and lengths
/// below it occur as exactly 0.
inline constexpr double kSmallest = 1e-6;

/// The domain of a stage's input or uniform: the family's where it declares one ("lights[]" is every
/// element); of built-in inputs what OpenGL gives; otherwise [-100, 100].
[[nodiscard]] Domain range_of(const evaluate::Port& port, const std::vector<Domain>& domains);

/// "PointLights.lights[2].color" as domains name it: "PointLights.lights[].color".
[[nodiscard]] std::string name_of_domain(const std::string& name);

/// Whether a component may hold the number. Not for domains of a length.
[[nodiscard]] bool holds(const Domain& domain, double number);

/// The numbers where shaders fail: 0, the bounds, the smallest, 1 and its neighbours, halves, band edges.
/// Of a component, or of a length where the domain is of one.
[[nodiscard]] std::vector<double> hard_numbers(const Domain& domain);

/// A number of the domain: evenly spread, or every power of ten as likely as any other.
[[nodiscard]] double ordinary_number(const Domain& domain, Random& random);

/// Fills in a unit vector: along an axis, a diagonal, nearly along an axis, or any.
void hard_direction(std::span<double> direction, Random& random);

}  // namespace gobo::sanitize
