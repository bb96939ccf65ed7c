// Reflection against OpenGL itself: the same hard layouts as before spirv-cross, linked on OSMesa.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program_interface.hpp"
#include "reflect_compile.hpp"
#include "reflect_shaders.hpp"

namespace gobo {
namespace {

using ::testing::IsEmpty;
using testing::Stage;

constexpr const char* plain_vertex = "#version 450\nvoid main() { gl_Position = vec4(1.0); }\n";

/// Where OpenGL's account of the linked program differs from `interface`.
std::vector<std::string> differences_from_opengl(const Interface& interface, const std::string& vertex,
                                                 const std::string& fragment) {
    const Result<Context> context = open_context(Backend::osmesa);
    if (!context) return {to_text(context.error().front())};
    const Result<Program> program =
        link_program(*context, {stage_text(StageKind::vertex, "a.vert", vertex),
                                stage_text(StageKind::fragment, "a.frag", fragment)});
    if (!program) return {to_text(program.error().front())};
    return differences(interface, interface_of_program(*context, *program));
}

class BlockLayout : public ::testing::TestWithParam<testing::Shader> {};

TEST_P(BlockLayout, AgreesWithOpenGl) {
    const std::string source = source_of(GetParam());
    Interface interface = merge(
        {interface_of_stage(Stage::vertex, plain_vertex), interface_of_stage(GetParam().stage, source)});
    EXPECT_FALSE(interface.blocks.empty());
    for (Block& block : interface.blocks) {
        block.stages.clear();  // OpenGL lists the stages that read a block, and none does
        // glslang hands out binding points where the source states none; OpenGL leaves them at 0.
        if (source.find("binding") == std::string::npos) block.binding = -1;
    }
    EXPECT_THAT(differences_from_opengl(interface, plain_vertex, source), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Shaders, BlockLayout, ::testing::ValuesIn(testing::block_shaders),
                         [](const auto& row) { return row.param.name; });

TEST(WholeProgram, AgreesWithOpenGl) {
    const std::string vertex = R"(#version 450
layout(std140, binding = 1) uniform Camera { mat4 viewProjection; mat3 normal; bool mirrored; } camera;
layout(location = 2) uniform float scales[3];
layout(location = 0) in vec3 position;
layout(location = 1) in mat3 frame;
layout(location = 4) in vec2 uvs[2];
layout(location = 6) in ivec2 ids;
layout(location = 0) out vec3 direction;
void main() {
    vec3 p = frame * position * scales[ids.x] + vec3(uvs[ids.y], 0.0);
    direction = camera.normal * p;
    gl_Position = camera.viewProjection * vec4(p, float(gl_VertexID));
}
)";
    const std::string fragment = R"(#version 450
struct Light { vec3 color; bool on; };
struct Surface { vec4 tint; float weights[2]; bool glossy; };
layout(std140, binding = 1) uniform Camera { mat4 viewProjection; mat3 normal; bool mirrored; } camera;
layout(std140, binding = 7) uniform Lights { int count; Light lights[4]; };
layout(location = 10) uniform Surface surfaces[2];
layout(location = 30) uniform bvec2 flags;
layout(binding = 3) uniform sampler2DArrayShadow shadows;
layout(binding = 5) uniform sampler2D maps[2];
layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 more[2];
layout(location = 3) out uint id;
void main() {
    Surface s = surfaces[count];
    color = s.tint * s.weights[count] + texture(shadows, vec4(direction, 0.5)) + texture(maps[1], direction.xy);
    if (s.glossy && lights[count].on || all(flags) || camera.mirrored) color += texture(maps[0], direction.yz);
    more[0] = color.wzyx;
    more[1] = color.xxyy;
    id = 7u;
}
)";
    const Interface interface =
        merge({interface_of_stage(Stage::vertex, vertex), interface_of_stage(Stage::fragment, fragment)});
    EXPECT_THAT(differences_from_opengl(interface, vertex, fragment), IsEmpty());
}

}  // namespace
}  // namespace gobo
