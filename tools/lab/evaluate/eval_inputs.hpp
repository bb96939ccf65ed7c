// The input file of `gobo eval`: which stage, and what it is given.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

/// One value of the file.
struct EvalValue {
    std::vector<double> numbers;  ///< component by component; matrices column by column
    Place place;
    std::string quoted_line;
};

/// What the file says. Names are those of reflection.
struct EvalInputs {
    std::string stage = "fragment";             ///< or "vertex"
    std::map<std::string, EvalValue> inputs;    ///< [inputs]
    std::map<std::string, EvalValue> uniforms;  ///< [uniforms]
    std::map<std::string, EvalValue> samplers;  ///< [samplers], as SamplerNumbers
};

/// Reads
///
///     stage = "fragment"
///     [inputs]
///     normal = [0, 0, 1]
///     [uniforms]
///     "PointLights.lights[0].position" = [0, 1, 2, 1]
///     [samplers]
///     shadowMap = [1, 1, 1, 1]
///
/// Numbers, booleans and (nested) arrays of them are values; a table inside a section adds to the name.
/// Errors stand at their line of `path`.
[[nodiscard]] Result<EvalInputs> read_eval_inputs(std::string_view text, const std::string& path);

/// The one invocation that the file describes. Every name that the stage does not have and every wrong number
/// of components is an error at its line.
[[nodiscard]] Result<Invocations> invocations_of(const EvalInputs& inputs, const Program& program);

/// A note for each input variable that the file does not name: it is 0.
[[nodiscard]] Diagnostics inputs_left_out(const EvalInputs& inputs, const Program& program);

}  // namespace gobo::evaluate
