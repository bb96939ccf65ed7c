// Draws meshes with permutations of lit, each built when it is first asked for.
#pragma once

#include <cstddef>
#include <map>

#include <glad/gl.h>

#include "lit.hpp"
#include "mesh.hpp"

namespace teapot {

class Renderer {
  public:
    explicit Renderer(const GladGLContext& gl) : gl_(gl) {}

    /// Puts a uniform block of lit.hpp where every permutation finds it.
    template <class Block>
    void set(const Block& block) {
        set_bytes(Block::binding, &block, sizeof block);
    }

    /// Fills the picture with a radiance and forgets all depths.
    void clear(glm::vec3 radiance) const;
    /// Draws a mesh by the permutation of a key. Throws std::runtime_error where it was not built.
    void draw(const Mesh& mesh, const lit::Key& key);

  private:
    struct Vertices {
        GLuint array = 0;
        GLsizei count = 0;
    };

    void set_bytes(int binding, const void* bytes, std::size_t size);
    GLuint program_of(const lit::Key& key);
    const Vertices& vertices_of(const Mesh& mesh);

    const GladGLContext& gl_;
    std::map<int, GLuint> blocks_;
    std::map<const lit::Permutation*, GLuint> programs_;
    std::map<const Mesh*, Vertices> vertices_;
};

}  // namespace teapot
