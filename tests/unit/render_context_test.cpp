// Contexts, programs and framebuffers on both backends.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/render/context.hpp"
#include "lab/render/program.hpp"
#include "lab/render/render.hpp"

namespace gobo {
namespace {

constexpr const char* vertex_source = R"(#version 330
in vec2 position;
void main() { gl_Position = vec4(position, 0.5, 1.0); }
)";
constexpr const char* fragment_source = R"(#version 330
out vec4 color;
void main() { color = vec4(2.5, -1.0, 0.25, 1.0); }
)";

/// Covers the lower left half of an 8 x 8 picture with one colour at depth 0.75.
void draw_triangle(const Context& context, Image& color, Image& depth) {
    const auto framebuffer = make_framebuffer(context, 8, 8);
    ASSERT_TRUE(framebuffer) << to_text(framebuffer.error());
    const auto program = link_program(context, {stage_text(StageKind::vertex, "a.vert", vertex_source),
                                                stage_text(StageKind::fragment, "a.frag", fragment_source)});
    ASSERT_TRUE(program) << to_text(program.error());
    const GladGLContext& gl = context.gl();
    framebuffer->bind();
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    const std::array<float, 6> corners = {-1, -1, 1, -1, -1, 1};
    GLuint array = 0;
    GLuint buffer = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl.BufferData(GL_ARRAY_BUFFER, sizeof corners, corners.data(), GL_STATIC_DRAW);
    const auto location = static_cast<GLuint>(gl.GetAttribLocation(program->id(), "position"));
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl.UseProgram(program->id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    color = framebuffer->read_color();
    depth = framebuffer->read_depth();
    gl.DeleteBuffers(1, &buffer);
    gl.DeleteVertexArrays(1, &array);
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

void expect_triangle(const Image& color, const Image& depth) {
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            if (x == y) continue;       // the centre lies on the edge: either is right
            const bool inside = x < y;  // the top row is row 0
            EXPECT_EQ(color.at(x, y, 0), inside ? 2.5F : 0.0F) << x << ", " << y;
            EXPECT_EQ(color.at(x, y, 1), inside ? -1.0F : 0.0F) << x << ", " << y;
            EXPECT_EQ(depth.at(x, y, 0), inside ? 0.75F : 1.0F) << x << ", " << y;
        }
    }
}

class Backends : public testing::TestWithParam<Backend> {};

TEST_P(Backends, DrawUnclampedFloats) {
    const auto context = open_context(GetParam());
    // EGL is optional: OSMesa alone must draw, so only its absence is a failure.
    if (!context && GetParam() == Backend::egl) GTEST_SKIP() << to_text(context.error());
    ASSERT_TRUE(context) << to_text(context.error());
    EXPECT_EQ(context->backend(), GetParam());
    EXPECT_GE(context->version(), 45);
    EXPECT_THAT(context->renderer(), testing::HasSubstr("llvmpipe"));
    Image color;
    Image depth;
    draw_triangle(*context, color, depth);
    expect_triangle(color, depth);
}

TEST_P(Backends, GiveOpenGl33) {
    const auto context = open_context(GetParam(), 33);
    // As above: EGL is optional.
    if (!context && GetParam() == Backend::egl) GTEST_SKIP() << to_text(context.error());
    ASSERT_TRUE(context) << to_text(context.error());
    EXPECT_GE(context->version(), 33);
}

INSTANTIATE_TEST_SUITE_P(Render, Backends, testing::Values(Backend::osmesa, Backend::egl),
                         [](const auto& row) { return std::string(name_of(row.param)); });

TEST(Context, TwoBackendsTakeTurnsInOneThread) {
    const auto osmesa = open_context(Backend::osmesa);
    ASSERT_TRUE(osmesa) << to_text(osmesa.error());
    const auto egl = open_context(Backend::egl);
    // As above: EGL is optional.
    if (!egl) GTEST_SKIP() << to_text(egl.error());
    for (int round = 0; round < 2; ++round) {
        for (const Context& context : {*osmesa, *egl}) {
            Image color;
            Image depth;
            draw_triangle(context, color, depth);
            expect_triangle(color, depth);
        }
    }
}

TEST(Context, UnknownBackend) {
    const auto backend = backend_of("elg");
    ASSERT_FALSE(backend);
    EXPECT_EQ(to_text(backend.error()), "gobo: error: unknown backend 'elg'\n  help: did you mean 'egl'?\n");
}

