// Points for a stage of any family, drawn from what the family says its inputs may hold.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"

namespace gobo::verify {

/// That of a port or field; null where none is declared.
[[nodiscard]] const Domain* domain_of(const std::vector<Domain>& domains, const std::string& name);

/// `count` invocations with inputs and uniforms of their own, floats within the domains and within 1e3; from
/// -1 to 1 where no domain is declared. Every texture is one smooth picture.
[[nodiscard]] evaluate::Invocations draw_points(const evaluate::Program& program,
                                                const std::vector<Domain>& domains, std::size_t count,
                                                std::uint64_t seed);

/// By name, component by component, as evaluate::Outputs::values.
using NamedValues = std::map<std::string, std::vector<double>, std::less<>>;

/// The largest component of an output at a point, of so many points.
[[nodiscard]] double largest_component(const std::vector<double>& values, std::size_t count,
                                       std::size_t index);

/// How far outputs move, at most, as the points are moved by `step` a few times: `run` evaluates points,
/// `outputs` are those where nothing is moved.
[[nodiscard]] Result<NamedValues> spread(
    const std::vector<evaluate::Port>& ports, const evaluate::Invocations& base, const NamedValues& outputs,
    double step, std::uint64_t seed,
    const std::function<Result<NamedValues>(const evaluate::Invocations&)>& run);

/// The outputs of one program in fp64, and their spread over all that it is given.
[[nodiscard]] Result<NamedValues> in_double(const evaluate::Program& program,
                                            const evaluate::Invocations& points);
[[nodiscard]] Result<NamedValues> spread(const evaluate::Program& program, const evaluate::Invocations& base,
                                         const NamedValues& outputs, double step, std::uint64_t seed);

/// Of a spread measured with roundings of 2^-24, or explained by a step: moving inputs so far crosses it.
inline constexpr double kRoundingStep = 0x1p-24;
inline constexpr double kEdgeStep = 1e-5;

}  // namespace gobo::verify
