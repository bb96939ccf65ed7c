// gobo/gl.hpp with a loader whose functions are macros for function pointers (as glad's, GLEW's and epoxy's
// are), and with a table. The driver behind both is a pretended one that notes what it is told: no OpenGL is
// needed.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "lit.hpp"

namespace pretended {

struct Driver {
    std::string calls;
    std::vector<std::string> sources;
    std::string log;       // of compiling and linking
    bool compiles = true;  // the fragment stage
    bool links = true;
    unsigned current = 77;
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
void GetProgramiv(unsigned, unsigned name, int* value) {
    *value = status_or_size(name, driver.links);
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
unsigned GetUniformBlockIndex(unsigned, const char* name) {
    return std::strcmp(name, "Camera") == 0 ? 0xFFFFFFFF : 9;
}
void UniformBlockBinding(unsigned, unsigned block, unsigned binding) {
    note("block " + std::to_string(block) + ": " + std::to_string(binding));
}

}  // namespace pretended

// A loader: pointers in variables, macros with OpenGL's names.
#define GL_VERSION_2_0 1
#define LOADER_FUNCTIONS(DO)                                                                    \
    DO(CreateShader)                                                                            \
    DO(ShaderSource)                                                                            \
    DO(CompileShader)                                                                           \
    DO(GetShaderiv)                                                                             \
    DO(GetShaderInfoLog)                                                                        \
    DO(DeleteShader) DO(CreateProgram) DO(AttachShader) DO(BindAttribLocation) DO(LinkProgram)  \
        DO(GetProgramiv) DO(GetProgramInfoLog) DO(DeleteProgram) DO(UseProgram) DO(GetIntegerv) \
            DO(GetUniformLocation) DO(Uniform1iv) DO(GetUniformBlockIndex) DO(UniformBlockBinding)
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

#include <gobo/gl.hpp>

namespace {

int failures = 0;

void expect_text(const std::string& actual, const std::string& expected) {
    if (actual == expected) return;
    std::printf("failed: expected \"%s\"\n             got \"%s\"\n", expected.c_str(), actual.c_str());
    ++failures;
}

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

}  // namespace

int main() {
    test_success();
    // The fragment stage is common.glsl, two lines, then "piece of fog=linear", two lines.
    test_compile_error("0:2(7): error: x\n", "shader_lib/common.glsl:2(7): error: x\n");
    test_compile_error("0:4(1): error: Mesa\n", "piece of fog=linear:2(1): error: Mesa\n");
    test_compile_error("0:9(1): error: past the end\n", "piece of fog=linear:7(1): error: past the end\n");
    test_compile_error("1(2) : error C1: NVIDIA\nend", "piece of fog=linear:2 : error C1: NVIDIA\nend");
    test_compile_error("ERROR: 1:1: 'y' : Intel", "ERROR: piece of fog=linear:1: 'y' : Intel");
    test_compile_error("5:1: no such string\n0 errors\n123456789:1\n0:x",
                       "5:1: no such string\n0 errors\n123456789:1\n0:x");
    test_link_error();
    return failures == 0 ? 0 : 1;
}
