// What differs between Vulkan's clip space and OpenGL's, as docs/vulkan.md says it: each on a picture that
// looks different when it is turned over, drawn by both.
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/read_family.hpp"
#include "lab/render/program.hpp"
#include "lab/render/render.hpp"
#include "lab/vulkan/picture.hpp"
#include "lab/vulkan/state.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

constexpr int kSide = 32;

/// With the validation layer: what it says is an error of every picture.
vulkan::Device device_with_layer() {
    ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
    auto device = vulkan::open_device();
    EXPECT_TRUE(device) << (device ? "" : to_text(device.error().front()));
    return std::move(device).value();
}

/// A triangle in its own space, which the vertex stage may take for clip space.
Mesh triangle(const std::vector<glm::vec3>& corners) {
    return {corners, std::vector(3, glm::vec3(0, 0, 1)), std::vector(3, glm::vec2(0)), {0, 1, 2}};
}

/// In clip space the corner where x and y are -1, counter-clockwise where y points down.
const std::vector<glm::vec3> kCorner = {{-1, -1, 0.5F}, {-1, 0, 0.5F}, {0, -1, 0.5F}};

/// A pair of stages of a family that has nothing else.
struct Tiny {
    Tiny(const std::string& vertex, const std::string& fragment, Dialect dialect) {
        MemoryFileSystem files;
        EXPECT_TRUE(files.write("tiny.vert", vertex));
        EXPECT_TRUE(files.write("tiny.frag", fragment));
        SearchPath search;
        search.add(files, "", "", false);
        const Family family =
            read_family("name = \"tiny\"\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n", "tiny.toml",
                        {})
                .value();
        composition = compose(family, {Key{}}, search, dialect).value();
        validated = validate(family, composition, {.keep_spirv = true});
        for (const Diagnostic& diagnostic : validated.diagnostics) ADD_FAILURE() << to_text(diagnostic);
        interface = interface_of(validated, permutation());
    }
    [[nodiscard]] const Permutation& permutation() const { return composition.permutations.front(); }

    Composition composition;
    Validated validated;
    Interface interface;
};

/// The camera looks along -z from z = 5 at a square from -1 to 1.
View small_view() {
    View view;
    view.width = view.height = kSide;
    view.camera.field_of_view = 2 * std::atan(0.2);
    return view;
}

Picture checked(Result<Picture> picture) {
    EXPECT_TRUE(picture) << (picture ? "" : to_text(picture.error().front()));
    return picture ? *std::move(picture) : Picture{Image(kSide, kSide, 4), Image(kSide, kSide, 1), {}};
}

/// One picture by a pair of stages.
Picture drawn(const std::string& vertex, const std::string& fragment, const std::vector<glm::vec3>& corners,
              vulkan::DrawStart start = {}, const vulkan::Textures& textures = {}) {
    const Tiny tiny(vertex, fragment, Dialect::vulkan);
    std::vector<std::span<const std::uint32_t>> modules;
    for (const ValidatedStage& stage : tiny.validated.stages) modules.emplace_back(stage.spirv);
    // Never destroyed: when statics are, the validation layer is gone already.
    static const vulkan::Device& device = *new vulkan::Device(device_with_layer());
    return checked(vulkan::render_permutation(
        device, vulkan::modules_of(modules, tiny.permutation()), tiny.interface,
        {{triangle(corners), glm::dmat4(1), {}, false, true}}, {}, small_view(), textures, start));
}

/// The same by OpenGL.
Picture drawn_by_opengl(const std::string& vertex, const std::string& fragment,
                        const std::vector<glm::vec3>& corners) {
    const Tiny tiny(vertex, fragment, Dialect::glsl450);
    const Context context = open_context(Backend::osmesa).value();
    return checked(render_permutation(context, stages_of(tiny.composition, tiny.permutation()),
                                      tiny.interface, {{triangle(corners), glm::dmat4(1), {}, false, true}},
                                      {}, small_view()));
}

const std::string kInClipSpace =
    "ATTRIBUTE(0) vec3 position;\nvoid main() { gl_Position = vec4(position, 1.0); }\n";
const std::string kWhite = "OUTPUT(0) vec4 color;\nvoid main() { color = vec4(1.0); }\n";

std::string colored(const std::string& value) {
    return "OUTPUT(0) vec4 color;\nvoid main() { color = " + value + "; }\n";
}

