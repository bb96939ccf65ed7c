// Permutations of the dialect vulkan drawn as pictures: the same objects, values and views as OpenGL's
// renderer has, in Vulkan's clip space.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "lab/render/render_selection.hpp"
#include "lab/vulkan/device.hpp"
#include "reflect/interface.hpp"

namespace gobo::vulkan {

/// One stage, and what its specialisation constants are set to.
struct StageModule {
    StageKind kind = StageKind::vertex;
    std::span<const std::uint32_t> words;
    std::vector<SpecializedCount> specialized;
};

/// The stages of a permutation; `modules` by stage of the composition.
[[nodiscard]] std::vector<StageModule> modules_of(const std::vector<std::span<const std::uint32_t>>& modules,
                                                  const Permutation& permutation);

/// The texels of a texture, layer by layer: colours of four channels, or depths of one. Row 0 is that at t =
/// 0.
struct TextureTexels {
    enum class Shape { flat, array, cube, volume };
    Shape shape = Shape::flat;
    bool is_depth = false;  ///< compared as sampler2DShadow does: reference <= depth
    bool repeats = true;    ///< beyond 0 to 1; else the border's texels go on
    bool has_levels = false;
    std::vector<std::vector<float>> smaller;  ///< the levels behind the first; empty: means of four texels
    int width = 1;
    int height = 1;
    int layers = 1;
    std::vector<float> values;
};
/// By the name of their sampler.
using Textures = std::map<std::string, TextureTexels>;

/// What the renderer has for a sampler that nothing is given to, as make_texture() of OpenGL's renderer;
/// nothing where it has none of the type.
[[nodiscard]] std::optional<TextureTexels> usual_texels(const std::string& sampler_type,
                                                        const TextureSource& source, TextureLevels levels);
/// Level by level six faces, one below the other.
[[nodiscard]] TextureTexels cube_texels(const std::vector<Image>& levels);
/// A table of four channels, looked up from its first texel to its last.
[[nodiscard]] TextureTexels table_texels(const Image& table);
/// Shadow maps, as draw_shadow_maps() draws them.
[[nodiscard]] TextureTexels depth_texels(const std::vector<Image>& layers);

/// From OpenGL's clip space to Vulkan's: depth 0 to 1, y downward. A projection behind this draws upright
/// pictures whose triangles run as OpenGL's do.
[[nodiscard]] glm::dmat4 clip_space_of_pictures();
/// The same with y upward: what texture coordinates of 0 to 1 then find in the map is what OpenGL's find.
[[nodiscard]] glm::dmat4 clip_space_of_maps();

/// Where a draw's numbers of vertices and instances begin, and which vertex gives a triangle's flat values:
/// the last as in OpenGL, else the first, as Vulkan has it.
struct DrawStart {
    std::int32_t vertex = 0;
    std::uint32_t instance = 0;
    bool flat_from_last = true;
};

/// Draws the objects once and reads the result, as render_permutation() of OpenGL's renderer does. Errors: of
/// the driver and of validation layers; of the values (see resolve_uniforms()); of the size.
[[nodiscard]] Result<Picture> render_permutation(const Device& device, const std::vector<StageModule>& stages,
                                                 const Interface& interface,
                                                 const std::vector<Object>& objects,
                                                 const std::vector<RenderValue>& values, const View& view,
                                                 const Textures& textures = {}, const DrawStart& start = {});

/// What draws shadow maps: `pass` with its stages as modules.
struct ShadowPass {
    std::vector<StageModule> stages;
    Interface interface;
    std::vector<RenderValue> values;
    int side = 1024;
    double slope = 2;  ///< as of DepthPass
    double units = 4;
};

/// The depth of all objects as each camera of a plan sees them; row 0 of each is that at t = 0.
[[nodiscard]] Result<std::vector<Image>> draw_shadow_maps(const Device& device, const ShadowPass& pass,
                                                          const ShadowPlan& plan,
                                                          const std::vector<Object>& objects);

/// Draws a selection by Vulkan, as opengl_renderer() does by OpenGL; `modules` are by stage.
[[nodiscard]] std::unique_ptr<KeyRenderer> vulkan_renderer(
    const Device& device, const DrawnSelection& selection,
    const std::vector<std::span<const std::uint32_t>>& modules, const Textures& textures = {},
    const ShadowPass* pass = nullptr);

}  // namespace gobo::vulkan