TEST(Context, NoSuchVersion) {
    const auto context = open_context(Backend::osmesa, 49);
    ASSERT_FALSE(context);
    EXPECT_EQ(to_text(context.error()), "gobo: error: OSMesa gives no OpenGL 4.9 core profile\n");
}

TEST(Framebuffer, SizeMustBePossible) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    const auto framebuffer = make_framebuffer(*context, 0, 8);
    ASSERT_FALSE(framebuffer);
    EXPECT_EQ(to_text(framebuffer.error()),
              "gobo: error: cannot draw a picture of 0 x 8 pixels\n  help: choose both from 1 to 16384\n");
}

TEST(Program, DriverErrorsNameThePieceAndItsOwnLine) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    StageText fragment{StageKind::fragment, {}};
    fragment.pieces.push_back({"prologue", "lit.toml", "#version 450 core\n#define LIGHTS 3\n", false});
    fragment.pieces.push_back({"fog/linear.glsl", "lib/fog/linear.glsl",
                               "float fog(float d) {\n    return mxi(d, 1.0, 0.5);\n}\n", true});
    fragment.pieces.push_back(
        {"lit.frag", "lit.frag",
         "layout(location = 0) out vec4 color;\nvoid main() { color = vec3(fog(1.0)); }\n", true});
    const auto program =
        link_program(*context, {stage_text(StageKind::vertex, "a.vert", vertex_source), fragment});
    ASSERT_FALSE(program);
    EXPECT_EQ(to_text(program.error()),
              "lib/fog/linear.glsl:2: error: no function with name 'mxi'\n"
              "        return mxi(d, 1.0, 0.5);\n"
              "lib/fog/linear.glsl:2: error: could not implicitly convert return value to float, in function "
              "`fog'\n"
              "        return mxi(d, 1.0, 0.5);\n"
              "lit.frag:2: error: value of type vec3 cannot be assigned to variable of type vec4\n"
              "    void main() { color = vec3(fog(1.0)); }\n");
}

TEST(Program, LinkErrorsAreReported) {
    const auto context = open_context(Backend::osmesa);
    ASSERT_TRUE(context);
    const auto program =
        link_program(*context, {stage_text(StageKind::vertex, "a.vert",
                                           "#version 330\nout vec4 normal;\n"
                                           "void main() { normal = vec4(1.0); gl_Position = vec4(1.0); }\n"),
                                stage_text(StageKind::fragment, "a.frag",
                                           "#version 330\nin vec3 normal;\nout vec4 color;\n"
                                           "void main() { color = vec4(normal, 1.0); }\n")});
    ASSERT_FALSE(program);
    EXPECT_EQ(to_text(program.error()),
              "gobo: error: vertex shader output `normal' declared as type `vec4', but fragment shader input "
              "declared as type `vec3'\n");
}

struct LogRow {
    const char* name;
    const char* log;
    const char* text;
};

class DriverLogs : public testing::TestWithParam<LogRow> {};

TEST_P(DriverLogs, AreMappedToPieces) {
    StageText stage{StageKind::fragment, {}};
    stage.pieces.push_back({"first", "first.glsl", "one\ntwo\n", true});
    stage.pieces.push_back({"empty", "empty.glsl", "", true});
    stage.pieces.push_back({"last", "last.glsl", "three\nfour", true});
    EXPECT_EQ(to_text(diagnostics_of_log(GetParam().log, stage)), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Render, DriverLogs,
    testing::Values(
        LogRow{"mesa_counts_over_all_strings", "0:4(7): error: bad\n", "last.glsl:2: error: bad\n    four\n"},
        LogRow{"mesa_warning", "0:2(1): warning: odd\n", "first.glsl:2: warning: odd\n    two\n"},
        LogRow{"nvidia_counts_per_string", "2(1) : error C1503: bad\n",
               "last.glsl:1: error: C1503: bad\n    three\n"},
        LogRow{"others_count_per_string", "ERROR: 2:2: bad\n", "last.glsl:2: error: bad\n    four\n"},
        LogRow{"no_such_string", "ERROR: 9:2: bad\n", "gobo: error: bad\n"},
        LogRow{"no_place", "out of memory\n\n", "gobo: error: out of memory\n"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
