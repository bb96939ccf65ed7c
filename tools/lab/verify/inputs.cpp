#include "lab/verify/inputs.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>

#include <glm/gtc/type_ptr.hpp>

#include "lab/evaluate/images.hpp"

namespace gobo::verify {
namespace {

template <class Number>
std::vector<double> numbers(const Number& value) requires std::is_arithmetic_v<Number> {
    return {static_cast<double>(value)};
}
std::vector<double> numbers(const std::array<double, 3>& values) {
    return {values.begin(), values.end()};
}
template <glm::length_t size>
std::vector<double> numbers(const glm::vec<size, double>& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + size};
}
template <glm::length_t columns, glm::length_t rows>
std::vector<double> numbers(const glm::mat<columns, rows, double>& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + columns * rows};
}

template <class Number>
void assign(Number& target, const std::vector<double>& values) requires std::is_arithmetic_v<Number> {
    target = static_cast<Number>(values.at(0));
}
void assign(std::array<double, 3>& target, const std::vector<double>& values) {
    std::copy_n(values.begin(), 3, target.begin());
}
template <class Vector>
void assign(Vector& target, const std::vector<double>& values) requires(!std::is_arithmetic_v<Vector>) {
    std::copy_n(values.begin(), std::min(values.size(), numbers(target).size()), glm::value_ptr(target));
}

/// The field that `access` gives a reference to.
template <class Access>
Field field(Access access) {
    return {[access](const Sample& sample) { return numbers(access(sample)); },
            [access](Sample& sample, const std::vector<double>& values) { assign(access(sample), values); }};
}

const std::map<std::string, Field, std::less<>>& plain_fields() {
    static const std::map<std::string, Field, std::less<>> kFields = {
        // Of the vertex stage.
        {"position", field([](auto& s) -> auto& { return s.object_position; })},
        {"normal", field([](auto& s) -> auto& { return s.object_normal; })},
        {"color", field([](auto& s) -> auto& { return s.surface.color; })},
        {"texcoord", field([](auto& s) -> auto& { return s.texture_coordinate; })},
        {"materialIndex", field([](auto& s) -> auto& { return s.surface.material; })},
        {"Transform.modelView", field([](auto& s) -> auto& { return s.model_view; })},
        {"Transform.projection", field([](auto& s) -> auto& { return s.projection; })},
        {"Transform.normalMatrix", field([](auto& s) -> auto& { return s.normal_matrix; })},
        // Interpolated.
        {"eyePosition", field([](auto& s) -> auto& { return s.surface.position; })},
        {"eyeNormal", field([](auto& s) -> auto& { return s.surface.normal; })},
        {"vertexColor", field([](auto& s) -> auto& { return s.surface.color; })},
        {"textureCoordinate", field([](auto& s) -> auto& { return s.texture_coordinate; })},
        {"flatMaterialIndex", field([](auto& s) -> auto& { return s.surface.material; })},
        {"handedness", field([](auto& s) -> auto& { return s.handedness; })},
        {"litRadiance", field([](auto& s) -> auto& { return s.lit_radiance; })},
        {"flatRadiance", field([](auto& s) -> auto& { return s.lit_radiance; })},
        {"backRadiance", field([](auto& s) -> auto& { return s.back_radiance; })},
        {"flatBackRadiance", field([](auto& s) -> auto& { return s.back_radiance; })},
        {"gl_FrontFacing", field([](auto& s) -> auto& { return s.is_front_facing; })},
        {"gl_FragCoord",
         {[](const Sample& s) {
              return std::vector<double>{0.5, 0.5, s.depth, 1};
          },
          [](Sample& s, const std::vector<double>& values) { s.depth = values.at(2); }}},
        // The same for a whole draw.
        {"Material.emission", field([](auto& s) -> auto& { return s.scene.material.emission; })},
        {"Material.ambient", field([](auto& s) -> auto& { return s.scene.material.ambient; })},
        {"Material.diffuse", field([](auto& s) -> auto& { return s.scene.material.diffuse; })},
        {"Material.specular", field([](auto& s) -> auto& { return s.scene.material.specular; })},
        {"Material.shininess", field([](auto& s) -> auto& { return s.scene.material.shininess; })},
        {"Material.strength", field([](auto& s) -> auto& { return s.scene.material.strength; })},
        {"Ambient.color", field([](auto& s) -> auto& { return s.scene.ambient; })},
        {"Hemisphere.up", field([](auto& s) -> auto& { return s.scene.hemisphere.up; })},
        {"Hemisphere.sky", field([](auto& s) -> auto& { return s.scene.hemisphere.sky; })},
        {"Hemisphere.ground", field([](auto& s) -> auto& { return s.scene.hemisphere.ground; })},
        {"Harmonics.toProbe", field([](auto& s) -> auto& { return s.scene.harmonics.to_probe; })},
        {"Harmonics.scale", field([](auto& s) -> auto& { return s.scene.harmonics.scale; })},
        {"ImageLight.color", field([](auto& s) -> auto& { return s.scene.image_light.color; })},
        {"ImageLight.weight", field([](auto& s) -> auto& { return s.scene.image_light.weight; })},
        {"ImageLight.toMap", field([](auto& s) -> auto& { return s.scene.image_light.to_map; })},
        {"Reflection.weight", field([](auto& s) -> auto& { return s.scene.reflection.weight; })},
        {"Reflection.toMap", field([](auto& s) -> auto& { return s.scene.reflection.to_map; })},
        {"Toon.levels", field([](auto& s) -> auto& { return s.scene.toon_levels; })},
        {"ToonThresholds.thresholds", field([](auto& s) -> auto& { return s.scene.toon_thresholds; })},
        {"ToonThresholds.tones", field([](auto& s) -> auto& { return s.scene.toon_tones; })},
        {"Cutout.threshold", field([](auto& s) -> auto& { return s.scene.cutout_threshold; })},
        {"Fog.color", field([](auto& s) -> auto& { return s.scene.fog.color; })},
        {"Fog.density", field([](auto& s) -> auto& { return s.scene.fog.density; })},
        {"Fog.start", field([](auto& s) -> auto& { return s.scene.fog.start; })},
        {"Fog.end", field([](auto& s) -> auto& { return s.scene.fog.end; })},
        {"DepthOffset.offset", field([](auto& s) -> auto& { return s.scene.depth_offset; })},
    };
    return kFields;
}

