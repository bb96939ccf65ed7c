#include "lab/oracle/model.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "lab/oracle/reflectance_extensions.hpp"

namespace gobo::oracle {
namespace {

/// Sets what a feature's value means; false where the value is unknown.
using Setter = std::function<bool(Model&, const std::string& value)>;

/// A choice whose enumerators are numbered as these names are.
template <class Enum>
Setter choice(Enum Model::*member, std::vector<std::string_view> names) {
    return [member, names = std::move(names)](Model& model, const std::string& value) {
        const auto found = std::find(names.begin(), names.end(), value);
        model.*member = static_cast<Enum>(found - names.begin());
        return found != names.end();
    };
}

Setter count(int Model::*member) {
    return [member](Model& model, const std::string& value) {
        model.*member = std::stoi(value);
        return true;
    };
}

bool set_depth(Model& model, const std::string& value) {
    static const Setter moved = choice(&Model::depth, {"default", "any", "greater", "less", "unchanged"});
    return value == "early" || moved(model, value);  // which leaves it as it comes, too
}

/// Of either the light is the same, but for roundings.
bool is_precision(Model&, const std::string& value) {
    return value == "high" || value == "mediump_light";
}

const std::map<std::string, Setter>& setters() {
    static const std::map<std::string, Setter> table = {
        {"directional", count(&Model::directional)},
        {"point", count(&Model::point)},
        {"spot", count(&Model::spot)},
        {"directional_or_point", count(&Model::directional_or_point)},
        {"directional_shadows", count(&Model::directional_shadows)},
        {"point_shadows", count(&Model::point_shadows)},
        {"spot_shadows", count(&Model::spot_shadows)},
        {"reflection", choice(&Model::reflection, {"none", "image"})},
        {"shadow_filter", choice(&Model::shadow_filter, {"bilinear", "sampler", "nearest"})},
        {"diffuse", choice(&Model::diffuse, {"lambert", "toon", "toon_ceil", "toon_thresholds"})},
        {"specular", choice(&Model::specular, {"none", "phong", "blinn"})},
        {"fog", choice(&Model::fog, {"none", "linear", "exponential", "exponential_squared"})},
        {"fog_distance", choice(&Model::fog_distance, {"radial", "planar"})},
        {"shading", choice(&Model::shading, {"fragment", "hybrid", "vertex", "flat"})},
        {"n_dot_l", choice(&Model::n_dot_l, {"fragment", "vertex"})},
        {"normal", choice(&Model::normal, {"renormalised", "interpolated"})},
        {"viewer", choice(&Model::viewer, {"local", "infinite"})},
        {"power", choice(&Model::power, {"exact", "near_exact", "squaring", "gaussian_fitted", "gaussian",
                                         "lyon", "schlick"})},
        {"light_sum", choice(&Model::light_sum, {"plain", "compensated", "pairwise"})},
        {"precision", is_precision},
        {"guards", choice(&Model::guards, {"full", "ordinary"})},
        {"spot_edge", choice(&Model::spot_edge, {"one_minus_cosine", "angle", "cosine"})},
        {"base_color_map", choice(&Model::base_color_map, {"none", "texture"})},
        {"metallic_roughness_map", choice(&Model::metallic_roughness_map, {"none", "texture"})},
        {"normal_map", choice(&Model::normal_map, {"none", "tangent", "derivatives"})},
        {"occlusion_map", choice(&Model::occlusion_map, {"none", "texture"})},
        {"emissive_map", choice(&Model::emissive_map, {"none", "texture"})},
        {"texture_placement", choice(&Model::texture_placement, {"plain", "placed"})},
        {"clearcoat", choice(&Model::clearcoat, {"none", "layer"})},
        {"sheen", choice(&Model::sheen, {"none", "charlie"})},
        {"specular_antialiasing", choice(&Model::specular_antialiasing, {"none", "widened"})},
        {"light_range", choice(&Model::light_range, {"unlimited", "windowed"})},
        {"anisotropy", choice(&Model::anisotropy, {"none", "brushed"})},
        {"output_range", choice(&Model::output_range, {"unbounded", "half_float", "display"})},
        {"depth", set_depth},
        {"lighting", choice(&Model::lighting, {"lit", "unlit", "metallic_roughness", "base_color"})},
        {"distribution", choice(&Model::distribution, {"cross_product", "plain"})},
        {"visibility", choice(&Model::masking_shadowing, {"correlated", "interpolated", "half_angle"})},
        {"fresnel", choice(&Model::fresnel, {"exact", "schlick", "gaussian", "constant"})},
        {"diffuse_lobe", choice(&Model::diffuse_lobe, {"oren_nayar", "burley", "lambert"})},
        {"environment_brdf", choice(&Model::environment_brdf, {"table", "karis", "lazarov", "constant"})},
        {"multiple_scattering", choice(&Model::multiple_scattering, {"returned", "none"})},
        {"light_ambient", choice(&Model::light_ambient, {"none", "each"})},
        {"ambient", choice(&Model::ambient, {"global", "hemisphere", "spherical_harmonics", "image"})},
        {"hemisphere", choice(&Model::hemisphere, {"sine", "cosine"})},
        {"harmonics", choice(&Model::harmonics, {"second", "first", "zeroth"})},
        {"material", choice(&Model::material, {"uniform", "array"})},
        {"sides", choice(&Model::sides, {"one", "two", "two_materials"})},
        {"cutout", choice(&Model::cutout, {"none", "threshold"})},
        {"vertex_color", choice(&Model::vertex_color, {"none", "modulate"})}};
    return table;
}

/// Adds the extension that the value stands for; false where none does.
bool add_extension(Model& model, const std::string& feature, const std::string& value) {
    const auto& all = reflectance_extensions();
    const auto found = std::ranges::find_if(all, [&](const ReflectanceExtension& extension) {
        return extension.feature == feature && extension.value == value;
    });
    if (found != all.end()) model.extensions.push_back(static_cast<std::size_t>(found - all.begin()));
    return found != all.end();
}

}  // namespace

tl::expected<Model, std::string> model_of(const Family& family, const Key& key) {
    if (family.name != "lit" && family.name != "pbr")
        return tl::unexpected(fmt::format("the oracle does not know the family '{}'", family.name));
    Model model;
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& feature = family.features[i];
        const std::string& value = feature.values[static_cast<std::size_t>(key[i])];
        const auto setter = setters().find(feature.name);
        const bool is_known = setter == setters().end()
                                  ? key[i] == 0 || add_extension(model, feature.name, value)
                                  : setter->second(model, value);
        if (!is_known) {
            return tl::unexpected(fmt::format("the oracle has no equation for {}={}", feature.name, value));
        }
    }
    return model;
}

}  // namespace gobo::oracle
