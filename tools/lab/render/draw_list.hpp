// Objects made ready to be drawn by one program: all that remains is OpenGL's own work, so that it can be
// timed.
#pragma once

#include <vector>

#include "lab/render/bind.hpp"
#include "lab/render/mesh.hpp"
#include "lab/render/texture.hpp"

namespace gobo {

/// What shadow maps hold of an object: all of its triangles, these without what its own program discards, or
/// nothing.
enum class ShadowShape { whole, with_holes, none };

/// A mesh in the world.
struct Object {
    Mesh mesh;
    glm::dmat4 model{1};              ///< object to world space
    std::vector<RenderValue> values;  ///< uniforms and attributes that differ from those of other objects
    bool culls_back_faces = false;    ///< the model matrix may mirror: a front face stays one
    bool casts_shadow = true;         ///< shadow maps are fitted to the objects that do
    ShadowShape shadow_shape = ShadowShape::whole;

    /// Whether the model matrix turns counter-clockwise faces into clockwise ones.
    [[nodiscard]] bool is_mirrored() const;
};

/// As what the corners of a mesh's triangles are drawn: in their order, as many at a time as it takes.
struct Primitive {
    GLenum mode = GL_TRIANGLES;
    GLint corners_of_patch = 0;  ///< of GL_PATCHES
};

/// Objects with their vertex arrays, filled uniform buffers and textures.
class DrawList {
  public:
    /// Draws all objects to the framebuffer that is bound, with a depth test (less).
    void draw() const;
    /// Attributes, uniforms and samplers without a value, each once.
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    friend Result<DrawList> make_draw_list(const Context& context, const Program& program,
                                           const Interface& interface, const std::vector<Object>& objects,
                                           const std::vector<RenderValue>& values, const ViewedObject& view,
                                           const GivenTextures& textures);
    /// An attribute that is the same for all vertices.
    struct Constant {
        GLuint location;
        std::vector<double> numbers;
    };
    struct Buffer {
        GLuint binding;
        GLuint buffer;
    };
    struct Unit {
        GLuint unit;
        Texture texture;
    };
    struct Item {
        GLuint array = 0;
        GLsizei indices = 0;
        GLenum culled = GL_NONE;  ///< GL_BACK, GL_FRONT or nothing
        std::vector<Constant> constants;
        std::vector<Buffer> blocks;
        std::vector<Assignment> uniforms;
    };

    DrawList(const Context& context, const Program& program) : resources_(context), program_(program) {}
    Result<void> add(const Interface& interface, const Object& object, const std::vector<RenderValue>& values,
                     ViewedObject view);
    Result<void> add_attributes(Item& item, const Interface& interface, const Mesh& mesh,
                                const std::vector<RenderValue>& values);
    void add_textures(const Interface& interface, const std::vector<RenderValue>& values,
                      const GivenTextures& given);
    void warn(Diagnostic warning);

    GlResources resources_;
    Program program_;
    Primitive primitive_;
    std::vector<Item> items_;
    std::vector<Unit> units_;
    Diagnostics warnings_;
};

/// Uploads the objects. Samplers that `textures` names get those, others what `values` say. `values` are the
/// family's, an object's own come after them; `view` is the camera's part (its model matrix is replaced by
/// each object's). Patches have as many corners as the tessellation control stage makes; without one, three
/// for triangles and four for quads and lines. Errors as of resolve_uniforms(), and unknown attribute or
/// texture sources.
[[nodiscard]] Result<DrawList> make_draw_list(const Context& context, const Program& program,
                                              const Interface& interface, const std::vector<Object>& objects,
                                              const std::vector<RenderValue>& values,
                                              const ViewedObject& view, const GivenTextures& textures = {});

}  // namespace gobo