// The lists of a sample, and what stands for a whole element.
constexpr auto kDirectional = [](auto& s) -> auto& {
    return s.scene.directional;
};
constexpr auto kPoint = [](auto& s) -> auto& {
    return s.scene.point;
};
constexpr auto kSpot = [](auto& s) -> auto& {
    return s.scene.spot;
};
constexpr auto kDirectionalOrPoint = [](auto& s) -> auto& {
    return s.scene.directional_or_point;
};
constexpr auto kLightAmbients = [](auto& s) -> auto& {
    return s.scene.light_ambients;
};
constexpr auto kShadows = [](auto& s) -> auto& {
    return s.scene.shadows;
};
constexpr auto kMaterials = [](auto& s) -> auto& {
    return s.scene.materials;
};
constexpr auto kHarmonics = [](auto& s) -> auto& {
    return s.scene.harmonics.coefficients;
};
constexpr auto kRays = [](auto& s) -> auto& {
    return s.surface.rays;
};
constexpr auto kHalfways = [](auto& s) -> auto& {
    return s.surface.halfways;
};
constexpr auto kWhole = [](auto& element) -> auto& {
    return element;
};

/// A member of an element. Setting it makes the element, and those before it, where there are fewer; one that
/// was never set is zero, as where the vertex stage is about to write it.
template <auto list, auto member>
std::optional<Field> element(std::size_t index) {
    using List = std::remove_cvref_t<decltype(list(std::declval<Sample&>()))>;
    constexpr bool kGrows = requires(List & grown) {
        grown.resize(1);
    };
    if constexpr (!kGrows) {
        if (index >= std::tuple_size_v<List>) return std::nullopt;
    }
    return Field{[index](const Sample& sample) {
                     const List& all = list(sample);
                     const typename List::value_type zero{};
                     return numbers(std::invoke(member, index < all.size() ? all[index] : zero));
                 },
                 [index](Sample& sample, const std::vector<double>& values) {
                     List& all = list(sample);
                     if constexpr (kGrows) all.resize(std::max(all.size(), index + 1));
                     assign(std::invoke(member, all[index]), values);
                 }};
}

