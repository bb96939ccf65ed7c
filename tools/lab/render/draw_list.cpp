#include "lab/render/draw_list.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "lab/render/chosen_values.hpp"

namespace gobo {
namespace {

template <class Value>
void upload(GlResources& resources, GLenum target, const std::vector<Value>& values) {
    resources.make_buffer(target, values.data(), values.size() * sizeof(Value));
}

/// Uploads an attribute to `location` of the vertex array that is bound.
void upload(GlResources& resources, GLuint location, const AttributeValues& values) {
    const GladGLContext& gl = resources.context().gl();
    if (values.integers.empty()) {
        upload(resources, GL_ARRAY_BUFFER, values.floats);
        gl.VertexAttribPointer(location, values.components, GL_FLOAT, GL_FALSE, 0, nullptr);
    } else {
        upload(resources, GL_ARRAY_BUFFER, values.integers);
        gl.VertexAttribIPointer(location, values.components, GL_INT, 0, nullptr);
    }
    gl.EnableVertexAttribArray(location);
}

/// As what a mesh is drawn, so that the program's first stage behind the vertex stage takes it.
Primitive primitive_of(const GladGLContext& gl, const Program& program, const Interface& interface) {
    const auto has = [&](StageKind kind) { return std::ranges::count(interface.stages, name_of(kind)) > 0; };
    const auto number = [&](GLenum name) {
        GLint value = 0;
        gl.GetProgramiv(program.id(), name, &value);
        return value;
    };
    if (!has(StageKind::tess_evaluation))
        return {has(StageKind::geometry) ? static_cast<GLenum>(number(GL_GEOMETRY_INPUT_TYPE))
                                         : GL_TRIANGLES};
    if (has(StageKind::tess_control)) return {GL_PATCHES, number(GL_TESS_CONTROL_OUTPUT_VERTICES)};
    return {GL_PATCHES, number(GL_TESS_GEN_MODE) == GL_TRIANGLES ? 3 : 4};
}

}  // namespace

bool Object::is_mirrored() const {
    return glm::determinant(glm::dmat3(model)) < 0;
}

void DrawList::warn(Diagnostic warning) {
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
        warnings_.push_back(std::move(warning));
}

Result<void> DrawList::add_attributes(Item& item, const Interface& interface, const Mesh& mesh,
                                      const std::vector<RenderValue>& values) {
    const GladGLContext& gl = resources_.context().gl();
    for (const Variable& input : interface.inputs) {
        const GLint found = gl.GetAttribLocation(program_.id(), input.name.c_str());
        if (found < 0) continue;
        const auto location = static_cast<GLuint>(found);
        GOBO_TRY(ChosenAttribute chosen, chosen_attribute(input.name, mesh, values));
        if (chosen.warning) warn(*std::move(chosen.warning));
        if (chosen.is_constant)
            item.constants.push_back({location, {chosen.values.floats.begin(), chosen.values.floats.end()}});
        else
            upload(resources_, location, chosen.values);
    }
    return {};
}

Result<void> DrawList::add(const Interface& interface, const Object& object,
                           const std::vector<RenderValue>& values, ViewedObject view) {
    view.model = object.model;
    std::vector<RenderValue> all = values;
    all.insert(all.end(), object.values.begin(), object.values.end());
    GOBO_TRY(const ResolvedUniforms resolved, resolve_uniforms(interface, all, view));
    for (const Diagnostic& diagnostic : resolved.warnings) warn(diagnostic);
    Item item;
    const Bindings bindings = bindings_of(interface);
    for (const Block& block : interface.blocks) {
        const std::vector<std::byte> bytes = bytes_of(block, resolved.assignments);
        item.blocks.push_back({static_cast<GLuint>(bindings.blocks.at(block.name)),
                               resources_.make_buffer(GL_UNIFORM_BUFFER, bytes.data(), bytes.size())});
    }
    for (const Assignment& assignment : resolved.assignments)
        if (assignment.leaf.block.empty()) item.uniforms.push_back(assignment);
    const GladGLContext& gl = resources_.context().gl();
    item.array = resources_.make(&GladGLContext::GenVertexArrays, &GladGLContext::DeleteVertexArrays);
    gl.BindVertexArray(item.array);
    GOBO_TRY_DO(add_attributes(item, interface, object.mesh, all));
    upload(resources_, GL_ELEMENT_ARRAY_BUFFER, object.mesh.indices);
    item.indices = static_cast<GLsizei>(object.mesh.indices.size());
    if (object.culls_back_faces) item.culled = object.is_mirrored() ? GL_FRONT : GL_BACK;
    gl.BindVertexArray(0);
    items_.push_back(std::move(item));
    return {};
}

void DrawList::add_textures(const Interface& interface, const std::vector<RenderValue>& values,
                            const GivenTextures& given) {
    const Bindings bindings = bindings_of(interface);
    for (const Sampler& sampler : interface.samplers) {
        const auto first = static_cast<GLuint>(bindings.samplers.at(sampler.name));
        if (const auto found = given.find(sampler.name); found != given.end()) {
            units_.push_back({first, found->second});
            continue;
        }
        const auto texture =
            make_texture(resources_.context(), sampler.type, texture_source_of(sampler.name, values));
        if (!texture) {
            Diagnostic warning;
            warning.severity = Severity::warning;
            warning.message =
                fmt::format("the renderer has no texture for '{}' of type {}", sampler.name, sampler.type);
            warning.help = "it reads as black";
            warn(std::move(warning));
            continue;
        }
        resources_.adopt(*texture);
        const auto count = static_cast<GLuint>(element_count(sampler.array));
        for (GLuint i = 0; i < count; ++i) units_.push_back({first + i, *texture});
    }
}

void DrawList::draw() const {
    resources_.context().make_current();
    const GladGLContext& gl = resources_.context().gl();
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.UseProgram(program_.id());
    if (primitive_.mode == GL_PATCHES) gl.PatchParameteri(GL_PATCH_VERTICES, primitive_.corners_of_patch);
    for (const Unit& unit : units_) {
        gl.ActiveTexture(GL_TEXTURE0 + unit.unit);
        gl.BindTexture(unit.texture.target, unit.texture.name);
    }
    for (const Item& item : items_) {
        for (const Buffer& block : item.blocks)
            gl.BindBufferBase(GL_UNIFORM_BUFFER, block.binding, block.buffer);
        for (const Assignment& uniform : item.uniforms) set_uniform(gl, program_, uniform);
        for (const Constant& constant : item.constants) {
            gl.VertexAttrib4dv(constant.location, constant.numbers.data());
        }
        if (item.culled == GL_NONE) {
            gl.Disable(GL_CULL_FACE);
        } else {
            gl.Enable(GL_CULL_FACE);
            gl.CullFace(item.culled);
        }
        gl.BindVertexArray(item.array);
        gl.DrawElements(primitive_.mode, item.indices, GL_UNSIGNED_INT, nullptr);
    }
    gl.Disable(GL_CULL_FACE);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
}

Result<DrawList> make_draw_list(const Context& context, const Program& program, const Interface& interface,
                                const std::vector<Object>& objects, const std::vector<RenderValue>& values,
                                const ViewedObject& view, const GivenTextures& textures) {
    context.make_current();
    GOBO_TRY_DO(check_textures(interface, values));
    DrawList list(context, program);
    list.primitive_ = primitive_of(context.gl(), program, interface);
    list.add_textures(interface, values, textures);
    for (const Object& object : objects) GOBO_TRY_DO(list.add(interface, object, values, view));
    return list;
}

}  // namespace gobo
