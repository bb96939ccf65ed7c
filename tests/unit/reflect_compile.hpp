// Compiles GLSL in a test, so that reflection has a module to read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reflect/interface.hpp"

namespace gobo::testing {

enum class Stage { vertex, fragment };

/// What glslang makes of a stage.
struct Compiled {
    std::vector<std::uint32_t> spirv;
    GlTypes types;    ///< from glslang's reflection
    std::string log;  ///< empty where all went well
};

/// Compiles with OpenGL semantics. What has no location or binding is given one.
[[nodiscard]] Compiled compile(Stage stage, const std::string& source);

/// The interface of a stage that compiles, with its booleans; failing to compile it fails the test.
[[nodiscard]] Interface interface_of_stage(Stage stage, const std::string& source);

}  // namespace gobo::testing
