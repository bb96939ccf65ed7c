// A program's picture from meshes, a camera and values by name.
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "lab/render/render.hpp"
#include "reflect_compile.hpp"

namespace gobo {
namespace {

constexpr const char* vertex_source = R"(#version 450
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(std140, binding = 3) uniform Transforms {
    layout(row_major) mat4 modelView;
    mat4 projection;
    mat3 normalMatrix;
};
layout(location = 0) out vec3 normal;
layout(location = 1) out vec3 eyePosition;
void main() {
    eyePosition = (modelView * vec4(aPosition, 1.0)).xyz;
    normal = normalMatrix * aNormal;
    gl_Position = projection * vec4(eyePosition, 1.0);
}
)";

constexpr const char* fragment_source = R"(#version 450
struct Light { vec3 position; vec3 color; };
layout(std140, binding = 1) uniform Lights { Light lights[2]; };
layout(std140, binding = 2) uniform Material { vec3 diffuse; bool twoSided; };
layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 eyePosition;
layout(location = 0) out vec4 color;
void main() {
    vec3 sum = vec3(0.02);
    for (int i = 0; i < 2; ++i) {
        float cosine = dot(normalize(normal), normalize(lights[i].position - eyePosition));
        sum += diffuse * lights[i].color * (twoSided ? abs(cosine) : max(cosine, 0.0));
    }
    color = vec4(sum, 1.0);
}
)";

const std::vector<RenderValue> lights = {
    {"Lights.lights[0].position", "eye_point", {4, 5, 3}, {}},
    {"Lights.lights[0].color", "", {1, 0.9, 0.7}, {}},
    {"Lights.lights[1].position", "eye_point", {-5, 2, 4}, {}},
    {"Lights.lights[1].color", "", {0.1, 0.2, 0.4}, {}},
    {"Lights.lights[2].color", "", {9, 9, 9}, {}},  // beyond this permutation's count: left out
    {"Fog.start", "", {1}, {}},                     // of a block that this permutation does not have
    {"Material.diffuse", "", {0.8, 0.8, 0.8}, {}},
    {"Material.twoSided", "", {0}, {}},
};

std::vector<StageText> stages(const char* vertex, const char* fragment) {
    return {stage_text(StageKind::vertex, "picture.vert", vertex),
            stage_text(StageKind::fragment, "picture.frag", fragment)};
}

Interface interface_of(const char* vertex, const char* fragment) {
    return merge({testing::interface_of_stage(testing::Stage::vertex, vertex),
                  testing::interface_of_stage(testing::Stage::fragment, fragment)});
}

class Pictures : public ::testing::TestWithParam<Backend> {
  protected:
    void SetUp() override {
        auto context = open_context(GetParam());
        // EGL is optional: OSMesa alone must draw, so only its absence is a failure.
        if (!context && GetParam() == Backend::egl) GTEST_SKIP() << to_text(context.error());
        ASSERT_TRUE(context) << to_text(context.error());
        context_.emplace(std::move(*context));
    }
    std::optional<Context> context_;
};

TEST_P(Pictures, SphereIsLitAsTheEquationSays) {
    View view;
    view.width = view.height = 65;
    view.camera.position = {3, 4, 5};
    const auto picture = render_permutation(*context_, stages(vertex_source, fragment_source),
                                            interface_of(vertex_source, fragment_source),
                                            {{make_sphere(128, 64), glm::dmat4(1), {}}}, lights, view);
    ASSERT_TRUE(picture) << to_text(picture.error());
    EXPECT_EQ(to_text(picture->warnings), "");
    // The middle pixel sees the point of the sphere that faces the camera.
    const glm::dvec3 point = glm::normalize(view.camera.position);
    const double first = glm::dot(point, glm::normalize(glm::dvec3(4, 5, 3) - point));
    const double second = glm::dot(point, glm::normalize(glm::dvec3(-5, 2, 4) - point));
    // The mesh is inscribed: 128 slices lie up to 1 - cos(pi / 128) = 3e-4 below the sphere, and its
    // interpolated normals are off by less.
    EXPECT_NEAR(picture->color.at(32, 32, 0), 0.02 + 0.8 * (first + 0.1 * std::max(second, 0.0)), 5e-4);
    EXPECT_NEAR(picture->color.at(32, 32, 2), 0.02 + 0.8 * (0.7 * first + 0.4 * std::max(second, 0.0)), 5e-4);
    EXPECT_EQ(picture->color.at(0, 0, 0), 0.0F);
    EXPECT_EQ(picture->depth.at(0, 0, 0), 1.0F);
    const double distance = glm::length(view.camera.position) - 1;
    const double depth = 100 / (100 - 0.1) * (1 - 0.1 / distance);
    // d(depth) / d(distance) is 0.1 / distance^2 = 3e-3, times the mesh's 3e-4.
    EXPECT_NEAR(picture->depth.at(32, 32, 0), depth, 2e-6);
}

