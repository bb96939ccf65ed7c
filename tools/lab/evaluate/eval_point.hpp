// One invocation as numbers, and as the file with which `gobo eval` repeats it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lab/evaluate/texture_content.hpp"

namespace gobo::evaluate {

/// What one invocation is given, by reflected name, component by component.
struct EvalPoint {
    std::map<std::string, std::vector<double>> inputs;
    std::map<std::string, std::vector<double>> uniforms;
    SamplerNumbers samplers;
};

/// Invocation `index` of a stage's inputs. What the invocations do not name is left out.
[[nodiscard]] EvalPoint point_of(const Program& program, const Invocations& invocations, std::size_t index);

/// How numbers are written.
enum class Digits {
    all,       ///< so that they read back as the same doubles
    of_float,  ///< so that they read back as the same floats, where they are floats
};

/// The point as an input file: the lines of `comment`, `stage`, `[inputs]`, `[uniforms]` and `[samplers]`.
[[nodiscard]] std::string eval_file(std::string_view stage, const EvalPoint& point, std::string_view comment,
                                    Digits digits);

}  // namespace gobo::evaluate
