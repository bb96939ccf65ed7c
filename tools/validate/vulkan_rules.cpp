#include "validate/vulkan_rules.hpp"

#include <map>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "spirv/vertex_locations.hpp"
#include "validate/declaration.hpp"

namespace gobo {
namespace {

void check_samplers(const Interface& interface, const std::vector<const Piece*>& pieces, Diagnostics& found) {
    for (const Sampler& sampler : interface.samplers) {
        const Declaration at = declaration_of(sampler.name, sampler.type, pieces);
        const std::size_t rectangle = sampler.type.find("2DRect");
        if (rectangle != std::string::npos) {
            const bool is_image = sampler.type.find("image") != std::string::npos;
            const std::string flat = std::string(sampler.type).erase(rectangle + 2, 4);
            found.push_back(diagnostic_at(
                at, Severity::error, fmt::format("Vulkan 1.0 has no {}", sampler.type),
                is_image ? fmt::format("make it {}: its coordinates are texels, too", flat)
                         : fmt::format("make it {}, and look up at the coordinates divided by textureSize()",
                                       flat)));
        }
        if (sampler.array.size() > 1)
            found.push_back(diagnostic_at(
                at, Severity::error,
                fmt::format("'{}' is an array of arrays, which Vulkan 1.0 cannot bind", sampler.name),
                "make it an array of one dimension: [2 * i + j] for [i][j]"));
    }
}

void check_inputs(const Interface& interface, const std::vector<const Piece*>& pieces, Diagnostics& found) {
    std::map<int, const Variable*> taken;  // by location
    for (const Variable& input : interface.inputs) {
        if (input.location < 0) continue;
        const GlslType type = glsl_type(input.type).value_or(GlslType{});
        const int count = location_count(input.type, input.array) * vulkan_locations_of_column(type);
        for (int location = input.location; location < input.location + count; ++location) {
            const auto [at, is_new] = taken.try_emplace(location, &input);
            const Variable& other = *at->second;
            if (is_new || &other == &input) continue;
            const bool is_apart = input.component != other.component;
            found.push_back(diagnostic_at(
                declaration_of(input.name, input.type, pieces), Severity::error,
                fmt::format("the vertex inputs '{}' and '{}' ({}) share location {}: Vulkan reads one "
                            "attribute for each location",
                            input.name, other.name, declaration_of(other.name, other.type, pieces).text(),
                            location),
                is_apart ? "make them one input, such as a vec4, and take its components"
                         : "count on behind it: a column of three or four doubles takes two locations, a "
                           "matrix as many as its columns together, an array as its elements"));
            break;
        }
    }
}

}  // namespace

Diagnostics check_vulkan(StageKind kind, const Interface& interface,
                         const std::vector<const Piece*>& pieces) {
    Diagnostics found;
    check_samplers(interface, pieces, found);
    if (kind == StageKind::vertex) check_inputs(interface, pieces, found);
    return found;
}

}  // namespace gobo
