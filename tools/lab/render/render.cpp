#include "lab/render/render.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#define XXH_INLINE_ALL  // one hash is no reason to link a library
#include <xxhash.h>

#include "family/key.hpp"

namespace gobo {
namespace {

/// Draws one permutation and writes its picture. The result are warnings.
Result<Diagnostics> render_one(const Context& context, const std::vector<StageText>& stages,
                               const Interface& interface, const std::vector<Object>& objects,
                               std::vector<RenderValue> values, const std::vector<ShadowLight>& shadows,
                               const PictureOptions& options, FileSystem& files, const std::string& path) {
    GivenTextures textures = options.textures;
    std::optional<ShadowMaps> maps;
    if (!shadows.empty() && options.depth_pass != nullptr) {
        GOBO_TRY(ShadowMaps drawn, draw_shadow_maps(context, *options.depth_pass, shadows, objects,
                                                    options.view.camera.view()));
        maps.emplace(std::move(drawn));
        textures["shadowMaps"] = maps->texture();
        values.insert(values.end(), maps->values().begin(), maps->values().end());
    }
    GOBO_TRY(Picture picture,
             render_permutation(context, stages, interface, objects, values, options.view, textures));
    GOBO_TRY_DO(write_image(files, path, shrunk(picture.color, options.smooth)));
    return std::move(picture.warnings);
}

constexpr double kGround = -0.75;

/// Scales the mesh into the box and puts it on the ground.
glm::dmat4 placed(const Mesh& mesh) {
    const glm::dvec3 box(3, 1.5, 3);
    const Bounds bounds = bounds_of(mesh);
    if (bounds.is_empty()) return glm::dmat4(1);
    const glm::dvec3& low = bounds.low;
    const glm::dvec3& high = bounds.high;
    const glm::dvec3 room = box / glm::max(high - low, glm::dvec3(1e-9));
    const double scale = std::min({room.x, room.y, room.z});
    const glm::dvec3 foot((low.x + high.x) / 2, low.y, (low.z + high.z) / 2);
    return glm::translate(glm::dmat4(1), glm::dvec3(0, kGround, 0)) *
           glm::scale(glm::dmat4(1), glm::dvec3(scale)) * glm::translate(glm::dmat4(1), -foot);
}

}  // namespace

ViewedObject viewed_from(const View& view) {
    return {glm::dmat4(1),
            view.camera.view(),
            view.camera.projection(static_cast<double>(view.width) / view.height),
            {view.width, view.height}};
}

Result<Picture> render_permutation(const Context& context, const std::vector<StageText>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const GivenTextures& textures) {
    GOBO_TRY(const Framebuffer framebuffer, make_framebuffer(context, view.width, view.height, view.depth));
    GOBO_TRY(const Program program, link_program(context, stages));
    set_bindings(context, program, interface);
    GOBO_TRY(const DrawList list,
             make_draw_list(context, program, interface, objects, values, viewed_from(view), textures));
    framebuffer.bind();
    framebuffer.clear(view.background);
    list.draw();
    Picture picture{framebuffer.read_color(), framebuffer.read_depth(), list.warnings()};
    if (const GLenum error = context.gl().GetError(); error != GL_NO_ERROR)
        return fail(Fault::internal, fmt::format("OpenGL reports the error 0x{:04X} after drawing", error));
    return picture;
}

RenderedSelection render_selection(const Context& context, const Family& family,
                                   const Composition& composition, const std::vector<Interface>& interfaces,
                                   const std::vector<Object>& objects, const PictureOptions& options,
                                   FileSystem& files) {
    RenderedSelection rendered;
    DiagnosticGroups groups(family);
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        const std::string path =
            fmt::format("{}/{}.{}", options.folder, picture_name(key_text(family, permutation.key)),
                        name_of(options.format));
        const auto warnings =
            render_one(context, stages_of(composition, permutation), interfaces[i], objects, family.render,
                       shadow_lights(family, permutation.key), options, files, path);
        if (warnings) rendered.files.push_back(path);
        for (const Diagnostic& diagnostic : warnings ? *warnings : warnings.error())
            groups.add(diagnostic, permutation.key);
    }
    rendered.diagnostics = groups.result();
    return rendered;
}

std::string picture_name(std::string_view key_text) {
    constexpr std::size_t kLongest = 200;
    std::string name;
    for (const char character : key_text) name += character == '=' ? '-' : character == ' ' ? '+' : character;
    if (name.size() <= kLongest) return name;
    const XXH64_hash_t hash = XXH3_64bits(key_text.data(), key_text.size());
    return fmt::format("{}+{:016x}", name.substr(0, kLongest - 17), hash);
}

std::vector<Object> demo_objects(Mesh mesh) {
    const glm::dmat4 model = placed(mesh);
    // Fine enough for light computed at the vertices to show its cones.
    return {{std::move(mesh), model, {}, false, true},
            {make_plane(12, 96), glm::translate(glm::dmat4(1), glm::dvec3(0, kGround, 0)), {}, false, false}};
}

Camera demo_camera() {
    return {.position = {0, 1.5, 5}, .target = {0, -0.05, 0}, .field_of_view = 0.6, .far_plane = 50};
}

}  // namespace gobo
