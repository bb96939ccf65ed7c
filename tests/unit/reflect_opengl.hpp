// A second independent witness of reflection: what OpenGL's program-interface queries say of a linked
// program.
#pragma once

#include <string>
#include <vector>

#include "reflect/interface.hpp"
#include "render/context.hpp"
#include "render/program.hpp"

namespace gobo::testing {

/// The facts of an interface in OpenGL's terms, sorted.
struct OpenGlFacts {
    std::vector<std::string> blocks;  ///< uniform blocks with their sizes, every leaf member with its layout
    std::vector<std::string> bindings;  ///< of uniform blocks
    std::vector<std::string> others;    ///< plain uniforms, samplers, inputs, outputs

    friend bool operator==(const OpenGlFacts&, const OpenGlFacts&) = default;
};

[[nodiscard]] OpenGlFacts opengl_facts(const Interface& interface);
[[nodiscard]] OpenGlFacts opengl_facts(const Context& context, const Program& program);

}  // namespace gobo::testing
