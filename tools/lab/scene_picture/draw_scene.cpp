#include "lab/scene_picture/draw_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "lab/scene_picture/picture_levels.hpp"
#include "lab/scene_picture/posed_mesh.hpp"

namespace gobo::scene {
namespace {

int largest_texture(const Context& context) {
    GLint most = 0;
    context.gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return most;
}

/// The map as the alpha of a texture that is white otherwise: filtered linearly, repeated. Opaque where the
/// draw has none.
Texture make_alpha_map(const Context& context, const SceneImages& images, std::size_t draw,
                       Diagnostics& warnings) {
    const AlphaMap map = alpha_map_within(largest_texture(context), images.opacity, draw, warnings);
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

constexpr double usual_angle = 0.7;

/// A perspective projection; the far plane may be infinitely far.
glm::dmat4 perspective(double vertical_angle, double aspect, double near_plane, double far_plane) {
    return std::isinf(far_plane) ? glm::infinitePerspective(vertical_angle, aspect, near_plane)
                                 : glm::perspective(vertical_angle, aspect, near_plane, far_plane);
}

glm::dmat4 projection_of(const Camera& camera, double aspect) {
    if (camera.is_perspective)
        return perspective(camera.vertical_angle, aspect, camera.near_plane, camera.far_plane);
    const double height = std::abs(camera.half_extent.y);
    const double width = height * aspect;
    return glm::ortho(-width, width, -height, height, camera.near_plane, camera.far_plane);
}

/// The node's place and directions, without its scale.
glm::dmat4 view_of(const glm::dmat4& world) {
    const glm::dvec3 position(world[3]);
    const glm::dvec3 ahead = -glm::dvec3(world[2]);
    const glm::dvec3 up(world[1]);
    if (glm::length(glm::cross(ahead, up)) == 0) return glm::translate(glm::dmat4(1), -position);
    return glm::lookAt(position, position + glm::normalize(ahead), glm::normalize(up));
}

}  // namespace

bool reads(const Interface& interface, std::string_view sampler) {
    return std::any_of(interface.samplers.begin(), interface.samplers.end(),
                       [&](const Sampler& own) { return own.name == sampler; });
}

std::vector<std::size_t> drawing_order(const std::vector<Draw>& draws, const SceneImages& images,
                                       const SceneView& view) {
    std::vector<std::size_t> order(draws.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto rank = [&](std::size_t i) {
        const bool is_blended = i < images.are_blended.size() && images.are_blended[i];
        if (!is_blended) return std::pair(0, 0.0);
        const Box bounds = draws[i].bounds.value_or(Box{glm::dvec3(0), glm::dvec3(0)});
        return std::pair(1, (view.view * glm::dvec4((bounds.low + bounds.high) / 2.0, 1)).z);
    };
    std::ranges::stable_sort(order, {}, rank);
    return order;
}

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
    shaders.validated =
        validate(family, shaders.composition, {.jobs = jobs, .keep_spirv = true, .child_processes = true});
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

/// Four channels of 8 bits, of which the colours of an sRGB picture are decoded before they are filtered,
/// with all smaller levels.
Texture SceneDrawing::texture_of(const Context& context, const PictureUse& use) {
    const auto key = std::tuple(use.picture, use.is_srgb, use.use->wrap_s, use.use->wrap_t,
                                use.use->is_nearest, use.use->min_filter);
    if (const auto found = pictures_.find(key); found != pictures_.end()) return found->second;
    const GladGLContext& gl = context.gl();
    context.make_current();
    Texture texture;
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(GL_TEXTURE_2D, texture.name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // Not by glGenerateMipmap: llvmpipe's takes one sample of the level above, which misses texels where a
    // side is odd.
    GLint number = 0;
    for (const TextureImage& level :
         levels_within(largest_texture(context), picture_levels(*use.picture, use.is_srgb), warnings_))
        gl.TexImage2D(GL_TEXTURE_2D, number++, use.is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, level.width,
                      level.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, level.texels.data());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, use.use->min_filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, use.use->is_nearest ? GL_NEAREST : GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, use.use->wrap_s);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, use.use->wrap_t);
    alpha_maps_.adopt(texture);
    pictures_.emplace(key, texture);
    return texture;
}

void SceneDrawing::draw(DriverClock* clock) const {
    const GladGLContext& gl = alpha_maps_.context().gl();
    const auto draw_one = [&](const List& list) {
        if (clock != nullptr) clock->begin(static_cast<int>(list.permutation));
        list.draws.draw();
        if (clock != nullptr) gl.Finish();
    };
    std::ranges::for_each(lists_, draw_one);
    if (blended_.empty()) return;
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthMask(GL_FALSE);
    std::ranges::for_each(blended_, draw_one);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_BLEND);
}

Result<SceneDrawing> SceneDrawing::make(const Context& context, const SceneShaders& shaders,
                                        const std::vector<Object>& objects,
                                        const std::vector<RenderValue>& values, const SceneView& view,
                                        const SceneImages& images, const SceneTextures& textures,
                                        DriverClock* clock) {
    SceneDrawing drawing(context);
    const Composition& composition = shaders.composition;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        if (clock != nullptr) clock->begin(static_cast<int>(i));
        GOBO_TRY(auto program, link_program(context, stages_of(composition, composition.permutations[i])));
        set_bindings(context, program, shaders.interfaces[i]);
        drawing.programs_.push_back(std::make_unique<Program>(std::move(program)));
    }
    std::vector<GivenTextures> given(shaders.draws.size(), textures.given);  // one per draw
    std::vector<ObjectWithHoles> with_holes;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        const Interface& interface = shaders.interfaces[*permutation];
        if (reads(interface, "opacityMap")) {
            given[i]["opacityMap"] = make_alpha_map(context, images, i, drawing.warnings_);
            drawing.alpha_maps_.adopt(given[i]["opacityMap"]);
        }
        if (i < images.pictures.size())
            for (const auto& [sampler, use] : images.pictures[i])
                if (reads(interface, sampler)) given[i][sampler] = drawing.texture_of(context, use);
        if (objects[i].shadow_shape == ShadowShape::with_holes)
            with_holes.push_back({*drawing.programs_[*permutation], interface, objects[i], values, given[i]});
    }
    if (textures.depth_pass != nullptr && !images.lights.empty()) {
        GOBO_TRY(auto maps, draw_shadow_maps(context, *textures.depth_pass, images.lights, objects, view.view,
                                             with_holes));
        drawing.shadow_maps_ = std::make_unique<ShadowMaps>(std::move(maps));
        for (GivenTextures& own : given) own["shadowMaps"] = drawing.shadow_maps_->texture();
    }
    // In the scene's order, whatever their permutations: surfaces in one place are drawn alike by any keys.
    for (const std::size_t i : drawing_order(shaders.draws, images, view)) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        Object object = objects[i];
        if (drawing.shadow_maps_ && i < images.shadows.size())
            std::ranges::move(shadow_values(drawing.shadow_maps_->values(), images.shadows[i]),
                              std::back_inserter(object.values));
        const Interface& interface = shaders.interfaces[*permutation];
        GOBO_TRY(auto list, make_draw_list(context, *drawing.programs_[*permutation], interface, {object},
                                           values, view, given[i]));
        Diagnostics& warnings = drawing.warnings_;
        for (const Diagnostic& warning : list.warnings())
            if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
        const bool is_blended = i < images.are_blended.size() && images.are_blended[i];
        (is_blended ? drawing.blended_ : drawing.lists_).push_back({*permutation, std::move(list)});
    }
    return drawing;
}

