// Textures: what samplers read that a family leaves to the renderer, and pictures given to samplers by name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "family/family.hpp"
#include "lab/render/context.hpp"
#include "lab/render/image.hpp"

namespace gobo {

/// Textures that are there already, by the name of their sampler; whoever made them deletes them.
using GivenTextures = std::map<std::string, Texture>;

/// The value given last to that name, else to the elements of all arrays ("surfaces[].albedo"), or null.
[[nodiscard]] const RenderValue* find_value(const std::vector<RenderValue>& values, std::string_view name);

/// The type of sampler that looks up a texture which Vulkan has apart from it: "texture2D" gives "sampler2D".
/// Others stay.
[[nodiscard]] std::string combined_type(std::string_view type);

/// Whether make_texture() knows the type of sampler, or of what it would be if it were one.
[[nodiscard]] bool has_texture(std::string_view sampler_type);

/// What a texture is made of: a name that make_texture() knows, or one colour.
struct TextureSource {
    std::string name;
    std::vector<double> numbers;
};

/// What the values say last of that sampler; where they do not, what its name tells.
[[nodiscard]] TextureSource texture_source_of(const std::string& sampler,
                                              const std::vector<RenderValue>& values);
[[nodiscard]] const std::vector<std::string>& texture_sources();

/// The texels of a texture of colours, four channels; row 0 is that at t = 0.
[[nodiscard]] Image texture_texels(const TextureSource& source);

/// Whether smaller copies stand in for a texture that is seen from afar.
enum class TextureLevels { all, one };

/// Makes a texture for a sampler type; the caller deletes it. Nothing where the renderer has none for that
/// type (it has for sampler2D, sampler2DArray, sampler3D, samplerCube, sampler2DShadow and
/// sampler2DArrayShadow).
///
/// texture_checker: squares of 0.25 and 1, eight a side. texture_white: 1. texture_ramp: from 0 to 1 along x.
/// texture_normal: the undisturbed normal (0.5, 0.5, 1). texture_lattice: opaque but for
/// one round hole. Empty with `numbers` (one to four): that colour.
/// Shadow maps hold the depth 1, so that nothing is in shadow, or `numbers`' first.
[[nodiscard]] std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                                  const TextureSource& source,
                                                  TextureLevels levels = TextureLevels::all);

/// Levels of an environment that is blurred by roughness, which rises evenly from 0 to 1.
inline constexpr int kRoughnessLevels = 7;

/// What environmentBrdfTable looks up, in four channels: A, B, 0, 1 (see environment_brdf_table()).
[[nodiscard]] Image environment_brdf_image();

/// Textures made from pictures, deleted together: for pictures lit by an environment.
class EnvironmentMaps {
  public:
    explicit EnvironmentMaps(const Context& context) : resources_(context) {}

    /// A picture of side x 6 side texels, the faces +x -x +y -y +z -z one below the other, as the texture of
    /// a samplerCube of that name; its alpha is 1. Fault::input where the picture has another shape.
    [[nodiscard]] Result<void> add(const std::string& sampler, const Image& faces) {
        return add(sampler, std::vector{faces});
    }
    /// The same level by level, each half as wide as the one before; lookups between two blend them.
    [[nodiscard]] Result<void> add(const std::string& sampler, const std::vector<Image>& levels);
    /// A table of four channels as the texture of a sampler2D, looked up from its first texel to its last.
    void add_table(const std::string& sampler, const Image& table);
    [[nodiscard]] const GivenTextures& textures() const { return textures_; }

  private:
    GlResources resources_;
    GivenTextures textures_;
};

}  // namespace gobo
