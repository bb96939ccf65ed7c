#include "lab/render/chosen_values.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/render/texture.hpp"

namespace gobo {

Result<ChosenAttribute> chosen_attribute(const std::string& name, const Mesh& mesh,
                                         const std::vector<RenderValue>& values) {
    const RenderValue* value = find_value(values, name);
    const std::string source(value != nullptr ? value->source : attribute_source_of(name));
    if (value != nullptr && source.empty()) {
        ChosenAttribute numbers{{4, {0, 0, 0, 1}, {}}};
        for (std::size_t i = 0; i < std::min<std::size_t>(value->numbers.size(), 4); ++i)
            numbers.values.floats[i] = static_cast<float>(value->numbers[i]);
        return numbers;
    }
    if (auto own = attribute_values(mesh, source)) return ChosenAttribute{*std::move(own), false};
    if (source == "color") return ChosenAttribute{{4, {1, 1, 1, 1}, {}}};
    if (value != nullptr) return unknown_source(*value, attribute_sources());
    return ChosenAttribute{{4, {0, 0, 0, 0}, {}},
                           true,
                           no_value(fmt::format("the attribute '{}' has no value and stays 0", name))};
}

bool writes_color(const Interface& interface) {
    return std::ranges::count(interface.stages, name_of(StageKind::fragment)) == 0 ||
           std::ranges::any_of(interface.outputs,
                               [](const Variable& output) { return output.location <= 0; });
}

Result<void> check_textures(const Interface& interface, const std::vector<RenderValue>& values) {
    const std::vector<std::string>& known = texture_sources();
    for (const Sampler& sampler : interface.samplers) {
        const RenderValue* value = find_value(values, sampler.name);
        if (value != nullptr && !value->source.empty() &&
            std::find(known.begin(), known.end(), value->source) == known.end())
            return unknown_source(*value, known);
    }
    return {};
}

}  // namespace gobo
