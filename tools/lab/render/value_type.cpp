#include "lab/render/value_type.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <glad/gl.h>

namespace gobo {
namespace {

constexpr auto types = std::to_array<ValueType>({
    {"float", GL_FLOAT, Component::float32, 1, 1},
    {"vec2", GL_FLOAT_VEC2, Component::float32, 1, 2},
    {"vec3", GL_FLOAT_VEC3, Component::float32, 1, 3},
    {"vec4", GL_FLOAT_VEC4, Component::float32, 1, 4},
    {"double", GL_DOUBLE, Component::float64, 1, 1},
    {"dvec2", GL_DOUBLE_VEC2, Component::float64, 1, 2},
    {"dvec3", GL_DOUBLE_VEC3, Component::float64, 1, 3},
    {"dvec4", GL_DOUBLE_VEC4, Component::float64, 1, 4},
    {"int", GL_INT, Component::int32, 1, 1},
    {"ivec2", GL_INT_VEC2, Component::int32, 1, 2},
    {"ivec3", GL_INT_VEC3, Component::int32, 1, 3},
    {"ivec4", GL_INT_VEC4, Component::int32, 1, 4},
    {"uint", GL_UNSIGNED_INT, Component::uint32, 1, 1},
    {"uvec2", GL_UNSIGNED_INT_VEC2, Component::uint32, 1, 2},
    {"uvec3", GL_UNSIGNED_INT_VEC3, Component::uint32, 1, 3},
    {"uvec4", GL_UNSIGNED_INT_VEC4, Component::uint32, 1, 4},
    {"bool", GL_BOOL, Component::boolean, 1, 1},
    {"bvec2", GL_BOOL_VEC2, Component::boolean, 1, 2},
    {"bvec3", GL_BOOL_VEC3, Component::boolean, 1, 3},
    {"bvec4", GL_BOOL_VEC4, Component::boolean, 1, 4},
    {"mat2", GL_FLOAT_MAT2, Component::float32, 2, 2},
    {"mat3", GL_FLOAT_MAT3, Component::float32, 3, 3},
    {"mat4", GL_FLOAT_MAT4, Component::float32, 4, 4},
    {"mat2x3", GL_FLOAT_MAT2x3, Component::float32, 2, 3},
    {"mat2x4", GL_FLOAT_MAT2x4, Component::float32, 2, 4},
    {"mat3x2", GL_FLOAT_MAT3x2, Component::float32, 3, 2},
    {"mat3x4", GL_FLOAT_MAT3x4, Component::float32, 3, 4},
    {"mat4x2", GL_FLOAT_MAT4x2, Component::float32, 4, 2},
    {"mat4x3", GL_FLOAT_MAT4x3, Component::float32, 4, 3},
    {"dmat2", GL_DOUBLE_MAT2, Component::float64, 2, 2},
    {"dmat3", GL_DOUBLE_MAT3, Component::float64, 3, 3},
    {"dmat4", GL_DOUBLE_MAT4, Component::float64, 4, 4},
    {"dmat2x3", GL_DOUBLE_MAT2x3, Component::float64, 2, 3},
    {"dmat2x4", GL_DOUBLE_MAT2x4, Component::float64, 2, 4},
    {"dmat3x2", GL_DOUBLE_MAT3x2, Component::float64, 3, 2},
    {"dmat3x4", GL_DOUBLE_MAT3x4, Component::float64, 3, 4},
    {"dmat4x2", GL_DOUBLE_MAT4x2, Component::float64, 4, 2},
    {"dmat4x3", GL_DOUBLE_MAT4x3, Component::float64, 4, 3},
});

constexpr auto samplers = std::to_array<std::pair<unsigned, std::string_view>>({
    {GL_SAMPLER_1D, "sampler1D"},
    {GL_SAMPLER_2D, "sampler2D"},
    {GL_SAMPLER_3D, "sampler3D"},
    {GL_SAMPLER_CUBE, "samplerCube"},
    {GL_SAMPLER_1D_SHADOW, "sampler1DShadow"},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
    {GL_SAMPLER_1D_ARRAY, "sampler1DArray"},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray"},
    {GL_SAMPLER_CUBE_MAP_ARRAY, "samplerCubeArray"},
    {GL_SAMPLER_1D_ARRAY_SHADOW, "sampler1DArrayShadow"},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow"},
    {GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, "samplerCubeArrayShadow"},
    {GL_SAMPLER_2D_MULTISAMPLE, "sampler2DMS"},
    {GL_SAMPLER_2D_MULTISAMPLE_ARRAY, "sampler2DMSArray"},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow"},
    {GL_SAMPLER_BUFFER, "samplerBuffer"},
    {GL_SAMPLER_2D_RECT, "sampler2DRect"},
    {GL_SAMPLER_2D_RECT_SHADOW, "sampler2DRectShadow"},
    {GL_INT_SAMPLER_1D, "isampler1D"},
    {GL_INT_SAMPLER_2D, "isampler2D"},
    {GL_INT_SAMPLER_3D, "isampler3D"},
    {GL_INT_SAMPLER_CUBE, "isamplerCube"},
    {GL_INT_SAMPLER_2D_ARRAY, "isampler2DArray"},
    {GL_INT_SAMPLER_BUFFER, "isamplerBuffer"},
    {GL_UNSIGNED_INT_SAMPLER_1D, "usampler1D"},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D"},
    {GL_UNSIGNED_INT_SAMPLER_3D, "usampler3D"},
    {GL_UNSIGNED_INT_SAMPLER_CUBE, "usamplerCube"},
    {GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, "usampler2DArray"},
    {GL_UNSIGNED_INT_SAMPLER_BUFFER, "usamplerBuffer"},
});

}  // namespace

std::optional<ValueType> value_type(std::string_view name) {
    // GLSL allows both spellings of the square matrices.
    if (name == "mat2x2") name = "mat2";
    if (name == "mat3x3") name = "mat3";
    if (name == "mat4x4") name = "mat4";
    const auto* found =
        std::find_if(types.begin(), types.end(), [&](const auto& type) { return type.name == name; });
    return found == types.end() ? std::nullopt : std::optional(*found);
}

std::optional<ValueType> value_type(unsigned enumerant) {
    const auto* found = std::find_if(types.begin(), types.end(),
                                     [&](const auto& type) { return type.enumerant == enumerant; });
    return found == types.end() ? std::nullopt : std::optional(*found);
}

std::string_view sampler_type_name(unsigned enumerant) {
    for (const auto& [number, name] : samplers)
        if (number == enumerant) return name;
    return {};
}

}  // namespace gobo