TEST(VulkanClipSpace, YPointsDown) {
    const Picture picture = drawn(kInClipSpace, kWhite, kCorner);
    EXPECT_EQ(picture.color.at(1, 1, 0), 1) << "upper left";
    EXPECT_EQ(picture.color.at(1, kSide - 2, 0), 0) << "lower left";
    EXPECT_EQ(picture.color.at(kSide - 2, 1, 0), 0) << "upper right";
    const Picture upward = drawn_by_opengl(kInClipSpace, kWhite, kCorner);
    EXPECT_EQ(upward.color.at(1, kSide - 2, 0), 1) << "lower left";
    EXPECT_EQ(upward.color.at(1, 1, 0), 0) << "upper left";
}

TEST(VulkanClipSpace, DepthIsFrom0To1) {
    struct Row {
        float z;
        float vulkan;
        float opengl;
    };
    for (const Row& row : {Row{0.5F, 0.5F, 0.75F}, {0.25F, 0.25F, 0.625F}, {-0.25F, 1, 0.375F}}) {
        SCOPED_TRACE(row.z);
        std::vector<glm::vec3> corners = kCorner;
        for (glm::vec3& corner : corners) corner.z = row.z;
        EXPECT_EQ(drawn(kInClipSpace, kWhite, corners).depth.at(1, 1, 0), row.vulkan);
        EXPECT_EQ(drawn_by_opengl(kInClipSpace, kWhite, corners).depth.at(1, kSide - 2, 0), row.opengl);
    }
}

TEST(VulkanClipSpace, FrontFacesRunCounterClockwiseInThePicture) {
    const std::string sides = colored("gl_FrontFacing ? vec4(1.0, 0.0, 0.0, 1.0) : vec4(0.0, 1.0, 0.0, 1.0)");
    const std::vector<glm::vec3> turned = {kCorner[0], kCorner[2], kCorner[1]};
    EXPECT_EQ(drawn(kInClipSpace, sides, kCorner).color.at(1, 1, 0), 1);
    EXPECT_EQ(drawn(kInClipSpace, sides, turned).color.at(1, 1, 1), 1);
    EXPECT_EQ(drawn_by_opengl(kInClipSpace, sides, kCorner).color.at(1, kSide - 2, 1), 1);
    EXPECT_EQ(drawn_by_opengl(kInClipSpace, sides, turned).color.at(1, kSide - 2, 0), 1);
}

TEST(VulkanClipSpace, FragCoordCountsFromTheUpperLeft) {
    const Picture picture = drawn(kInClipSpace, colored("gl_FragCoord"), kCorner);
    EXPECT_EQ(picture.color.at(3, 1, 0), 3.5F);
    EXPECT_EQ(picture.color.at(3, 1, 1), 1.5F);
    EXPECT_EQ(picture.color.at(3, 1, 2), 0.5F);
    const Picture upward = drawn_by_opengl(kInClipSpace, colored("gl_FragCoord"), kCorner);
    EXPECT_EQ(upward.color.at(3, kSide - 2, 0), 3.5F);
    EXPECT_EQ(upward.color.at(3, kSide - 2, 1), 1.5F) << "from the lower edge";
    EXPECT_EQ(upward.color.at(3, kSide - 2, 2), 0.75F);
}

/// What a projection for OpenGL, put behind the matrix of the renderer, makes of a triangle in the lower
/// left.
const std::string kProjected =
    "BLOCK(0, Transform) { mat4 modelView; mat4 projection; } transform;\nATTRIBUTE(0) vec3 position;\n"
    "VARYING(0) float height;\n"
    "void main() {\n    height = position.y;\n"
    "    gl_Position = transform.projection * (transform.modelView * vec4(position, 1.0));\n}\n";
const std::vector<glm::vec3> kLowerLeft = {{-1, -1, 0}, {0, -1, 0}, {-1, 0, 0}};

TEST(VulkanClipSpace, DerivativesUpwardsAreNegative) {
    const std::string fragment =
        "VARYING(0) float height;\n" + colored("vec4(dFdx(height), dFdy(height), height, 1.0)");
    const Picture picture = drawn(kProjected, fragment, kLowerLeft);
    const Picture upward = drawn_by_opengl(kProjected, fragment, kLowerLeft);
    for (const Picture* one : {&picture, &upward}) {
        EXPECT_NEAR(one->color.at(2, kSide - 3, 2), -1 + 2.5F * 2 / kSide, 1e-3F) << "upright";
        EXPECT_NEAR(one->color.at(2, kSide - 3, 0), 0, 1e-6F);
    }
    EXPECT_NEAR(picture.color.at(2, kSide - 3, 1), -2.0F / kSide, 1e-4F);
    EXPECT_NEAR(upward.color.at(2, kSide - 3, 1), 2.0F / kSide, 1e-4F);
}

