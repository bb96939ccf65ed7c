#include "lab/sanitize/input_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "lab/evaluate/images.hpp"
#include "lab/sanitize/input_range.hpp"

namespace gobo::sanitize {
namespace {

void add_field(InputSpace& space, InputField field) {
    field.first = space.numbers;
    space.numbers += field.components;
    if (field.is_vector() && !field.is_texture) space.vectors.push_back(space.fields.size());
    if (field.is_number()) space.reals.push_back(space.fields.size());
    space.fields.push_back(std::move(field));
}

InputField texture_field(const std::string& name) {
    InputField field;
    field.name = name;
    field.type = "vec4";
    field.is_texture = true;
    field.components = 4;
    field.domain.name = name;
    field.domain.high = 1;
    field.hard = {0, 1};
    return field;
}

double nearest_allowed(const Domain& domain, double number) {
    if (holds(domain, number) && std::abs(number) >= kSmallest) return number;
    double nearest = std::clamp(number, domain.low, domain.high);
    if (std::abs(nearest) < kSmallest && nearest != domain.low && nearest != domain.high) nearest = 0;
    for (const double also : domain.also)
        if (std::abs(also - number) < std::abs(nearest - number)) nearest = also;
    return nearest;
}

/// The colour of each point, whatever is asked; sizes and levels are those of a small texture.
evaluate::Image one_colour_at_each_point(std::size_t first, const PointSet& points) {
    using Texel = std::array<double, 4>;
    auto texels = std::make_shared<std::vector<Texel>>(points.count());
    for (std::size_t i = 0; i < texels->size(); ++i)
        std::copy_n(points[i].begin() + static_cast<std::ptrdiff_t>(first), 4, (*texels)[i].begin());
    return [texels](const evaluate::ImageRequest& request) {
        return evaluate::answer((*texels)[request.invocation], request);
    };
}

}  // namespace

bool InputField::is_vector() const {
    return is_real() && (type == "vec2" || type == "vec3" || type == "vec4");
}

Domain InputField::last_domain() const {
    Domain last;
    last.name = name;
    last.low = domain.last.at(0);
    last.high = domain.last.at(1);
    return last;
}

InputSpace input_space_of(const evaluate::Program& program, const std::vector<Domain>& domains) {
    InputSpace space;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            InputField field;
            field.name = port.name;
            field.type = port.type;
            field.scalar = port.scalar;
            field.domain = range_of(port, domains);
            field.hard = hard_numbers(field.domain);
            field.components = port.components;
            add_field(space, std::move(field));
        }
    for (const evaluate::ImagePort& image : program.images) add_field(space, texture_field(image.name));
    return space;
}

void bring_into_domain(const InputField& field, std::span<double> all) {
    if (field.ranged() < all.size())
        all.back() =
            static_cast<double>(static_cast<float>(nearest_allowed(field.last_domain(), all.back())));
    const std::span<double> numbers = all.first(field.ranged());
    if (field.domain.of_length) {
        double square = 0;
        for (const double number : numbers) square += number * number;
        const double length = std::sqrt(square);
        const double allowed = nearest_allowed(field.domain, length);
        if (length == 0 && allowed != 0) numbers[0] = allowed;
        for (double& number : numbers)
            number = length == 0 ? number : number * (allowed == length ? 1 : allowed / length);
    } else {
        for (double& number : numbers) number = nearest_allowed(field.domain, number);
    }
    for (double& number : numbers)
        number = field.is_real() ? static_cast<double>(static_cast<float>(number)) : std::round(number);
}

evaluate::Invocations invocations_of(const InputSpace& space, const PointSet& points) {
    evaluate::Invocations invocations;
    const std::size_t count = points.count();
    invocations.count = count;
    for (const InputField& field : space.fields) {
        if (field.is_texture) {
            invocations.images[field.name] = one_colour_at_each_point(field.first, points);
            continue;
        }
        std::vector<double>& values = invocations.values[field.name];
        values.resize(field.components * count);
        for (std::size_t c = 0; c < field.components; ++c) {
            const double* from = points.values.data() + field.first + c;
            for (std::size_t i = 0; i < count; ++i) values[c * count + i] = from[i * space.numbers];
        }
    }
    return invocations;
}

std::vector<double> flat_point(const InputSpace& space, const evaluate::Invocations& invocations,
                               std::size_t index) {
    std::vector<double> point(space.numbers);
    evaluate::ImageRequest request;
    request.invocation = index;
    for (const InputField& field : space.fields) {
        if (field.is_texture) {
            const auto given = invocations.images.find(field.name);
            if (given == invocations.images.end()) continue;
            const std::array<double, 4> texel = given->second(request);
            std::copy(texel.begin(), texel.end(), point.begin() + static_cast<std::ptrdiff_t>(field.first));
            continue;
        }
        const auto given = invocations.values.find(field.name);
        if (given == invocations.values.end()) continue;
        const bool is_common = given->second.size() == field.components;
        for (std::size_t c = 0; c < field.components; ++c)
            point[field.first + c] = given->second[is_common ? c : c * invocations.count + index];
    }
    return point;
}

}  // namespace gobo::sanitize
