#include "lab/oracle/microfacets.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lab/oracle/reflectance_extensions.hpp"

namespace gobo::oracle {
namespace {

/// Constants of the models as a float holds them, written as short as tells it.
constexpr double kPi = 3.1415927;
constexpr double kTwoPi = 6.2831855;
constexpr double kFujiiNorm = 0.2877934;      // 1/2 - 2 / (3 pi)
constexpr double kFujiiAverage = 0.07248821;  // 2/3 - 28 / (15 pi)

constexpr double kLeastAlpha = 0.002;
constexpr double kLeastCosineToViewer = 1e-4;
constexpr double kLeastSheenAlpha = 0.07;

/// Fresnel's equations, both polarisations, of a dielectric with that F0, from air (Born and Wolf, Principles
/// of Optics, 1.5.2). At F0 near 1 no index of refraction is left: 0.999 of its square root is the most.
double dielectric_reflectance(double f0, double cosine) {
    const double root = std::min(std::sqrt(f0), 0.999);
    const double eta = (1 + root) / (1 - root);
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    const double inside = std::sqrt(std::max(1 - sine * sine / (eta * eta), 1e-12 / (eta * eta)));
    const double s = (cosine - eta * inside) / (cosine + eta * inside);
    const double p = (eta * cosine - inside) / (eta * cosine + inside);
    return (s * s + p * p) / 2;
}

double schlick_weight(double vh) {
    return std::pow(std::max(1 - vh, 0.0), 5);
}

/// The albedo of Oren and Nayar's model in Fujii's form at a cosine (their fit, equation 13 there).
double fujii_albedo(double cosine, double roughness) {
    const double m = std::clamp(1 - cosine, 0.0, 1.0);
    const double g =
        0.05710853 * m + 0.49188188 * m * m - 0.33218145 * std::pow(m, 3) + 0.071443 * std::pow(m, 4);
    return (1 + roughness * g) / (1 + kFujiiNorm * roughness);
}

glm::dvec3 oren_nayar(const glm::dvec3& color, double roughness, double nl, double nv, double lv) {
    const double norm = 1 / (1 + kFujiiNorm * roughness);
    const double s = lv - nl * nv;
    const double shape = 1 + roughness * (s > 0 ? s / std::max(nl, nv) : s);
    const double average = norm * (1 + kFujiiAverage * roughness);
    const double lost = std::max(1 - average, 1e-7);
    const double lost_both =
        std::max(1 - fujii_albedo(nv, roughness), 0.0) * std::max(1 - fujii_albedo(nl, roughness), 0.0);
    const glm::dvec3 again = color * color * (average * lost_both / lost) / (1.0 - color * lost);
    return (color * norm * std::max(shape, 0.0) + again) / kPi;
}

/// The exponent of sheen_shadow(), l(x) = a / (1 + b x^c) + d x + e.
double sheen_exponent(double alpha, double x, Roundings& r) {
    const double t = (1 - alpha) * (1 - alpha);
    const auto between = [&](double rough, double smooth) { return rough + t * (smooth - rough); };
    const double first =
        between(21.5473, 25.3245) / (1 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801)));
    return r(first, 8 * first) + r(between(-1.9776, -1.27393) * x + between(-4.32054, -4.85967), 20);
}

/// The sheen as its lights and its environment see it.
struct SheenOfPoint {
    glm::dvec3 color{0};
    double strength = 0;
    double alpha = 1;
    double seen = 0;  ///< the albedo towards the viewer
    double masking = 0;
};

/// Lights and environment find the same surface.
struct Surface {
    SheenOfPoint sheen;
    Reflectance reflectance;
    glm::dvec3 diffuse{0};
    double roughness = 0;
    double alpha = 0;
    double nv = 0;
    glm::dvec2 brdf{0};
};

