// A glTF scene as this application holds it: meshes, materials, and what each draw is lit by.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "lab/render/mesh.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lit.hpp"
#include "physical_draw.hpp"
#include "scene/effects.hpp"
#include "scene/read_scene.hpp"
#include "settings.hpp"

namespace viewer {

/// What a draw needs, in the application's own terms: members named after features are what
/// lit::select() takes.
struct DrawState {
    int directional = 0;
    int point = 0;
    int spot = 0;
    int directional_shadows = 0;
    int point_shadows = 0;
    int spot_shadows = 0;
    lit::Diffuse diffuse = lit::Diffuse::lambert;
    lit::Specular specular = lit::Specular::none;
    lit::Fog fog = lit::Fog::none;
    lit::Sides sides = lit::Sides::one;
    lit::VertexColor vertex_color = lit::VertexColor::none;
    lit::AmbientFeature ambient = lit::AmbientFeature::global;
    lit::Shading shading = lit::Shading::fragment;
};

/// One primitive, ready to be drawn.
struct StageDraw {
    std::string name;
    gobo::Mesh mesh;
    glm::dmat4 model{1};
    glm::dvec3 middle{0};  ///< of its bounds, in world space
    bool double_sided = false;
    lit::Material material{};
    lit::Fog_block fog{};
    lit::Toon toon{};
    gobo::scene::Probe probe;
    DrawState state;
    std::optional<PhysicalDraw> physical;  ///< in place of the above, where the scene is read for `pbr`
    std::vector<std::string> not_drawn;    ///< effects that it needs, but that this viewer lacks
    /// The lights that reach it, by their number among all lights of the scene; those with shadows first.
    std::vector<std::size_t> lights;
    std::vector<std::size_t> shadows;  ///< that it receives, by their number among the stage's
};

/// A scene, and where its lights are.
struct Stage {
    gobo::scene::Scene scene;
    std::vector<StageDraw> draws;
    std::vector<gobo::ShadowLight> shadow_lights;
    glm::dvec3 center{0};
    double radius = 1;  ///< of a sphere that has all draws in it
};

/// Reads the scene, for the family `lit` or `pbr`. Effects are decided for a camera that may be anywhere, as
/// this one's may.
[[nodiscard]] gobo::Result<Stage> read_stage(const gobo::FileSystem& files, const std::string& path,
                                             gobo::scene::Reading reading);

/// The state with the settings applied: what they turn off is not needed.
[[nodiscard]] DrawState under(const DrawState& state, const Settings& settings);

}  // namespace viewer
