#include "program_interface.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "lab/render/value_type.hpp"

namespace gobo {
namespace {

/// One of the program's interfaces (GL_UNIFORM, GL_PROGRAM_INPUT, ...).
class Query {
  public:
    Query(const GladGLContext& gl, GLuint program, GLenum interface)
        : gl_(gl), program_(program), interface_(interface) {}

    [[nodiscard]] GLuint count() const {
        GLint count = 0;
        gl_.GetProgramInterfaceiv(program_, interface_, GL_ACTIVE_RESOURCES, &count);
        return static_cast<GLuint>(count);
    }
    [[nodiscard]] GLint get(GLuint resource, GLenum property) const {
        GLint value = 0;
        gl_.GetProgramResourceiv(program_, interface_, resource, 1, &property, 1, nullptr, &value);
        return value;
    }
    [[nodiscard]] std::string name(GLuint resource) const {
        std::string name(static_cast<std::size_t>(get(resource, GL_NAME_LENGTH)), '\0');
        GLsizei length = 0;
        gl_.GetProgramResourceName(program_, interface_, resource, static_cast<GLsizei>(name.size()), &length,
                                   name.data());
        name.resize(static_cast<std::size_t>(length));
        return name;
    }

  private:
    const GladGLContext& gl_;
    GLuint program_;
    GLenum interface_;
};

/// Takes off the "[0]" that OpenGL puts after the name of an array of scalars, vectors or matrices.
bool take_off_subscript(std::string& name) {
    if (!name.ends_with("[0]")) return false;
    name.resize(name.size() - 3);
    return true;
}

std::string type_name(GLint enumerant) {
    const auto number = static_cast<GLenum>(enumerant);
    if (const auto type = value_type(number)) return std::string(type->name);
    const std::string_view sampler = sampler_type_name(number);
    return sampler.empty() ? fmt::format("type 0x{:04X}", number) : std::string(sampler);
}

std::vector<std::string> stages_of(const Query& query, GLuint resource) {
    std::vector<std::string> stages;
    if (query.get(resource, GL_REFERENCED_BY_VERTEX_SHADER) != 0) stages.emplace_back("vertex");
    if (query.get(resource, GL_REFERENCED_BY_FRAGMENT_SHADER) != 0) stages.emplace_back("fragment");
    return stages;
}

std::vector<Block> blocks_of(const Query& query) {
    std::vector<Block> blocks;
    for (GLuint i = 0; i < query.count(); ++i)
        blocks.push_back({query.name(i),
                          query.get(i, GL_BUFFER_BINDING),
                          query.get(i, GL_BUFFER_DATA_SIZE),
                          stages_of(query, i),
                          {}});
    return blocks;
}

Leaf leaf_of(const Query& query, GLuint resource, const std::string& block) {
    Leaf leaf{query.name(resource), block, type_name(query.get(resource, GL_TYPE))};
    leaf.is_array = take_off_subscript(leaf.name);
    leaf.count = query.get(resource, GL_ARRAY_SIZE);
    if (block.empty()) return leaf;
    if (!leaf.name.starts_with(block + ".")) leaf.name.insert(0, block + ".");
    leaf.offset = query.get(resource, GL_OFFSET);
    leaf.array_stride = query.get(resource, GL_ARRAY_STRIDE);
    leaf.matrix_stride = query.get(resource, GL_MATRIX_STRIDE);
    leaf.row_major = query.get(resource, GL_IS_ROW_MAJOR) != 0;
    return leaf;
}

std::vector<Variable> variables_of(const Query& query) {
    std::vector<Variable> variables;
    for (GLuint i = 0; i < query.count(); ++i) {
        Variable variable{query.name(i), type_name(query.get(i, GL_TYPE)), query.get(i, GL_LOCATION), {}};
        if (variable.name.starts_with("gl_")) continue;
        if (take_off_subscript(variable.name)) variable.array = {query.get(i, GL_ARRAY_SIZE)};
        variables.push_back(std::move(variable));
    }
    return variables;
}

}  // namespace

ProgramInterface interface_of_program(const Context& context, const Program& program) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    ProgramInterface result;
    result.blocks = blocks_of(Query(gl, program.id(), GL_UNIFORM_BLOCK));
    const Query uniforms(gl, program.id(), GL_UNIFORM);
    for (GLuint i = 0; i < uniforms.count(); ++i) {
        const GLint block = uniforms.get(i, GL_BLOCK_INDEX);
        Leaf leaf =
            leaf_of(uniforms, i, block < 0 ? "" : result.blocks[static_cast<std::size_t>(block)].name);
        if (sampler_type_name(static_cast<GLenum>(uniforms.get(i, GL_TYPE))).empty()) {
            result.leaves.push_back(std::move(leaf));
            continue;
        }
        GLint unit = 0;
        gl.GetUniformiv(program.id(), uniforms.get(i, GL_LOCATION), &unit);
        const std::vector<int> array = leaf.is_array ? std::vector<int>{leaf.count} : std::vector<int>{};
        result.samplers.push_back({leaf.name, leaf.type, unit, array, stages_of(uniforms, i)});
    }
    result.inputs = variables_of(Query(gl, program.id(), GL_PROGRAM_INPUT));
    result.outputs = variables_of(Query(gl, program.id(), GL_PROGRAM_OUTPUT));
    const auto by_name = [](const auto& left, const auto& right) { return left.name < right.name; };
    std::sort(result.blocks.begin(), result.blocks.end(), by_name);
    std::sort(result.leaves.begin(), result.leaves.end(), by_name);
    std::sort(result.samplers.begin(), result.samplers.end(), by_name);
    std::sort(result.inputs.begin(), result.inputs.end(), by_name);
    std::sort(result.outputs.begin(), result.outputs.end(), by_name);
    return result;
}

}  // namespace gobo