/// A light's position as the shaders take it: its w is 1.
template <auto list>
std::optional<Field> position(std::size_t index) {
    std::optional<Field> field = element<list, &oracle::PointLight::position>(index);
    field->get = [get = field->get](const Sample& sample) {
        std::vector<double> values = get(sample);
        values.push_back(1);
        return values;
    };
    return field;
}

/// The cosines of four lights.
std::optional<Field> cosines(std::size_t index) {
    const std::size_t first = 4 * index;
    return Field{[=](const Sample& sample) {
                     std::vector<double> values(4);
                     const std::vector<double>& all = sample.surface.cosines;
                     for (std::size_t i = 0; i < 4 && first + i < all.size(); ++i) values[i] = all[first + i];
                     return values;
                 },
                 [=](Sample& sample, const std::vector<double>& values) {
                     std::vector<double>& all = sample.surface.cosines;
                     all.resize(std::max(all.size(), first + 4));
                     std::copy(values.begin(), values.end(),
                               all.begin() + static_cast<std::ptrdiff_t>(first));
                 }};
}

/// What an element of an array, or a member of it, is bound to.
struct ElementField {
    std::string_view array;
    std::string_view member;
    std::optional<Field> (*at)(std::size_t index);
};

constexpr ElementField kElementFields[] = {
    {"DirectionalLights.lights", ".direction", &element<kDirectional, &oracle::DirectionalLight::direction>},
    {"DirectionalLights.lights", ".color", &element<kDirectional, &oracle::DirectionalLight::color>},
    {"PointLights.lights", ".position", &position<kPoint>},
    {"PointLights.lights", ".color", &element<kPoint, &oracle::PointLight::color>},
    {"PointLights.lights", ".attenuation", &element<kPoint, &oracle::PointLight::attenuation>},
    {"SpotLights.lights", ".position", &position<kSpot>},
    {"SpotLights.lights", ".color", &element<kSpot, &oracle::PointLight::color>},
    {"SpotLights.lights", ".attenuation", &element<kSpot, &oracle::PointLight::attenuation>},
    {"SpotLights.lights", ".axis", &element<kSpot, &oracle::SpotLight::axis>},
    {"SpotLights.lights", ".exponent", &element<kSpot, &oracle::SpotLight::exponent>},
    {"SpotLights.lights", ".innerOneMinusCosine",
     &element<kSpot, &oracle::SpotLight::inner_one_minus_cosine>},
    {"SpotLights.lights", ".outerOneMinusCosine",
     &element<kSpot, &oracle::SpotLight::outer_one_minus_cosine>},
    {"DirectionalOrPointLights.lights", ".position",
     &element<kDirectionalOrPoint, &oracle::DirectionalOrPointLight::position>},
    {"DirectionalOrPointLights.lights", ".color",
     &element<kDirectionalOrPoint, &oracle::DirectionalOrPointLight::color>},
    {"DirectionalOrPointLights.lights", ".attenuation",
     &element<kDirectionalOrPoint, &oracle::DirectionalOrPointLight::attenuation>},
    {"LightAmbients.colors", "", &element<kLightAmbients, kWhole>},
    {"Shadows.shadows", ".toMap", &element<kShadows, &oracle::Shadow::to_map>},
    {"Shadows.shadows", ".layer", &element<kShadows, &oracle::Shadow::layer>},
    {"Shadows.shadows", ".depthScale", &element<kShadows, &oracle::Shadow::depth_scale>},
    {"Shadows.shadows", ".depthShift", &element<kShadows, &oracle::Shadow::depth_shift>},
    {"Shadows.shadows", ".spread", &element<kShadows, &oracle::Shadow::spread>},
    {"Materials.rows", ".emission", &element<kMaterials, &oracle::Material::emission>},
    {"Materials.rows", ".ambient", &element<kMaterials, &oracle::Material::ambient>},
    {"Materials.rows", ".diffuse", &element<kMaterials, &oracle::Material::diffuse>},
    {"Materials.rows", ".specular", &element<kMaterials, &oracle::Material::specular>},
    {"Materials.rows", ".shininess", &element<kMaterials, &oracle::Material::shininess>},
    {"Materials.rows", ".strength", &element<kMaterials, &oracle::Material::strength>},
    {"Harmonics.coefficients", "", &element<kHarmonics, kWhole>},
    {"lightRays", "", &element<kRays, kWhole>},
    {"lightsHalfways", "", &element<kHalfways, kWhole>},
    {"lightCosines", "", &cosines},
};

