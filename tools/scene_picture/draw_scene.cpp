#include "scene_picture/draw_scene.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scene_picture/scene_object.hpp"

namespace gobo::scene {
void SceneDrawing::draw() const {
    for (const DrawList& list : lists_) list.draw();
}

Result<SceneDrawing> make_scene_drawing(const Context& context, const SceneShaders& shaders,
                                        const std::vector<Object>& objects,
                                        const std::vector<RenderValue>& values, const SceneView& view) {
    SceneDrawing drawing;
    const Composition& composition = shaders.composition;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        auto program = link_program(context, {stage_text(composition, permutation.vertex),
                                              stage_text(composition, permutation.fragment)});
        if (!program) return tl::unexpected(program.error());
        set_bindings(context, *program, shaders.interfaces[i]);
        drawing.programs_.push_back(std::make_unique<Program>(std::move(*program)));
    }
    // In the scene's order, whatever their permutations: surfaces in one place are drawn alike by any keys.
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        auto list = make_draw_list(context, *drawing.programs_[*permutation],
                                   shaders.interfaces[*permutation], {objects[i]}, values, viewed_by(view));
        if (!list) return tl::unexpected(list.error());
        for (const Diagnostic& warning : list->warnings())
            if (std::find(drawing.warnings_.begin(), drawing.warnings_.end(), warning) ==
                drawing.warnings_.end())
                drawing.warnings_.push_back(warning);
        drawing.lists_.push_back(std::move(*list));
    }
    return drawing;
}

std::vector<Object> objects_of(const Scene& scene, const SceneShaders& shaders) {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < shaders.draws.size(); ++i)
        objects.push_back(shaders.permutation[i] ? object_of(scene, shaders.draws[i]) : Object{});
    return objects;
}

Result<Picture> draw_scene(const Context& context, const Scene& scene, const SceneShaders& shaders,
                           const std::vector<RenderValue>& family_values, const SceneView& view) {
    const auto framebuffer = make_framebuffer(context, view.width, view.height);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    const auto drawing = make_scene_drawing(context, shaders, objects_of(scene, shaders),
                                            values_beside_scene(family_values), view);
    if (!drawing) return tl::unexpected(drawing.error());
    framebuffer->bind();
    framebuffer->clear(view.background);
    drawing->draw();
    Picture picture{framebuffer->read_color(), framebuffer->read_depth(), drawing->warnings()};
    if (const GLenum error = context.gl().GetError(); error != GL_NO_ERROR)
        return fail(Fault::internal, fmt::format("OpenGL reports the error 0x{:04X} after drawing", error));
    return picture;
}

}  // namespace gobo::scene
