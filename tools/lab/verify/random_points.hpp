// Points for a stage of any family, drawn from what the family says its inputs may hold.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/evaluate/evaluate.hpp"
#include "family/family.hpp"

namespace gobo::verify {

/// "PointLights.lights[2].color" as domains name it: "PointLights.lights[].color".
[[nodiscard]] std::string without_subscripts(const std::string& name);

/// `count` invocations with inputs and uniforms of their own, floats within the domains and within 1e3; from
/// -1 to 1 where no domain is declared. Every texture is one smooth picture.
[[nodiscard]] evaluate::Invocations draw_points(const evaluate::Program& program,
                                                const std::vector<Domain>& domains, std::size_t count,
                                                std::uint64_t seed);

/// Every number of type float moved up or down, at random, by `step` relative to itself.
[[nodiscard]] evaluate::Invocations moved(const std::vector<evaluate::Port>& ports,
                                          const evaluate::Invocations& base, double step, std::uint64_t seed);

}  // namespace gobo::verify
