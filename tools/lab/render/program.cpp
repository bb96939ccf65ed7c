#include "lab/render/program.hpp"

#include <set>
#include <utility>

#include "lab/render/driver_log.hpp"

namespace gobo {
namespace {

/// Owns an OpenGL shader object.
struct Shader {
    Shader(const Context& context, StageKind kind)
        : gl(context.gl()),
          id(gl.CreateShader(kind == StageKind::vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER)) {}
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { gl.DeleteShader(id); }

    const GladGLContext& gl;
    GLuint id;
};

std::string log_of_shader(const GladGLContext& gl, GLuint shader) {
    GLint length = 0;
    gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    if (length > 0) gl.GetShaderInfoLog(shader, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

std::string log_of_program(const GladGLContext& gl, GLuint program) {
    GLint length = 0;
    gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    if (length > 0) gl.GetProgramInfoLog(program, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

/// Nothing is never an error message: a driver that fails without a log is reported as such.
Diagnostics failure(Diagnostics diagnostics, const char* what) {
    if (diagnostics.empty()) {
        diagnostics.emplace_back();
        diagnostics.back().message = what;
    }
    return diagnostics;
}

Diagnostics compile(const GladGLContext& gl, GLuint shader, const StageText& stage) {
    std::vector<const GLchar*> texts;
    std::vector<GLint> lengths;
    for (const Piece& piece : stage.pieces) {
        texts.push_back(piece.text.data());
        lengths.push_back(static_cast<GLint>(piece.text.size()));
    }
    gl.ShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return {};
    return failure(diagnostics_of_log(log_of_shader(gl, shader), stage),
                   "the driver refuses the stage without a message");
}

/// `stated` where it is one, else the lowest number that is neither stated by anything nor given yet.
/// `count` consecutive numbers are taken.
int take(std::set<int>& taken, int stated, int count) {
    if (stated >= 0) return stated;
    int first = 0;
    for (int i = 0; i < count; ++i) {
        if (!taken.contains(first + i)) continue;
        first += i + 1;
        i = -1;
    }
    for (int i = 0; i < count; ++i) taken.insert(first + i);
    return first;
}

int count_of(const std::vector<int>& array) {
    int count = 1;
    for (const int extent : array) count *= extent;
    return count;
}

}  // namespace

Program::Program(Program&& other) noexcept : context_(other.context_), id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(id_, other.id_);
    return *this;
}

Program::~Program() {
    if (id_ == 0) return;
    context_.make_current();
    context_.gl().DeleteProgram(id_);
}

Bindings bindings_of(const Interface& interface) {
    Bindings bindings;
    std::set<int> buffers;
    for (const Block& block : interface.blocks)
        if (block.binding >= 0) buffers.insert(block.binding);
    for (const Block& block : interface.blocks) bindings.blocks[block.name] = take(buffers, block.binding, 1);
    std::set<int> units;
    for (const Sampler& sampler : interface.samplers)
        for (int i = 0; sampler.binding >= 0 && i < count_of(sampler.array); ++i)
            units.insert(sampler.binding + i);
    for (const Sampler& sampler : interface.samplers)
        bindings.samplers[sampler.name] = take(units, sampler.binding, count_of(sampler.array));
    return bindings;
}

Result<Program> link_program(const Context& context, const std::vector<StageText>& stages) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    Program program(context, gl.CreateProgram());
    Diagnostics diagnostics;
    for (const StageText& stage : stages) {
        const Shader shader(context, stage.kind);
        const Diagnostics errors = compile(gl, shader.id, stage);
        diagnostics.insert(diagnostics.end(), errors.begin(), errors.end());
        gl.AttachShader(program.id(), shader.id);
    }
    if (!diagnostics.empty()) return tl::unexpected(std::move(diagnostics));
    gl.LinkProgram(program.id());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    return tl::unexpected(failure(diagnostics_of_log(log_of_program(gl, program.id()), {}),
                                  "the driver refuses to link the stages without a message"));
}

void set_bindings(const Context& context, const Program& program, const Interface& interface) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    const Bindings bindings = bindings_of(interface);
    for (const auto& [name, binding] : bindings.blocks) {
        const GLuint index = gl.GetUniformBlockIndex(program.id(), name.c_str());
        if (index != GL_INVALID_INDEX)
            gl.UniformBlockBinding(program.id(), index, static_cast<GLuint>(binding));
    }
    gl.UseProgram(program.id());
    for (const Sampler& sampler : interface.samplers) {
        const GLint location = gl.GetUniformLocation(program.id(), sampler.name.c_str());
        if (location < 0) continue;
        std::vector<GLint> units;
        for (int i = 0; i < count_of(sampler.array); ++i)
            units.push_back(bindings.samplers.at(sampler.name) + i);
        gl.Uniform1iv(location, static_cast<GLsizei>(units.size()), units.data());
    }
    gl.UseProgram(0);
}

}  // namespace gobo
