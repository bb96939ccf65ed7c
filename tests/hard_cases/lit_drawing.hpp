// Permutations of `lit` at one point of a surface, drawn by OpenGL.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lab/render/program.hpp"
#include "lab/render/render.hpp"
#include "lit_under_test.hpp"

namespace gobo {

/// Draws one permutation with the inputs of a case: as a point of one pixel, by its own vertex stage, or
/// where the case names what the fragment stage is given, by a vertex stage that writes exactly that.
class LitDrawing {
  public:
    /// Compiles the permutation; failing fails the test.
    LitDrawing(const Context& context, const LitUnderTest& lit, std::size_t permutation);
    LitDrawing(const LitDrawing&) = delete;
    LitDrawing& operator=(const LitDrawing&) = delete;
    ~LitDrawing();

    /// One pixel, read back. The depth is what the depth target holds; the depth test always passes.
    [[nodiscard]] Shaded draw(const Inputs& inputs, DepthFormat depth_format = DepthFormat::float32);
    /// Covers the framebuffer that is bound with the fragment stage at these inputs; for timing.
    void cover(const Inputs& inputs);

  private:
    struct Buffer {
        std::string block;
        GLuint name;
    };
    void set_uniforms(const Program& program, const evaluate::Program& stage,
                      const evaluate::Invocations& invocation);
    void set_textures(const Program& program, const evaluate::Program& stage,
                      const evaluate::Invocations& invocation);
    void set_attributes(const evaluate::Invocations& vertex);
    void set_handed_on(const evaluate::Invocations& fragment, double depth);
    [[nodiscard]] bool names_fragment_input(const Inputs& inputs) const;

    Context context_;
    const LitUnderTest& lit_;
    std::size_t permutation_;
    std::unique_ptr<Program> own_;        ///< both stages of the permutation
    std::unique_ptr<Program> handed_on_;  ///< its fragment stage alone, fed by uniforms
    GLuint array_ = 0;
    std::vector<Buffer> buffers_;
    std::vector<GLuint> textures_;
};

}  // namespace gobo