Surface surface_of(const Model& model, const Scene& scene, const PhysicalPoint& point, Roundings& r) {
    const Material& material = scene.material;
    Surface surface;
    const glm::dvec3 base(point.base_color);
    surface.reflectance = {base, material.dielectric, material.dielectric_edge, point.metallic};
    surface.diffuse = (1 - point.metallic) * base;
    surface.roughness = point.roughness;
    surface.alpha =
        r(widened_alpha(model, r(alpha_of_roughness(surface.roughness)), r(point.bend, 8 * point.bend)));
    surface.nv = std::max(r(glm::dot(point.normal, point.to_viewer), 2), kLeastCosineToViewer);
    surface.brdf =
        environment_brdf(model.environment_brdf, scene.environment_brdf, surface.nv, surface.roughness);
    if (model.sheen == Sheen::charlie) {
        SheenOfPoint& sheen = surface.sheen;
        sheen.color = material.sheen_color;
        sheen.strength = std::max({sheen.color.r, sheen.color.g, sheen.color.b});
        sheen.alpha = std::max(r(material.sheen_roughness * material.sheen_roughness), kLeastSheenAlpha);
        const double cosine = std::min(surface.nv, 1.0);
        sheen.seen = sheen_albedo(sheen.alpha, cosine, r);
        sheen.masking = sheen_shadow(sheen.alpha, cosine, r);
    }
    return surface;
}

/// The lobe D V of a brushed surface, wider along the brush (KHR_materials_anisotropy; Burley 2012, appendix
/// B).
double brushed_lobe(const Material& material, const PhysicalPoint& point, const Surface& surface,
                    const glm::dvec3& to_light, double nl, Roundings& r) {
    const glm::dvec3& n = point.normal;
    const glm::dvec3 given(point.tangent);
    const glm::dvec3 t =
        direction_of(r(given - glm::dot(n, given) * n, 4));  // sizes cancel where T lies along n
    const glm::dvec3 b = point.tangent.w * r(glm::cross(n, t), 2);
    const glm::dvec3 along = material.anisotropy_direction.x * t + material.anisotropy_direction.y * b;
    const glm::dvec3 across = r(glm::cross(n, along), 2);
    const double at = surface.alpha + (1 - surface.alpha) * material.anisotropy * material.anisotropy;
    const double ab = surface.alpha;
    const glm::dvec3 sum = to_light + point.to_viewer;
    const double length = glm::length(sum);
    const glm::dvec3 half = r(sum / length, 2 / length);
    const auto sum_of_squares = [](double x, double y, double z) { return x * x + y * y + z * z; };
    const double spread =
        std::max(r(sum_of_squares(r(glm::dot(along, half), 2) / at, r(glm::dot(across, half), 2) / ab,
                                  r(glm::dot(n, half), 2))),
                 0.05);
    const auto length_of = [&](const glm::dvec3& w, double cosine) {
        return std::sqrt(
            r(sum_of_squares(at * r(glm::dot(along, w), 2), ab * r(glm::dot(across, w), 2), cosine)));
    };
    const double masking = nl * length_of(point.to_viewer, surface.nv) + surface.nv * length_of(to_light, nl);
    return 1 / (kPi * at * ab * spread * spread) / (2 * masking);
}

/// What a light adds by the sheen, per solid angle.
glm::dvec3 sheen_lobe(const PhysicalPoint& point, const Surface& surface, const glm::dvec3& sum, double nl,
                      Roundings& r) {
    const SheenOfPoint& sheen = surface.sheen;
    const double length = glm::length(sum);
    const glm::dvec3 across = r(glm::cross(point.normal, sum), 2) / length;
    const double power = r(std::min(r(glm::dot(across, across)), 1.0), 1);
    const double distribution =
        (2 + 1 / sheen.alpha) * std::pow(std::clamp(power, 0.0, 1.0), 0.5 / sheen.alpha) / kTwoPi;
    const double cosine = std::clamp(nl, 1e-4, 1.0);
    const double shadow = sheen_shadow(sheen.alpha, cosine, r);
    return sheen.color * (distribution / (4 * surface.nv * cosine * (1 + sheen.masking + shadow)));
}

