// What OpenGL itself says of a linked program: a cross-check of gobo's reflection.
#pragma once

#include <string>
#include <vector>

#include "lab/render/bind.hpp"

namespace gobo {

/// The active interface of a program, flattened as OpenGL lists it.
struct ProgramInterface {
    std::vector<Block> blocks;  ///< without members, which stand in `leaves`
    std::vector<Leaf> leaves;   ///< sorted by name
    std::vector<Sampler> samplers;
    std::vector<Variable> inputs;   ///< built-in ones left out
    std::vector<Variable> outputs;  ///< likewise
};

/// Asks by program interface queries. The context must have OpenGL 4.3 or later (open_context() gives 4.5).
/// Members of blocks without an instance name, which OpenGL lists bare, are put after their block's name.
[[nodiscard]] ProgramInterface interface_of_program(const Context& context, const Program& program);

/// Every respect in which the driver contradicts the reflection, a sentence each; empty where they agree.
/// Blocks and their members must agree in everything: name, type, offset, extent, strides, order, size,
/// stages, binding where the source states one. Of plain uniforms, samplers, inputs and outputs a driver
/// lists what is used: what it lists must be in the reflection with the same type, what it leaves out is
/// reported as unused. The extent of a plain array may be smaller (Mesa cuts off what is not read).
[[nodiscard]] std::vector<std::string> differences(const Interface& reflected,
                                                   const ProgramInterface& driver);

}  // namespace gobo
