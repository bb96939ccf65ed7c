#include "lab/oracle/oracle.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gobo::oracle {
namespace {

/// The material as the point's colour tints it.
Material tinted(const Model& model, const Material& material, const glm::dvec4& color) {
    if (model.vertex_color == VertexColor::none) return material;
    Material result = material;
    result.ambient *= glm::dvec3(color);
    result.diffuse *= glm::dvec3(color);
    return result;
}

AmbientLight ambient_light(const Model& model, const Scene& scene, const glm::dvec3& normal) {
    if (model.ambient == Ambient::hemisphere)
        return hemisphere_light(model.hemisphere, scene.hemisphere, normal);
    if (model.ambient == Ambient::spherical_harmonics)
        return harmonics_light(model.harmonics, scene.harmonics, normal);
    if (model.ambient == Ambient::image) {
        const LookedUp found = ambient_from_image(scene.image_light, normal);
        return {found.value, found.value, found.slope};
    }
    return {scene.ambient, scene.ambient, glm::dvec3(0)};
}

/// What remains of the diffuse light of all terms: tones by thresholds are limited by the brightest.
glm::dvec3 limited(const Model& model, const Scene& scene, const std::vector<LightTerm>& terms) {
    glm::dvec3 total{0};
    glm::dvec3 brightest{0};
    for (const LightTerm& term : terms) {
        total += term.diffuse * term.incident.radiance;
        if (term.diffuse > 0) brightest = glm::max(brightest, term.incident.radiance);
    }
    if (model.diffuse != Diffuse::toon_thresholds) return total;
    return glm::min(total, *std::max_element(scene.toon_tones.begin(), scene.toon_tones.end()) * brightest);
}

/// The lights' cosines to the side that is seen, where they come from the vertices.
std::vector<double> cosines_of(const Model& model, const SurfacePoint& point, bool is_flipped) {
    if (model.n_dot_l == NDotL::fragment) return {};
    std::vector<double> result = point.cosines;
    for (double& cosine : result) cosine *= is_flipped ? -1 : 1;
    return result;
}

double linear_fog_factor(const FogParameters& fog, double distance, Decisions& decisions) {
    if (fog.start != fog.end) return std::clamp((fog.end - distance) / (fog.end - fog.start), 0.0, 1.0);
    const double unit = std::max(fog.end, distance);  // the deciding quantity is a ratio of distances
    if (unit == 0) return 0;
    return decisions.above(fog.end / unit, distance / unit) ? 1 : 0;
}

glm::dvec3 mirrored(const glm::dvec3& normal, const glm::dvec3& to_light) {
    return 2 * glm::dot(normal, to_light) * normal - to_light;
}

/// The edge k / N nearest to the cosine decides between the bands on its two sides. There is none at 0 and 1.
double banded_factor(Diffuse diffuse, int levels, double cosine, Decisions& decisions) {
    const int edge = std::clamp(static_cast<int>(std::lround(cosine * levels)), 0, levels);
    const double at = static_cast<double>(edge) / levels;
    const bool is_inner = edge > 0 && edge < levels;
    int band = edge == levels ? levels - 1 : 0;  // counted from the darkest
    if (is_inner && diffuse == Diffuse::toon) band = decisions.above(at, cosine) ? edge - 1 : edge;
    if (is_inner && diffuse == Diffuse::toon_ceil) band = decisions.above(cosine, at) ? edge : edge - 1;
    return static_cast<double>(diffuse == Diffuse::toon ? band : band + 1) / levels;
}

double tone(const Scene& scene, double cosine, Decisions& decisions) {
    for (std::size_t i = 0; i < scene.toon_thresholds.size(); ++i)
        if (decisions.above(cosine, scene.toon_thresholds[i])) return scene.toon_tones[i];
    return 0;
}

/// Whether the radiance jumps where a light rises over the surface's horizon.
bool jumps_at_horizon(const Model& model) {
    return model.specular != Specular::none || model.diffuse == Diffuse::toon_ceil ||
           model.diffuse == Diffuse::toon_thresholds;
}

/// Models that end at a right angle are 0 from there on; at exponent 0 everything is 1.
double beyond_a_right_angle(double shininess) {
    return shininess > 0 ? 0 : 1;
}

double near_exact(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    const double z = (cosine - 1) / (cosine + 1);
    return std::exp(2 * shininess * (z + z * z * z / 3));
}

double schlick(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    return cosine / (shininess - shininess * cosine + cosine);
}

/// What a picture holds at the point; white where the key has none.
glm::dvec4 texel_of(const Model& model, const Scene& scene, const SurfacePoint& point, MapKind map,
                    bool is_in) {
    const auto index = static_cast<std::size_t>(map);
    if (!is_in) return glm::dvec4(1);
    glm::dvec2 place = point.texture_coordinate;
    if (model.texture_placement == Placement::placed) {
        const TexturePlacement& at = scene.placements[index];
        const glm::dvec2 uv = at.set == 0 ? point.texture_coordinate : point.texture_coordinate1;
        place = {at.linear[0] * uv.x + at.linear[1] * uv.y + at.offset.x,
                 at.linear[2] * uv.x + at.linear[3] * uv.y + at.offset.y};
    }
    return scene.pictures[index].at(place);
}

glm::dvec4 base_color_of(const Model& model, const Scene& scene, const SurfacePoint& point) {
    const glm::dvec4 texel =
        texel_of(model, scene, point, MapKind::base_color, model.base_color_map == Picture::texture);
    return scene.material.base_color * texel *
           (model.vertex_color == VertexColor::modulate ? point.color : glm::dvec4(1));
}

/// Two vectors along which a picture's x and y lie, and how much larger than the longer one the terms are
/// that it is the sum of.
struct PictureAxes {
    glm::dvec3 tangent{0};
    glm::dvec3 bitangent{0};
    double condition = 0;
};

/// A picture's axes as gradients of its coordinates along the surface (Mikkelsen 2010), times what both have
/// in common. The picture's y runs against its second coordinate.
PictureAxes axes_of_steps(const Model& model, const Scene& scene, const SurfacePoint& point,
                          const glm::dvec3& normal, Decisions& decisions) {
    const TexturePlacement& at = scene.placements[static_cast<std::size_t>(MapKind::normal)];
    const auto placed = [&](const PixelStep& step) {
        if (model.texture_placement == Placement::plain) return step.texture_coordinate;
        const glm::dvec2 uv = at.set == 0 ? step.texture_coordinate : step.texture_coordinate1;
        return glm::dvec2(at.linear[0] * uv.x + at.linear[1] * uv.y,
                          at.linear[2] * uv.x + at.linear[3] * uv.y);
    };
    const auto size_of = [&](const PixelStep& step) {
        const double factor = model.texture_placement == Placement::plain ? 1 : 2 * glm::length(at.linear);
        return factor * (glm::length(step.texture_coordinate) + glm::length(step.texture_coordinate1));
    };
    const glm::dvec3& px = point.along_x.position;
    const glm::dvec3& py = point.along_y.position;
    const double area = glm::length(px) * glm::length(py);
    const double facing = area > 0 ? glm::dot(normal, glm::cross(px, py)) / area : 0;
    const double side = area > 0 && decisions.above(0, facing) ? -1 : 1;
    const glm::dvec2 x = placed(point.along_x);
    const glm::dvec2 y = placed(point.along_y);
    const auto gradient = [&](int i) {
        return side * (x[i] * glm::cross(py, normal) + y[i] * glm::cross(normal, px));
    };
    PictureAxes axes{gradient(0), -gradient(1), 0};
    const double longer =
        std::max(glm::dot(axes.tangent, axes.tangent), glm::dot(axes.bitangent, axes.bitangent));
    const double length = std::sqrt(std::max(longer, 1e-30));
    axes.condition =
        (size_of(point.along_x) * glm::length(py) + size_of(point.along_y) * glm::length(px)) / length;
    axes.tangent /= length;
    axes.bitangent /= length;
    return axes;
}

/// The unit normal that a picture bends (glTF 2.0, 3.9.3): x T + y w (N x T) + z N of 2 texel - 1. `length`
/// becomes that of the sum, smaller by as much as its axes are less sure than vectors that are given.
glm::dvec3 bent(const Model& model, const Scene& scene, const SurfacePoint& point, const glm::dvec3& normal,
                double& length, Decisions& decisions) {
    if (model.normal_map == NormalMap::none) return normal;
    const glm::dvec3 texel =
        2.0 * glm::dvec3(texel_of(model, scene, point, MapKind::normal, true)) - glm::dvec3(1);
    const glm::dvec3 given(point.tangent);
    const PictureAxes axes = model.normal_map == NormalMap::derivatives
                                 ? axes_of_steps(model, scene, point, normal, decisions)
                                 : PictureAxes{given, point.tangent.w * glm::cross(normal, given), 0};
    const double scale = scene.material.normal_scale;
    const glm::dvec3 sum =
        scale * texel.x * axes.tangent + scale * texel.y * axes.bitangent + texel.z * normal;
    length = glm::length(sum);
    if (!decisions.above(length, 1e-6)) {
        length = 1;
        return normal;
    }
    const glm::dvec3 result = sum / length;
    length /= 1 + axes.condition;
    return result;
}

/// Of a metallic-roughness surface.
Radiance physical_radiance(const Model& model, const Scene& scene, const SurfacePoint& point,
                           Decisions& decisions) {
    Radiance radiance;
    PhysicalPoint physical;
    const Material& material = scene.material;
    physical.base_color = base_color_of(model, scene, point);
    if (model.lighting == Lighting::base_color) {
        radiance.value = radiance.largest = glm::dvec3(physical.base_color);
        return radiance;
    }
    const bool is_flipped = model.sides != Sides::one && point.is_back;
    const glm::dvec4 metallic_roughness = texel_of(model, scene, point, MapKind::metallic_roughness,
                                                   model.metallic_roughness_map == Picture::texture);
    physical.metallic = material.metallic * metallic_roughness.b;
    physical.roughness = material.roughness * metallic_roughness.g;
    physical.emission = material.emission * glm::dvec3(texel_of(model, scene, point, MapKind::emissive,
                                                                model.emissive_map == Picture::texture));
    const double occlusion =
        texel_of(model, scene, point, MapKind::occlusion, model.occlusion_map == Picture::texture).r;
    physical.occlusion = 1 + material.occlusion_strength * (occlusion - 1);
    physical.coat_normal = shading_direction(model, point.normal);
    physical.normal = bent(model, scene, point, physical.coat_normal, physical.normal_length, decisions);
    if (is_flipped) physical.normal = -physical.normal;
    if (is_flipped) physical.coat_normal = -physical.coat_normal;
    physical.tangent = point.tangent;
    const glm::dvec3& nx = point.along_x.normal;
    const glm::dvec3& ny = point.along_y.normal;
    physical.bend = glm::dot(nx, nx) + glm::dot(ny, ny);
    physical.to_viewer = to_viewer(model, point.position);
    physical.lights = incident_lights(model, scene, point.position, decisions);
    cast_shadows(model, scene, point.position, physical.lights, decisions);
    for (const IncidentLight& light : physical.lights)
        physical.has_half.push_back(decisions.above(glm::length(light.to_light + physical.to_viewer), 1e-6));
    physical.ambient = ambient_light(model, scene, physical.normal);
    if (model.reflection == Reflection::image) {
        ImageLight whole = scene.reflection;
        whole.weight = 1;
        physical.reflected = reflection_from_image(whole, physical.normal, physical.to_viewer);
        physical.coat_reflected = reflection_from_image(whole, physical.coat_normal, physical.to_viewer);
    }
    Roundings exact;
    const PhysicalRadiance found = radiance_of(model, scene, physical, exact);
    radiance.value = found.value;
    radiance.largest = found.largest;
    radiance.of_white = found.of_white;
    radiance.physical = std::move(physical);
    return radiance;
}

}  // namespace

