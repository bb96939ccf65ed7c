#include "software_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/raster/rasterise.hpp"
#include "software_textures.hpp"

namespace gobo::scene {
namespace {

using raster::Fragment;
using raster::Pipeline;
using raster::RasterObject;

/// The least difference of depths that a map of 32-bit floats tells apart near 1, times the renderer's
/// `units`.
constexpr double least_offset = 4.0 / (1 << 24);

void draw_depths(const ShadowCamera& camera, const Object& object, double slope, int side, double* depths) {
    const gobo::Mesh& mesh = object.mesh;
    std::vector<glm::dvec4> positions;
    for (const glm::vec3& position : mesh.positions)
        positions.push_back(camera.projection * camera.view * object.model * glm::dvec4(position, 1));
    for (const Fragment& fragment : raster::rasterise(positions, mesh.indices, side, side)) {
        if (!fragment.is_covered) continue;
        if (object.culls_back_faces && fragment.is_front_facing == object.is_mirrored()) continue;
        const std::size_t first = 3 * std::size_t{fragment.triangle};
        const raster::Interpolator triangle(
            {positions[mesh.indices[first]], positions[mesh.indices[first + 1]],
             positions[mesh.indices[first + 2]]},
            side, side);
        const double x = fragment.x + 0.5;
        const double y = fragment.y + 0.5;
        const double moved =
            std::min(fragment.weights.depth + slope * triangle.depth_slope(x, y) + least_offset, 1.0);
        double& nearest = depths[fragment.y * side + fragment.x];
        nearest = std::min(nearest, moved);
    }
}

double texel(const AlphaMap& map, double x, double y) {
    const auto wrapped = [](double at, int count) {
        const double inside = at - std::floor(at / count) * count;
        return static_cast<std::size_t>(std::min(inside, count - 1.0));
    };
    return map.texels[wrapped(y, map.height) * static_cast<std::size_t>(map.width) + wrapped(x, map.width)] /
           255.0;
}

/// OpenGL 4.5, 8.14.3, GL_LINEAR and GL_REPEAT.
double filtered(const AlphaMap& map, double s, double t) {
    const double u = s * map.width - 0.5;
    const double v = t * map.height - 0.5;
    const double left = std::floor(u);
    const double lower = std::floor(v);
    return std::lerp(std::lerp(texel(map, left, lower), texel(map, left + 1, lower), u - left),
                     std::lerp(texel(map, left, lower + 1), texel(map, left + 1, lower + 1), u - left),
                     v - lower);
}

/// Whether the depth of a fragment is that of its triangle, and the fragment certain to be drawn.
bool is_plain(const Pipeline& program) {
    const auto& outputs = program.fragment.outputs;
    const bool writes_depth = std::any_of(outputs.begin(), outputs.end(), [](const evaluate::Port& port) {
        return port.name == "gl_FragDepth";
    });
    return !writes_depth && !program.may_discard;
}

class Canvas {
  public:
    explicit Canvas(const SceneView& view)
        : width_(view.width),
          height_(view.height),
          depths_(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height),
                  std::numeric_limits<double>::infinity()),
          picture_{Image(view.width, view.height, 4), std::vector<int>(depths_.size(), -1), 0, {}} {
        for (std::size_t i = 0; i < picture_.color.values.size(); ++i)
            picture_.color.values[i] = view.background[i % 4];
    }

    /// Notes what hides what lies behind it, before anything is shaded.
    void occlude(const RasterObject& object) {
        if (hidden_behind_.empty()) hidden_behind_ = depths_;
        for (const Fragment& fragment : object.fragments) {
            double& nearest = hidden_behind_[index(fragment)];
            if (fragment.is_covered) nearest = std::min(nearest, fragment.weights.depth);
        }
    }

    /// Leaves only fragments that may be seen.
    void cull(RasterObject& object) const {
        std::erase_if(object.fragments, [&](const Fragment& fragment) {
            const bool is_hidden =
                !hidden_behind_.empty() && fragment.weights.depth > hidden_behind_[index(fragment)];
            return !fragment.is_covered || is_hidden || fragment.weights.depth > 1;
        });
    }

    void count(const raster::Work& work) {
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            picture_.operations[kind] += work.fragments[kind] + work.helpers[kind];
    }

    /// What is blended lies over what is there by its alpha, and hides nothing.
    void draw(const RasterObject& object, const std::vector<raster::Shaded>& shaded, int number,
              bool is_blended) {
        picture_.fragments += shaded.size();
        for (std::size_t i = 0; i < shaded.size(); ++i) {
            const std::size_t pixel = index(object.fragments[i]);
            if (!object.fragments[i].is_covered || shaded[i].is_discarded) continue;
            if (shaded[i].depth >= std::min(depths_[pixel], 1.0)) continue;
            if (!is_blended) depths_[pixel] = shaded[i].depth;
            picture_.draw[pixel] = number;
            const double opacity = is_blended ? std::clamp(shaded[i].color[3], 0.0, 1.0) : 1;
            for (std::size_t c = 0; c < 4; ++c) {
                float& color = picture_.color.values[4 * pixel + c];
                color =
                    static_cast<float>(std::lerp(static_cast<double>(color), shaded[i].color[c], opacity));
            }
        }
    }

    [[nodiscard]] SoftwarePicture picture() && { return std::move(picture_); }

