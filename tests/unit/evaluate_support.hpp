// Compiles GLSL for the tests of evaluation, through glslang, with debug information.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lab/evaluate/evaluate.hpp"

namespace gobo::evaluate {

enum class ShaderStage { vertex, fragment };

/// The SPIR-V of a stage whose source is called "test.glsl".
[[nodiscard]] std::vector<std::uint32_t> compile(ShaderStage stage, const std::string& source);

/// compile() and decode(); fails the test where either does.
[[nodiscard]] Program program_of(ShaderStage stage, const std::string& source);

/// A fragment stage of GLSL 450 with inputs a, b, c (vec4), uniforms none, and the output `vec4 r`, whose
/// main() consists of `body`; `declarations` stand before it.
[[nodiscard]] Program fragment_of(const std::string& body, const std::string& declarations = {});

/// Runs one invocation with the given values, in double or float; fails the test where it cannot.
template <class T>
[[nodiscard]] std::vector<double> output_of(
    const Program& program, const std::map<std::string, std::vector<double>, std::less<>>& values,
    const std::string& output = "r");

}  // namespace gobo::evaluate