TEST_P(Pictures, TeapotOnAPlane) {
    const DiskFileSystem files;
    const auto teapot = read_obj(files, GOBO_SOURCE_DIR "/data/meshes/teapot.obj");
    ASSERT_TRUE(teapot) << to_text(teapot.error());
    View view;
    view.width = 320;
    view.height = 240;
    view.camera.position = {12, 24, 44};
    view.camera.target = {0, 6, 0};
    view.camera.far_plane = 200;
    const std::vector<Object> objects = {{*teapot,
                                          glm::translate(glm::dmat4(1), glm::dvec3(0, 7.875, 0)),
                                          {{"Material.diffuse", "", {0.8, 0.3, 0.2}, {}}}},
                                         {make_plane(60, 8), glm::dmat4(1), {}}};
    std::vector<RenderValue> values = lights;
    values[0].numbers = {15, 30, 20};
    values[2].numbers = {-25, 15, 10};
    const auto picture =
        render_permutation(*context_, stages(vertex_source, fragment_source),
                           interface_of(vertex_source, fragment_source), objects, values, view);
    ASSERT_TRUE(picture) << to_text(picture.error());
    // The teapot's middle is red, the plane before it grey, the sky black.
    EXPECT_GT(picture->color.at(160, 130, 0), 2 * picture->color.at(160, 130, 1));
    EXPECT_NEAR(picture->color.at(160, 230, 0), picture->color.at(160, 230, 1), 0.1);
    EXPECT_EQ(picture->color.at(2, 2, 0), 0.0F);
    EXPECT_LT(picture->depth.at(160, 130, 0), 1.0F);
}

INSTANTIATE_TEST_SUITE_P(Render, Pictures, ::testing::Values(Backend::osmesa, Backend::egl),
                         [](const auto& row) { return std::string(name_of(row.param)); });

/// GLSL 330 states no bindings and has plain uniforms; every kind of them is set and shown as a channel.
TEST(Picture, PlainUniformsAndSamplersOf330) {
    const auto context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error());
    const char* const vertex = R"(#version 330
in vec3 position;
uniform mat4 u_mvp;
void main() { gl_Position = u_mvp * vec4(position, 1.0); }
)";
    const char* const fragment = R"(#version 330
struct Part { float gain[3]; ivec2 shift; };
uniform Part parts[2];
uniform uint mask;
uniform bool on;
uniform mat2x3 shear;
uniform sampler2D rampTexture;
uniform sampler2D tint;
struct Surface { float share; sampler2D albedo; };
uniform Surface surfaces[2];
layout(std140) uniform Second { vec2 pair; } second;
layout(std140) uniform First { float single[3]; } first;
out vec4 color;
void main() {
    color = vec4(parts[1].gain[2] + float(parts[0].shift.y), float(mask) + (on ? 0.5 : 0.0) + shear[1][2],
                 texture(rampTexture, vec2(0.5)).r + texture(tint, vec2(0.5)).g +
                 surfaces[1].share * texture(surfaces[1].albedo, vec2(0.5)).r + texture(surfaces[0].albedo, vec2(0.5)).r,
                 second.pair.y + first.single[2]);
}
)";
    const std::vector<RenderValue> values = {
        {"parts[1].gain", "", {1, 2, 4}, {}},
        {"parts[0].shift", "", {7, -3}, {}},
        {"parts[0].gain[1]", "", {8}, {}},
        {"parts[1].shift", "", {0, 0}, {}},
        {"mask", "", {5}, {}},
        {"on", "", {1}, {}},
        {"shear", "", {1, 2, 3, 4, 5, 6}, {}},
        {"tint", "", {0.25, 0.75, 0.5}, {}},
        {"surfaces[].albedo", "", {2, 0, 0}, {}},
        {"surfaces[1].albedo", "", {4, 0, 0}, {}},
        {"surfaces[].share", "", {0.5}, {}},
        {"Second.pair", "", {100, 200}, {}},
        {"First.single[1]", "", {10, 20}, {}},
    };
    View view;
    view.width = view.height = 9;
    // Names of GLSL 330 are the same in 450, whose locations the reflection's compiler makes up.
    Interface interface = interface_of(vertex, fragment);
    for (Block& block : interface.blocks) block.binding = -1;
    for (Sampler& sampler : interface.samplers) sampler.binding = -1;
    for (Variable& input : interface.inputs) input.location = -1;
    const auto picture = render_permutation(*context, stages(vertex, fragment), interface,
                                            {{make_sphere(16, 8), glm::dmat4(1), {}}}, values, view);
    ASSERT_TRUE(picture) << to_text(picture.error());
    EXPECT_EQ(to_text(picture->warnings), "");
    EXPECT_EQ(picture->color.at(4, 4, 0), 1.0F);
    EXPECT_EQ(picture->color.at(4, 4, 1), 11.5F);
    EXPECT_NEAR(picture->color.at(4, 4, 2), 0.5 + 0.75 + 0.5 * 4 + 2,
                1e-6);  // the sampler interpolates floats
    EXPECT_EQ(picture->color.at(4, 4, 3), 220.0F);
}