/// What several reflections give back (Turquin 2019; Fdez-Aguera 2019).
glm::dvec3 highlight_scale(const Model& model, const Surface& surface) {
    if (model.multiple_scattering == MultipleScattering::none) return glm::dvec3(1);
    const double once = std::clamp(surface.brdf.x + surface.brdf.y, 0.1, 1.0);
    return 1.0 + surface.reflectance.f0() * (1 / once - 1);
}

glm::dvec3 environment_again(const Model& model, const Surface& surface, const glm::dvec3& once) {
    if (model.multiple_scattering == MultipleScattering::none) return glm::dvec3(0);
    const double lost = std::max(1 - surface.brdf.x - surface.brdf.y, 0.0);
    const glm::dvec3 f0 = surface.reflectance.f0();
    const glm::dvec3 mean = f0 + (surface.reflectance.f90() - f0) / 21.0;
    return once * mean * lost / glm::max(1.0 - mean * lost, glm::dvec3(1e-3));
}

/// What of `bare` is mirrored at the cosine beneath the extensions that the model has; `whole` is what a
/// surface that mirrors everything would mirror.
glm::dvec3 mirrored_part(const Model& model, const Scene& scene, const Reflectance& surface, glm::dvec3 bare,
                         double cosine, double whole, Roundings& r) {
    for (const std::size_t place : model.extensions) {
        const ReplacedReflectance replaced = reflectance_extensions()[place].at(
            numbers_of(scene.extension_numbers, place), surface, cosine, r);
        bare += replaced.share * (whole * replaced.value - bare);
    }
    return bare;
}

/// What enters: of a coloured reflection as little as of its strongest channel, so that what is scattered
/// does not take the opposite colour (KHR_materials_iridescence, rgb_mix).
glm::dvec3 entering_part(const Model& model, const glm::dvec3& mirrored) {
    const double most = std::max({mirrored.r, mirrored.g, mirrored.b});
    return glm::max(1.0 - (model.extensions.empty() ? mirrored : glm::dvec3(most)), glm::dvec3(0));
}

void add_environment(const Model& model, const Scene& scene, const PhysicalPoint& point,
                     const Surface& surface, PhysicalRadiance& radiance, Roundings& r) {
    glm::dvec3 scattered = surface.diffuse;
    const bool has_map = model.reflection == Reflection::image && point.normal != glm::dvec3(0) &&
                         point.to_viewer != glm::dvec3(0);
    if (has_map) {
        const double weight = scene.reflection.weight;
        const glm::dvec3 bare = surface.brdf.x * surface.reflectance.f0() +
                                glm::dvec3(surface.brdf.y * surface.reflectance.f90());
        const glm::dvec3 once = mirrored_part(model, scene, surface.reflectance, bare, surface.nv,
                                              surface.brdf.x + surface.brdf.y, r);
        const glm::dvec3 again = weight * environment_again(model, surface, once);
        radiance.value += point.occlusion * weight * once * point.reflected.value;
        radiance.largest += weight * once * glm::abs(point.reflected.value);
        scattered = again + glm::max(1.0 - weight * once - again, glm::dvec3(0)) * surface.diffuse;
        radiance.largest += (again + surface.diffuse) * point.ambient.largest;
    }
    radiance.value += point.occlusion * scattered * point.ambient.value;
    radiance.largest += scattered * point.ambient.largest;
    // What the ambient light loses beneath the sheen, and the sheen's own.
    const double left = 1 - surface.sheen.strength * surface.sheen.seen;
    const glm::dvec3 sheen = surface.sheen.seen * surface.sheen.color;
    radiance.value = point.emission + left * (radiance.value - point.emission) +
                     point.occlusion * sheen * point.ambient.value;
    radiance.largest += sheen * point.ambient.largest;
}

/// What leaves of a light, per solid angle.
struct Reflected {
    glm::dvec3 part{0};
    double highlight = 0;  ///< D V alone
};

}  // namespace