std::optional<Field> element_field(std::string_view name) {
    const auto element = element_name(name);
    if (!element) return std::nullopt;
    for (const ElementField& row : kElementFields)
        if (row.array == element->array && row.member == element->rest) return row.at(element->index);
    return std::nullopt;
}

FieldOfFamily family_field = nullptr;

Result<void> bind(const evaluate::Port& port, std::span<const Sample> samples,
                  evaluate::Invocations& invocations) {
    const std::optional<Field> field = field_of(port.name);
    if (!field && port.name.starts_with("gl_")) return {};  // gl_InstanceID and the like: 0
    if (!field) {
        return fail(Fault::input, fmt::format("nothing is known to give '{}'", port.name),
                    "the oracle's samples must learn what it means (tools/lab/verify/inputs.cpp)");
    }
    std::vector<double>& values = invocations.values[port.name];
    values.resize(port.components * samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::vector<double> value = field->get(samples[i]);
        for (std::size_t c = 0; c < std::min<std::size_t>(port.components, value.size()); ++c)
            values[c * samples.size() + i] = value[c];
    }
    return {};
}

evaluate::EvenColor content_of(const oracle::CubeMap& map) {
    evaluate::EvenColor even{{map.mean.r, map.mean.g, map.mean.b, 1}, {}};
    for (int axis = 0; axis < 3; ++axis)
        for (int channel = 0; channel < 3; ++channel)
            even.along[static_cast<std::size_t>(axis)][static_cast<std::size_t>(channel)] =
                map.slope[axis][channel];
    return even;
}

oracle::CubeMap cube_map_of(const evaluate::TextureContent& content) {
    const auto& even = std::get<evaluate::EvenColor>(content);
    oracle::CubeMap map;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        map.mean[static_cast<int>(channel)] = even.color[channel];
        for (std::size_t axis = 0; axis < 3; ++axis)
            map.slope[static_cast<int>(axis)][static_cast<int>(channel)] = even.along[axis][channel];
    }
    return map;
}

oracle::DepthMaps depth_maps_of(const evaluate::TextureContent& content) {
    if (const auto* texels = std::get_if<evaluate::DepthTexels>(&content))
        return {texels->width, texels->height, texels->layers, texels->depths};
    return {1, 1, 1, {std::get<evaluate::EvenColor>(content).color[0]}};
}

double opacity_of(const evaluate::Image& image, const Sample& sample) {
    evaluate::ImageRequest request;
    request.coordinates = {sample.texture_coordinate.x, sample.texture_coordinate.y, 0, 0};
    return image(request)[3];
}

/// What a sampler holds for a sample.
struct SamplerField {
    std::string_view name;
    evaluate::TextureContent (*get)(const Sample& sample);
    void (*set)(Sample& sample, const evaluate::Image& image, const evaluate::ImagePort& port);
};

