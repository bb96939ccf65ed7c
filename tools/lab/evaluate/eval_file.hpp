// One invocation as a file: what `gobo eval` reads, and what others write so that it repeats their point.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/images.hpp"

namespace gobo::evaluate {

/// One value of the file.
struct EvalValue {
    std::vector<double> numbers;  ///< component by component; matrices column by column
    Place place;
    std::string quoted_line;
    std::string text = {};  ///< where it is a name
};

/// What the file says. Names are those of reflection.
struct EvalInputs {
    std::string stage = "fragment";           ///< or "vertex"
    EvalValue machine;                        ///< `text` names the arithmetic; where empty, as the stage says
    std::size_t pixel = 0;                    ///< of the quad's four: which is told of
    std::map<std::string, EvalValue> inputs;  ///< [inputs]
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
/// Numbers, booleans and (nested) arrays of them are values; a table inside a section adds to the name. An
/// input of a fragment stage with four times its components has a value for each pixel of a quad, in the
/// order of Invocations; `pixel = 0` to 3 says which is meant. `machine = "flushed"` names a variant of
/// arithmetic. Errors stand at their line of `path`.
[[nodiscard]] Result<EvalInputs> read_eval_inputs(std::string_view text, const std::string& path);

/// The elements that an array needs so that the file's largest index is one of them.
[[nodiscard]] std::uint32_t longest_array(const EvalInputs& inputs);

/// The invocation that the file describes, or the four of its quad. Every name that the stage does not have
/// and every wrong number of components is an error at its line.
[[nodiscard]] Result<Invocations> invocations_of(const EvalInputs& inputs, const Program& program);

/// A note for each input variable that the file does not name: it is 0.
[[nodiscard]] Diagnostics inputs_left_out(const EvalInputs& inputs, const Program& program);

/// What one invocation is given, by reflected name, component by component.
struct EvalPoint {
    std::map<std::string, std::vector<double>> inputs;
    std::map<std::string, std::vector<double>> uniforms;
    SamplerNumbers samplers;
    std::size_t pixel = 0;  ///< of the quad, where inputs have a value for each
    std::string machine;    ///< empty: as written
};

/// Invocation `index` of a stage's inputs, where the stage needs quads with the other three. What the
/// invocations do not name is left out.
[[nodiscard]] EvalPoint point_of(const Program& program, const Invocations& invocations, std::size_t index);

/// How numbers are written.
enum class Digits {
    all,       ///< so that they read back as the same doubles
    of_float,  ///< so that they read back as the same floats, where they are floats
};

/// The shortest decimal that reads back the same; whole numbers of 32 bits with all their digits. Infinities
/// and NaN by name.
[[nodiscard]] std::string number_text(double number, Digits digits);

/// The point as an input file: the lines of `comment`, `stage`, `[inputs]`, `[uniforms]` and `[samplers]`.
[[nodiscard]] std::string eval_file(std::string_view stage, const EvalPoint& point,
                                    const std::vector<std::string>& comment, Digits digits);

}  // namespace gobo::evaluate
