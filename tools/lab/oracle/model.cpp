#include "lab/oracle/model.hpp"

#include <functional>
#include <map>

#include <fmt/format.h>

namespace gobo::oracle {
namespace {

/// Sets what a feature's value means; false where the value is unknown.
using Setter = std::function<bool(Model&, const std::string& value)>;

template <class Enum>
Setter choice(Enum Model::*member, std::map<std::string, Enum> values) {
    return [member, values = std::move(values)](Model& model, const std::string& value) {
        const auto found = values.find(value);
        if (found == values.end()) return false;
        model.*member = found->second;
        return true;
    };
}

Setter count(int Model::*member) {
    return [member](Model& model, const std::string& value) {
        model.*member = std::stoi(value);
        return true;
    };
}

const std::map<std::string, Setter>& setters() {
    static const std::map<std::string, Setter> table = {
        {"directional", count(&Model::directional)},
        {"point", count(&Model::point)},
        {"spot", count(&Model::spot)},
        {"reflection",
         choice<Reflection>(&Model::reflection, {{"none", Reflection::none}, {"image", Reflection::image}})},
        {"directional_shadows", count(&Model::directional_shadows)},
        {"point_shadows", count(&Model::point_shadows)},
        {"spot_shadows", count(&Model::spot_shadows)},
        {"shadow_filter", choice<ShadowFilter>(&Model::shadow_filter, {{"bilinear", ShadowFilter::bilinear},
                                                                       {"sampler", ShadowFilter::sampler},
                                                                       {"nearest", ShadowFilter::nearest}})},
        {"diffuse", choice<Diffuse>(&Model::diffuse, {{"lambert", Diffuse::lambert},
                                                      {"toon", Diffuse::toon},
                                                      {"toon_ceil", Diffuse::toon_ceil},
                                                      {"toon_thresholds", Diffuse::toon_thresholds}})},
        {"specular", choice<Specular>(
                         &Model::specular,
                         {{"none", Specular::none}, {"phong", Specular::phong}, {"blinn", Specular::blinn}})},
        {"fog", choice<Fog>(&Model::fog, {{"none", Fog::none},
                                          {"linear", Fog::linear},
                                          {"exponential", Fog::exponential},
                                          {"exponential_squared", Fog::exponential_squared}})},
        {"fog_distance", choice<FogDistance>(&Model::fog_distance, {{"radial", FogDistance::radial},
                                                                    {"planar", FogDistance::planar}})},
        {"shading", choice<Shading>(&Model::shading, {{"fragment", Shading::fragment},
                                                      {"hybrid", Shading::hybrid},
                                                      {"vertex", Shading::vertex},
                                                      {"flat", Shading::flat}})},
        {"intensity", choice<Intensity>(&Model::intensity,
                                        {{"fragment", Intensity::fragment}, {"vertex", Intensity::vertex}})},
        {"normal", choice<Normal>(&Model::normal, {{"renormalised", Normal::renormalised},
                                                   {"interpolated", Normal::interpolated}})},
        {"viewer",
         choice<Viewer>(&Model::viewer, {{"local", Viewer::local}, {"infinite", Viewer::infinite}})},
        {"power", choice<Power>(&Model::power, {{"exact", Power::exact},
                                                {"near_exact", Power::near_exact},
                                                {"squaring", Power::squaring},
                                                {"gaussian_fitted", Power::gaussian_fitted},
                                                {"gaussian", Power::gaussian},
                                                {"lyon", Power::lyon},
                                                {"schlick", Power::schlick}})},
        {"light_sum", choice<LightSum>(&Model::light_sum, {{"plain", LightSum::plain},
                                                           {"compensated", LightSum::compensated},
                                                           {"pairwise", LightSum::pairwise}})},
        {"guards", choice<Guards>(&Model::guards, {{"full", Guards::full}, {"ordinary", Guards::ordinary}})},
        {"spot_edge", choice<SpotEdge>(&Model::spot_edge, {{"versine", SpotEdge::versine},
                                                           {"angle", SpotEdge::angle},
                                                           {"cosine", SpotEdge::cosine}})},

        {"output_range", choice<OutputRange>(&Model::output_range, {{"unbounded", OutputRange::unbounded},
                                                                    {"half_float", OutputRange::half_float},
                                                                    {"display", OutputRange::display}})},
        {"depth", choice<Depth>(&Model::depth, {{"default", Depth::untouched},
                                                {"early", Depth::untouched},
                                                {"any", Depth::any},
                                                {"greater", Depth::greater},
                                                {"less", Depth::less},
                                                {"unchanged", Depth::unchanged}})},
        {"lighting",
         choice<Lighting>(&Model::lighting, {{"lit", Lighting::lit}, {"unlit", Lighting::unlit}})},
        {"homogeneous", count(&Model::homogeneous)},
        {"light_ambient", choice<LightAmbient>(&Model::light_ambient,
                                               {{"none", LightAmbient::none}, {"each", LightAmbient::each}})},
        {"ambient", choice<Ambient>(&Model::ambient, {{"global", Ambient::global},
                                                      {"hemisphere", Ambient::hemisphere},
                                                      {"spherical_harmonics", Ambient::spherical_harmonics},
                                                      {"image", Ambient::image}})},
        {"hemisphere", choice<Hemisphere>(&Model::hemisphere,
                                          {{"sine", Hemisphere::sine}, {"cosine", Hemisphere::cosine}})},
        {"harmonics", choice<Harmonics>(&Model::harmonics, {{"second", Harmonics::second},
                                                            {"first", Harmonics::first},
                                                            {"zeroth", Harmonics::zeroth}})},
        {"material", choice<MaterialChoice>(&Model::material, {{"uniform", MaterialChoice::uniform},
                                                               {"array", MaterialChoice::array}})},
        {"sides",
         choice<Sides>(&Model::sides,
                       {{"one", Sides::one}, {"two", Sides::two}, {"two_materials", Sides::two_materials}})},
        {"cutout",
         choice<Cutout>(&Model::cutout, {{"none", Cutout::none}, {"threshold", Cutout::threshold}})},
        {"vertex_color", choice<VertexColor>(&Model::vertex_color, {{"none", VertexColor::none},
                                                                    {"modulate", VertexColor::modulate}})}};
    return table;
}

}  // namespace

tl::expected<Model, std::string> model_of(const Family& family, const Key& key) {
    if (family.name != "lit")
        return tl::unexpected(fmt::format("the oracle does not know the family '{}'", family.name));
    Model model;
    for (std::size_t i = 0; i < key.size(); ++i) {
        const Feature& feature = family.features[i];
        const std::string& value = feature.values[static_cast<std::size_t>(key[i])];
        const auto setter = setters().find(feature.name);
        const bool is_known = setter == setters().end() ? key[i] == 0 : setter->second(model, value);
        if (!is_known) {
            return tl::unexpected(fmt::format("the oracle has no equation for {}={}", feature.name, value));
        }
    }
    return model;
}

}  // namespace gobo::oracle
