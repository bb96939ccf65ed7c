#include "scene/scene_domains.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::scene {
namespace {

/// The shortest decimal that is the same float: 0.1, not 0.10000000149.
double as_float_reads(double number) {
    return number_from<double>(fmt::format("{}", static_cast<float>(number))).value_or(number);
}

/// The numbers that the draws have for one name.
struct Held {
    std::vector<double> numbers;
    std::vector<double> beside;  ///< of draws that it does nothing to
};

void add_once(std::vector<double>& numbers, double number) {
    if (std::ranges::find(numbers, number) == numbers.end()) numbers.push_back(number);
}

/// A material without a highlight has a shininess all the same.
bool does_nothing(const std::string& name, const Material& material) {
    return name == "Material.shininess" && material.specular == glm::dvec3(0);
}

}  // namespace

std::vector<Domain> domains_of_scene(const Scene& scene, const std::vector<Draw>& draws,
                                     const std::vector<Domain>& of_family) {
    std::map<std::string, Held> all;
    for (const Draw& draw : draws) {
        if (!draw.excluded.empty()) continue;
        const Material& material = material_of(scene, draw);
        for (const RenderValue& value : values_of_draw(scene, draw)) {
            if (!value.source.empty()) continue;
            const std::string name = without_subscripts(value.name);
            Held& held = all[name];
            for (const double number : value.numbers)
                (does_nothing(name, material) ? held.beside : held.numbers).push_back(as_float_reads(number));
        }
    }
    std::vector<Domain> domains;
    for (const Domain& own : of_family) {
        const auto found = all.find(own.name);
        if (found == all.end() || own.of_length || !own.last.empty()) continue;
        Domain domain;
        domain.name = own.name;
        domain.place.file = scene.path;
        for (const double number : found->second.beside) add_once(domain.also, number);
        std::optional<Interval> range;
        for (const double number : found->second.numbers) {
            if (std::ranges::find(own.also, number) != own.also.end())
                add_once(domain.also, number);
            else if (range)
                range->add(number);
            else
                range = Interval{number, number};
        }
        if (!range && domain.also.empty()) continue;
        if (!range) {  // all are allowed besides it
            range = Interval{domain.also.front(), domain.also.front()};
            domain.also.erase(domain.also.begin());
        }
        domain.low = range->low;
        domain.high = range->high;
        domains.push_back(std::move(domain));
    }
    return domains;
}

}  // namespace gobo::scene