TEST(Picture, WhatHasNoValueIsWarnedOf) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error());
    const char* const vertex = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 wind;
layout(location = 0) uniform mat4 mvp;
void main() { gl_Position = mvp * vec4(position + wind, 1.0); }
)";
    const char* const fragment = R"(#version 450
struct Light { vec3 color; float range; };
layout(std140, binding = 0) uniform Lights { Light lights[2]; };
layout(binding = 1) uniform sampler1D table;
layout(location = 0) out vec4 color;
void main() { color = vec4(lights[1].color, texture(table, lights[0].range).r); }
)";
    const auto picture =
        render_permutation(*context, stages(vertex, fragment), interface_of(vertex, fragment),
                           {{make_plane(1, 1), glm::dmat4(1), {}}, {make_plane(2, 1), glm::dmat4(1), {}}},
                           {{"Lights.lights[1].color", "", {1, 1, 1}, {}}}, View());
    ASSERT_TRUE(picture) << to_text(picture.error());
    EXPECT_EQ(to_text(picture->warnings),
              "gobo: warning: the renderer has no texture for 'table' of type sampler1D\n"
              "  help: it reads as black\n"
              "gobo: warning: 'Lights.lights[].range' has no value and stays 0\n"
              "  help: give it one under [render] in the family file\n"
              "gobo: warning: the attribute 'wind' has no value and stays 0\n"
              "  help: give it one under [render] in the family file\n");
    EXPECT_EQ(to_text(picture->background_alone),  // planes seen along themselves
              "gobo: warning: the picture is the background alone: nothing of the objects is drawn\n"
              "  help: see what gl_Position is, and which fragments are discarded\n");
}

struct ColorRow {
    const char* name;
    const char* version;
    const char* body;     ///< of the fragment stage
    const char* warning;  ///< in part; empty where green is drawn
};

class Colors : public ::testing::TestWithParam<ColorRow> {};

TEST_P(Colors, AreDrawnOrWarnedOf) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error());
    const bool is_old = std::string_view(GetParam().version) < "130";
    const std::string head = fmt::format("#version {}\n", GetParam().version);
    const std::string vertex = head + (is_old ? "attribute" : "in") +
                               " vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";
    const std::string fragment = head + "void main() { " + GetParam().body + " }\n";
    Variable position;
    position.name = "position";
    position.type = "vec3";
    position.location = -1;
    Interface interface;
    interface.stages = {"vertex", "fragment"};
    interface.inputs = {position};
    View view;
    view.width = view.height = 9;
    const auto picture = render_permutation(*context, stages(vertex.c_str(), fragment.c_str()), interface,
                                            {{make_sphere(16, 8), glm::dmat4(1), {}}}, {}, view);
    ASSERT_TRUE(picture) << to_text(picture.error());
    const std::string warning = GetParam().warning;
    EXPECT_EQ(picture->color.at(4, 4, 1), warning.empty() ? 1.0F : 0.0F);
    EXPECT_EQ(to_text(picture->warnings), "");
    EXPECT_EQ(to_text(picture->background_alone),
              warning.empty() ? "" : "gobo: warning: the picture is the background alone: " + warning);
}

constexpr const char* nothing_drawn =
    "nothing of the objects is drawn\n  help: see what gl_Position is, and which fragments are discarded\n";
constexpr const char* no_color =
    "the fragment stage writes no color\n  help: declare an output at location 0\n";

