// The part of a generated header that says where attributes, outputs, samplers, uniforms and blocks are
// bound.
#pragma once

#include <map>
#include <string>

#include "emit/header_templates.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// A copy in which every block, sampler and attribute has a place: where the source states none, the lowest
/// that is free, in the order of names; a single output stands at 0. Names that OpenGL itself supplies (gl_*)
/// are left out.
[[nodiscard]] Interface with_places(Interface interface);

/// Adds the values of the templates' placeholders about the interface, which has places.
void describe_interface(const Interface& interface, const std::vector<Domain>& domains,
                        TemplateValues& values);

}  // namespace gobo
