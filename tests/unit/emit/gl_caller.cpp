// gobo/gl.hpp with a loader whose functions are macros for function pointers (as glad's, GLEW's and epoxy's
// are), and with a table. The driver behind both is a pretended one that notes what it is told: no OpenGL is
// needed.
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "expectations.hpp"
#include "lit.hpp"

namespace pretended {

struct Driver {
    std::string calls;
    std::vector<std::string> sources;
    std::string log;       // of compiling and linking
    bool compiles = true;  // the fragment stage
    bool links = true;
    unsigned current = 77;
    unsigned deleted = 0;
};
Driver driver;

void note(const std::string& call) {
    driver.calls += call + "\n";
}
int status_or_size(unsigned name, bool fine) {
    return name == 0x8B84 ? static_cast<int>(driver.log.size()) + 1 : (fine ? 1 : 0);
}
void copy_log(int size, int* length, char* text) {
    *length = std::snprintf(text, static_cast<std::size_t>(size), "%s", driver.log.c_str());
}

unsigned CreateShader(unsigned kind) {
    return kind == 0x8B31 ? 1 : 2;
}
void ShaderSource(unsigned, int count, const char* const* texts, const int* lengths) {
    std::string source;
    for (int index = 0; index < count; ++index)
        source.append(texts[index], static_cast<std::size_t>(lengths[index]));
    driver.sources.push_back(source);
}
void CompileShader(unsigned) {}
void GetShaderiv(unsigned shader, unsigned name, int* value) {
    *value = status_or_size(name, shader == 1 || driver.compiles);
}
void GetShaderInfoLog(unsigned, int size, int* length, char* text) {
    copy_log(size, length, text);
}
void DeleteShader(unsigned shader) {
    note("delete shader " + std::to_string(shader));
}
unsigned CreateProgram() {
    return 3;
}
void AttachShader(unsigned, unsigned) {}
void BindAttribLocation(unsigned, unsigned location, const char* name) {
    note("attribute " + std::string(name) + " " + std::to_string(location));
}
void LinkProgram(unsigned) {
    note("link");
}
void GetProgramiv(unsigned program, unsigned name, int* value) {
    const bool asks_whether_deleted = name == 0x8B80;
    *value = asks_whether_deleted ? (program == driver.deleted ? 1 : 0) : status_or_size(name, driver.links);
}
void GetProgramInfoLog(unsigned, int size, int* length, char* text) {
    copy_log(size, length, text);
}
void DeleteProgram(unsigned) {
    note("delete program");
}
void UseProgram(unsigned program) {
    driver.current = program;
}
void GetIntegerv(unsigned, int* value) {
    *value = static_cast<int>(driver.current);
}
int GetUniformLocation(unsigned, const char*) {
    return 5;
}
void Uniform1iv(int location, int, const int* values) {
    note("unit of " + std::to_string(location) + ": " + std::to_string(*values));
}
void Uniform1fv(int location, int, const float* values) {
    note("uniform " + std::to_string(location) + ": " + std::to_string(*values));
}
void ActiveTexture(unsigned unit) {
    note("active unit " + std::to_string(unit - 0x84C0));
}
void BindTexture(unsigned target, unsigned texture) {
    note("texture " + std::to_string(texture) + " as " + std::to_string(target));
}
void EnableVertexAttribArray(unsigned location) {
    note("enable " + std::to_string(location));
}
void VertexAttribPointer(unsigned location, int size, unsigned type, unsigned char normalized, int stride,
                         const void* offset) {
    note("pointer " + std::to_string(location) + ": " + std::to_string(size) + " of " +
         std::to_string(type + normalized) + " each " + std::to_string(stride) + " from " +
         std::to_string(reinterpret_cast<std::size_t>(offset)));
}
void VertexAttribIPointer(unsigned location, int size, unsigned type, int stride, const void* offset) {
    VertexAttribPointer(location, size, type, 0, stride, offset);
}
unsigned GetUniformBlockIndex(unsigned, const char* name) {
    return std::strcmp(name, "Camera") == 0 ? 0xFFFFFFFF : 9;
}
void UniformBlockBinding(unsigned, unsigned block, unsigned binding) {
    note("block " + std::to_string(block) + ": " + std::to_string(binding));
}

}  // namespace pretended

