// Storage blocks and arrays of blocks, on a real driver: each member is where the header's struct has it.
#include <dlfcn.h>
#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "lab/render/context.hpp"
#include "storage.hpp"

namespace gobo {
namespace {

/// OpenGL 4.3 beside what the loader has.
struct Functions : GladGLContext {
    GLuint (*GetProgramResourceIndex)(GLuint program, GLenum kind, const char* name) = nullptr;
    void (*GetProgramResourceiv)(GLuint program, GLenum kind, GLuint index, GLsizei count,
                                 const GLenum* names, GLsizei size, GLsizei* length, GLint* values) = nullptr;
    void (*ShaderStorageBlockBinding)(GLuint program, GLuint block, GLuint binding) = nullptr;

    explicit Functions(const GladGLContext& loaded) : GladGLContext(loaded) {
        void* const library = dlopen("libOSMesa.so.8", RTLD_NOW);
        using Find = void (*(*)(const char*))();
        const auto find =
            library == nullptr ? nullptr : reinterpret_cast<Find>(dlsym(library, "OSMesaGetProcAddress"));
        if (find == nullptr) return;
        const auto load = [find](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(find(name));
        };
        load(GetProgramResourceIndex, "glGetProgramResourceIndex");
        load(GetProgramResourceiv, "glGetProgramResourceiv");
        load(ShaderStorageBlockBinding, "glShaderStorageBlockBinding");
    }
};

constexpr GLenum kBufferVariable = 0x92E5;
constexpr GLenum kStorageBlock = 0x92E6;
constexpr GLenum kOffset = 0x92FC;
constexpr GLenum kArrayStride = 0x92FE;
constexpr GLenum kTopLevelStride = 0x930D;
constexpr GLenum kBinding = 0x9302;

struct Row {
    const char* name;
    GLenum kind;
    GLenum asked;
    std::size_t value;
};

using storage::Particles;
using storage::Samples;
using storage::Table;
using storage::Wide;

const Row rows[] = {
    {"Particles", kStorageBlock, kBinding, std::size_t{Particles::binding}},
    {"Samples", kStorageBlock, kBinding, std::size_t{Samples::binding}},
    {"Table", kStorageBlock, kBinding, std::size_t{Table::binding}},
    {"count", kBufferVariable, kOffset, offsetof(Particles, count)},
    {"awake", kBufferVariable, kOffset, offsetof(Particles, awake)},
    {"first.tint", kBufferVariable, kOffset, offsetof(Particles, first) + offsetof(storage::Particle, tint)},
    {"particles[0].position", kBufferVariable, kOffset, Particles::bytes(0)},
    {"particles[0].mass", kBufferVariable, kOffset, Particles::bytes(0) + offsetof(storage::Particle, mass)},
    {"particles[0].mass", kBufferVariable, kTopLevelStride, sizeof(storage::Particle)},
    {"Samples.turns[0]", kBufferVariable, kArrayStride, sizeof(Samples::turns[0])},
    {"Samples.on[0]", kBufferVariable, kOffset, offsetof(Samples, on)},
    {"Samples.on[0]", kBufferVariable, kArrayStride, sizeof(Samples::on[0])},
    {"Samples.samples[0]", kBufferVariable, kOffset, Samples::bytes(0)},
    {"Samples.samples[0]", kBufferVariable, kArrayStride, Samples::bytes(1) - Samples::bytes(0)},
    {"cells[0]", kBufferVariable, kArrayStride, sizeof(Table::cells[0])},
    {"most", kBufferVariable, kOffset, offsetof(Wide, most)},
    {"masks[0]", kBufferVariable, kOffset, Wide::bytes(0)},
    {"masks[0]", kBufferVariable, kArrayStride, Wide::bytes(1) - Wide::bytes(0)},
    {"turn", kBufferVariable, kOffset, offsetof(Table, turn)},
    {"last.tint", kBufferVariable, kOffset, offsetof(Table, last) + offsetof(storage::Particle, tint)},
};

TEST(StorageBlocks, AreLaidOutAsTheDriverSays) {
    const Result<Context> context = open_context(Backend::osmesa, 45);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const Functions functions(context->gl());
    ASSERT_TRUE(functions.GetProgramResourceiv);
    for (const storage::Permutation& permutation : storage::permutations) {
        const gl::Program program = gl::build_program(permutation, functions);
        ASSERT_TRUE(program) << program.error;
        for (const Row& row : rows) {
            const GLuint index = functions.GetProgramResourceIndex(program.id, row.kind, row.name);
            ASSERT_NE(index, GL_INVALID_INDEX) << row.name;
            GLint value = -1;
            functions.GetProgramResourceiv(program.id, row.kind, index, 1, &row.asked, 1, nullptr, &value);
            EXPECT_EQ(static_cast<std::size_t>(value), row.value) << row.name << ", " << row.asked;
        }
        const bool is_heavy = permutation.key().heavy;
        static_assert(storage::Shadows::count == 2 && storage::Shadows_2::count == 3);
        static_assert(storage::Shadows::binding == storage::Shadows_2::binding);
        for (int element = 0; element < (is_heavy ? 3 : 2); ++element) {
            const std::string name = "Shadows[" + std::to_string(element) + "]";
            GLint binding = -1;
            functions.GetActiveUniformBlockiv(program.id,
                                              functions.GetUniformBlockIndex(program.id, name.c_str()),
                                              GL_UNIFORM_BLOCK_BINDING, &binding);
            EXPECT_EQ(binding, storage::Shadows::binding + element);
            GLint size = 0;
            functions.GetActiveUniformBlockiv(program.id,
                                              functions.GetUniformBlockIndex(program.id, name.c_str()),
                                              GL_UNIFORM_BLOCK_DATA_SIZE, &size);
            EXPECT_EQ(static_cast<std::size_t>(size),
                      is_heavy ? storage::Shadows_2::size : storage::Shadows::size);
        }
        EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        functions.DeleteProgram(program.id);
    }
}

TEST(StorageBlocks, OfWideNumbersAreChecked) {
    Wide wide{};
    wide.least = std::int64_t{-1} << 40;
    wide.most = {1, 2, 30};
    std::string found;
    for (const OutOfRange& one : storage::check(wide)) found += to_text(one) + "\n";
    EXPECT_EQ(found,
              "Wide.least is -1099511627776, allowed is [-5, 0]\n"
              "Wide.most.z is 30, allowed is [0, 9]\n");
}

}  // namespace
}  // namespace gobo
