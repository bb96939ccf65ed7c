#include "renderer.hpp"

#include <stdexcept>

#define GOBO_GL_NO_LOADER  // OpenGL's functions stand in glad's table
#include <gobo/gl.hpp>

namespace teapot {
namespace {

template <class Value>
GLuint filled_buffer(const GladGLContext& gl, const std::vector<Value>& values) {
    GLuint buffer = 0;
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size() * sizeof(Value)), values.data(), 0);
    return buffer;
}

void set_attribute(const GladGLContext& gl, GLuint array, int location, std::size_t offset) {
    const auto attribute = static_cast<GLuint>(location);
    gl.EnableVertexArrayAttrib(array, attribute);
    gl.VertexArrayAttribFormat(array, attribute, 3, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.VertexArrayAttribBinding(array, attribute, 0);
}

}  // namespace

void Renderer::clear(glm::vec3 radiance) const {
    gl_.ClearColor(radiance.x, radiance.y, radiance.z, 1);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Renderer::draw(const Mesh& mesh, const lit::Key& key) {
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Enable(GL_CULL_FACE);
    gl_.UseProgram(program_of(key));
    const Vertices& vertices = vertices_of(mesh);
    gl_.BindVertexArray(vertices.array);
    gl_.DrawElements(GL_TRIANGLES, vertices.count, GL_UNSIGNED_INT, nullptr);
}

void Renderer::set_bytes(int binding, const void* bytes, std::size_t size) {
    GLuint& buffer = blocks_[binding];
    if (buffer == 0) {
        gl_.CreateBuffers(1, &buffer);
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), buffer);
    }
    gl_.NamedBufferData(buffer, static_cast<GLsizeiptr>(size), bytes, GL_DYNAMIC_DRAW);
}

GLuint Renderer::program_of(const lit::Key& key) {
    const lit::Permutation* permutation = lit::find(key);
    if (permutation == nullptr) throw std::runtime_error(lit::describe_missing(key));
    GLuint& program = programs_[permutation];
    if (program == 0) {
        const gobo::gl::Program built = gobo::gl::build_program(*permutation, gl_);
        if (!built) throw std::runtime_error(built.error);
        program = built.id;
    }
    return program;
}

const Renderer::Vertices& Renderer::vertices_of(const Mesh& mesh) {
    Vertices& vertices = vertices_[&mesh];
    if (vertices.array != 0) return vertices;
    gl_.CreateVertexArrays(1, &vertices.array);
    gl_.VertexArrayVertexBuffer(vertices.array, 0, filled_buffer(gl_, mesh.vertices), 0, sizeof(Vertex));
    gl_.VertexArrayElementBuffer(vertices.array, filled_buffer(gl_, mesh.indices));
    set_attribute(gl_, vertices.array, lit::attribute::position, offsetof(Vertex, position));
    set_attribute(gl_, vertices.array, lit::attribute::normal, offsetof(Vertex, normal));
    vertices.count = static_cast<GLsizei>(mesh.indices.size());
    return vertices;
}

}  // namespace teapot