// A loader: pointers in variables, macros with OpenGL's names.
#define GL_VERSION_2_0 1
#define LOADER_FUNCTIONS(DO)                                                                                 \
    DO(CreateShader)                                                                                         \
    DO(ShaderSource)                                                                                         \
    DO(CompileShader)                                                                                        \
    DO(GetShaderiv)                                                                                          \
    DO(GetShaderInfoLog)                                                                                     \
    DO(DeleteShader)                                                                                         \
    DO(CreateProgram)                                                                                        \
    DO(AttachShader)                                                                                         \
    DO(BindAttribLocation)                                                                                   \
    DO(LinkProgram)                                                                                          \
    DO(GetProgramiv)                                                                                         \
    DO(GetProgramInfoLog)                                                                                    \
    DO(DeleteProgram)                                                                                        \
    DO(UseProgram)                                                                                           \
    DO(GetIntegerv) DO(GetUniformLocation) DO(Uniform1iv) DO(GetUniformBlockIndex) DO(UniformBlockBinding)   \
        DO(Uniform1fv) DO(ActiveTexture) DO(BindTexture) DO(EnableVertexAttribArray) DO(VertexAttribPointer) \
            DO(VertexAttribIPointer)
#define LOADER_POINTER(name) static decltype(&pretended::name) loader_gl##name = &pretended::name;
LOADER_FUNCTIONS(LOADER_POINTER)
#define glCreateShader loader_glCreateShader
#define glShaderSource loader_glShaderSource
#define glCompileShader loader_glCompileShader
#define glGetShaderiv loader_glGetShaderiv
#define glGetShaderInfoLog loader_glGetShaderInfoLog
#define glDeleteShader loader_glDeleteShader
#define glCreateProgram loader_glCreateProgram
#define glAttachShader loader_glAttachShader
#define glBindAttribLocation loader_glBindAttribLocation
#define glLinkProgram loader_glLinkProgram
#define glGetProgramiv loader_glGetProgramiv
#define glGetProgramInfoLog loader_glGetProgramInfoLog
#define glDeleteProgram loader_glDeleteProgram
#define glUseProgram loader_glUseProgram
#define glGetIntegerv loader_glGetIntegerv
#define glGetUniformLocation loader_glGetUniformLocation
#define glUniform1iv loader_glUniform1iv
#define glGetUniformBlockIndex loader_glGetUniformBlockIndex
#define glUniformBlockBinding loader_glUniformBlockBinding
#define glUniform1fv loader_glUniform1fv
#define glActiveTexture loader_glActiveTexture
#define glBindTexture loader_glBindTexture
#define glEnableVertexAttribArray loader_glEnableVertexAttribArray
#define glVertexAttribPointer loader_glVertexAttribPointer
#define glVertexAttribIPointer loader_glVertexAttribIPointer

#include <gobo/gl.hpp>
#include <gobo/gl_uniforms.hpp>
#include <gobo/gl_vertices.hpp>

