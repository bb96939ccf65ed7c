// A sum of many lights as OpenGL draws it: 4096 equal terms through each piece that sums lights, in one
// fragment.
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "lab/render/program.hpp"
#include "lab/render/render.hpp"

namespace gobo {
namespace {

constexpr double kSum = 4096 * static_cast<double>(0.7F);

constexpr const char* kWholeTarget =
    "#version 450\n"
    "void main() {\n"
    "    gl_Position = vec4(vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0);\n"
    "}\n";

/// The terms come from a uniform, so that no compiler adds them up.
std::string stage_of(const std::string& piece) {
    return "#version 450\n#define LIGHT_PRECISION\nlayout(location = 0) out vec4 color;\nuniform float "
           "term;\n" +
           piece +
           "void main() {\n"
           "    LightSum sum = emptySum();\n"
           "    for (int i = 0; i < 4096; ++i) addTerm(sum, vec3(term));\n"
           "    color = vec4(totalOf(sum), 1.0);\n"
           "}\n";
}

std::vector<std::string> sum_pieces() {
    return piece_paths("light_sum/");
}

std::string piece_name(const std::string& path) {
    return std::filesystem::path(path).stem().string();
}

double drawn_sum(const Context& context, const std::string& path) {
    const Result<Framebuffer> target = make_framebuffer(context, 1, 1);
    const Result<Program> program =
        link_program(context, {stage_text(StageKind::vertex, "whole_target.vert", kWholeTarget),
                               stage_text(StageKind::fragment, path, stage_of(piece_text(path)))});
    EXPECT_TRUE(target);
    EXPECT_TRUE(program) << (program ? "" : to_text(program.error().front()));
    if (!target || !program) return 0;
    const GladGLContext& gl = context.gl();
    GLuint array = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    target->bind();
    gl.Disable(GL_DEPTH_TEST);
    gl.UseProgram(program->id());
    gl.Uniform1f(gl.GetUniformLocation(program->id(), "term"), 0.7F);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    const double sum = static_cast<double>(target->read_color().at(0, 0, 0));
    gl.DeleteVertexArrays(1, &array);
    return sum;
}

class DrawnLightSum : public testing::TestWithParam<std::string> {};

TEST_P(DrawnLightSum, HoldsItsBoundOver4096Terms) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    context->make_current();
    // As in light_sum_test: each plain addition costs half a unit of the total.
    const double tolerance = piece_name(GetParam()) == "plain" ? 4095 * 0x1p-24 : 1e-6;
    EXPECT_LE(std::abs(drawn_sum(*context, GetParam()) / kSum - 1), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Pieces, DrawnLightSum, testing::ValuesIn(sum_pieces()),
                         [](const auto& tested) { return piece_name(tested.param); });

}  // namespace
}  // namespace gobo
