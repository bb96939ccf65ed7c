#include "render/texture.hpp"

#include <algorithm>
#include <array>
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

Texel texel(const std::string& source, const std::vector<double>& numbers, int x, int y) {
    if (source == "texture_white") return {1, 1, 1, 1};
    if (source == "texture_normal") return {0.5F, 0.5F, 1, 1};
    if (source == "texture_lattice") {  // opaque but for one round hole
        const float across = (static_cast<float>(x) + 0.5F) / side - 0.5F;
        const float up = (static_cast<float>(y) + 0.5F) / side - 0.5F;
        return {1, 1, 1, std::clamp(4 * std::hypot(across, up) - 0.7F, 0.0F, 1.0F)};
    }
    if (source == "texture_ramp") {
        const float value = (static_cast<float>(x) + 0.5F) / side;
        return {value, value, value, 1};
    }
    if (source == "texture_checker") {
        const float value = (x * 8 / side + y * 8 / side) % 2 == 0 ? 0.25F : 1.0F;
        return {value, value, value, 1};
    }
    Texel color = {0, 0, 0, 1};
    for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 4); ++i)
        color[i] = static_cast<float>(numbers[i]);
    return color;
}

void fill_color(const GladGLContext& gl, GLenum target, const std::string& source,
                const std::vector<double>& numbers) {
    std::vector<Texel> texels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) texels.push_back(texel(source, numbers, x, y));
    if (target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D) {
        gl.TexImage3D(target, 0, GL_RGBA32F, side, side, 1, 0, GL_RGBA, GL_FLOAT, texels.data());
    } else {
        const bool cube = target == GL_TEXTURE_CUBE_MAP;
        const GLenum first = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : target;
        for (GLenum face = first; face < first + (cube ? 6U : 1U); ++face)
            gl.TexImage2D(face, 0, GL_RGBA32F, side, side, 0, GL_RGBA, GL_FLOAT, texels.data());
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

std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                    const std::string& source, const std::vector<double>& numbers) {
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
        fill_depth(gl, texture.target, numbers);
    } else {
        fill_color(gl, texture.target, source, numbers);
    }
    return texture;
}

}  // namespace gobo
