// A generated header of SPIR-V for OpenGL 4.6, on a driver that takes it.
#include <dlfcn.h>
#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "lab/render/render.hpp"
#include "spirv_count.hpp"

namespace gobo {
namespace {

/// OpenGL as far as glad has it here, and the function of GL_ARB_gl_spirv.
struct Functions : GladGLContext {
    void (*SpecializeShader)(unsigned, const char*, unsigned, const unsigned*, const unsigned*) = nullptr;
};

Functions functions_of(const Context& context) {
    Functions functions{context.gl()};
    void* const library = ::dlopen("libOSMesa.so.8", RTLD_LAZY);
    const auto find = reinterpret_cast<void (*(*)(const char*))()>(::dlsym(library, "OSMesaGetProcAddress"));
    functions.SpecializeShader =
        reinterpret_cast<decltype(functions.SpecializeShader)>(find("glSpecializeShaderARB"));
    return functions;
}

/// What the fragment stage of so many lamps writes.
float drawn(const Context& context, int lamps) {
    spirv_count::Key key;
    key.lamps = lamps;
    const Functions functions = functions_of(context);
    const gl::Program program = gl::build_program(*spirv_count::find(key), functions);
    EXPECT_TRUE(program) << program.error;
    const Framebuffer framebuffer = make_framebuffer(context, 4, 4).value();
    framebuffer.bind();
    framebuffer.clear({-1, -1, -1, -1});
    GLuint array = 0;
    functions.GenVertexArrays(1, &array);
    functions.BindVertexArray(array);
    functions.UseProgram(program.id);
    functions.DrawArrays(GL_TRIANGLES, 0, 3);
    const float value = framebuffer.read_color().at(1, 1, 0);
    EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    functions.DeleteVertexArrays(1, &array);
    functions.DeleteProgram(program.id);
    return value;
}

TEST(OpenGlSpirv, DrawsWithTheCountsOfTheKey) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const spirv_count::Key none;
    spirv_count::Key five;
    five.lamps = 5;
    spirv_count::Key eight;
    eight.lamps = 8;
    EXPECT_EQ(spirv_count::find(five)->fragment, spirv_count::find(eight)->fragment) << "one module";
    EXPECT_NE(spirv_count::find(none)->fragment, spirv_count::find(eight)->fragment);
    for (const int lamps : {0, 1, 5, 8}) EXPECT_EQ(drawn(*context, lamps), static_cast<float>(lamps));
}

}  // namespace
}  // namespace gobo
