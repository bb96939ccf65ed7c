#include "lab/verify/inputs.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/oracle/reflectance_extensions.hpp"
#include "lab/verify/random_points.hpp"
#include "lab/verify/sample_members.hpp"

namespace gobo::verify {
namespace {

template <class Value>
std::vector<double> numbers(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) return {static_cast<double>(value)};
    const auto* first = reinterpret_cast<const double*>(&value);
    return {first, first + sizeof(Value) / sizeof(double)};
}

template <class Value>
void assign(Value& target, const std::vector<double>& values) {
    if constexpr (std::is_arithmetic_v<Value>)
        target = static_cast<Value>(values.at(0));
    else
        std::copy_n(values.begin(), std::min(values.size(), sizeof(Value) / sizeof(double)),
                    reinterpret_cast<double*>(&target));
}

// An element of a list. Setting it makes the element, and those before it, where there are fewer; one that
// was never set is zero, as where the vertex stage is about to write it.
template <class Value>
Value& element(std::vector<Value>& list, std::size_t index) {
    list.resize(std::max(list.size(), index + 1));
    return list[index];
}
template <class Value>
const Value& element(const std::vector<Value>& list, std::size_t index) {
    static const Value kZero{};
    return index < list.size() ? list[index] : kZero;
}
template <class Value, std::size_t size>
auto& element(std::array<Value, size>& list, std::size_t index) {
    return list.at(index);
}
template <class Value, std::size_t size>
auto& element(const std::array<Value, size>& list, std::size_t index) {
    return list.at(index);
}

/// So many elements a list may have.
template <class Value>
constexpr std::size_t kMostElements = std::numeric_limits<std::size_t>::max();
template <class Value, std::size_t size>
constexpr std::size_t kMostElements<std::array<Value, size>> = size;

/// By name without subscripts, for an index: nothing where an array ends before it.
using Fields = std::map<std::string, std::function<std::optional<Field>(std::size_t)>, std::less<>>;

/// Adds what `at` gives a reference to, or its members, down to numbers.
template <class At>
void add_fields(Fields& fields, const std::string& name, std::size_t most, At at) {
    using Value = std::remove_cvref_t<decltype(at(std::declval<Sample&>(), 0))>;
    if constexpr (kIsNumbers<Value>) {
        fields[name] = [=](std::size_t index) -> std::optional<Field> {
            if (index >= most) return std::nullopt;
            return Field{[=](const Sample& sample) { return numbers(at(sample, index)); },
                         [=](Sample& sample, const std::vector<double>& values) {
                             assign(at(sample, index), values);
                         }};
        };
    } else if constexpr (requires(Value & list) { element(list, 0); }) {
        add_fields(
            fields, name + "[]", kMostElements<Value>, [=](auto& sample, std::size_t index) -> auto& {
                return element(at(sample, index), index);
            });
    } else {
        const auto add_member = [&](const std::string& member_name, auto member) {
            const bool is_nested = !name.empty() && !member_name.empty();
            add_fields(
                fields, name + (is_nested ? "." : "") + member_name,
                most, [=](auto& sample, std::size_t index) -> auto& { return at(sample, index).*member; });
        };
        for_each_member<Value>(add_member);
    }
}

/// A local light's position. Its w is 1, or 1 / range where the key has ranges.
template <class Light>
auto places(std::vector<Light> oracle::Scene::*lights) {
    return [=](std::size_t index) -> std::optional<Field> {
        return Field{[=](const Sample& sample) {
                         const Light& light = element(sample.scene.*lights, index);
                         const bool has_range = sample.model.light_range == oracle::LightRange::windowed;
                         return std::vector<double>{light.position.x, light.position.y, light.position.z,
                                                    has_range ? light.nearness : 1};
                     },
                     [=](Sample& sample, const std::vector<double>& values) {
                         Light& light = element(sample.scene.*lights, index);
                         light.position = {values.at(0), values.at(1), values.at(2)};
                         light.nearness = values.size() > 3 ? values[3] : 0;
                     }};
    };
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

/// A number of an extension's block, by its place among all of them.
auto extension_number(std::size_t place) {
    return [=](std::size_t) -> std::optional<Field> {
        return Field{
            [=](const Sample& sample) { return std::vector{element(sample.scene.extension_numbers, place)}; },
            [=](Sample& sample, const std::vector<double>& values) {
                element(sample.scene.extension_numbers, place) = values.at(0);
            }};
    };
}

const Fields& fields_of_lit() {
    static const Fields kFields = [] {
        Fields fields;
        add_fields(
            fields, "", kMostElements<Sample>, [](auto& sample, std::size_t) -> auto& { return sample; });
        const std::vector<oracle::ExtensionNumber> of_extensions = oracle::extension_numbers();
        for (std::size_t i = 0; i < of_extensions.size(); ++i)
            fields[of_extensions[i].uniform] = extension_number(i);
        fields["lightCosines[]"] = &cosines;
        fields["PointLights.lights[].position"] = places(&oracle::Scene::point);
        fields["SpotLights.lights[].position"] = places(&oracle::Scene::spot);
        fields["gl_FragCoord"] = [](std::size_t) {
            return Field{
                [](const Sample& sample) {
                    return std::vector<double>{0.5, 0.5, sample.depth, 1};
                },
                [](Sample& sample, const std::vector<double>& values) { sample.depth = values.at(2); }};
        };
        return fields;
    }();
    return kFields;
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
    request.coordinates = {sample.surface.texture_coordinate.x, sample.surface.texture_coordinate.y, 0, 0};
    return image(request)[3];
}

template <oracle::MapKind map>
evaluate::TextureContent picture_of(const Sample& sample) {
    const oracle::EvenPicture& picture = sample.scene.pictures[static_cast<std::size_t>(map)];
    const auto four = [](const glm::dvec4& color) {
        return std::array<double, 4>{color.r, color.g, color.b, color.a};
    };
    return evaluate::EvenColor{four(picture.even), {four(picture.along_s), four(picture.along_t), {}}};
}

/// Of one colour, as the image is asked at one place.
template <oracle::MapKind map>
void set_picture(Sample& sample, const evaluate::Image& image, const evaluate::ImagePort& port) {
    const auto even = std::get<evaluate::EvenColor>(evaluate::content_of(image, port, 0));
    sample.scene.pictures[static_cast<std::size_t>(map)] = {
        {even.color[0], even.color[1], even.color[2], even.color[3]}, glm::dvec4(0), glm::dvec4(0)};
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
    {"baseColorMap", picture_of<oracle::MapKind::base_color>, set_picture<oracle::MapKind::base_color>},
    {"metallicRoughnessMap", picture_of<oracle::MapKind::metallic_roughness>,
     set_picture<oracle::MapKind::metallic_roughness>},
    {"normalMap", picture_of<oracle::MapKind::normal>, set_picture<oracle::MapKind::normal>},
    {"occlusionMap", picture_of<oracle::MapKind::occlusion>, set_picture<oracle::MapKind::occlusion>},
    {"emissiveMap", picture_of<oracle::MapKind::emissive>, set_picture<oracle::MapKind::emissive>},
    {"environmentBrdfTable",
     [](const Sample& s) -> evaluate::TextureContent {
         return evaluate::EvenColor{{s.scene.environment_brdf.x, s.scene.environment_brdf.y, 0, 1}, {}};
     },
     [](Sample& s, const auto& image, const auto& port) {
         const auto even = std::get<evaluate::EvenColor>(evaluate::content_of(image, port, 0));
         s.scene.environment_brdf = {even.color[0], even.color[1]};
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
    const auto found = fields_of_lit().find(without_subscripts(name));
    const auto element = element_name(name);
    std::optional<Field> field;
    if (found != fields_of_lit().end()) field = found->second(element ? element->index : 0);
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
