#include "lab/render/texture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace gobo {
namespace {

constexpr int side = 64;
using Texel = std::array<float, 4>;

struct TargetRow {
    std::string_view sampler_type;
    GLenum target;
    bool shadow;
};
constexpr auto targets = std::to_array<TargetRow>({
    {"sampler2D", GL_TEXTURE_2D, false},
    {"sampler2DArray", GL_TEXTURE_2D_ARRAY, false},
    {"sampler3D", GL_TEXTURE_3D, false},
    {"samplerCube", GL_TEXTURE_CUBE_MAP, false},
    {"sampler2DShadow", GL_TEXTURE_2D, true},
    {"sampler2DArrayShadow", GL_TEXTURE_2D_ARRAY, true},
});

Texel texel(const TextureSource& source, int x, int y) {
    if (source.name == "texture_white") return {1, 1, 1, 1};
    if (source.name == "texture_normal") return {0.5F, 0.5F, 1, 1};
    if (source.name == "texture_lattice") {
        const float across = (static_cast<float>(x) + 0.5F) / side - 0.5F;
        const float up = (static_cast<float>(y) + 0.5F) / side - 0.5F;
        return {1, 1, 1, std::clamp(4 * std::hypot(across, up) - 0.7F, 0.0F, 1.0F)};
    }
    if (source.name == "texture_ramp") {
        const float value = (static_cast<float>(x) + 0.5F) / side;
        return {value, value, value, 1};
    }
    if (source.name == "texture_checker") {
        const float value = (x * 8 / side + y * 8 / side) % 2 == 0 ? 0.25F : 1.0F;
        return {value, value, value, 1};
    }
    Texel color = {0, 0, 0, 1};
    for (std::size_t i = 0; i < std::min<std::size_t>(source.numbers.size(), 4); ++i)
        color[i] = static_cast<float>(source.numbers[i]);
    return color;
}

/// What stands in a sampler's place where the family does not say.
std::string usual_texture(std::string_view sampler) {
    std::string name(sampler);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const auto mentions = [&](const char* word) { return name.find(word) != std::string::npos; };
    if (mentions("normal")) return "texture_normal";
    return mentions("ramp") || mentions("lut") ? "texture_ramp" : "texture_checker";
}

void fill_color(const GladGLContext& gl, GLenum target, const TextureSource& source, TextureLevels levels) {
    const Image image = texture_texels(source);
    const float* const texels = image.values.data();
    if (target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D) {
        gl.TexImage3D(target, 0, GL_RGBA32F, side, side, 1, 0, GL_RGBA, GL_FLOAT, texels);
    } else {
        const bool cube = target == GL_TEXTURE_CUBE_MAP;
        const GLenum first = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : target;
        for (GLenum face = first; face < first + (cube ? 6U : 1U); ++face)
            gl.TexImage2D(face, 0, GL_RGBA32F, side, side, 0, GL_RGBA, GL_FLOAT, texels);
    }
    if (levels == TextureLevels::one) {
        gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        return;
    }
    gl.GenerateMipmap(target);
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

void fill_depth(const GladGLContext& gl, GLenum target, const std::vector<double>& numbers) {
    const float depth = numbers.empty() ? 1.0F : static_cast<float>(numbers.front());
    if (target == GL_TEXTURE_2D_ARRAY) {
        // One layer: OpenGL clamps what is asked of later ones to it.
        gl.TexImage3D(target, 0, GL_DEPTH_COMPONENT32F, 1, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    } else {
        gl.TexImage2D(target, 0, GL_DEPTH_COMPONENT32F, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    }
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(target, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

}  // namespace

TextureSource texture_source_of(const std::string& sampler, const std::vector<RenderValue>& values) {
    const auto found = std::find_if(values.rbegin(), values.rend(),
                                    [&](const RenderValue& value) { return value.name == sampler; });
    if (found == values.rend()) return {usual_texture(sampler), {}};
    return {found->source, found->numbers};
}

Image texture_texels(const TextureSource& source) {
    Image image(side, side, 4);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Texel color = texel(source, x, y);
            for (int channel = 0; channel < 4; ++channel)
                image.at(x, y, channel) = color[static_cast<std::size_t>(channel)];
        }
    }
    return image;
}

std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                    const TextureSource& source, TextureLevels levels) {
    const auto* const row = std::find_if(targets.begin(), targets.end(), [&](const TargetRow& known) {
        return known.sampler_type == sampler_type;
    });
    if (row == targets.end()) return std::nullopt;
    context.make_current();
    const GladGLContext& gl = context.gl();
    Texture texture;
    texture.target = row->target;
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(texture.target, texture.name);
    gl.TexParameteri(texture.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (row->shadow) {
        fill_depth(gl, texture.target, source.numbers);
    } else {
        fill_color(gl, texture.target, source, levels);
    }
    return texture;
}

}  // namespace gobo
