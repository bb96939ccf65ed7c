#include "lab/render/render.hpp"

#include <fmt/format.h>

namespace gobo {

Result<Picture> render_permutation(const Context& context, const std::vector<StageText>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const GivenTextures& textures) {
    const auto framebuffer = make_framebuffer(context, view.width, view.height, view.depth);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    const auto program = link_program(context, stages);
    if (!program) return tl::unexpected(program.error());
    set_bindings(context, *program, interface);
    ViewedObject viewed;
    viewed.view = view.camera.view();
    viewed.projection = view.camera.projection(static_cast<double>(view.width) / view.height);
    viewed.viewport = {view.width, view.height};
    const auto list = make_draw_list(context, *program, interface, objects, values, viewed, textures);
    if (!list) return tl::unexpected(list.error());
    framebuffer->bind();
    framebuffer->clear(view.background);
    list->draw();
    Picture picture{framebuffer->read_color(), framebuffer->read_depth(), list->warnings()};
    if (const GLenum error = context.gl().GetError(); error != GL_NO_ERROR)
        return fail(Fault::internal, fmt::format("OpenGL reports the error 0x{:04X} after drawing", error));
    return picture;
}

}  // namespace gobo
