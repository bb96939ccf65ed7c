// Headers of families whose permutations declare names differently, on a real driver: each links, and each
// name is where the header says. The game of the documentation builds whole.
#include <set>

#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl_uniforms.hpp>
#include <gobo/gl_vertices.hpp>

#include "differing.hpp"
#include "game.hpp"
#include "lab/render/context.hpp"

namespace gobo {
namespace {

TEST(PermutationsThatDiffer, LinkAndBindAsTheHeaderSays) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    ASSERT_EQ(differing::permutations.size(), 32U);
    for (const differing::Permutation& permutation : differing::permutations) {
        SCOPED_TRACE(differing::key_text(permutation.key()));
        const gl::Program program = gl::build_program(permutation, functions);
        ASSERT_TRUE(program) << program.error;
        std::set<GLint> units;
        const auto unit_of = [&](const char* name) {
            GLint unit = -1;
            functions.GetUniformiv(program.id, functions.GetUniformLocation(program.id, name), &unit);
            EXPECT_TRUE(units.insert(unit).second) << name << " shares its unit";
            return unit;
        };
        EXPECT_EQ(unit_of("shadow"), differing::sampler::shadow);
        for (int light = 0; light < permutation.key().lights; ++light)
            EXPECT_EQ(unit_of(("masks[" + std::to_string(light) + "]").c_str()),
                      differing::sampler::masks + light);
        EXPECT_EQ(functions.GetAttribLocation(program.id, "color"), differing::attribute::color);
        EXPECT_EQ(functions.GetAttribLocation(program.id, "color"), differing::attribute::color_2);
        GLint size = 0;
        functions.GetActiveUniformBlockiv(program.id, functions.GetUniformBlockIndex(program.id, "Material"),
                                          GL_UNIFORM_BLOCK_DATA_SIZE, &size);
        const bool has_glow = permutation.key().glow;
        EXPECT_EQ(static_cast<std::size_t>(size),
                  has_glow ? differing::Material_2::size : differing::Material::size);
        EXPECT_EQ(differing::declared::Material(permutation), has_glow ? 2 : 1);
        EXPECT_EQ(differing::declared::shadow(permutation), permutation.key().compare ? 2 : 1);
        EXPECT_EQ(differing::declared::color(permutation), permutation.key().opaque ? 2 : 1);
        EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        functions.DeleteProgram(program.id);
    }
}

TEST(UniformPlaces, SetWhatTheyName) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    differing::Key key;
    key.lights = 2;
    key.glow = true;
    const differing::Permutation& permutation = *differing::find(key);
    const gl::Program program = gl::build_program(permutation, functions);
    ASSERT_TRUE(program) << program.error;
    const auto locations = gl::find_locations(permutation, program.id, functions);
    functions.UseProgram(program.id);
    namespace uniform = differing::uniform;
    gl::set(locations, uniform::turn, glm::mat3(1, 2, 3, 4, 5, 6, 7, 8, 9), functions);
    gl::set(locations, uniform::inverted, true, functions);
    gl::set(locations, uniform::weights, std::array{0.25F, 0.75F}, functions);
    gl::set(locations, uniform::lights[1].direction, glm::vec3(1, 2, 3), functions);
    gl::set(locations, uniform::lights[1].halo, 0.5F, functions);
    gl::set(locations, uniform::lights[2].halo, 0.5F, functions);  // this permutation has two lights
    const auto values_of = [&](const char* name) {
        std::vector<float> values(9);
        functions.GetUniformfv(program.id, functions.GetUniformLocation(program.id, name), values.data());
        return values;
    };
    EXPECT_EQ(values_of("turn"), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(values_of("inverted").front(), 1.0F);
    EXPECT_EQ(values_of("weights[1]").front(), 0.75F);
    EXPECT_EQ(values_of("lights[1].direction")[2], 3.0F);
    EXPECT_EQ(values_of("lights[1].halo").front(), 0.5F);
    EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    functions.DeleteProgram(program.id);
}

TEST(SamplerPlaces, BindAndMoveWhatTheyName) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    differing::Key key;
    key.lights = 2;
    for (const bool compares : {false, true}) {
        key.compare = compares;
        const differing::Permutation& permutation = *differing::find(key);
        const gl::Program program = gl::build_program(permutation, functions);
        ASSERT_TRUE(program) << program.error;
        std::array<GLuint, 3> textures{};
        functions.GenTextures(3, textures.data());
        const auto bound_at = [&](int unit) {
            functions.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
            GLint texture = 0;
            functions.GetIntegerv(GL_TEXTURE_BINDING_2D, &texture);
            return static_cast<GLuint>(texture);
        };
        namespace sampler = differing::sampler;
        gl::bind_texture(sampler::shadow, textures[0], functions);
        gl::bind_textures(sampler::masks, std::array{textures[1], textures[2]}, functions);
        EXPECT_EQ(bound_at(sampler::shadow), textures[0]);
        EXPECT_EQ(bound_at(sampler::masks + 1), textures[2]);

        const auto locations = gl::find_locations(permutation, program.id, functions);
        functions.UseProgram(program.id);
        gl::set(locations, sampler::shadow, 9, functions);
        gl::set(locations, sampler::masks, std::array{11, 12}, functions);
        const auto unit_of = [&](const char* name) {
            GLint unit = -1;
            functions.GetUniformiv(program.id, functions.GetUniformLocation(program.id, name), &unit);
            return unit;
        };
        EXPECT_EQ(unit_of("shadow"), 9) << "whichever type of sampler it is";
        EXPECT_EQ(unit_of("masks[1]"), 12);
        EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        functions.DeleteTextures(3, textures.data());
        functions.DeleteProgram(program.id);
    }
}

