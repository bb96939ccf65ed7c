#include "lab/render/draw_list.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "core/text.hpp"
#include "lab/render/vertex_values.hpp"

namespace gobo {
namespace {

Diagnostic warning(std::string message, std::string help) {
    Diagnostic diagnostic;
    diagnostic.severity = Severity::warning;
    diagnostic.message = std::move(message);
    diagnostic.help = std::move(help);
    return diagnostic;
}

tl::unexpected<Diagnostics> unknown_source(const RenderValue& value, const std::vector<std::string>& known) {
    Diagnostic diagnostic;
    diagnostic.place = value.place;
    diagnostic.message = fmt::format("unknown source '{}' for '{}'", value.source, value.name);
    diagnostic.help = suggestion(value.source, known);
    return fail(std::move(diagnostic));
}

/// Uploads a mesh's attribute to `location` of the vertex array that is bound.
void upload(GlResources& resources, GLuint location, const Mesh& mesh, std::string_view source) {
    const GladGLContext& gl = resources.context().gl();
    const auto attach = [&](const auto& values) {
        static_cast<void>(
            resources.make_buffer(GL_ARRAY_BUFFER, values.data(), values.size() * sizeof values[0]));
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, static_cast<GLint>(sizeof values[0] / sizeof(float)), GL_FLOAT,
                               GL_FALSE, 0, nullptr);
    };
    const auto attach_integers = [&](const std::vector<std::int32_t>& values) {
        static_cast<void>(
            resources.make_buffer(GL_ARRAY_BUFFER, values.data(), values.size() * sizeof values[0]));
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribIPointer(location, 1, GL_INT, 0, nullptr);
    };
    if (source == "tile") attach(tiled_texcoords(mesh));
    if (source == "tint") attach(vertex_tints(mesh));
    if (source == "material_number") attach_integers(material_numbers(mesh));
    if (source == "position") attach(mesh.positions);
    if (source == "normal") attach(mesh.normals);
    if (source == "texcoord") attach(mesh.texcoords);
    if (source == "color") attach(mesh.colors);
}

}  // namespace

const RenderValue* find_value(const std::vector<RenderValue>& values, std::string_view name) {
    const auto found = std::find_if(values.rbegin(), values.rend(),
                                    [&](const RenderValue& value) { return value.name == name; });
    return found == values.rend() ? nullptr : &*found;
}

bool Object::is_mirrored() const {
    return glm::determinant(glm::dmat3(model)) < 0;
}

GlResources::GlResources(GlResources&& other) noexcept
    : context_(other.context_),
      arrays_(std::exchange(other.arrays_, {})),
      buffers_(std::exchange(other.buffers_, {})),
      textures_(std::exchange(other.textures_, {})) {}

GlResources& GlResources::operator=(GlResources&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(arrays_, other.arrays_);
    std::swap(buffers_, other.buffers_);
    std::swap(textures_, other.textures_);
    return *this;
}

GlResources::~GlResources() {
    if (arrays_.empty() && buffers_.empty() && textures_.empty()) return;
    context_.make_current();
    const GladGLContext& gl = context_.gl();
    gl.DeleteVertexArrays(static_cast<GLsizei>(arrays_.size()), arrays_.data());
    gl.DeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    gl.DeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
}

GLuint GlResources::make_array() {
    arrays_.push_back(0);
    context_.gl().GenVertexArrays(1, &arrays_.back());
    return arrays_.back();
}

GLuint GlResources::make_buffer(GLenum target, const void* data, std::size_t size) {
    buffers_.push_back(0);
    context_.gl().GenBuffers(1, &buffers_.back());
    context_.gl().BindBuffer(target, buffers_.back());
    context_.gl().BufferData(target, static_cast<GLsizeiptr>(size), data, GL_STATIC_DRAW);
    return buffers_.back();
}

void DrawList::warn(Diagnostic warning) {
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
        warnings_.push_back(std::move(warning));
}

Result<void> DrawList::add_attributes(Item& item, const Interface& interface, const Object& object,
                                      const std::vector<RenderValue>& values) {
    const GladGLContext& gl = resources_.context().gl();
    for (const Variable& input : interface.inputs) {
        const GLint found = gl.GetAttribLocation(program_->id(), input.name.c_str());
        if (found < 0) continue;
        const auto location = static_cast<GLuint>(found);
        const RenderValue* value = find_value(values, input.name);
        if (value != nullptr && value->source.empty()) {
            item.constants.push_back({location, value->numbers});
            continue;
        }
        const std::string source(value != nullptr ? value->source : attribute_source_of(input.name));
        const auto& known = attribute_sources();
        if (source == "color" && object.mesh.colors.empty()) {
            item.constants.push_back({location, {1, 1, 1, 1}});
        } else if (std::find(known.begin(), known.end(), source) != known.end()) {
            upload(resources_, location, object.mesh, source);
        } else if (value != nullptr) {
            return unknown_source(*value, known);
        } else {
            item.constants.push_back({location, {0, 0, 0, 0}});
            warn(warning(fmt::format("the attribute '{}' has no value and stays 0", input.name),
                         "give it one under [render] in the family file"));
        }
    }
    return {};
}

