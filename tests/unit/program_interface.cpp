#include "program_interface.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

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

/// GLSL's names of OpenGL's types.
constexpr auto kTypeNames = std::to_array<std::pair<GLenum, std::string_view>>({
    {GL_FLOAT, "float"},
    {GL_FLOAT_VEC2, "vec2"},
    {GL_FLOAT_VEC3, "vec3"},
    {GL_FLOAT_VEC4, "vec4"},
    {GL_DOUBLE, "double"},
    {GL_DOUBLE_VEC2, "dvec2"},
    {GL_DOUBLE_VEC3, "dvec3"},
    {GL_DOUBLE_VEC4, "dvec4"},
    {GL_INT, "int"},
    {GL_INT_VEC2, "ivec2"},
    {GL_INT_VEC3, "ivec3"},
    {GL_INT_VEC4, "ivec4"},
    {GL_UNSIGNED_INT, "uint"},
    {GL_UNSIGNED_INT_VEC2, "uvec2"},
    {GL_UNSIGNED_INT_VEC3, "uvec3"},
    {GL_UNSIGNED_INT_VEC4, "uvec4"},
    {GL_BOOL, "bool"},
    {GL_BOOL_VEC2, "bvec2"},
    {GL_BOOL_VEC3, "bvec3"},
    {GL_BOOL_VEC4, "bvec4"},
    {GL_FLOAT_MAT2, "mat2"},
    {GL_FLOAT_MAT3, "mat3"},
    {GL_FLOAT_MAT4, "mat4"},
    {GL_FLOAT_MAT2x3, "mat2x3"},
    {GL_FLOAT_MAT2x4, "mat2x4"},
    {GL_FLOAT_MAT3x2, "mat3x2"},
    {GL_FLOAT_MAT3x4, "mat3x4"},
    {GL_FLOAT_MAT4x2, "mat4x2"},
    {GL_FLOAT_MAT4x3, "mat4x3"},
    {GL_DOUBLE_MAT2, "dmat2"},
    {GL_DOUBLE_MAT3, "dmat3"},
    {GL_DOUBLE_MAT4, "dmat4"},
    {GL_DOUBLE_MAT2x3, "dmat2x3"},
    {GL_DOUBLE_MAT2x4, "dmat2x4"},
    {GL_DOUBLE_MAT3x2, "dmat3x2"},
    {GL_DOUBLE_MAT3x4, "dmat3x4"},
    {GL_DOUBLE_MAT4x2, "dmat4x2"},
    {GL_DOUBLE_MAT4x3, "dmat4x3"},
    {GL_SAMPLER_1D, "sampler1D"},
    {GL_SAMPLER_2D, "sampler2D"},
    {GL_SAMPLER_3D, "sampler3D"},
    {GL_SAMPLER_CUBE, "samplerCube"},
    {GL_SAMPLER_1D_SHADOW, "sampler1DShadow"},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
    {GL_SAMPLER_1D_ARRAY, "sampler1DArray"},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray"},
    {GL_SAMPLER_CUBE_MAP_ARRAY, "samplerCubeArray"},
    {GL_SAMPLER_1D_ARRAY_SHADOW, "sampler1DArrayShadow"},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow"},
    {GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, "samplerCubeArrayShadow"},
    {GL_SAMPLER_2D_MULTISAMPLE, "sampler2DMS"},
    {GL_SAMPLER_2D_MULTISAMPLE_ARRAY, "sampler2DMSArray"},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow"},
    {GL_SAMPLER_BUFFER, "samplerBuffer"},
    {GL_SAMPLER_2D_RECT, "sampler2DRect"},
    {GL_SAMPLER_2D_RECT_SHADOW, "sampler2DRectShadow"},
    {GL_INT_SAMPLER_1D, "isampler1D"},
    {GL_INT_SAMPLER_2D, "isampler2D"},
    {GL_INT_SAMPLER_3D, "isampler3D"},
    {GL_INT_SAMPLER_CUBE, "isamplerCube"},
    {GL_INT_SAMPLER_2D_ARRAY, "isampler2DArray"},
    {GL_INT_SAMPLER_BUFFER, "isamplerBuffer"},
    {GL_UNSIGNED_INT_SAMPLER_1D, "usampler1D"},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D"},
    {GL_UNSIGNED_INT_SAMPLER_3D, "usampler3D"},
    {GL_UNSIGNED_INT_SAMPLER_CUBE, "usamplerCube"},
    {GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, "usampler2DArray"},
    {GL_UNSIGNED_INT_SAMPLER_BUFFER, "usamplerBuffer"},
});

std::string type_name(GLint enumerant) {
    const auto number = static_cast<GLenum>(enumerant);
    for (const auto& [known, name] : kTypeNames)
        if (known == number) return std::string(name);
    return fmt::format("type 0x{:04X}", number);
}

bool is_sampler(const std::string& type) {
    return type.find("sampler") != std::string::npos;
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
        if (!is_sampler(leaf.type)) {
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
