#include "lab/verify/rounding.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lab/raster/random.hpp"

namespace gobo::verify {
namespace {

constexpr double kU = kUnitRoundoff;

/// 1 - cos of an angle, known to within `error`.
struct OneMinusCosine {
    double value = 0;
    double error = 0;
};

/// Results below this may be flushed to 0.
constexpr double kSmallestFloat = 0x1p-126;

/// What computing 1 - u costs: nothing where a formula takes u as it is; otherwise one rounding of 1.
double subtraction_error(oracle::Power power, const OneMinusCosine& u) {
    switch (power) {
        case oracle::Power::exact:
        case oracle::Power::near_exact:
            return u.value < 0.1 ? 0 : kU;
        case oracle::Power::squaring:
        case oracle::Power::schlick:
            return kU;
        default:
            return 0;
    }
}

/// The roundings of the formula, each counted as often as what follows multiplies it by.
double formula_error(oracle::Power power, const OneMinusCosine& u, double exponent, double value) {
    const double logarithm = value > 0 ? std::abs(std::log(value)) : 0;
    switch (power) {
        case oracle::Power::exact:  // six of the logarithm and the product, two of the exponential
            return value * (6 * logarithm + 2) * kU;
        case oracle::Power::near_exact:  // z, its square and the products: nine; two of the exponential
            return value * (9 * logarithm + 2) * kU;
        case oracle::Power::squaring: {
            // The square's error doubles and gets a rounding: n in all for the factors of c^n together, and
            // one for each of at most 20 products. Squares that underflow are lost products of the result.
            const double whole = std::nearbyint(exponent);
            return value * (whole + 20) * kU + kSmallestFloat;
        }
        case oracle::Power::gaussian_fitted:  // the sum, the product; two of the exponential
        case oracle::Power::gaussian:
            return value * (2 * logarithm + 2) * kU + kSmallestFloat;
        case oracle::Power::lyon: {
            // 1 - x, where x = m u / 4 has two roundings and the difference one of at most 1; the fourth
            // power multiplies it by 4 b^3 and adds two products.
            const double x = exponent * u.value / 4;
            const double root = std::max(1 - x, 0.0);
            const double off = 2 * kU * std::min(x, 1.0) + kU;
            return 4 * std::pow(root + off, 3) * off + 2 * value * kU;
        }
        case oracle::Power::schlick:  // a product, a sum of terms that are not negative, a division
            return value * 3 * kU;
    }
    return 0;
}

/// Bound of the error of oracle::lobe(): the spread of the lobe over its argument's error, evaluated at both
/// ends since the slope may be infinite, and the formula's own roundings.
double power_error(oracle::Power power, const OneMinusCosine& angle, double exponent) {
    const double spread = angle.error + subtraction_error(power, angle);
    const double least = oracle::lobe(power, std::min(angle.value + spread, 2.0), exponent);
    const double most = oracle::lobe(power, std::max(angle.value - spread, 0.0), exponent);
    const double value = oracle::lobe(power, angle.value, exponent);
    return most - least + formula_error(power, angle, exponent, value);
}

/// 1 - a.b of two directions whose errors add up to `directions`. Near 0 it is |a - b|^2 / 2, whose
/// derivative is |a - b| = sqrt(2 u), and five roundings; from 1/2 on 1 - a.b, with four roundings of at most
/// 1, which are eight of u.
OneMinusCosine from_unit_directions(double value, double directions) {
    const double slope = std::sqrt(2 * value);
    return {value, (slope + directions / 2) * directions + 8 * kU * value};
}

/// 1 - a.b as it stands: the directions' errors, by the sine of the angle where both are unit, and four
/// roundings of at most 1 each.
OneMinusCosine from_cosine(double value, double directions, bool are_unit) {
    const double sine = std::sqrt(std::max(value * (2 - value), 0.0));
    const double slope = are_unit ? sine + directions / 2 : 1;
    return {value, slope * directions + 4 * kU};
}

/// Where a ray lies in a cone. By the angle itself: |a x b| and a.b are good to four roundings of 1 each, so
/// that the angle is off by six, and 2 sin^2 of its half by its slope, the sine, and six roundings more.
OneMinusCosine cone_angle(oracle::SpotEdge edge, double angle, double directions) {
    const double value = oracle::one_minus_cosine_of(angle);
    if (edge == oracle::SpotEdge::one_minus_cosine) return from_unit_directions(value, directions);
    if (edge == oracle::SpotEdge::cosine) return from_cosine(value, directions, true);
    const double off = directions + 6 * kU;
    return {value, (std::sin(angle) + off / 2) * off + 6 * kU * value};
}

/// How far a highlight's angle is off, as one minus its cosine, of directions whose errors add up to
/// `directions`.
OneMinusCosine lobe_angle(const oracle::Model& model, double value, double directions) {
    return model.normal == oracle::Normal::renormalised ? from_unit_directions(value, directions)
                                                        : from_cosine(value, directions, false);
}

double edge(const oracle::SpotLight& light, double one_minus_cosine) {
    const double width = light.outer_one_minus_cosine - light.inner_one_minus_cosine;
    if (width <= 0)
        return one_minus_cosine < light.outer_one_minus_cosine || light.outer_one_minus_cosine >= 2 ? 1 : 0;
    const double fade = std::clamp((light.outer_one_minus_cosine - one_minus_cosine) / width, 0.0, 1.0);
    return fade * fade;
}

/// Error of a spot light's attenuation. A hard edge is decided, not rounded: it adds nothing here.
double cone_error(oracle::SpotEdge spot_edge, const oracle::IncidentLight& incident, double to_light_error) {
    const oracle::SpotLight& light = *incident.spot;
    // The axis is unit to two roundings.
    const OneMinusCosine u = cone_angle(spot_edge, incident.cone_angle, to_light_error + 2 * kU);
    const bool is_hard = light.inner_one_minus_cosine >= light.outer_one_minus_cosine;
    const double most = edge(light, std::max(u.value - u.error, 0.0));
    const double edge_error = is_hard ? 0 : most - edge(light, u.value + u.error) + 6 * kU * most;
    return edge_error + power_error(oracle::Power::exact, u, light.exponent) + kU;
}

/// Error of a shadowed light's attenuation. A product of a matrix and a position rounds each term at most
/// four times, a cube's spread twice more, the division once, and the place among the texels twice; what lies
/// before the place in the map is decided. The weights and the product with the light are ten roundings of at
/// most 1. A texel's centre, where a formula asks for that, is rounded once as it is divided by the map's
/// size.
double shadow_error(const oracle::IncidentLight& incident, double position_error) {
    const double centre = incident.shadow.per_place * kU;
    if (incident.shadow.per_rounding == 0) return incident.is_shadowed ? centre + kU : 0;
    return incident.shadow.per_rounding * 9 * kU + incident.shadow.per_length * position_error + centre +
           10 * kU;
}

/// What becomes of a direction that is an input: it is made unit, or taken as it is.
double given_direction(const oracle::Model& model) {
    return model.normal == oracle::Normal::renormalised ? kDirectionError : 0;
}

/// The sum of the errors of the two directions between which the highlight's angle lies.
double highlight_directions(const oracle::Model& model, const oracle::LightTerm& term, double normal,
                            double to_light, double to_viewer) {
    if (model.specular == oracle::Specular::phong)  // r = 2 (n.s) n - s: at most four times n's error
        return to_light + 4 * normal + 8 * kU + to_viewer;
    if (model.shading == oracle::Shading::hybrid) return given_direction(model) + normal;
    return halfway_error(to_light, to_viewer, term.half_length) + normal;
}

/// Roundings of a sum of n terms that are not negative: one for each, one for each level of pairs and the few
/// partial sums of the last, or, where what is lost is carried along, two.
double sum_roundings(oracle::LightSum kind, std::size_t terms) {
    const auto count = static_cast<double>(terms);
    if (kind == oracle::LightSum::compensated) return 2;
    return kind == oracle::LightSum::plain || terms < 4 ? count : std::ceil(std::log2(count)) + 1;
}

/// A light's parts of the error, without the material.
struct LightErrors {
    glm::dvec3 ambient{0};
    glm::dvec3 diffuse{0};
    glm::dvec3 specular{0};
};

/// The share that a light's error counts with: the brightest tone where that limits the sum.
double largest_diffuse(const oracle::Model& model, const oracle::Scene& scene,
                       const oracle::LightTerm& term) {
    if (model.diffuse != oracle::Diffuse::toon_thresholds) return term.diffuse;
    return *std::max_element(scene.toon_tones.begin(), scene.toon_tones.end());
}

/// Ambient light at a normal known to within `normal`: its slope times that error (turning the normal to the
/// probe's axes rounds three products more), and ten roundings of its terms.
glm::dvec3 ambient_error(const oracle::AmbientLight& ambient, double normal) {
    return ambient.slope * (normal + 6 * kU) + ambient.largest * (10 * kU);
}

LightErrors light_errors(const oracle::Model& model, const oracle::Scene& scene,
                         const oracle::LightTerm& term, double shininess, const PointErrors& errors,
                         double normal, double to_viewer) {
    const IncidentErrors incident = incident_errors(model, term.incident, errors.position);
    const glm::dvec3& light = term.incident.radiance;
    LightErrors result;
    result.ambient = term.ambient * (incident.attenuation + 2 * kU);
    // The gate is decided; where it is open, the cosine is off by both directions and a dot product.
    const double cosine = normal + incident.direction + 3 * kU;
    const bool may_be_lit = term.is_lit || std::abs(term.cosine) <= cosine;
    if (!may_be_lit) return result;
    const double diffuse = model.diffuse == oracle::Diffuse::lambert ? cosine : 2 * kU;
    result.diffuse = light * (diffuse + kU) + incident.radiance * largest_diffuse(model, scene, term);
    if (model.specular == oracle::Specular::none) return result;
    const double directions = highlight_directions(model, term, normal, incident.direction, to_viewer);
    const double share =
        power_error(model.power, lobe_angle(model, term.highlight_one_minus_cosine, directions), shininess);
    result.specular = light * (share + kU) + incident.radiance * term.specular;
    return result;
}

/// A metallic-roughness surface: what random roundings of all that it is computed from make of it, at most,
/// times kRoundedFactor, and the sums' own roundings.
glm::dvec3 physical_error(const oracle::Model& model, const oracle::Scene& scene,
                          const oracle::SurfacePoint& surface, const oracle::Radiance& radiance,
                          const PointErrors& errors) {
    const oracle::PhysicalPoint& exact = *radiance.physical;
    const double normal = errors.normal + given_direction(model);
    const double to_viewer = viewer_error(model, surface.position, errors.position);
    const glm::dvec3 ambient = ambient_error(exact.ambient, normal);
    const auto mirrored_error = [&](const oracle::LookedUp& reflected) {
        return reflected.slope * (to_viewer + 4 * normal + 14 * kU) + reflected.value * (5 * kU);
    };
    // A texel at a place that is rounded: eight roundings of what it is multiplied by. A normal of a picture
    // is a sum of three such vectors, made unit.
    const bool is_bent = model.normal_map != oracle::NormalMap::none;
    const bool has_pictures = is_bent || model.base_color_map == oracle::Picture::texture ||
                              model.metallic_roughness_map == oracle::Picture::texture ||
                              model.occlusion_map == oracle::Picture::texture ||
                              model.emissive_map == oracle::Picture::texture;
    const double texel = has_pictures ? 8 * kU : 0;
    const double tilt = 1 + std::abs(scene.material.normal_scale);
    const double bent_normal =
        is_bent ? tilt * (2 * normal + 16 * kU) / exact.normal_length + kDirectionError : normal;
    glm::dvec3 change{0};
    for (int i = 1; i <= kRoundedEvaluations; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const auto off = [&](const glm::dvec3& most) { return most * random.components(-1, 1); };
        oracle::PhysicalPoint point = exact;
        point.normal += off(glm::dvec3(bent_normal));
        point.coat_normal += off(glm::dvec3(normal));
        point.tangent += glm::dvec4(off(glm::dvec3(4 * kU)), 0);
        point.base_color += glm::dvec4(off(glm::dvec3(texel)), 0);
        const glm::dvec3 factors = off(glm::dvec3(texel));
        point.metallic += factors.x;
        point.roughness += factors.y;
        point.occlusion += factors.z;
        point.emission += off(exact.emission * texel);
        point.to_viewer += off(glm::dvec3(to_viewer));
        for (oracle::IncidentLight& light : point.lights) {
            const IncidentErrors incident = incident_errors(model, light, errors.position);
            light.to_light += off(glm::dvec3(incident.direction));
            light.radiance += off(incident.radiance);
        }
        point.ambient.value += off(ambient);
        point.reflected.value += off(mirrored_error(exact.reflected));
        point.coat_reflected.value += off(mirrored_error(exact.coat_reflected));
        oracle::Roundings roundings(kU, static_cast<std::uint64_t>(i));
        change = glm::max(
            change, glm::abs(oracle::radiance_of(model, scene, point, roundings).value - radiance.value));
    }
    const double sums = sum_roundings(model.light_sum, 2 * exact.lights.size()) + 16;
    return kRoundedFactor * change + radiance.largest * (sums * kU);
}

}  // namespace

/// Directional lights are inputs, unit to two roundings. Of local ones the ray is a difference (one rounding,
/// and the position's own error), the distance is good to as much, and 1 / (k_c + d (k_l + d k_q)) changes by
/// at most twice as much, with seven roundings of positive terms.
IncidentErrors incident_errors(const oracle::Model& model, const oracle::IncidentLight& incident,
                               double position_error) {
    const glm::dvec3 shadow = incident.unshaped * shadow_error(incident, position_error);
    if (incident.is_interpolated) return {given_direction(model), kU, incident.radiance * kU + shadow};
    if (incident.is_given) return {2 * kU, 0, shadow};
    if (incident.distance == 0) return {kDirectionError, 0, glm::dvec3(0)};
    const double ray = kU + (position_error + kU * incident.place_size) / incident.distance;
    const double direction = ray + kDirectionError;
    const double attenuation = 2 * direction + 7 * kU;
    const double cone = incident.spot != nullptr ? cone_error(model.spot_edge, incident, direction) : 0;
    // 1 - x^4, x a product of the distance.
    const bool has_range = model.light_range == oracle::LightRange::windowed;
    const double window = has_range ? 4 * (direction + 3 * kU) * (1 - incident.window) + kU : 0;
    return {direction, attenuation,
            incident.radiance * attenuation + incident.unshaped * (cone + window) + shadow};
}

double viewer_error(const oracle::Model& model, const glm::dvec3& position, double position_error) {
    const double distance = glm::length(position);
    const bool is_computed = model.viewer == oracle::Viewer::local && distance > 0;
    return is_computed ? position_error / distance + kDirectionError : 0;
}

double halfway_error(double to_light, double to_viewer, double half_length) {
    return (to_light + to_viewer + 2 * kU) / std::max(half_length, 1e-30) + kDirectionError;
}

glm::dvec3 radiance_error(const oracle::Model& model, const oracle::Scene& scene,
                          const oracle::SurfacePoint& point, const oracle::Radiance& radiance,
                          const PointErrors& errors) {
    if (radiance.physical) return physical_error(model, scene, point, radiance, errors);
    if (model.is_physical()) {  // the base colour, tinted; a texel, of up to 1, is off by eight roundings
        const bool has_picture = model.base_color_map == oracle::Picture::texture;
        const bool is_tinted = model.vertex_color == oracle::VertexColor::modulate;
        const glm::dvec4 factors = scene.material.base_color * (is_tinted ? point.color : glm::dvec4(1));
        return radiance.value * (3 * kU) + glm::dvec3(factors) * (has_picture ? 8 * kU : 0);
    }
    const double normal = errors.normal + given_direction(model);
    const double to_viewer = viewer_error(model, point.position, errors.position);
    const oracle::Material& material = radiance.material;
    glm::dvec3 error = material.ambient * ambient_error(radiance.ambient, normal);
    // A mirrored direction is known to four times the normal's error besides the viewer's; turning it to the
    // map's axes rounds three products more, mixing and scaling five.
    const double mirrored = to_viewer + 4 * normal + 8 * kU;
    error += material.strength * material.specular *
             (radiance.reflected.slope * (mirrored + 6 * kU) + radiance.reflected.value * (5 * kU));
    for (const oracle::LightTerm& term : radiance.terms) {
        const LightErrors one =
            light_errors(model, scene, term, material.shininess, errors, normal, to_viewer);
        error += material.ambient * one.ambient + material.diffuse * one.diffuse +
                 material.strength * material.specular * one.specular;
    }
    // Sums of terms that are not negative, three products with the material and two with the vertices'
    // colour, four sums of the parts.
    const double roundings = sum_roundings(model.light_sum, radiance.terms.size()) + 9;
    return error + radiance.value * (roundings * kU);
}

glm::dvec3 fog_error(const oracle::Model& model, const oracle::Scene& scene, const oracle::Seen& seen,
                     const glm::dvec3& radiance, const glm::dvec3& radiance_error, double position_error) {
    if (model.fog == oracle::Fog::none) return radiance_error;
    const oracle::FogParameters& fog = scene.fog;
    const double distance = kDirectionError * seen.distance + position_error;
    double fog_factor = 0;
    if (model.fog == oracle::Fog::linear && fog.start != fog.end) {
        const double ahead = distance + kU * std::abs(fog.end - seen.distance);
        fog_factor = ahead / std::abs(fog.end - fog.start) + 2 * kU * seen.fog_factor;
    } else if (model.fog != oracle::Fog::linear) {
        // exp(-t) or exp(-t^2): the thickness t is a product, the square doubles its relative error.
        const double thickness = fog.density * seen.distance;
        const double relative = seen.distance > 0 ? distance / seen.distance + kU : 0;
        const double exponent = model.fog == oracle::Fog::exponential
                                    ? thickness * relative
                                    : thickness * thickness * (2 * relative + kU);
        fog_factor = seen.fog_factor * (exponent + 2 * kU);
    }
    const glm::dvec3 blend = glm::abs(radiance) * seen.fog_factor + fog.color * (1 - seen.fog_factor);
    return seen.fog_factor * radiance_error + (glm::abs(radiance) + fog.color) * fog_factor + 3 * kU * blend;
}

}  // namespace gobo::verify
