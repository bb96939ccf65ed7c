#include "shadows.hpp"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "lab/render/texture.hpp"

namespace viewer {
namespace {

const gobo::DepthPass kUsual;  // its size and its offsets

}  // namespace

Shadows::Shadows(const GladGLContext& gl, const Stage& stage) : gl_(gl), stage_(stage) {
    if (stage.shadow_lights.empty()) return;
    std::vector<gobo::Object> objects;
    for (const StageDraw& draw : stage.draws) objects.push_back({draw.mesh, draw.model, {}});
    plan_ = gobo::shadow_plan(stage.shadow_lights, objects, glm::dmat4(1), kUsual.side);
}

void Shadows::draw(const std::function<void(const gobo::ShadowCamera&)>& draw_all) {
    if (texture_ != 0 || plan_.cameras.empty()) return;
    const GLenum target = GL_TEXTURE_2D_ARRAY;
    gl_.GenTextures(1, &texture_);
    gl_.BindTexture(target, texture_);
    gl_.TexImage3D(target, 0, GL_DEPTH_COMPONENT32F, kUsual.side, kUsual.side,
                   static_cast<GLsizei>(plan_.cameras.size()), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    for (const auto& [state, value] : {std::pair<GLenum, GLint>{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                       {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                       {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                       {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                       {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                                       {GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}})
        gl_.TexParameteri(target, state, value);
    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl_.DrawBuffer(GL_NONE);
    gl_.Viewport(0, 0, kUsual.side, kUsual.side);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(static_cast<GLfloat>(kUsual.slope), static_cast<GLfloat>(kUsual.units));
    for (std::size_t layer = 0; layer < plan_.cameras.size(); ++layer) {
        gl_.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_, 0,
                                    static_cast<GLint>(layer));
        gl_.Clear(GL_DEPTH_BUFFER_BIT);
        draw_all(plan_.cameras[layer]);
    }
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
    gl_.DeleteFramebuffers(1, &framebuffer);
}

lit::Shadows Shadows::block(const StageDraw& draw, const Settings& settings, const glm::dmat4& view) const {
    using Kind = gobo::ShadowLight::Kind;
    const glm::dmat4 to_world = glm::inverse(view);
    lit::Shadows block{};
    std::size_t count = 0;
    for (const std::size_t light : draw.shadows) {
        const Kind kind = stage_.shadow_lights[light].kind;
        const bool is_on = kind == Kind::directional ? settings.directional
                           : kind == Kind::spot      ? settings.spot
                                                     : settings.point;
        if (!is_on || count == std::size(block.shadows)) continue;
        const auto numbers = [&](const char* member) {
            return gobo::find_value(plan_.values, fmt::format("Shadows.shadows[{}].{}", light, member))
                ->numbers;
        };
        auto& shadow = block.shadows[count++];
        shadow.toMap = glm::mat4(glm::make_mat4(numbers("toMap").data()) * to_world);
        shadow.layer = static_cast<float>(numbers("layer").front());
        shadow.depthScale = static_cast<float>(numbers("depthScale").front());
        shadow.depthShift = static_cast<float>(numbers("depthShift").front());
        shadow.spread = static_cast<float>(numbers("spread").front());
    }
    return block;
}

}  // namespace viewer