glm::dvec3 to_viewer(const Model& model, const glm::dvec3& position) {
    return model.viewer == Viewer::infinite ? glm::dvec3(0, 0, 1) : direction_of(-position);
}

const Material& material_of(const Model& model, const Scene& scene, const SurfacePoint& point) {
    if (model.material == MaterialChoice::uniform) return scene.material;
    const int rows = static_cast<int>(scene.materials.size());
    const bool has_pairs = model.sides == Sides::two_materials;
    const int index = std::clamp(point.material, 0, (has_pairs ? rows / 2 : rows) - 1);
    const int row = has_pairs ? 2 * index + (point.is_back ? 1 : 0) : index;
    return scene.materials[static_cast<std::size_t>(row)];
}

Radiance lit_radiance(const Model& model, const Scene& scene, const SurfacePoint& point,
                      Decisions& decisions) {
    if (model.is_physical()) return physical_radiance(model, scene, point, decisions);
    Radiance radiance;
    radiance.material = tinted(model, material_of(model, scene, point), point.color);
    const Material& material = radiance.material;
    if (model.lighting == Lighting::unlit) {
        radiance.value = radiance.largest = material.diffuse;
        return radiance;
    }
    const bool is_flipped = model.sides != Sides::one && point.is_back;
    const bool is_hybrid = model.shading == Shading::hybrid;
    const glm::dvec3 normal = shading_direction(model, is_flipped ? -point.normal : point.normal);
    const View view{normal, to_viewer(model, point.position), material.shininess,
                    is_hybrid ? point.halfways : std::vector<glm::dvec3>(),
                    cosines_of(model, point, is_flipped)};
    const glm::dvec3 highlight = material.strength * material.specular;
    radiance.ambient = ambient_light(model, scene, normal);
    if (model.reflection == Reflection::image)
        radiance.reflected = reflection_from_image(scene.reflection, normal, view.to_viewer);
    const glm::dvec3 mirrored = highlight * radiance.reflected.value;
    radiance.value = material.emission + material.ambient * radiance.ambient.value + mirrored;
    radiance.largest = material.emission + material.ambient * radiance.ambient.largest + mirrored;
    std::vector<IncidentLight> lights = is_hybrid ? interpolated_incident_lights(model, scene, point)
                                                  : incident_lights(model, scene, point.position, decisions);
    cast_shadows(model, scene, point.position, lights, decisions);
    for (const IncidentLight& incident : lights) {
        LightTerm term = respond(model, scene, view, incident, radiance.terms.size(), decisions);
        if (model.light_ambient == LightAmbient::each)
            term.ambient = incident.attenuation * scene.light_ambients.at(radiance.terms.size());
        radiance.value += highlight * term.specular * incident.radiance + material.ambient * term.ambient;
        radiance.largest += material.diffuse * incident.unshaped + material.ambient * term.ambient;
        if (model.specular != Specular::none) radiance.largest += highlight * incident.unshaped;
        radiance.terms.push_back(term);
    }
    radiance.value += material.diffuse * limited(model, scene, radiance.terms);
    return radiance;
}

