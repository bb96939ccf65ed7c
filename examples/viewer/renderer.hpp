// Draws a stage, each draw by the permutation that it needs. Programs are built when first asked for.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glad/gl.h>
#include <gobo/record.hpp>
#include <gobo/reload.hpp>

#include "lab/render/image.hpp"
#include "orbit.hpp"
#include "shadows.hpp"
#include "stage.hpp"
#include "textures.hpp"

namespace viewer {

/// Of the framebuffer, in pixels.
struct Size {
    int width = 960;
    int height = 600;
};

class Renderer {
  public:
    /// The functions must stay those of the current context for as long as this lives. Keys that were not
    /// built are noted in `record`.
    /// `reload` is the socket of gobo watch, or empty.
    Renderer(const GladGLContext& gl, const Stage& stage, Size size, gobo::KeyRecord& record,
             const std::string& reload);

    /// Takes the shaders that were changed since, between two frames. What is new: "2 programs changed";
    /// empty where nothing is.
    [[nodiscard]] std::string take_changes();

    /// Draws one frame to a float framebuffer.
    void draw(const Settings& settings, const Orbit& orbit);
    /// Milliseconds of a frame: the median of several, the driver waited for.
    [[nodiscard]] double frame_time(const Settings& settings, const Orbit& orbit);
    /// The picture drawn last: linear radiance.
    [[nodiscard]] gobo::Image picture() const;
    /// Shows it in the window's own framebuffer, which has the given size.
    void show(Size window) const;

    /// The distinct keys of the frame drawn last, sorted.
    [[nodiscard]] const std::set<std::string>& keys() const { return keys_; }
    /// What could not be drawn, and why, since this was last asked.
    [[nodiscard]] std::vector<std::string> take_complaints();

  private:
    /// A program, and how it is built anew.
    struct Built {
        GLuint id = 0;
        std::string key;
        /// By the texts given, else by those of the header: its id, or 0 and why there is none.
        std::function<std::pair<GLuint, std::string>(const gobo::ReloadedProgram*)> build;
        std::function<bool(const gobo::ReloadedProgram&)> is_as_built;
    };
    struct Vertices {
        GLuint array = 0;
        GLsizei count = 0;
    };

    void make_framebuffer();
    void upload(const gobo::Mesh& mesh);
    void draw(std::size_t number, const Settings& settings, const glm::dmat4& view,
              const glm::dmat4& projection);
    void draw_mesh(std::size_t number, GLuint program);
    void draw_depths(const gobo::ShadowCamera& camera);
    void set_classic(const StageDraw& draw, const glm::dmat4& view);
    void set_physical(const StageDraw& draw, const glm::dmat4& view);
    /// Of either header's key; 0 where there is none.
    template <class Key>
    GLuint program_of(const Key& key);
    void make_environment();
    void complain(const std::string& key, const std::string& why);
    template <class Block>
    void set(const Block& block);

    const GladGLContext& gl_;
    const Stage& stage_;
    Size size_;
    gobo::KeyRecord& record_;
    gobo::Reload reload_;
    std::map<std::string, gobo::ReloadedProgram> reloaded_;  ///< what was taken last, by key
    GLuint framebuffer_ = 0;
    std::vector<Vertices> vertices_;         ///< of each draw
    std::map<int, GLuint> blocks_;           ///< buffers by binding
    std::map<const void*, Built> programs_;  ///< by permutation
    Textures textures_;
    Shadows shadows_;
    GLuint diffuse_map_ = 0;
    GLuint specular_map_ = 0;
    std::set<std::string> keys_;
    std::set<std::string> complained_;
    std::vector<std::string> complaints_;
    std::string reload_errors_;
};

}  // namespace viewer
