// What the attributes and samplers of an object get, whichever API draws it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/render/bind.hpp"
#include "lab/render/mesh.hpp"

namespace gobo {

/// What an attribute gets.
struct ChosenAttribute {
    AttributeValues values;
    bool is_constant = true;                           ///< four floats for all vertices
    std::optional<Diagnostic> warning = std::nullopt;  ///< nothing says what, and all are 0
};
/// What `values`, or else its name, say of an attribute, which a mesh or a constant gives it. Fault::input
/// for a source that is none of attributes.
[[nodiscard]] Result<ChosenAttribute> chosen_attribute(const std::string& name, const Mesh& mesh,
                                                       const std::vector<RenderValue>& values);

/// False for a fragment stage without a declared output for the picture's colours, which stay the background then.
[[nodiscard]] bool writes_color(const Interface& interface);

/// Fault::input where `values` give a sampler a source that is none of textures.
[[nodiscard]] Result<void> check_textures(const Interface& interface, const std::vector<RenderValue>& values);

}  // namespace gobo
