// The extensions of glTF's material that are features of the family `pbr`, one row each: what is read of
// them, when a draw needs them, and the uniforms that take their numbers.
#pragma once

#include <string>
#include <vector>

#include "scene/document.hpp"

namespace gobo::scene {

/// A number, or a colour, that an extension states.
struct ExtensionProperty {
    const char* name;             ///< "clearcoatFactor"
    const char* uniform;          ///< "Material.clearcoat"
    std::vector<double> initial;  ///< where the file does not state it; three numbers are a colour
    Range range = kUpToOne;       ///< of each number
    std::vector<double> (*to_uniform)(double) = nullptr;  ///< where the uniform holds something else
};

/// Which light shows an extension: lights, or the mirrored environment as well, or light from all around,
/// too.
enum class SeenBy { lights, reflection, probes };

/// An extension that is one value of one feature.
struct MaterialExtension {
    const char* name;  ///< "KHR_materials_clearcoat"
    const char* feature;
    const char* value;
    /// The first says how much there is of it: where it is 0, nothing is seen.
    std::vector<ExtensionProperty> properties;
    std::vector<const char*> pictures;  ///< of its own, which no family looks up
    SeenBy seen_by;
};

[[nodiscard]] const std::vector<MaterialExtension>& material_extensions();

/// The names of all extensions of materials that PhysicalMaterial takes in, or that say nothing to see.
[[nodiscard]] std::vector<std::string> read_material_extensions();

}  // namespace gobo::scene