constexpr SamplerField kSamplerFields[] = {
    {"opacityMap",
     [](const Sample& s) -> evaluate::TextureContent {
         return evaluate::EvenColor{{0, 0, 0, s.surface.opacity}, {}};
     },
     [](Sample& s, const auto& image, const auto&) { s.surface.opacity = opacity_of(image, s); }},
    {"diffuseMap",
     [](const Sample& s) -> evaluate::TextureContent { return content_of(s.scene.image_light.map); },
     [](Sample& s, const auto& image, const auto& port) {
         s.scene.image_light.map = cube_map_of(evaluate::content_of(image, port, 0));
     }},
    {"specularMap",
     [](const Sample& s) -> evaluate::TextureContent { return content_of(s.scene.reflection.map); },
     [](Sample& s, const auto& image, const auto& port) {
         s.scene.reflection.map = cube_map_of(evaluate::content_of(image, port, 0));
     }},
    {"shadowMaps",
     [](const Sample& s) -> evaluate::TextureContent {
         const oracle::DepthMaps& maps = s.scene.maps;
         return evaluate::DepthTexels{maps.width, maps.height, maps.layers, maps.depths};
     },
     [](Sample& s, const auto& image, const auto& port) {
         s.scene.maps = depth_maps_of(evaluate::content_of(image, port, 0));
     }},
};

const SamplerField* sampler_field_of(std::string_view name) {
    const auto* found = std::find_if(std::begin(kSamplerFields), std::end(kSamplerFields),
                                     [&](const SamplerField& row) { return row.name == name; });
    return found == std::end(kSamplerFields) ? nullptr : found;
}

/// Each invocation sees the textures of its own sample.
void bind_textures(const evaluate::Program& program, std::span<const Sample> samples,
                   evaluate::Invocations& invocations) {
    for (const evaluate::ImagePort& port : program.images) {
        const SamplerField* field = sampler_field_of(port.name);
        if (field == nullptr || samples.empty()) continue;
        const auto images = std::make_shared<std::vector<evaluate::Image>>();
        for (const Sample& sample : samples)
            images->push_back(evaluate::image_of(field->get(sample), port.type));
        invocations.images[port.name] = [images](const evaluate::ImageRequest& request) {
            return (*images)[request.invocation](request);
        };
    }
}

}  // namespace

std::optional<ElementName> element_name(std::string_view name) {
    const auto bracket = name.find('[');
    if (bracket == std::string_view::npos) return std::nullopt;
    ElementName element{name.substr(0, bracket), 0, {}};
    const char* last = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data() + bracket + 1, last, element.index);
    if (error != std::errc() || end == last || *end != ']') return std::nullopt;
    element.rest = {end + 1, static_cast<std::size_t>(last - end - 1)};
    return element;
}

std::optional<Field> field_of(const std::string& name) {
    const auto found = plain_fields().find(name);
    std::optional<Field> field = found != plain_fields().end() ? found->second : element_field(name);
    return family_field == nullptr ? field : family_field(name, std::move(field));
}

void lay_fields_over_lit(FieldOfFamily field) {
    family_field = field;
}

Result<evaluate::Invocations> bind_inputs(const evaluate::Program& program, std::span<const Sample> samples) {
    evaluate::Invocations invocations;
    invocations.count = samples.size();
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) GOBO_TRY_DO(bind(port, samples, invocations));
    bind_textures(program, samples, invocations);
    return invocations;
}

std::optional<Sample> sample_of(const evaluate::Program& program, const evaluate::Invocations& invocations) {
    Sample sample;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            const std::optional<Field> field = field_of(port.name);
            if (!field && !port.name.starts_with("gl_")) return std::nullopt;
            const auto given = invocations.values.find(port.name);
            if (!field) continue;
            field->set(sample, given == invocations.values.end() ? std::vector<double>(port.components)
                                                                 : given->second);
        }
    for (const evaluate::ImagePort& port : program.images) {
        const SamplerField* field = sampler_field_of(port.name);
        const auto given = invocations.images.find(port.name);
        if (field == nullptr || given == invocations.images.end()) return std::nullopt;
        field->set(sample, given->second, port);
    }
    return sample;
}

}  // namespace gobo::verify