INSTANTIATE_TEST_SUITE_P(
    Render, Colors,
    ::testing::Values(ColorRow{"fragment_color_100", "100", "gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);", ""},
                      ColorRow{"fragment_color_120", "120", "gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);", ""},
                      ColorRow{"fragment_data_120", "120", "gl_FragData[0] = vec4(0.0, 1.0, 0.0, 1.0);", ""},
                      ColorRow{"fragment_color_130", "130", "gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0);", ""},
                      ColorRow{"discarded", "120", "gl_FragColor = vec4(1.0); discard;", nothing_drawn},
                      ColorRow{"no_color", "330", "", no_color}),
    [](const auto& row) { return row.param.name; });

struct BadValue {
    const char* name;
    RenderValue value;
    const char* text;
};

class BadValues : public ::testing::TestWithParam<BadValue> {};

TEST_P(BadValues, AreErrorsAtTheirPlace) {
    RenderValue value = GetParam().value;
    value.place = {"demo.toml", 7, 3};
    const Interface interface = interface_of(vertex_source, fragment_source);
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error());
    const auto picture = render_permutation(*context, stages(vertex_source, fragment_source), interface,
                                            {{make_plane(1, 1), glm::dmat4(1), {}}}, {value}, View());
    ASSERT_FALSE(picture);
    EXPECT_EQ(to_text(picture.error()), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Render, BadValues,
    ::testing::Values(BadValue{"misspelt_member",
                               {"Material.difuse", "", {1, 1, 1}, {}},
                               "demo.toml:7:3: error: 'Material' has no member 'Material.difuse'\n"
                               "  help: did you mean 'Material.diffuse'?\n"},
                      BadValue{"too_few_numbers",
                               {"Material.diffuse", "", {1, 1}, {}},
                               "demo.toml:7:3: error: 'Material.diffuse' is given 2 numbers\n"
                               "  help: it is of type vec3: give 3\n"},
                      BadValue{"too_many_elements",
                               {"Material.twoSided", "", {1, 1}, {}},
                               "demo.toml:7:3: error: 'Material.twoSided' is given 2 numbers\n"
                               "  help: it is of type bool: give 1\n"},
                      BadValue{"unknown_source",
                               {"Material.diffuse", "eye_pont", {1, 1, 1}, {}},
                               "demo.toml:7:3: error: unknown source 'eye_pont' for 'Material.diffuse'\n"
                               "  help: did you mean 'eye_point'?\n"},
                      BadValue{"matrix_for_a_vector",
                               {"Material.diffuse", "model", {}, {}},
                               "demo.toml:7:3: error: the source 'model' with 0 numbers cannot supply "
                               "'Material.diffuse' of type vec3\n"
                               "  help: matrices go to matrices, vectors to vectors\n"},
                      BadValue{"unknown_attribute_source",
                               {"aNormal", "normals", {}, {}},
                               "demo.toml:7:3: error: unknown source 'normals' for 'aNormal'\n"
                               "  help: did you mean 'normal'?\n"}),
    [](const auto& row) { return row.param.name; });

struct SpellingRow {
    const char* name;
    const char* spelling;
    const char* uniform;
    const char* attribute;
};

class Spellings : public ::testing::TestWithParam<SpellingRow> {};

TEST_P(Spellings, AreUnderstood) {
    EXPECT_EQ(uniform_source_of(GetParam().spelling), GetParam().uniform);
    EXPECT_EQ(attribute_source_of(GetParam().spelling), GetParam().attribute);
}

INSTANTIATE_TEST_SUITE_P(
    Render, Spellings,
    ::testing::Values(SpellingRow{"capitals", "uMVP", "model_view_projection", ""},
                      SpellingRow{"underscore", "u_mvp", "model_view_projection", ""},
                      SpellingRow{"words", "model_view_projection_matrix", "model_view_projection", ""},
                      SpellingRow{"member", "Camera.viewMatrix", "view", ""},
                      SpellingRow{"in_prefix", "inPosition", "", "position"},
                      SpellingRow{"a_prefix", "a_texCoord", "", "texcoord"},
                      SpellingRow{"v_is_a_letter_of_view", "view", "view", ""},
                      SpellingRow{"once_built_in", "legacy_Vertex", "", "position"},
                      SpellingRow{"matrix_once_built_in", "legacy_ModelViewProjectionMatrix",
                                  "model_view_projection", ""},
                      SpellingRow{"texcoord_once_built_in", "legacy_MultiTexCoord0", "", "texcoord"},
                      SpellingRow{"normal", "aNormal", "normal_matrix", "normal"},
                      SpellingRow{"none", "shininess", "", ""}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