namespace {

/// The same functions as members of a struct, as in GladGLContext.
struct Table {
#define TABLE_MEMBER(name) decltype(&pretended::name) name = &pretended::name;
    LOADER_FUNCTIONS(TABLE_MEMBER)
};

const lit::Permutation& permutation() {
    lit::Key key;
    key.fog = lit::Fog::linear;
    return *lit::find(key);
}

const char* const all_bound =
    "attribute normal 1\nattribute position 0\nlink\ndelete shader 1\ndelete shader 2\n"
    "block 9: 3\nblock 9: 2\nunit of 5: 4\n";

void test_success() {
    pretended::driver = {};
    const gobo::gl::Program program = gobo::gl::build_program(permutation());
    expect_text(std::to_string(program.id) + program.error, "3");
    expect_text(pretended::driver.sources.at(1), permutation().fragment.source());
    expect_text(pretended::driver.calls, all_bound);
    expect_text(std::to_string(pretended::driver.current), "77");
    pretended::driver = {};
    pretended::driver.deleted = 77;
    expect_text(std::to_string(gobo::gl::build_program(permutation()).id), "3");
    expect_text(std::to_string(pretended::driver.current), "0");
    pretended::driver = {};
    expect_text(std::to_string(gobo::gl::build_program(permutation(), Table{}).id), "3");
    expect_text(pretended::driver.calls, all_bound);
}

void test_compile_error(const char* log, const char* translated) {
    pretended::driver = {};
    pretended::driver.compiles = false;
    pretended::driver.log = log;
    const gobo::gl::Program program = gobo::gl::build_program(permutation());
    expect_text(std::to_string(program.id), "0");
    expect_text(program.error, std::string("fragment stage does not compile\n") + translated);
    expect_text(pretended::driver.calls, "delete shader 2\ndelete shader 1\n");
}

void test_link_error() {
    pretended::driver = {};
    pretended::driver.links = false;
    pretended::driver.log = "error: vNormal is not written";
    expect_text(gobo::gl::build_program(permutation()).error,
                "the stages do not link\nerror: vNormal is not written");
}

struct Vertex {
    float weight;
    glm::vec3 position;
    glm::vec3 normal;
};

void test_places() {
    const auto pointed = [](int location, std::size_t offset) {
        const std::string number = std::to_string(location);
        return "enable " + number + "\npointer " + number + ": 3 of 5126 each " +
               std::to_string(sizeof(Vertex)) + " from " + std::to_string(offset) + "\n";
    };
    const std::string calls = "uniform 5: 0.500000\nunit of 5: 7\nactive unit 4\ntexture 9 as 35866\n" +
                              pointed(0, offsetof(Vertex, position)) + pointed(1, offsetof(Vertex, normal));
    pretended::driver = {};
    const auto locations = gobo::gl::find_locations(permutation(), 3);
    gobo::gl::set(locations, lit::uniform::exposure, 0.5F);
    gobo::gl::set(locations, lit::sampler::shadowMaps, 7);
    gobo::gl::bind_texture(lit::sampler::shadowMaps, 9);
    gobo::gl::point_to(lit::attribute::position, &Vertex::position);
    gobo::gl::point_to(lit::attribute::normal, &Vertex::normal);
    expect_text(pretended::driver.calls, calls);
    pretended::driver = {};
    const Table table;
    gobo::gl::set(locations, lit::uniform::exposure, 0.5F, table);
    gobo::gl::set(locations, lit::sampler::shadowMaps, 7, table);
    gobo::gl::bind_texture(lit::sampler::shadowMaps, 9, table);
    gobo::gl::point_to(lit::attribute::position, &Vertex::position, table);
    gobo::gl::point_to(lit::attribute::normal, &Vertex::normal, table);
    expect_text(pretended::driver.calls, calls);
}

// What set() and point_to() take.
using gobo::runtime::TakesValue;
static_assert(TakesValue<gobo::std140::vec3, glm::vec3>::value);
static_assert(!TakesValue<gobo::std140::vec3, glm::vec4>::value);
static_assert(!TakesValue<float, double>::value && !TakesValue<std::int32_t, std::uint32_t>::value);
static_assert(
    std::is_same_v<decltype(lit::attribute::position), const gobo::AttributePlace<gobo::std140::vec3>>);
static_assert(lit::sampler::shadowMaps.target == gobo::target::texture_2d_array);

}  // namespace

int main() {
    test_success();
    test_places();
    // The fragment stage is common.glsl, two lines, then "piece of fog=linear", lines 31 and 32 of its file.
    test_compile_error("0:2(7): error: x\n", "shader_lib/common.glsl:2(7): error: x\n");
    test_compile_error("0:4(1): error: Mesa\n", "piece of fog=linear:32(1): error: Mesa\n");
    test_compile_error("0:9(1): error: past the end\n", "piece of fog=linear:37(1): error: past the end\n");
    test_compile_error("1(2) : error C1: NVIDIA\nend", "piece of fog=linear:32 : error C1: NVIDIA\nend");
    test_compile_error("ERROR: 1:1: 'y' : Intel", "ERROR: piece of fog=linear:31: 'y' : Intel");
    test_compile_error("5:1: no such string\n0 errors\n123456789:1\n0:x",
                       "5:1: no such string\n0 errors\n123456789:1\n0:x");
    test_link_error();
    return failures == 0 ? 0 : 1;
}
