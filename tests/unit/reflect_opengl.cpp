#include "reflect_opengl.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace gobo::testing {
namespace {

using Lines = std::vector<std::string>;

/// GLSL's names of OpenGL's types (OpenGL 4.5, table 7.3), those that the tests use.
const std::map<GLint, std::string> type_names = {
    {GL_FLOAT, "float"},
    {GL_FLOAT_VEC2, "vec2"},
    {GL_FLOAT_VEC3, "vec3"},
    {GL_FLOAT_VEC4, "vec4"},
    {GL_DOUBLE, "double"},
    {GL_DOUBLE_VEC2, "dvec2"},
    {GL_DOUBLE_VEC3, "dvec3"},
    {GL_DOUBLE_VEC4, "dvec4"},
    {GL_DOUBLE_MAT2x3, "dmat2x3"},
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
    {GL_SAMPLER_2D, "sampler2D"},
    {GL_SAMPLER_3D, "sampler3D"},
    {GL_SAMPLER_CUBE, "samplerCube"},
    {GL_SAMPLER_BUFFER, "samplerBuffer"},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow"},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray"},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow"},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow"},
    {GL_INT_SAMPLER_2D, "isampler2D"},
    {GL_UNSIGNED_INT_SAMPLER_3D, "usampler3D"},
};

std::string type_name(GLint type) {
    const auto found = type_names.find(type);
    return found == type_names.end() ? fmt::format("type {:#x}", type) : found->second;
}

struct Layout {
    int offset = 0;
    int array_stride = 0;
    int matrix_stride = 0;
    bool row_major = false;
};

std::string member_line(const std::string& name, const std::string& type, int count, const Layout& layout) {
    return fmt::format("{}: {} x {} at {}, array stride {}, matrix stride {}, {}", name, type, count,
                       layout.offset, layout.array_stride, layout.matrix_stride,
                       layout.row_major ? "rows" : "columns");
}

std::string other_line(std::string_view kind, const std::string& name, const std::string& type, int count,
                       int place) {
    return fmt::format("{} {}: {} x {} at {}", kind, name, type, count, place);
}

int product(const std::vector<int>& extents, std::size_t first) {
    int result = 1;
    for (std::size_t i = first; i < extents.size(); ++i) result *= extents[i];
    return result;
}

/// Calls `visit(suffix, offset in elements)` for every element that OpenGL lists by itself: all of an array
/// of structs; of other arrays the first of the innermost dimension stands for that dimension.
template <class Visit>
void for_each_listed(const std::vector<int>& extents, bool structure, Visit visit) {
    const int innermost = extents.empty() || structure ? 1 : extents.back();
    for (int i = 0; i < product(extents, 0); i += innermost) {
        std::string suffix;
        for (std::size_t k = 0; k < extents.size(); ++k) {
            suffix += fmt::format("[{}]", i / product(extents, k + 1) % extents[k]);
        }
        visit(suffix, i);
    }
}

/// std140 packs the inner dimensions of an array without gaps, so their strides follow from the outermost.
int innermost_stride(const Member& member) {
    return member.array.empty() ? 0 : member.array_stride / product(member.array, 1);
}

void add_leaves(Lines& lines, const std::string& path, int base, const Member& member, bool in_block) {
    const bool structure = !member.members.empty();
    const int stride = innermost_stride(member);
    for_each_listed(member.array, structure, [&](const std::string& suffix, int element) {
        const std::string name = path + member.name + suffix;
        const int offset = base + member.offset + element * stride;
        for (const Member& inner : member.members) add_leaves(lines, name + ".", offset, inner, in_block);
        if (structure) return;
        const int count = member.array.empty() ? 1 : member.array.back();
        if (in_block) {
            lines.push_back(member_line(name, member.type, count,
                                        {offset, stride, member.matrix_stride, member.row_major}));
        } else {
            lines.push_back(other_line("uniform", name, member.type, count, -1));
        }
    });
}

template <class Entry>
void add_others(Lines& lines, std::string_view kind, const std::vector<Entry>& entries, int Entry::*place) {
    for (const Entry& entry : entries) {
        for_each_listed(entry.array, false, [&](const std::string& suffix, int element) {
            const int count = entry.array.empty() ? 1 : entry.array.back();
            lines.push_back(other_line(kind, entry.name + suffix, entry.type, count, entry.*place + element));
        });
    }
}

/// OpenGL's answers to a program-interface query.
class Query {
  public:
    Query(const GladGLContext& gl, GLuint program, GLenum interface)
        : gl_(gl), program_(program), interface_(interface) {
        gl_.GetProgramInterfaceiv(program_, interface_, GL_ACTIVE_RESOURCES, &count_);
    }

    [[nodiscard]] GLuint count() const { return static_cast<GLuint>(count_); }

    [[nodiscard]] GLint value(GLuint index, GLenum property) const {
        GLint result = 0;
        gl_.GetProgramResourceiv(program_, interface_, index, 1, &property, 1, nullptr, &result);
        return result;
    }