double alpha_of(const Model& model, const Scene& scene, const SurfacePoint& point) {
    if (model.is_physical()) return base_color_of(model, scene, point).a;
    return model.vertex_color == VertexColor::modulate ? point.color.a : 1;
}

bool is_cut_out(const Model& model, const Scene& scene, const SurfacePoint& point, Decisions& decisions) {
    return model.cutout == Cutout::threshold &&
           decisions.above(scene.cutout_threshold,
                           alpha_of(model, scene, point) * (model.is_physical() ? 1 : point.opacity));
}

double fog_distance(FogDistance kind, const glm::dvec3& position) {
    return kind == FogDistance::radial ? glm::length(position) : std::abs(position.z);
}

double fog_factor(Fog kind, const FogParameters& fog, double distance, Decisions& decisions) {
    if (kind == Fog::none) return 1;
    if (kind == Fog::linear) return linear_fog_factor(fog, distance, decisions);
    const double thickness = fog.density * distance;
    return std::exp(kind == Fog::exponential ? -thickness : -thickness * thickness);
}

glm::dvec3 within_range(OutputRange range, const glm::dvec3& radiance) {
    if (range == OutputRange::half_float) return glm::min(radiance, glm::dvec3((2 - 0x1p-10) * 0x1p15));
    return range == OutputRange::display ? glm::min(radiance, glm::dvec3(1)) : radiance;
}