struct Vertex {
    float weight;
    glm::vec3 position;
    glm::vec4 color;
};

TEST(AttributePlaces, PointAtMembers) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    GLuint array = 0;
    GLuint buffer = 0;
    functions.GenVertexArrays(1, &array);
    functions.BindVertexArray(array);
    functions.GenBuffers(1, &buffer);
    functions.BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl::point_to(differing::attribute::position, &Vertex::position, functions);
    gl::point_to(differing::attribute::color, &Vertex::color, functions, 64);
    const auto value_of = [&](int location, GLenum name) {
        GLint value = 0;
        functions.GetVertexAttribiv(static_cast<GLuint>(location), name, &value);
        return value;
    };
    const auto offset_of = [&](int location) {
        void* offset = nullptr;
        functions.GetVertexAttribPointerv(static_cast<GLuint>(location), GL_VERTEX_ATTRIB_ARRAY_POINTER,
                                          &offset);
        return reinterpret_cast<std::size_t>(offset);
    };
    EXPECT_EQ(value_of(differing::attribute::position, GL_VERTEX_ATTRIB_ARRAY_SIZE), 3);
    EXPECT_EQ(value_of(differing::attribute::position, GL_VERTEX_ATTRIB_ARRAY_ENABLED), 1);
    EXPECT_EQ(value_of(differing::attribute::color, GL_VERTEX_ATTRIB_ARRAY_STRIDE),
              static_cast<GLint>(sizeof(Vertex)));
    EXPECT_EQ(offset_of(differing::attribute::position), offsetof(Vertex, position));
    EXPECT_EQ(offset_of(differing::attribute::color), 64 + offsetof(Vertex, color));
    EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    functions.DeleteBuffers(1, &buffer);
    functions.DeleteVertexArrays(1, &array);
}

TEST(UniformPlaces, OfAGame) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    for (const game::Permutation& permutation : game::permutations) {
        SCOPED_TRACE(game::key_text(permutation.key()));
        const gl::Program program = gl::build_program(permutation, functions);
        ASSERT_TRUE(program) << program.error;
        functions.DeleteProgram(program.id);
    }
}

}  // namespace
}  // namespace gobo
