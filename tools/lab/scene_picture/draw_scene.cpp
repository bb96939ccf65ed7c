#include "lab/scene_picture/draw_scene.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"

namespace gobo::scene {
namespace {

/// The map as the alpha of a texture that is white otherwise: filtered linearly, repeated. Opaque where the
/// draw has none.
Texture make_alpha_map(const Context& context, const SceneImages& images, std::size_t draw) {
    const AlphaMap opaque{1, 1, {255}};
    const bool has_map = draw < images.opacity.size() && !images.opacity[draw].texels.empty();
    const AlphaMap& map = has_map ? images.opacity[draw] : opaque;
    const GladGLContext& gl = context.gl();
    context.make_current();
    Texture texture;
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(GL_TEXTURE_2D, texture.name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, map.width, map.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                  map.texels.data());
    const auto set = [&](GLenum state, GLint value) { gl.TexParameteri(GL_TEXTURE_2D, state, value); };
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) set(filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) set(wrap, GL_REPEAT);
    for (const GLenum color : {GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B})
        set(color, GL_ONE);
    set(GL_TEXTURE_SWIZZLE_A, GL_RED);
    return texture;
}

bool reads(const Interface& interface, std::string_view sampler) {
    return std::any_of(interface.samplers.begin(), interface.samplers.end(),
                       [&](const Sampler& own) { return own.name == sampler; });
}

}  // namespace

Result<SceneShaders> shaders_of(const Family& family, const SearchPath& search, std::vector<Draw> draws,
                                const std::vector<std::optional<Key>>& keys, Dialect dialect, int jobs) {
    std::map<Key, std::size_t> numbers;  // of the distinct keys, sorted
    for (const auto& key : keys)
        if (key) numbers.emplace(*key, 0);
    std::vector<Key> distinct;
    for (auto& [key, number] : numbers) {
        number = distinct.size();
        distinct.push_back(key);
    }
    SceneShaders shaders;
    shaders.draws = std::move(draws);
    GOBO_TRY(shaders.composition, compose(family, distinct, search, dialect));
    ValidateOptions options;
    options.jobs = jobs;
    options.keep_spirv = true;
    shaders.validated = validate(family, shaders.composition, options);
    if (exit_status(shaders.validated.diagnostics) != 0) return tl::unexpected(shaders.validated.diagnostics);
    for (const Permutation& permutation : shaders.composition.permutations)
        shaders.interfaces.push_back(interface_of(shaders.validated, permutation));
    for (const auto& key : keys)
        shaders.permutation.push_back(key ? std::optional(numbers.at(*key)) : std::nullopt);
    return shaders;
}

Result<SceneShaders> shaders_for_draws(const Family& family, const SearchPath& search,
                                       std::vector<Draw> draws, const Buckets& buckets, Dialect dialect,
                                       int jobs) {
    GOBO_TRY(const auto needed, keys_for_draws(family, draws, buckets, name_of(dialect)));
    std::vector<std::optional<Key>> keys;
    for (const auto& draw : needed) keys.push_back(draw ? std::optional(draw->key) : std::nullopt);
    return shaders_of(family, search, std::move(draws), keys, dialect, jobs);
}

std::vector<Object> objects_of(const Scene& scene, const SceneShaders& shaders) {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < shaders.draws.size(); ++i)
        objects.push_back(shaders.permutation[i] ? object_of(scene, shaders.draws[i]) : Object{});
    return objects;
}

void SceneDrawing::draw() const {
    for (const DrawList& list : lists_) list.draw();
}

Result<SceneDrawing> SceneDrawing::make(const Context& context, const SceneShaders& shaders,
                                        const std::vector<Object>& objects,
                                        const std::vector<RenderValue>& values, const SceneView& view,
                                        const SceneImages& images, const SceneTextures& textures) {
    SceneDrawing drawing(context);
    GivenTextures given = textures.given;
    if (textures.depth_pass != nullptr && !images.lights.empty()) {
        GOBO_TRY(auto maps,
                 draw_shadow_maps(context, *textures.depth_pass, images.lights, objects, view.view));
        drawing.shadow_maps_ = std::make_unique<ShadowMaps>(std::move(maps));
        given["shadowMaps"] = drawing.shadow_maps_->texture();
    }
    const Composition& composition = shaders.composition;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        GOBO_TRY(auto program, link_program(context, {stage_text(composition, permutation.vertex),
                                                      stage_text(composition, permutation.fragment)}));
        set_bindings(context, program, shaders.interfaces[i]);
        drawing.programs_.push_back(std::make_unique<Program>(std::move(program)));
    }
    // In the scene's order, whatever their permutations: surfaces in one place are drawn alike by any keys.
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        Object object = objects[i];
        if (drawing.shadow_maps_ && i < images.shadows.size())
            std::ranges::move(shadow_values(drawing.shadow_maps_->values(), images.shadows[i]),
                              std::back_inserter(object.values));
        const Interface& interface = shaders.interfaces[*permutation];
        if (reads(interface, "opacityMap")) {
            given["opacityMap"] = make_alpha_map(context, images, i);
            drawing.alpha_maps_.adopt(given["opacityMap"]);
        }
        GOBO_TRY(auto list, make_draw_list(context, *drawing.programs_[*permutation], interface, {object},
                                           values, viewed_by(view), given));
        Diagnostics& warnings = drawing.warnings_;
        for (const Diagnostic& warning : list.warnings())
            if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
        drawing.lists_.push_back(std::move(list));
    }
    return drawing;
}

Result<Picture> draw_scene(const Context& context, const Scene& scene, const SceneShaders& shaders,
                           const std::vector<RenderValue>& family_values, const SceneView& view,
                           const SceneTextures& textures) {
    GOBO_TRY(const auto framebuffer, make_framebuffer(context, view.width, view.height));
    GOBO_TRY(const auto drawing, SceneDrawing::make(context, shaders, objects_of(scene, shaders),
                                                    values_beside_scene(family_values), view,
                                                    images_of(scene, shaders.draws), textures));
    framebuffer.bind();
    framebuffer.clear(view.background);
    drawing.draw();
    Picture picture{framebuffer.read_color(), framebuffer.read_depth(), drawing.warnings()};
    if (const GLenum error = context.gl().GetError(); error != GL_NO_ERROR)
        return fail(Fault::internal, fmt::format("OpenGL reports the error 0x{:04X} after drawing", error));
    return picture;
}

}  // namespace gobo::scene
