// A generated header on a real driver: GLSL 330, where the header's bindings must be set by name.
#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "drawn.hpp"
#include "lab/render/context.hpp"

namespace gobo {
namespace {

gl::Program build(const Context& context, drawn::Tint tint) {
    drawn::Key key;
    key.tint = tint;
    return gl::build_program(*drawn::find(key), context.gl());
}

TEST(GeneratedHeaderOnOsmesa, BindsWhatTheHeaderSays) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    const gl::Program program = build(*context, drawn::Tint::texture);
    ASSERT_TRUE(program) << program.error;

    const auto block_binding = [&](const char* name) {
        GLint binding = -1;
        functions.GetActiveUniformBlockiv(program.id, functions.GetUniformBlockIndex(program.id, name),
                                          GL_UNIFORM_BLOCK_BINDING, &binding);
        return binding;
    };
    EXPECT_EQ(block_binding("Colors"), drawn::Colors::binding);
    EXPECT_EQ(block_binding("Bases"), drawn::Bases::binding);

    const auto unit_of = [&](const char* name) {
        GLint unit = -1;
        functions.GetUniformiv(program.id, functions.GetUniformLocation(program.id, name), &unit);
        return unit;
    };
    EXPECT_EQ(unit_of("image"), drawn::sampler::image);
    EXPECT_EQ(unit_of("maps[0]"), drawn::sampler::maps);
    EXPECT_EQ(unit_of("maps[1]"), drawn::sampler::maps + 1);
    EXPECT_EQ(functions.GetAttribLocation(program.id, "corner"), drawn::attribute::corner);
    EXPECT_EQ(functions.GetAttribLocation(program.id, "position"), drawn::attribute::position);
    EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    functions.DeleteProgram(program.id);
}

TEST(GeneratedHeaderOnOsmesa, ErrorsNameThePieceAndItsLine) {
    const Result<Context> context = open_context(Backend::osmesa, 33);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const gl::Program program = build(*context, drawn::Tint::broken);
    ASSERT_FALSE(program);
    // Mesa counts lines over the whole source: this is its line 6.
    EXPECT_EQ(program.error.substr(0, program.error.find('\n', program.error.find('\n') + 1)),
              "fragment stage does not compile\ntint/broken.glsl:2(11): error: `colour' undeclared");
}

}  // namespace
}  // namespace gobo