bool turns_all_faces_away(const Scene& scene, const std::vector<Draw>& draws, const SceneView& view) {
    bool has_faces = false;
    const bool is_perspective = view.projection[2][3] != 0;
    for (const Draw& draw : draws) {
        if (!draw.excluded.empty()) continue;
        if (material_of(scene, draw).double_sided) return false;
        const PosedMesh posed = posed_mesh(scene, draw.node, primitive_of(scene, draw));
        const glm::dmat4 to_eye = view.view * posed.model;
        const double side = glm::determinant(glm::dmat3(posed.model)) < 0 ? -1 : 1;
        const std::vector<std::uint32_t>& indices = posed.mesh.indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(to_eye * glm::dvec4(posed.mesh.positions[indices[i + k]], 1));
            };
            const glm::dvec3 first = corner(0);
            const glm::dvec3 normal = side * glm::cross(corner(1) - first, corner(2) - first);
            if (glm::dot(normal, is_perspective ? -first : glm::dvec3(0, 0, 1)) > 0) return false;
            has_faces = has_faces || normal != glm::dvec3(0);
        }
    }
    return has_faces;
}

Result<Picture> draw_scene(const Context& context, const Scene& scene, const SceneShaders& shaders,
                           const std::vector<RenderValue>& family_values, const SceneView& view,
                           const SceneTextures& textures, DriverClock* clock) {
    GOBO_TRY(const auto framebuffer, make_framebuffer(context, view.width, view.height));
    GOBO_TRY(const auto drawing, SceneDrawing::make(context, shaders, objects_of(scene, shaders),
                                                    values_beside_scene(family_values), view,
                                                    images_of(scene, shaders.draws), textures, clock));
    return take_picture(framebuffer, view.background, drawing.warnings(), [&] { drawing.draw(clock); });
}