double Roundings::next() {
    if (step_ == 0) return 0;
    state_ += 0x9E3779B97F4A7C15U;  // SplitMix64
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((mixed ^ (mixed >> 31U)) >> 11U) * 0x1p-52 - 1;
}

glm::dvec3 Roundings::operator()(const glm::dvec3& value, double size) {
    const double x = (*this)(value.x, size);
    const double y = (*this)(value.y, size);
    return {x, y, (*this)(value.z, size)};
}

double alpha_of_roughness(double roughness) {
    return std::max(roughness * roughness, kLeastAlpha);
}

double widened_alpha(const Model& model, double alpha, double bend) {
    if (model.specular_antialiasing == SpecularAntialiasing::none) return alpha;
    return std::sqrt(std::min(alpha * alpha + std::min(0.31830987 * bend, 0.18), 1.0));
}

double normal_distribution(Distribution kind, double alpha, const glm::dvec3& normal,
                           const glm::dvec3& to_light, const glm::dvec3& to_viewer, Roundings& r) {
    const glm::dvec3 sum = to_light + to_viewer;
    const double length = glm::length(sum);
    double sine_squared = 0;
    if (kind == Distribution::cross_product) {
        const glm::dvec3 across = r(glm::cross(normal, sum), 2) / length;
        sine_squared = std::min(r(glm::dot(across, across)), 1.0);
    } else {
        const double cosine = r(glm::dot(normal, sum) / length, 2 / length);
        sine_squared = std::max(r(1 - cosine * cosine, 2), 0.0);
    }
    const double square = alpha * alpha;
    const double spread = r((1 - square) * sine_squared + square);
    return square / (kPi * spread * spread);
}

double visibility_term(MaskingShadowing kind, double alpha, double nl, double nv, double half_square,
                       Roundings& r) {
    if (kind == MaskingShadowing::half_angle) return 1 / std::max(r(half_square), 1e-4);
    if (kind == MaskingShadowing::interpolated)
        return 1 / (2 * r((1 - alpha) * 2 * nl * nv + alpha * (nl + nv)));
    const double square = alpha * alpha;
    const double masking = nl * std::sqrt(square + (1 - square) * nv * nv);
    const double shadowing = nv * std::sqrt(square + (1 - square) * nl * nl);
    return 1 / (2 * r(masking + shadowing));
}

glm::dvec3 Reflectance::f0() const {
    return (1 - metallic) * dielectric + metallic * base;
}

double Reflectance::f90() const {
    return (1 - metallic) * dielectric_edge + metallic;
}

glm::dvec3 fresnel_reflectance(Fresnel kind, const Reflectance& surface, double vh) {
    const glm::dvec3 f0 = surface.f0();
    switch (kind) {
        case Fresnel::exact: {
            const double cosine = std::min(vh, 1.0);
            glm::dvec3 dielectric{0};
            for (int channel = 0; channel < 3; ++channel)
                if (surface.dielectric_edge > 0)
                    dielectric[channel] =
                        surface.dielectric_edge *
                        dielectric_reflectance(
                            std::min(surface.dielectric[channel] / surface.dielectric_edge, 1.0), cosine);
            const glm::dvec3 metal = surface.base + (1.0 - surface.base) * schlick_weight(cosine);
            return (1 - surface.metallic) * dielectric + surface.metallic * metal;
        }
        case Fresnel::schlick:
            return f0 + (surface.f90() - f0) * schlick_weight(vh);
        case Fresnel::gaussian:
            return f0 + (surface.f90() - f0) * std::exp2((-5.55473 * vh - 6.98316) * vh);
        case Fresnel::constant:
            break;
    }
    return f0;
}