TEST(VulkanClipSpace, DerivativesToTheRightArePositive) {
    std::string along = kProjected;
    along.replace(along.find("position.y"), 10, "position.x");
    const std::string fragment =
        "VARYING(0) float height;\n" + colored("vec4(dFdx(height), dFdy(height), 0.0, 1.0)");
    const Picture picture = drawn(along, fragment, kLowerLeft);
    const Picture upward = drawn_by_opengl(along, fragment, kLowerLeft);
    for (const Picture* one : {&picture, &upward}) {
        EXPECT_NEAR(one->color.at(2, kSide - 3, 0), 2.0F / kSide, 1e-4F);
        EXPECT_NEAR(one->color.at(2, kSide - 3, 1), 0, 1e-6F);
    }
}

TEST(VulkanClipSpace, UprightPicturesKeepTheWindingOfOpenGl) {
    const std::string fragment =
        "VARYING(0) float height;\n" + colored("vec4(gl_FrontFacing ? 1.0 : 0.0, height, 0.0, 1.0)");
    EXPECT_EQ(drawn(kProjected, fragment, kLowerLeft).color.at(2, kSide - 3, 0), 1);
    EXPECT_EQ(drawn_by_opengl(kProjected, fragment, kLowerLeft).color.at(2, kSide - 3, 0), 1);
}

/// A triangle that covers the left upper half in Vulkan, the lower in OpenGL, from the numbers of its
/// vertices, of which the first is `first`.
std::string numbered(int first) {
    return fmt::format(
        "layout(location = 0) flat out vec2 numbers;\n"
        "void main() {{\n    numbers = vec2(gl_VertexID, gl_InstanceID);\n"
        "    gl_Position = vec4(gl_VertexID == {} ? 0.0 : -1.0, gl_VertexID == {} ? 0.0 : -1.0, 0.5, "
        "1.0);\n}}\n",
        first + 2, first + 1);
}
const std::string kNumbers =
    "layout(location = 0) flat in vec2 numbers;\n" + colored("vec4(numbers, 0.0, 1.0)");

TEST(VulkanClipSpace, FlatValuesComeFromTheFirstVertex) {
    const vulkan::DrawStart as_it_is = {.flat_from_last = false};
    EXPECT_EQ(drawn(numbered(0), kNumbers, kCorner, as_it_is).color.at(1, 1, 0), 0);
    EXPECT_EQ(drawn(numbered(0), kNumbers, kCorner).color.at(1, 1, 0), 2) << "the renderer turns triangles";
    EXPECT_EQ(drawn_by_opengl(numbered(0), kNumbers, kCorner).color.at(1, kSide - 2, 0), 2);
}

TEST(VulkanClipSpace, NumbersOfVerticesAndInstancesCountTheFirstOneIn) {
    const Picture picture = drawn(numbered(4), kNumbers, kCorner, {.vertex = 4, .instance = 3});
    EXPECT_EQ(picture.color.at(1, 1, 0), 4 + 2);
    EXPECT_EQ(picture.color.at(1, 1, 1), 3);

    const Tiny tiny(numbered(4), kNumbers, Dialect::glsl450);
    const Context context = open_context(Backend::osmesa).value();
    const Framebuffer framebuffer = make_framebuffer(context, kSide, kSide).value();
    const Program program = link_program(context, stages_of(tiny.composition, tiny.permutation())).value();
    const Picture by_opengl = checked(take_picture(framebuffer, {0, 0, 0, 1}, {}, [&] {
        const GladGLContext& gl = context.gl();
        GLuint array = 0;
        gl.GenVertexArrays(1, &array);
        gl.BindVertexArray(array);
        gl.UseProgram(program.id());
        gl.DrawArraysInstancedBaseInstance(GL_TRIANGLES, 4, 3, 1, 3);
        gl.DeleteVertexArrays(1, &array);
    }));
    EXPECT_EQ(by_opengl.color.at(1, kSide - 2, 0), 4 + 2);
    EXPECT_EQ(by_opengl.color.at(1, kSide - 2, 1), 0) << "gl_BaseInstance is another matter";
}