std::optional<SceneView> view_of_camera(const Scene& scene, std::size_t camera, int width, int height) {
    for (const std::size_t index : scene.order) {
        const Node& node = scene.nodes[index];
        if (node.camera != camera) continue;
        const double aspect = static_cast<double>(width) / height;
        return SceneView{{glm::dmat4(1), view_of(node.world), projection_of(scene.cameras[camera], aspect),
                          glm::dvec2(width, height)},
                         width,
                         height,
                         background_of(scene)};
    }
    return std::nullopt;
}

std::optional<std::size_t> first_camera(const Scene& scene) {
    for (const std::size_t index : scene.order)
        if (const auto& camera = scene.nodes[index].camera) return camera;
    return std::nullopt;
}

SceneView view_of_all(const std::vector<Draw>& draws, const glm::dvec3& direction, int width, int height) {
    Box bounds;
    for (const Draw& draw : draws)
        if (draw.bounds) bounds.add(*draw.bounds);
    return view_of_all(bounds, direction, width, height);
}

Box bounds_at_rest(const Scene& scene, const std::vector<Draw>& draws) {
    Box bounds;
    for (const Draw& draw : draws) {
        if (!draw.excluded.empty()) continue;
        const PosedMesh posed = posed_mesh(scene, draw.node, primitive_of(scene, draw));
        for (const glm::vec3& position : posed.mesh.positions)
            bounds.add(glm::dvec3(posed.model * glm::dvec4(position, 1)));
    }
    return bounds;
}

SceneView view_of_all(Box bounds, const glm::dvec3& direction, int width, int height) {
    if (bounds.is_empty()) bounds = {glm::dvec3(-1), glm::dvec3(1)};
    const glm::dvec3 center = (bounds.low + bounds.high) / 2.0;
    const double radius = std::max(glm::length(bounds.high - bounds.low) / 2, 1e-6);
    const double aspect = static_cast<double>(width) / height;
    const double half_angle = std::atan(std::tan(usual_angle / 2) * std::min(aspect, 1.0));
    const double distance = radius / std::sin(half_angle);
    const glm::dvec3 toward = glm::normalize(direction);
    const glm::dvec3 up = std::abs(toward.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    return {{glm::dmat4(1), glm::lookAt(center + distance * toward, center, up),
             perspective(usual_angle, aspect, std::max(distance - radius, 1e-3 * distance) * 0.99,
                         (distance + radius) * 1.01),
             glm::dvec2(width, height)},
            width,
            height};
}

std::array<float, 4> background_of(const Scene& scene) {
    const auto& fog = scene.overrides.fog;
    const bool is_clear = !fog || fog->kind == "none";
    const glm::dvec3 usual = is_clear ? glm::dvec3(0.05, 0.06, 0.08) : fog->color;
    const glm::vec3 color(scene.background.value_or(usual));
    return {color.r, color.g, color.b, 1};
}

}  // namespace gobo::scene