Result<void> DrawList::add(const Interface& interface, const Object& object,
                           const std::vector<RenderValue>& values, ViewedObject view) {
    view.model = object.model;
    std::vector<RenderValue> all = values;
    all.insert(all.end(), object.values.begin(), object.values.end());
    const auto resolved = resolve_uniforms(interface, all, view);
    if (!resolved) return tl::unexpected(resolved.error());
    for (const Diagnostic& diagnostic : resolved->warnings) warn(diagnostic);
    Item item;
    const Bindings bindings = bindings_of(interface);
    for (const Block& block : interface.blocks) {
        std::vector<std::byte> bytes(static_cast<std::size_t>(block.size));
        for (const Assignment& assignment : resolved->assignments)
            if (assignment.leaf.block == block.name) write(assignment, bytes);
        item.blocks.push_back({static_cast<GLuint>(bindings.blocks.at(block.name)),
                               resources_.make_buffer(GL_UNIFORM_BUFFER, bytes.data(), bytes.size())});
    }
    for (const Assignment& assignment : resolved->assignments)
        if (assignment.leaf.block.empty()) item.uniforms.push_back(assignment);
    item.array = resources_.make_array();
    resources_.context().gl().BindVertexArray(item.array);
    if (auto added = add_attributes(item, interface, object, all); !added) return added;
    const std::vector<std::uint32_t>& indices = object.mesh.indices;
    static_cast<void>(
        resources_.make_buffer(GL_ELEMENT_ARRAY_BUFFER, indices.data(), indices.size() * sizeof indices[0]));
    item.indices = static_cast<GLsizei>(indices.size());
    if (object.culls_back_faces) item.culled = object.is_mirrored() ? GL_FRONT : GL_BACK;
    resources_.context().gl().BindVertexArray(0);
    items_.push_back(std::move(item));
    return {};
}

void DrawList::add_textures(const Interface& interface, const std::vector<RenderValue>& values,
                            const GivenTextures& given) {
    const Bindings bindings = bindings_of(interface);
    for (const Sampler& sampler : interface.samplers) {
        if (const auto found = given.find(sampler.name); found != given.end()) {
            units_.push_back({static_cast<GLuint>(bindings.samplers.at(sampler.name)), found->second});
            continue;
        }
        const auto texture =
            make_texture(resources_.context(), sampler.type, texture_source_of(sampler.name, values));
        if (!texture) {
            warn(warning(
                fmt::format("the renderer has no texture for '{}' of type {}", sampler.name, sampler.type),
                "it reads as black"));
            continue;
        }
        resources_.adopt(*texture);
        int count = 1;
        for (const int extent : sampler.array) count *= extent;
        const auto first = static_cast<GLuint>(bindings.samplers.at(sampler.name));
        for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) units_.push_back({first + i, *texture});
    }
}

void DrawList::draw() const {
    resources_.context().make_current();
    const GladGLContext& gl = resources_.context().gl();
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.UseProgram(program_->id());
    for (const Unit& unit : units_) {
        gl.ActiveTexture(GL_TEXTURE0 + unit.unit);
        gl.BindTexture(unit.texture.target, unit.texture.name);
    }
    for (const Item& item : items_) {
        for (const Buffer& block : item.blocks)
            gl.BindBufferBase(GL_UNIFORM_BUFFER, block.binding, block.buffer);
        for (const Assignment& uniform : item.uniforms) set_uniform(gl, *program_, uniform);
        for (const Constant& constant : item.constants) {
            std::array<GLfloat, 4> values = {0, 0, 0, 1};
            for (std::size_t i = 0; i < std::min<std::size_t>(constant.numbers.size(), 4); ++i)
                values[i] = static_cast<GLfloat>(constant.numbers[i]);
            gl.VertexAttrib4fv(constant.location, values.data());
        }
        if (item.culled == GL_NONE) {
            gl.Disable(GL_CULL_FACE);
        } else {
            gl.Enable(GL_CULL_FACE);
            gl.CullFace(item.culled);
        }
        gl.BindVertexArray(item.array);
        gl.DrawElements(GL_TRIANGLES, item.indices, GL_UNSIGNED_INT, nullptr);
    }
    gl.Disable(GL_CULL_FACE);
    gl.BindVertexArray(0);
    gl.UseProgram(0);
}

Result<DrawList> make_draw_list(const Context& context, const Program& program, const Interface& interface,
                                const std::vector<Object>& objects, const std::vector<RenderValue>& values,
                                const ViewedObject& view, const GivenTextures& textures) {
    context.make_current();
    for (const Sampler& sampler : interface.samplers) {
        const RenderValue* value = find_value(values, sampler.name);
        if (value == nullptr || value->source.empty()) continue;
        const auto& known = texture_sources();
        if (std::find(known.begin(), known.end(), value->source) == known.end())
            return unknown_source(*value, known);
    }
    DrawList list(context, program);
    list.add_textures(interface, values, textures);
    for (const Object& object : objects)
        if (const auto added = list.add(interface, object, values, view); !added)
            return tl::unexpected(added.error());
    return list;
}

}  // namespace gobo