Seen seen_through_fog(const Model& model, const Scene& scene, const glm::dvec3& position,
                      const glm::dvec3& radiance, const glm::dvec3& largest, Decisions& decisions) {
    if (model.fog == Fog::none) return {radiance, largest, 0, 1};
    const double distance = fog_distance(model.fog_distance, position);
    const double clear = fog_factor(model.fog, scene.fog, distance, decisions);
    return {clear * radiance + (1 - clear) * scene.fog.color, largest + scene.fog.color, distance, clear};
}

std::optional<double> written_depth(const Model& model, const Scene& scene, double depth) {
    if (model.depth == Depth::untouched) return std::nullopt;
    if (model.depth == Depth::unchanged) return depth;
    double offset = scene.depth_offset;
    if (model.depth == Depth::greater) offset = std::max(offset, 0.0);
    if (model.depth == Depth::less) offset = std::min(offset, 0.0);
    return std::clamp(depth + offset, 0.0, 1.0);
}

double diffuse_factor(const Model& model, const Scene& scene, double cosine, Decisions& decisions) {
    if (model.diffuse == Diffuse::lambert) return cosine;
    if (model.diffuse == Diffuse::toon_thresholds) return tone(scene, cosine, decisions);
    return banded_factor(model.diffuse, scene.toon_levels, cosine, decisions);
}

