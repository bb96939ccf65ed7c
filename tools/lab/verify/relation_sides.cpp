#include "lab/verify/relation_sides.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/text.hpp"
#include "lab/raster/random.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::verify {
namespace {

using Values = std::vector<double>;

/// The element of that array; nothing for other names.
std::optional<ElementName> element_of(const std::string& name, const std::string& array) {
    auto element = element_name(name);
    if (element && element->array != array) element.reset();
    return element;
}

std::size_t elements_of(const std::string& array, const std::vector<evaluate::Port>& ports) {
    std::size_t count = 0;
    for (const evaluate::Port& port : ports)
        if (const auto element = element_of(port.name, array)) count = std::max(count, element->index + 1);
    return count;
}

std::string name_of(const std::string& array, std::size_t index, std::string_view member) {
    return fmt::format("{}[{}]{}", array, index, member);
}

/// Each element takes the place of the one before it.
std::optional<Sides> reordered(const std::string& array, const std::vector<evaluate::Port>& ports,
                               const evaluate::Invocations& points) {
    const std::size_t count = elements_of(array, ports);
    if (count < 2) return std::nullopt;
    Sides sides{points, points};
    for (const evaluate::Port& port : ports)
        if (const auto element = element_of(port.name, array))
            sides.other.values[port.name] =
                points.values.at(name_of(array, (element->index + 1) % count, element->rest));
    return sides;
}

/// The values of the invocation after each: any others, as far as they are concerned.
Values of_others(const Values& values, std::size_t count) {
    Values others(values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
        others[k] = values[k / count * count + (k % count + 1) % count];
    return others;
}

/// `member` of the elements adds up. Two elements that are the same but for it, against one with the sum and
/// another one that has none of it; a single one with none, against another one with none.
std::optional<Sides> added_up(const std::string& name, const std::vector<evaluate::Port>& ports,
                              const evaluate::Invocations& points) {
    const auto brackets = name.find("[]");
    const std::string array = name.substr(0, brackets);
    const std::string member = name.substr(brackets + 2);
    const std::size_t count = elements_of(array, ports);
    if (count == 0 || !points.values.contains(name_of(array, 0, member))) return std::nullopt;
    const std::size_t last = count - 1;
    Sides sides{points, points};
    for (const evaluate::Port& port : ports) {
        const auto element = element_of(port.name, array);
        if (!element || element->index != last) continue;
        Values& one = sides.one.values[port.name];
        Values& other = sides.other.values[port.name];
        if (element->rest == member) {
            std::fill(other.begin(), other.end(), 0);
            if (count == 1) std::fill(one.begin(), one.end(), 0);
        } else if (count == 1) {
            other = of_others(one, points.count);
        } else {
            one = points.values.at(name_of(array, 0, element->rest));
        }
    }
    if (count > 1) {
        Values& sum = sides.other.values[name_of(array, 0, member)];
        const Values& more = points.values.at(name_of(array, last, member));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
    }
    return sides;
}

/// Turns the columns of a vector or matrix, or with `by_row` its rows, as of a matrix that leads out of the
/// space that is turned: times the inverse rotation. False for what is neither of three nor of four
/// dimensions.
bool turn(Values& values, std::uint32_t components, std::size_t count, const glm::dmat3& rotation,
          bool by_row) {
    const std::uint32_t rows = components == 16 || components == 4 ? 4 : 3;
    if (components % rows != 0 || components < 3 || (by_row && components != rows * rows)) return false;
    for (std::uint32_t first = 0; first < components / rows; ++first)
        for (std::size_t i = 0; i < count; ++i) {
            const auto at = [&](std::uint32_t c) -> double& {
                return values[(by_row ? c * rows + first : first * rows + c) * count + i];
            };
            const glm::dvec3 turned = rotation * glm::dvec3(at(0), at(1), at(2));
            for (std::uint32_t c = 0; c < 3; ++c) at(c) = turned[static_cast<int>(c)];
        }
    return true;
}

bool names(const std::vector<std::string>& list, const std::string& port) {
    return std::any_of(list.begin(), list.end(), [name = without_subscripts(port)](const std::string& one) {
        return without_subscripts(one) == name;
    });
}

std::optional<Sides> turned(const Relation& relation, const std::vector<evaluate::Port>& ports,
                            const evaluate::Invocations& points, std::uint64_t seed) {
    Random random(seed);
    const glm::dmat3 rotation(random.rotation(0.3, 2.8));
    Sides sides{points, points};
    bool is_there = false;
    for (const evaluate::Port& port : ports) {
        const auto found = sides.other.values.find(port.name);
        if (found == sides.other.values.end()) continue;
        Values& values = found->second;
        if (names(relation.names, port.name))
            is_there |= turn(values, port.components, points.count, rotation, false);
        else if (names(relation.turned_back, port.name))
            is_there |= turn(values, port.components, points.count, rotation, true);
    }
    if (!is_there) return std::nullopt;
    return sides;
}

/// Whether a name is the port's where each `[]` of it stands for any element.
bool stands_for(std::string_view name, std::string_view port) {
    while (true) {
        const std::size_t any = std::min(name.find("[]"), name.size());
        if (name.substr(0, any) != port.substr(0, any)) return false;
        port.remove_prefix(any);
        if (any == name.size()) return port.empty();
        if (!port.starts_with('[')) return false;
        name.remove_prefix(any + 2);
        port.remove_prefix(std::min(port.find(']'), port.size() - 1) + 1);
    }
}

/// The value that turns an effect off, wherever the name stands for: with `[]` the last element of `count`,
/// or every element where that is 0.
std::optional<Sides> turned_off(const Relation& relation, const std::vector<evaluate::Port>& ports, int count,
                                const evaluate::Invocations& points) {
    Sides sides{points, points};
    for (const RenderValue& value : relation.at) {
        const auto brackets = value.name.find("[]");
        std::string name = value.name;
        if (count > 0 && brackets != std::string::npos)
            name.replace(brackets, 2, fmt::format("[{}]", count - 1));
        for (const evaluate::Port& port : ports) {
            if (!stands_for(name, port.name)) continue;
            Values& values = sides.one.values[port.name];
            for (std::size_t c = 0; c < port.components; ++c)
                std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(c * points.count), points.count,
                            value.numbers[std::min(c, value.numbers.size() - 1)]);
        }
    }
    sides.other = sides.one;
    return sides;
}

}  // namespace

std::optional<Sides> sides_of(const Relation& relation, const std::vector<evaluate::Port>& ports, int count,
                              const evaluate::Invocations& points, std::uint64_t seed) {
    switch (relation.kind) {
        case Relation::Kind::any_order:
            return reordered(relation.names.front(), ports, points);
        case Relation::Kind::adds:
            return added_up(relation.names.front(), ports, points);
        case Relation::Kind::turn:
            return turned(relation, ports, points, seed);
        case Relation::Kind::off:
            return turned_off(relation, ports, count, points);
        case Relation::Kind::finer:
            break;
    }
    return std::nullopt;
}

}  // namespace gobo::verify
