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
/// - "read" of an input that a function mentions, even where nothing calls it
/// - "[]" of an array without a size
/// - "offset" of a member whose place its block states by offset or align
/// - "highp", "mediump" or "lowp" of a struct's member, "Lamp.color" of the struct's own name, and of what a
///   stage writes in it, "lamps.color" or "Surface.lamp.color"; of a member of an array of blocks
/// - "rgba8" or another format of an image, as "map.format"
/// - "located" of a block's member that states its own location, and its block none
/// - "std140", "std430", "shared" or "packed" of a uniform or storage block: its layout, by default too
/// - "free" of a block without binding, and of an input or output without location
/// - "apart" of a block's first member that stands at another location than its block
using Stated = std::map<std::string, std::string, std::less<>>;

/// By "float" and "int"; nothing on the desktop, where a precision is what is written.
using DefaultPrecisions = std::map<std::string_view, std::string_view>;

/// Those before a stage states any; nothing either where its prologue does.
[[nodiscard]] DefaultPrecisions default_precisions(StageKind kind, std::string_view prologue);

/// Those of a stage's active text; nothing of declarations in which macros stand.
[[nodiscard]] Stated stated_in(const ActiveText& text, DefaultPrecisions precisions);

/// Takes away the bindings and locations of what is free, which glslang gives what it links with others. The
/// rest it puts into Usage::stated of variables, members of blocks, uniforms and samplers, and precisions
/// into Usage::precision of the members of structs, of which they make two types.
void set_stated(Interface& interface, const Stated& stated);

}  // namespace gobo