double highlight_angle(Specular specular, const glm::dvec3& normal, const glm::dvec3& to_light,
                       const glm::dvec3& to_viewer) {
    if (specular == Specular::blinn) return angle_between(normal, to_light + to_viewer);
    return angle_between(mirrored(normal, to_light), to_viewer);
}

double lobe(Power power, double one_minus_cosine, double shininess) {
    const double cosine = 1 - one_minus_cosine;
    switch (power) {
        case Power::exact:
            break;
        case Power::near_exact:
            return near_exact(cosine, shininess);
        case Power::squaring:
            return std::pow(std::max(cosine, 0.0), std::nearbyint(shininess));
        case Power::gaussian_fitted:
            return std::exp((shininess + 0.664) * (cosine - 1));
        case Power::gaussian:
            return std::exp(shininess * (cosine - 1));
        case Power::lyon:
            return std::pow(std::max(1 - shininess * one_minus_cosine / 4, 0.0), 4);
        case Power::schlick:
            return schlick(cosine, shininess);
    }
    return std::pow(std::max(cosine, 0.0), shininess);
}

double highlight_one_minus_cosine(const Model& model, const View& view, const glm::dvec3& to_light,
                                  std::size_t light) {
    const bool is_blinn = model.specular == Specular::blinn;
    const bool is_given = is_blinn && !view.halfways.empty();
    if (model.normal == Normal::renormalised) {
        return one_minus_cosine_of(
            is_given ? angle_between(view.normal, view.halfways[light])
                     : highlight_angle(model.specular, view.normal, to_light, view.to_viewer));
    }
    const glm::dvec3 half = is_given ? view.halfways[light] : direction_of(to_light + view.to_viewer);
    const double cosine =
        is_blinn ? glm::dot(view.normal, half) : glm::dot(mirrored(view.normal, to_light), view.to_viewer);
    return std::max(1 - cosine, 0.0);
}

LightTerm respond(const Model& model, const Scene& scene, const View& view, const IncidentLight& incident,
                  std::size_t light, Decisions& decisions) {
    LightTerm term;
    term.incident = incident;
    term.cosine = view.cosines.empty() ? glm::dot(view.normal, incident.to_light) : view.cosines[light];
    const bool has_highlight = model.specular != Specular::none;
    // Where the radiance is continuous at the horizon, nothing is decided there.
    term.is_lit = jumps_at_horizon(model) ? decisions.above(term.cosine, 0) : term.cosine > 0;
    if (!term.is_lit) return term;
    term.diffuse = diffuse_factor(model, scene, std::max(term.cosine, 0.0), decisions);
    if (!has_highlight) return term;
    term.highlight_one_minus_cosine = highlight_one_minus_cosine(model, view, incident.to_light, light);
    term.specular = lobe(model.power, term.highlight_one_minus_cosine, view.shininess);
    if (view.halfways.empty()) term.half_length = glm::length(incident.to_light + view.to_viewer);
    return term;
}

}  // namespace gobo::oracle
