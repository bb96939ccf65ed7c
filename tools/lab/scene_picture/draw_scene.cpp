#include "lab/scene_picture/draw_scene.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/scene_picture/scene_object.hpp"

namespace gobo::scene {
namespace {

/// The map as the alpha of a texture that is white otherwise: filtered linearly, repeated.
Texture make_alpha_map(const Context& context, const AlphaMap& map) {
    const GladGLContext& gl = context.gl();
    context.make_current();
    Texture texture;
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(GL_TEXTURE_2D, texture.name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, map.width, map.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                  map.texels.data());
    const auto set = [&](GLenum state, GLint value) { gl.TexParameteri(GL_TEXTURE_2D, state, value); };
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, GL_REPEAT);
    set(GL_TEXTURE_WRAP_T, GL_REPEAT);
    set(GL_TEXTURE_SWIZZLE_R, GL_ONE);
    set(GL_TEXTURE_SWIZZLE_G, GL_ONE);
    set(GL_TEXTURE_SWIZZLE_B, GL_ONE);
    set(GL_TEXTURE_SWIZZLE_A, GL_RED);
    return texture;
}

const AlphaMap opaque{1, 1, {255}};

const AlphaMap& opacity_of(const SceneImages& images, std::size_t draw) {
    const bool has_map = draw < images.opacity.size() && !images.opacity[draw].texels.empty();
    return has_map ? images.opacity[draw] : opaque;
}

bool reads(const Interface& interface, std::string_view sampler) {
    return std::any_of(interface.samplers.begin(), interface.samplers.end(),
                       [&](const Sampler& own) { return own.name == sampler; });
}

/// The values of the maps' block that a draw has.
std::vector<RenderValue> own_shadows(const ShadowMaps* maps, const SceneImages& images, std::size_t draw) {
    if (maps == nullptr || draw >= images.shadows.size()) return {};
    ShadowPlan plan;
    plan.values = maps->values();
    return shadow_values(plan, images.shadows[draw]);
}

}  // namespace

void SceneDrawing::draw() const {
    for (const DrawList& list : lists_) list.draw();
}

Result<SceneDrawing> make_scene_drawing(const Context& context, const SceneShaders& shaders,
                                        const std::vector<Object>& objects,
                                        const std::vector<RenderValue>& values, const SceneView& view,
                                        const SceneImages& images, const SceneTextures& textures) {
    SceneDrawing drawing(context);
    GivenTextures given = textures.given;
    if (textures.depth_pass != nullptr && !images.lights.empty()) {
        auto maps = draw_shadow_maps(context, *textures.depth_pass, images.lights, objects, view.view);
        if (!maps) return tl::unexpected(maps.error());
        drawing.shadow_maps_ = std::make_unique<ShadowMaps>(std::move(*maps));
        given["shadowMaps"] = drawing.shadow_maps_->texture();
    }
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
        Object object = objects[i];
        for (RenderValue& value : own_shadows(drawing.shadow_maps_.get(), images, i))
            object.values.push_back(std::move(value));
        if (reads(shaders.interfaces[*permutation], "opacityMap")) {
            given["opacityMap"] = make_alpha_map(context, opacity_of(images, i));
            drawing.alpha_maps_.adopt(given["opacityMap"]);
        }
        auto list =
            make_draw_list(context, *drawing.programs_[*permutation], shaders.interfaces[*permutation],
                           {object}, values, viewed_by(view), given);
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
                           const std::vector<RenderValue>& family_values, const SceneView& view,
                           const SceneTextures& textures) {
    const auto framebuffer = make_framebuffer(context, view.width, view.height);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    const auto drawing =
        make_scene_drawing(context, shaders, objects_of(scene, shaders), values_beside_scene(family_values),
                           view, images_of(scene, shaders.draws), textures);
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
