// What a stage states although it holds without, and what linkers compare all the same.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "reflect/interface.hpp"
#include "validate/active_text.hpp"

namespace gobo {

/// Words by the path of what is declared, "tint" or "Surface.normal" of a block's member:
/// - "smooth" of an input or output
/// - "[]" of an array without a size
/// - "offset" of a member whose place its block states by offset or align
/// - "highp", "mediump" or "lowp" of a struct's member, "Lamp.color" of the struct's own name
/// - "located" of a block's member that states its own location, and its block none
/// - "std140", "std430", "shared" or "packed" of a uniform or storage block: its layout, by default too
/// - "free" of a block without binding, and of an input or output without location
/// - "apart" of a block's first member that stands at another location than its block
using Stated = std::map<std::string, std::string, std::less<>>;

/// Those of a stage's active text; nothing of declarations in which macros stand.
[[nodiscard]] Stated stated_in(const ActiveText& text);

/// Takes away the bindings and locations of what is free, which glslang gives what it links with others. The
/// rest it puts into Usage::stated of variables, members of blocks, uniforms and samplers, and precisions
/// into Usage::precision of the members of uniforms: on the desktop they make two types of a struct.
void set_stated(Interface& interface, const Stated& stated);

}  // namespace gobo
