#include "lab/gallery/live_page.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text_template.hpp"
#include "family/key.hpp"
#include "lab/render/bind.hpp"
#include "lab/render/texture.hpp"
#include "lab/study/html.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::gallery {
namespace {

using Json = nlohmann::ordered_json;

std::string encoded(std::span<const std::byte> bytes) {
    return study::data_url("", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

template <class Number>
std::string encoded(const std::vector<Number>& numbers) {
    return encoded(std::as_bytes(std::span(numbers)));
}

/// Red, green and blue, row by row from the bottom, as WebGL reads pixels.
std::vector<float> from_the_bottom(const Image& image) {
    std::vector<float> colors;
    for (int y = image.height; y-- > 0;)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < 3; ++channel) colors.push_back(image.at(x, y, channel));
    return colors;
}

/// What a sampler looks up, and its bytes; "none" where the page has nothing for it.
std::pair<Json, std::string> texture_of(const Sampler& sampler, const Drawing& drawing, const Scene& scene) {
    const auto texture = [](const char* kind, const Image& image, int layers, std::string data) {
        return std::pair<Json, std::string>{
            {{"kind", kind}, {"width", image.width}, {"height", image.height}, {"layers", layers}},
            std::move(data)};
    };
    const std::vector<Image>& maps = drawing.shadow_maps;
    if (sampler.name == "shadowMaps" && !maps.empty()) {
        std::vector<float> depths;
        for (const Image& map : maps) depths.insert(depths.end(), map.values.begin(), map.values.end());
        return texture("depths", maps.front(), static_cast<int>(maps.size()), encoded(depths));
    }
    const auto cube = scene.cube_maps.find(sampler.name);
    if (sampler.type == "samplerCube" && cube != scene.cube_maps.end()) {
        std::vector<float> texels;
        for (const Image& level : cube->second) {
            const std::vector<float> own = four_channels(level);
            texels.insert(texels.end(), own.begin(), own.end());
        }
        return texture("cube", cube->second.front(), static_cast<int>(cube->second.size()), encoded(texels));
    }
    if (sampler.type != "sampler2D" || !sampler.array.empty()) return texture("none", {}, 0, {});
    const Image texels = texture_texels(texture_source_of(sampler.name, drawing.values));
    return texture("flat", texels, 1, encoded(four_channels(texels)));
}

/// An attribute: one value for all vertices, or none and the bytes of all.
std::pair<Json, std::string> attribute_of(const Variable& input, const Mesh& mesh,
                                          const std::vector<RenderValue>& values) {
    const RenderValue* const value = find_value(values, input.name);
    const std::string source(value != nullptr ? value->source : attribute_source_of(input.name));
    if (value != nullptr && source.empty()) return {{{"constant", value->numbers}}, {}};
    const auto own = attribute_values(mesh, source);
    if (!own) return {{{"constant", source == "color" ? Json{1, 1, 1, 1} : Json{0, 0, 0, 0}}}, {}};
    const bool is_integer = !own->integers.empty();
    return {{{"components", own->components}, {"integer", is_integer}},
            is_integer ? encoded(own->integers) : encoded(own->floats)};
}

/// What a reader may change: every number that is no part of a matrix, within its domain, else up to twice
/// what it is.
Json control_json(const Assignment& assignment, const GlslType& type, const std::vector<Domain>& domains) {
    const Leaf& leaf = assignment.leaf;
    const double largest = std::abs(
        *std::ranges::max_element(assignment.numbers, {}, [](double number) { return std::abs(number); }));
    double low =
        std::ranges::any_of(assignment.numbers, [](double number) { return number < 0; }) ? -2 * largest : 0;
    double high = largest > 0 ? 2 * largest : 1;
    if (const Domain* const domain = verify::domain_of(domains, leaf.name)) {
        low = domain->of_length ? -domain->high : domain->low;
        high = domain->high;
    }
    return {{"name", leaf.name},
            {"block", leaf.block},
            {"offset", leaf.offset},
            {"stride", leaf.array_stride},
            {"components", type.rows},
            {"scalar", GlslType{type.scalar}.name()},
            {"low", low},
            {"high", high},
            {"numbers", assignment.numbers}};
}

}  // namespace

std::size_t LivePage::shared(std::string data) {
    const auto place = std::ranges::find(shared_, data) - shared_.begin();
    if (place == std::ssize(shared_)) shared_.push_back(std::move(data));
    return static_cast<std::size_t>(place);
}

Result<void> LivePage::add(std::size_t number, const Drawing& drawing, const Image& expected,
                           float exposure) {
    const Interface& interface = interfaces_[number];
    const Permutation& permutation = composition_.permutations[number];
    Json objects = Json::array();
    Json controls = Json::array();
    for (const Object& object : scene_.objects) {
        ViewedObject view = viewed_from(scene_.view);
        view.model = object.model;
        std::vector<RenderValue> values = drawing.values;
        values.insert(values.end(), object.values.begin(), object.values.end());
        GOBO_TRY(const ResolvedUniforms resolved, resolve_uniforms(interface, values, view));
        Json blocks = Json::object();
        for (const Block& block : interface.blocks)
            blocks[block.name] = encoded(bytes_of(block, resolved.assignments));
        Json uniforms = Json::array();
        for (const Assignment& assignment : resolved.assignments) {
            const auto type = glsl_type(assignment.leaf.type);
            if (!type || assignment.numbers.empty()) continue;
            if (assignment.leaf.block.empty())
                uniforms.push_back({{"name", assignment.leaf.name},
                                    {"rows", type->rows},
                                    {"columns", type->columns},
                                    {"scalar", GlslType{type->scalar}.name()},
                                    {"numbers", assignment.numbers}});
            if (objects.empty() && !type->is_matrix())
                controls.push_back(control_json(assignment, *type, family_.domains));
        }
        Json attributes = Json::object();
        for (const Variable& input : interface.inputs) {
            auto [attribute, data] = attribute_of(input, object.mesh, values);
            if (!data.empty()) attribute["data"] = shared(std::move(data));
            attributes[input.name] = std::move(attribute);
        }
        objects.push_back({{"attributes", std::move(attributes)},
                           {"indices", shared(encoded(object.mesh.indices))},
                           {"blocks", std::move(blocks)},
                           {"uniforms", std::move(uniforms)}});
    }
    Json samplers = Json::object();
    for (const Sampler& sampler : interface.samplers) {
        auto [texture, data] = texture_of(sampler, drawing, scene_);
        if (data.empty())
            return fail(Fault::input, fmt::format("the live page has no texture for '{}' of type {}",
                                                  sampler.name, sampler.type));
        texture["data"] = shared(std::move(data));
        samplers[sampler.name] = std::move(texture);
    }
    Json values = Json::array();
    for (std::size_t i = 0; i < family_.features.size(); ++i)
        values.push_back(family_.features[i].values[static_cast<std::size_t>(permutation.key[i])]);
    permutations_[number] = Json{
        {"key", key_text(family_, permutation.key)},
        {"values", std::move(values)},
        {"vertex", permutation.stages[StageKind::vertex]},
        {"fragment", permutation.stages[StageKind::fragment]},
        {"exposure", exposure},
        {"expected", encoded(from_the_bottom(expected))},
        {"samplers", std::move(samplers)},
        {"controls", std::move(controls)},
        {"objects",
         std::move(objects)}}.dump();
    return {};
}

Result<std::string> LivePage::text(const FileSystem& shipped, double white_error) const {
    constexpr const char* kTemplate = "templates/gallery/live.html.in";
    GOBO_TRY(const std::string text, shipped.read(kTemplate));
    std::vector<std::string> permutations = permutations_;
    std::erase(permutations, "");
    Json stages = Json::array();
    for (const Stage& stage : composition_.stages) stages.push_back(source_of(composition_, stage));
    Json features = Json::array();
    for (const Feature& feature : family_.features) features.push_back(feature.name);
    const Json data = {{"family", family_.name},       {"width", scene_.view.width},
                       {"height", scene_.view.height}, {"background", scene_.view.background},
                       {"white_error", white_error},   {"features", std::move(features)},
                       {"stages", std::move(stages)}};
    std::string json = data.dump();
    json.back() = ',';  // what was written as JSON before is not read again
    json += fmt::format("\"shared\":{},\"permutations\":[{}]}}", Json(shared_).dump(),
                        fmt::join(permutations, ","));
    return fill({kTemplate, text}, {{"title", study::html_escaped(family_.name + ", live")},
                                    {"data", study::html_script(std::move(json))}});
}

}  // namespace gobo::gallery