    [[nodiscard]] std::string name(GLuint index) const {
        std::array<char, 256> buffer = {};
        gl_.GetProgramResourceName(program_, interface_, index, buffer.size(), nullptr, buffer.data());
        return buffer.data();
    }

  private:
    const GladGLContext& gl_;
    GLuint program_;
    GLenum interface_;
    GLint count_ = 0;
};

/// The block's members are listed below its name only where it has an instance name; here always.
std::string full_name(std::string block, const std::string& member) {
    block = block.substr(0, block.find('[')) + ".";
    return member.starts_with(block) ? member : block + member;
}

void add_uniforms(OpenGlFacts& facts, const GladGLContext& gl, GLuint program) {
    const Query blocks(gl, program, GL_UNIFORM_BLOCK);
    const Query uniforms(gl, program, GL_UNIFORM);
    for (GLuint i = 0; i < uniforms.count(); ++i) {
        const std::string name = uniforms.name(i);
        const std::string type = type_name(uniforms.value(i, GL_TYPE));
        const int count = uniforms.value(i, GL_ARRAY_SIZE);
        const int block = uniforms.value(i, GL_BLOCK_INDEX);
        if (block >= 0) {
            const Layout layout = {uniforms.value(i, GL_OFFSET), uniforms.value(i, GL_ARRAY_STRIDE),
                                   uniforms.value(i, GL_MATRIX_STRIDE),
                                   uniforms.value(i, GL_IS_ROW_MAJOR) != 0};
            facts.blocks.push_back(
                member_line(full_name(blocks.name(static_cast<GLuint>(block)), name), type, count, layout));
            continue;
        }
        const int location = uniforms.value(i, GL_LOCATION);
        if (type.find("sampler") != std::string::npos) {
            GLint unit = 0;
            gl.GetUniformiv(program, location, &unit);
            facts.others.push_back(other_line("sampler", name, type, count, unit));
        } else {
            const bool inside = name.find('.') != std::string::npos;
            facts.others.push_back(other_line("uniform", name, type, count, inside ? -1 : location));
        }
    }
}

void add_variables(Lines& lines, const GladGLContext& gl, GLuint program, GLenum interface,
                   std::string_view kind) {
    const Query variables(gl, program, interface);
    for (GLuint i = 0; i < variables.count(); ++i) {
        if (variables.name(i).starts_with("gl_")) continue;
        lines.push_back(other_line(kind, variables.name(i), type_name(variables.value(i, GL_TYPE)),
                                   variables.value(i, GL_ARRAY_SIZE), variables.value(i, GL_LOCATION)));
    }
}

OpenGlFacts sorted(OpenGlFacts facts) {
    for (Lines* lines : {&facts.blocks, &facts.bindings, &facts.others}) std::ranges::sort(*lines);
    return facts;
}

std::string size_line(const std::string& block, int size) {
    return fmt::format("{}: {} bytes", block, size);
}

std::string binding_line(const std::string& block, int binding) {
    return fmt::format("{}: {}", block, binding);
}

}  // namespace

OpenGlFacts opengl_facts(const Interface& interface) {
    OpenGlFacts facts;
    for (const Block& block : interface.blocks) {
        facts.blocks.push_back(size_line(block.name, block.size));
        facts.bindings.push_back(binding_line(block.name, block.binding));
        const auto bracket = block.name.find('[');
        // OpenGL lists the members of an array of blocks once.
        if (bracket != std::string::npos && !block.name.ends_with("[0]")) continue;
        for (const Member& member : block.members) {
            add_leaves(facts.blocks, block.name.substr(0, bracket) + ".", 0, member, true);
        }
    }
    std::vector<Uniform> simple;
    for (const Uniform& uniform : interface.uniforms) {
        if (uniform.members.empty())
            simple.push_back(uniform);
        else
            add_leaves(facts.others, "", 0,
                       {uniform.name, uniform.type, 0, uniform.array, 0, 0, false, uniform.members}, false);
    }
    add_others(facts.others, "uniform", simple, &Uniform::location);
    add_others(facts.others, "sampler", interface.samplers, &Sampler::binding);
    add_others(facts.others, "input", interface.inputs, &Variable::location);
    add_others(facts.others, "output", interface.outputs, &Variable::location);
    return sorted(facts);
}

OpenGlFacts opengl_facts(const Context& context, const Program& program) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    OpenGlFacts facts;
    const Query blocks(gl, program.id(), GL_UNIFORM_BLOCK);
    for (GLuint i = 0; i < blocks.count(); ++i) {
        facts.blocks.push_back(size_line(blocks.name(i), blocks.value(i, GL_BUFFER_DATA_SIZE)));
        facts.bindings.push_back(binding_line(blocks.name(i), blocks.value(i, GL_BUFFER_BINDING)));
    }
    add_uniforms(facts, gl, program.id());
    add_variables(facts.others, gl, program.id(), GL_PROGRAM_INPUT, "input");
    add_variables(facts.others, gl, program.id(), GL_PROGRAM_OUTPUT, "output");
    return sorted(facts);
}

}  // namespace gobo::testing