  private:
    [[nodiscard]] std::size_t index(const Fragment& fragment) const {
        return static_cast<std::size_t>(height_ - 1 - fragment.y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(fragment.x);
    }

    int width_;
    int height_;
    std::vector<double> depths_;
    std::vector<double> hidden_behind_;
    SoftwarePicture picture_;
};

void add(std::vector<RenderValue> values, std::vector<RenderValue>& to) {
    to.insert(to.end(), std::make_move_iterator(values.begin()), std::make_move_iterator(values.end()));
}

/// What the fragment stage's samplers read, beside the one colour that they have.
void give_images(const SoftwareImages& images, std::size_t object, evaluate::Invocations& uniforms) {
    for (auto& [name, image] : uniforms.images) {
        if (name == "shadowMaps" && images.maps)
            image = [maps = images.maps](const evaluate::ImageRequest& request) {
                return evaluate::answer(*maps, request);
            };
        if (const auto cube = images.cubes.find(name); cube != images.cubes.end()) image = cube->second;
        if (object < images.images.pictures.size()) {
            const auto& pictures = images.images.pictures[object];
            if (const auto use = pictures.find(name); use != pictures.end())
                image = picture_image(use->second);
        }
        if (name != "opacityMap" || object >= images.images.opacity.size()) continue;
        const AlphaMap& map = images.images.opacity[object];
        if (!map.texels.empty()) image = alpha_image(map);
    }
}

}  // namespace

SoftwareImages software_images(SceneImages images, const std::vector<Object>& casters, int side,
                               double slope) {
    SoftwareImages result{std::move(images), casters, side, nullptr};
    if (result.images.lights.empty()) return result;
    const ShadowPlan plan = shadow_plan(result.images.lights, casters, glm::dmat4(1), side);
    auto maps = std::make_shared<evaluate::DepthTexels>();
    maps->width = maps->height = side;
    maps->layers = static_cast<int>(plan.cameras.size());
    const auto layer = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    maps->depths.assign(plan.cameras.size() * layer, 1.0);
    for (std::size_t i = 0; i < plan.cameras.size(); ++i)
        for (const Object& object : casters)  // those with holes as a whole: no scene compared has any
            if (object.shadow_shape != ShadowShape::none)
                draw_depths(plan.cameras[i], object, slope, side, maps->depths.data() + i * layer);
    result.maps = std::move(maps);
    return result;
}

evaluate::Image alpha_image(const AlphaMap& map) {
    return [map](const evaluate::ImageRequest& request) -> std::array<double, 4> {
        if (request.what == evaluate::ImageRequest::What::size)
            return {static_cast<double>(map.width), static_cast<double>(map.height), 1, 1};
        return {1, 1, 1, filtered(map, request.coordinates[0], request.coordinates[1])};
    };
}

Result<SoftwarePrograms> software_programs(const SceneShaders& shaders) {
    SoftwarePrograms programs;
    for (const Permutation& permutation : shaders.composition.permutations) {
        const auto& stages = shaders.validated.stages;
        auto program = raster::pipeline_of(
            stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])].spirv,
            stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])].spirv);
        if (!program) return tl::unexpected(program.error());
        programs.push_back(std::move(*program));
    }
    return programs;
}

Result<SoftwarePicture> draw_in_software(const SceneShaders& shaders, const SoftwarePrograms& programs,
                                         const std::vector<Object>& objects,
                                         const std::vector<RenderValue>& values, const SceneView& view,
                                         bool counts, const SoftwareImages& images) {
    Canvas canvas(view);
    const ShadowPlan plan = images.maps
                                ? shadow_plan(images.images.lights, images.casters, view.view, images.side)
                                : ShadowPlan();
    std::vector<RasterObject> rasterised(objects.size());
    const auto is_blended = [&](std::size_t draw) {
        return draw < images.images.are_blended.size() && images.images.are_blended[draw];
    };
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        Object with_shadows = objects[i];
        if (images.maps) {
            const std::vector<RenderValue> shadows = shadow_values(plan.values, images.images.shadows[i]);
            add(images.renamed ? images.renamed(i, shadows) : shadows, with_shadows.values);
        }
        auto object = raster::rasterise_object(
            programs[*permutation], shaders.interfaces[*permutation], with_shadows,
            raster::with_plain_textures(shaders.interfaces[*permutation], values), view);
        if (!object) return tl::unexpected(object.error());
        give_images(images, i, object->uniforms);
        rasterised[i] = std::move(*object);
        if (is_plain(programs[*permutation]) && !is_blended(i)) canvas.occlude(rasterised[i]);
    }
    for (const std::size_t i : drawing_order(shaders.draws, images.images, view)) {
        const auto& permutation = shaders.permutation[i];
        if (!permutation) continue;
        const Pipeline& program = programs[*permutation];
        if (is_plain(program)) canvas.cull(rasterised[i]);
        raster::Work work;
        GOBO_TRY(auto shaded, raster::shade<float>(program, rasterised[i], counts ? &work : nullptr));
        if (images.recolored) GOBO_TRY_DO(images.recolored(i, rasterised[i], shaded));
        canvas.count(work);
        canvas.draw(rasterised[i], shaded, static_cast<int>(i), is_blended(i));
    }
    return std::move(canvas).picture();
}

}  // namespace gobo::scene
