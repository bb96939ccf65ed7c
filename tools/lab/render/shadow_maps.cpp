#include "lab/render/shadow_maps.hpp"

#include <utility>

#include <fmt/format.h>

#include "lab/render/program.hpp"

namespace gobo {
namespace {

GLuint make_array(const GladGLContext& gl, int side, int layers) {
    GLuint name = 0;
    gl.GenTextures(1, &name);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, name);
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, side, side, layers, 0, GL_DEPTH_COMPONENT,
                  GL_FLOAT, nullptr);
    const auto set = [&](GLenum name_of_state, GLint value) {
        gl.TexParameteri(GL_TEXTURE_2D_ARRAY, name_of_state, value);
    };
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    set(GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    return name;
}

Result<void> draw_one(const Context& context, const Program& program, const DepthPass& pass,
                      const ShadowCamera& camera, const std::vector<Object>& objects) {
    ViewedObject viewed;
    viewed.view = camera.view;
    viewed.projection = camera.projection;
    viewed.viewport = {pass.side, pass.side};
    const auto list = make_draw_list(context, program, pass.interface, objects, pass.values, viewed);
    if (!list) return tl::unexpected(list.error());
    const GladGLContext& gl = context.gl();
    gl.ClearDepth(1);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(static_cast<GLfloat>(pass.slope), static_cast<GLfloat>(pass.units));
    list->draw();
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    return {};
}

}  // namespace

ShadowMaps::ShadowMaps(ShadowMaps&& other) noexcept
    : context_(other.context_),
      side_(other.side_),
      texture_(std::exchange(other.texture_, {})),
      framebuffer_(std::exchange(other.framebuffer_, 0)),
      values_(std::move(other.values_)) {}

ShadowMaps::~ShadowMaps() {
    if (framebuffer_ == 0) return;
    context_.make_current();
    context_.gl().DeleteFramebuffers(1, &framebuffer_);
    context_.gl().DeleteTextures(1, &texture_.name);
}

void ShadowMaps::attach(int layer) const {
    const GladGLContext& gl = context_.gl();
    context_.make_current();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.name, 0, layer);
    gl.Viewport(0, 0, side_, side_);
}

Image ShadowMaps::layer(int number) const {
    attach(number);
    Image image(side_, side_, 1);
    context_.gl().ReadPixels(0, 0, side_, side_, GL_DEPTH_COMPONENT, GL_FLOAT, image.values.data());
    return image;
}

Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                    const std::vector<ShadowLight>& lights,
                                    const std::vector<Object>& objects, const glm::dmat4& view) {
    const auto program = link_program(context, pass.stages);
    if (!program) return tl::unexpected(program.error());
    set_bindings(context, *program, pass.interface);
    const ShadowPlan plan = shadow_plan(lights, objects, view, pass.side);
    const std::vector<ShadowCamera>& cameras = plan.cameras;
    ShadowMaps maps(context, pass.side);
    maps.values_ = plan.values;
    const GladGLContext& gl = context.gl();
    context.make_current();
    maps.texture_ = {make_array(gl, pass.side, static_cast<int>(cameras.size())), GL_TEXTURE_2D_ARRAY};
    gl.GenFramebuffers(1, &maps.framebuffer_);
    gl.BindFramebuffer(GL_FRAMEBUFFER, maps.framebuffer_);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        maps.attach(static_cast<int>(i));
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return fail(Fault::file, fmt::format("the driver gives no {} shadow maps of {} x {} texels",
                                                 cameras.size(), pass.side, pass.side));
        if (const auto drawn = draw_one(context, *program, pass, cameras[i], objects); !drawn)
            return tl::unexpected(drawn.error());
    }
    return maps;
}

}  // namespace gobo