glm::dvec3 diffuse_lobe(DiffuseLobe kind, const glm::dvec3& color, double roughness, double nl, double nv,
                        double lv, double vh) {
    if (kind == DiffuseLobe::oren_nayar) return oren_nayar(color, roughness, nl, nv, lv);
    if (kind == DiffuseLobe::lambert) return color / kPi;
    const double at_grazing = 0.5 + 2 * roughness * vh * vh;
    const auto towards = [&](double cosine) { return 1 + (at_grazing - 1) * schlick_weight(cosine); };
    return color * (towards(nl) * towards(nv) / kPi);
}

double sheen_shadow(double alpha, double cosine, Roundings& r) {
    if (cosine < 0.5) return std::exp(sheen_exponent(alpha, cosine, r));
    return std::exp(2 * sheen_exponent(alpha, 0.5, r) - sheen_exponent(alpha, 1 - cosine, r));
}

double sheen_albedo(double alpha, double cosine, Roundings& r) {
    // exp of a polynomial of degree 2 in the cosine, whose coefficients are cubic in the roughness.
    constexpr double kFit[3][4] = {{0.968151, -5.64098, 8.59661, -3.98256},
                                   {-11.9792, 31.6348, -36.0005, 13.8504},
                                   {4.20783, -15.6925, 21.3047, -8.95853}};
    const double roughness = std::sqrt(alpha);
    double exponent = 0;
    double size = 0;
    for (int k = 2; k >= 0; --k) {
        double by_roughness = 0;
        for (int m = 3; m >= 0; --m) by_roughness = by_roughness * roughness + kFit[k][m];
        exponent = exponent * cosine + by_roughness;
        for (int m = 0; m < 4; ++m)
            size += std::abs(kFit[k][m]) * std::pow(roughness, m) * std::pow(cosine, k);
    }
    return std::min(std::exp(r(exponent, 4 * size)), 1.0);
}

glm::dvec2 environment_brdf(EnvironmentBrdf kind, const glm::dvec2& table, double nv, double roughness) {
    if (kind == EnvironmentBrdf::table) return table;
    if (kind == EnvironmentBrdf::constant) return {1, 0};
    if (kind == EnvironmentBrdf::lazarov) {
        // t0 min(t1, 2^(-9.28 n.v)) + t2 and t3 of gloss, as printed.
        const double gloss = 1 - roughness;
        const double a0 = gloss / 0.96 * std::min(0.475 * gloss, std::exp2(-9.28 * nv)) +
                          (0.0275 - 0.25 * 0.04) / 0.96 * gloss + (0.015 - 0.75 * 0.04) / 0.96;
        const double a1 = 0.25 * gloss + 0.75;
        return {a1 - a0, std::max(a0, 0.0)};
    }
    const double x = 1 - roughness;
    const double y = 0.0425 - 0.0275 * roughness;
    const double a = std::min(x * x, std::exp2(-9.28 * nv)) * x + y;
    return glm::clamp(glm::dvec2(-1.04 * a + 1.04 - 0.572 * roughness, 1.04 * a - 0.04 + 0.022 * roughness),
                      0.0, 1.0);
}