/// The map of a light that looks along the world's z axis at the triangle in the lower left, depth from -1
/// to 1.
std::vector<Image> map_of_lower_left() {
    const Tiny tiny(kProjected, "VARYING(0) float height;\nvoid main() {}\n", Dialect::vulkan);
    vulkan::ShadowPass pass;
    pass.side = kSide;
    pass.slope = pass.units = 0;
    pass.interface = tiny.interface;
    for (const StageKind kind : {StageKind::vertex, StageKind::fragment})
        pass.stages.push_back({kind, tiny.validated.stage(tiny.permutation().stages[kind]).spirv, {}});
    ShadowPlan plan;
    plan.cameras.push_back({});  // clip space is the world, as OpenGL has it
    auto maps = vulkan::draw_shadow_maps(device_with_layer(), pass, plan,
                                         {{triangle(kLowerLeft), glm::dmat4(1), {}, false, true}});
    EXPECT_TRUE(maps) << (maps ? "" : to_text(maps.error().front()));
    return maps ? *std::move(maps) : std::vector<Image>{Image(kSide, kSide, 1)};
}

/// The maps of lights are drawn with y upward: row 0, at t = 0, is where clip space has y = -1, as in OpenGL.
TEST(VulkanClipSpace, ShadowMapsHaveTheirRowsAsOpenGl) {
    const std::vector<Image> maps = map_of_lower_left();
    ASSERT_EQ(maps.size(), 1u);
    EXPECT_EQ(maps.front().at(1, 1, 0), 0.5F) << "the lower left is in the first rows; z = 0 is half way";
    EXPECT_EQ(maps.front().at(1, kSide - 2, 0), 1);
}

/// So that a shader finds a place in the map by half of its coordinates and a half, y and depth too.
TEST(VulkanClipSpace, ShadowMapsAreLookedUpAsInOpenGl) {
    const std::string vertex =
        "BLOCK(0, Transform) { mat4 modelView; mat4 projection; } transform;\nATTRIBUTE(0) vec3 position;\n"
        "VARYING(0) vec3 place;\n"
        "void main() {\n    place = position;\n"
        "    gl_Position = transform.projection * (transform.modelView * vec4(position, 1.0));\n}\n";
    const std::string fragment =
        "VARYING(0) vec3 place;\nSAMPLER(1, sampler2DArrayShadow) shadowMaps;\nOUTPUT(0) vec4 color;\n"
        "float lit(float z) {\n"
        "    return texture(shadowMaps, vec4(0.5 * place.xy + 0.5, 0.0, 0.5 * z + 0.5));\n}\n"
        "void main() { color = vec4(lit(-0.1), lit(0.1), 0.0, 1.0); }\n";
    const Picture picture = drawn(vertex, fragment, {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}}, {},
                                  {{"shadowMaps", vulkan::depth_texels(map_of_lower_left())}});
    struct Row {
        const char* name;
        int x, y;
        float before, behind;
    };
    for (const Row& row : {Row{"lower left", 3, kSide - 4, 1, 0},
                           {"upper left", 3, 3, 1, 1},
                           {"lower right", kSide - 4, kSide - 4, 1, 1}}) {
        SCOPED_TRACE(row.name);
        EXPECT_EQ(picture.color.at(row.x, row.y, 0), row.before) << "nearer to the light";
        EXPECT_EQ(picture.color.at(row.x, row.y, 1), row.behind) << "behind";
    }
}

/// Else no message would mean nothing.
TEST(VulkanValidation, IsListenedTo) {
    const vulkan::Device device = device_with_layer();
    const vulkan::Device::State& state = device.state();
    EXPECT_EQ(device.messages().size(), 0u);
    auto info = vulkan::made<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;  // but no size
    VkBuffer buffer = VK_NULL_HANDLE;
    if (state.vk.vkCreateBuffer(state.device, &info, nullptr, &buffer) == VK_SUCCESS)
        state.vk.vkDestroyBuffer(state.device, buffer, nullptr);
    const Diagnostics messages = device.messages();
    ASSERT_EQ(messages.size(), 1u) << "apt-get install vulkan-validationlayers";
    EXPECT_THAT(messages.front().message, testing::HasSubstr("VUID-VkBufferCreateInfo-size-00912"));
}

}  // namespace
}  // namespace gobo
