// Permutations of the dialect vulkan drawn as pictures: the same objects, values and views as OpenGL's
// renderer has, in Vulkan's clip space.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
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

/// How a texture is looked up.
struct TextureLookup {
    enum class Beyond { repeat, mirror, edge };  ///< outside 0 to 1: `edge`, the border's texels go on
    Beyond s = Beyond::repeat;
    Beyond t = Beyond::repeat;
    bool enlarges_nearest = false;  ///< without interpolation between texels
    bool shrinks_nearest = false;
    bool nearest_level = false;  ///< of smaller levels one, not two
};

/// The texels of a texture, layer by layer: colours of four channels, or depths of one. Row 0 is that at t =
/// 0.
struct TextureTexels {
    enum class Shape { flat, array, cube, volume };
    Shape shape = Shape::flat;
    bool is_depth = false;  ///< compared as sampler2DShadow does: reference <= depth
    TextureLookup lookup = {};
    bool has_levels = false;
    std::vector<std::vector<float>> smaller;  ///< the levels behind the first; empty: means of four texels
    int width = 1;
    int height = 1;
    int layers = 1;
    std::vector<float> values;
};
/// Those that several draws look up are uploaded once.
using Texels = std::shared_ptr<const TextureTexels>;
/// By the name of their sampler.
using Textures = std::map<std::string, Texels>;

/// What the renderer has for a sampler that nothing is given to, as make_texture() of OpenGL's renderer;
/// null where it has none of the type.
[[nodiscard]] Texels usual_texels(const std::string& sampler_type, const TextureSource& source,
                                  TextureLevels levels);
/// Level by level six faces, one below the other.
[[nodiscard]] Texels cube_texels(const std::vector<Image>& levels);
/// A table of four channels, looked up from its first texel to its last.
[[nodiscard]] Texels table_texels(const Image& table);
/// Shadow maps, as draw_shadow_maps() draws them.
[[nodiscard]] Texels depth_texels(const std::vector<Image>& layers);

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

/// What some draws of a picture have in common: the stages of a permutation, and what its uniforms hold but
/// for what objects say themselves. What is referred to outlives it.
struct DrawnBy {
    std::vector<StageModule> stages;
    const Interface& interface;
    const std::vector<RenderValue>& values;
};

struct Draw {
    std::size_t by = 0;  ///< the number of its permutation
    const Object& object;
    const Textures& textures;
    bool is_blended = false;  ///< over what is there, by its alpha; its depth is not written
};

/// Draws in their order to one picture. `view` has OpenGL's projection; `begins` is told of each permutation
/// when the driver is given it. Errors as of render_permutation().
[[nodiscard]] Result<Picture> render_draws(const Device& device, const std::vector<DrawnBy>& permutations,
                                           const std::vector<Draw>& draws, ViewedObject view, int width,
                                           int height, const std::array<float, 4>& background,
                                           const std::function<void(std::size_t permutation)>& begins = {},
                                           const DrawStart& start = {});

/// What draws shadow maps: `pass` with its stages as modules.
struct ShadowPass {
    std::vector<StageModule> stages;
    Interface interface;
    std::vector<RenderValue> values;
    int side = 1024;
    double slope = 2;  ///< as of DepthPass
    double units = 4;
};

/// The depth of all objects as each camera of a plan sees them, those with holes by draws of their own, of
/// `permutations`; row 0 of each is that at t = 0.
[[nodiscard]] Result<std::vector<Image>> draw_shadow_maps(const Device& device, const ShadowPass& pass,
                                                          const ShadowPlan& plan,
                                                          const std::vector<Object>& objects,
                                                          const std::vector<DrawnBy>& permutations = {},
                                                          const std::vector<Draw>& with_holes = {});

/// Draws a selection by Vulkan, as opengl_renderer() does by OpenGL; `modules` are by stage.
[[nodiscard]] std::unique_ptr<KeyRenderer> vulkan_renderer(
    const Device& device, const DrawnSelection& selection,
    const std::vector<std::span<const std::uint32_t>>& modules, const Textures& textures = {},
    const ShadowPass* pass = nullptr);

}  // namespace gobo::vulkan