PhysicalRadiance radiance_of(const Model& model, const Scene& scene, const PhysicalPoint& point,
                             Roundings& r) {
    const Surface surface = surface_of(model, scene, point, r);
    const Material& material = scene.material;
    const bool is_coated = model.clearcoat == Clearcoat::layer;
    // KHR_materials_clearcoat: mix(beneath, coat, factor (0.04 + 0.96 (1 - n.v)^5)).
    // At grazing incidence next to nothing is left of 1 - coat: its rounding is one of 1.
    const double coat_nv = std::max(r(glm::dot(point.coat_normal, point.to_viewer), 2), kLeastCosineToViewer);
    const double coat = is_coated ? r(material.clearcoat * (0.04 + 0.96 * schlick_weight(coat_nv)), 4) : 0;
    const double coat_alpha = r(widened_alpha(model, r(alpha_of_roughness(material.clearcoat_roughness)),
                                              r(point.bend, 8 * point.bend)));
    PhysicalRadiance radiance{point.emission, point.emission,
                              point.emission + point.ambient.largest + glm::abs(point.reflected.value)};
    add_environment(model, scene, point, surface, radiance, r);
    radiance.value *= 1 - coat;
    if (is_coated && model.reflection == Reflection::image) {
        const glm::dvec2 brdf = environment_brdf(model.environment_brdf, scene.environment_brdf, coat_nv,
                                                 material.clearcoat_roughness);
        const glm::dvec3 mirrored =
            coat * (brdf.x + brdf.y) * scene.reflection.weight * point.coat_reflected.value;
        radiance.value += point.occlusion * mirrored;
        radiance.largest += glm::abs(mirrored);
    }
    const glm::dvec3 scale = highlight_scale(model, surface);
    const bool has_sheen = model.sheen == Sheen::charlie;
    const auto lobe = [&](const glm::dvec3& normal, double alpha, const glm::dvec3& to_light, double cosine,
                          double nv, const glm::dvec3& sum) {
        return normal_distribution(model.distribution, alpha, normal, to_light, point.to_viewer, r) *
               visibility_term(model.masking_shadowing, alpha, cosine, nv, glm::dot(sum, sum), r);
    };
    for (std::size_t i = 0; i < point.lights.size(); ++i) {
        const IncidentLight& light = point.lights[i];
        const double nl = r(glm::dot(point.normal, light.to_light), 2);
        const glm::dvec3 sum = r(light.to_light + point.to_viewer, 1);
        const double vh = glm::length(sum) / 2;
        const glm::dvec3 mirrored =
            mirrored_part(model, scene, surface.reflectance,
                          fresnel_reflectance(model.fresnel, surface.reflectance, vh), vh, 1, r);
        const double lv = r(glm::dot(light.to_light, point.to_viewer), 2);
        // A cosine of 0.01 stands for all smaller ones in what errors are measured by.
        const auto reflected = [&](double cosine) {
            Reflected result{r(entering_part(model, mirrored), 1) *
                             diffuse_lobe(model.diffuse_lobe, surface.diffuse, surface.roughness, cosine,
                                          surface.nv, lv, vh)};
            const double left = 1 - coat;
            const double under_sheen =
                has_sheen ? 1 - surface.sheen.strength *
                                    std::max(surface.sheen.seen, sheen_albedo(surface.sheen.alpha, cosine, r))
                          : 1;
            if (point.has_half[i]) {
                result.highlight =
                    model.anisotropy == Anisotropy::brushed
                        ? brushed_lobe(material, point, surface, light.to_light, cosine, r)
                        : lobe(point.normal, surface.alpha, light.to_light, cosine, surface.nv, sum);
                result.part += scale * mirrored * result.highlight;
            }
            result.part *= left * under_sheen;
            if (has_sheen && point.has_half[i])
                result.part += left * sheen_lobe(point, surface, sum, cosine, r);
            return result;
        };
        const auto coated = [&](double cosine) {
            return coat * lobe(point.coat_normal, coat_alpha, light.to_light, cosine, coat_nv, sum);
        };
        if (nl > 0) radiance.value += reflected(nl).part * nl * light.radiance;
        const double least = std::max(nl, 0.01);
        if (nl > -0.01) {
            const Reflected most = reflected(least);
            radiance.largest += glm::abs(most.part) * least * light.unshaped;
            radiance.of_white += (1 / kPi + most.highlight * least) * light.unshaped;
        }
        if (!is_coated || !point.has_half[i]) continue;
        const double coat_nl = r(glm::dot(point.coat_normal, light.to_light), 2);
        if (coat_nl > 0) radiance.value += coated(coat_nl) * coat_nl * light.radiance;
        const double least_of_coat = std::max(coat_nl, 0.01);
        if (coat_nl <= -0.01) continue;
        const glm::dvec3 most = coated(least_of_coat) * least_of_coat * light.unshaped;
        radiance.largest += most;
        radiance.of_white += most;
    }
    return radiance;
}

}  // namespace gobo::oracle
