#include "lab/sanitize/input_space.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lab/evaluate/images.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::sanitize {
namespace {

Domain plain_domain(const std::string& name, double low, double high) {
    Domain domain;
    domain.name = name;
    domain.low = low;
    domain.high = high;
    return domain;
}

/// The domain of a stage's input or uniform: the family's where it declares one ("lights[]" is every
/// element); of built-in inputs what OpenGL gives; otherwise [-100, 100].
Domain range_of(const evaluate::Port& port, const std::vector<Domain>& domains) {
    const std::string name = verify::without_subscripts(port.name);
    if (const Domain* declared = verify::domain_of(domains, port.name)) return *declared;
    if (port.scalar == evaluate::Scalar::boolean) return plain_domain(name, 0, 1);
    if (port.scalar == evaluate::Scalar::uint32) return plain_domain(name, 0, 100);
    if (name == "gl_FragCoord" || name == "gl_PointCoord" || name == "gl_SamplePosition")
        return plain_domain(name, 0, 1);
    if (name.starts_with("gl_")) return plain_domain(name, 0, 100);
    return plain_domain(name, -100, 100);
}

constexpr double kAboveOne = 1.00000012;  // a float's neighbours of 1
constexpr double kBelowOne = 0.99999994;

void add_field(InputSpace& space, InputField field) {
    field.first = space.numbers;
    space.numbers += field.components;
    space.field_of.insert(space.field_of.end(), field.components, space.fields.size());
    if (field.is_vector() && !field.is_texture) space.vectors.push_back(space.fields.size());
    if (field.is_number()) space.floats.push_back(space.fields.size());
    space.fields.push_back(std::move(field));
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
    auto texels = std::make_shared<std::vector<Texel>>(points.count);
    for (std::size_t i = 0; i < texels->size(); ++i)
        std::copy_n(points[i].begin() + static_cast<std::ptrdiff_t>(first), 4, (*texels)[i].begin());
    return [texels](const evaluate::ImageRequest& request) {
        return evaluate::answer((*texels)[request.invocation], request);
    };
}

}  // namespace

double length_of(std::span<const double> vector) {
    double square = 0;
    for (const double component : vector) square += component * component;
    return std::sqrt(square);
}

bool holds(const Domain& domain, double number) {
    return (number >= domain.low && number <= domain.high) ||
           std::find(domain.also.begin(), domain.also.end(), number) != domain.also.end();
}

std::vector<double> hard_numbers(const Domain& domain) {
    std::vector<double> numbers;
    for (const double size : {kSmallest, 0.25, 0.5, 0.75, kBelowOne, 1.0, kAboveOne, 2.0, 1e3})
        for (const double number : {size, -size})
            if (holds(domain, number)) numbers.push_back(number);
    numbers.insert(numbers.end(), {domain.low, domain.high});
    numbers.insert(numbers.end(), domain.also.begin(), domain.also.end());
    if (holds(domain, 0)) numbers.insert(numbers.end(), {0, 0, 0});  // the hardest of all
    return numbers;
}

double ordinary_number(const Domain& domain, Random& random) {
    if (random.one_in(2)) return random.between(domain.low, domain.high);
    const double largest = std::max(std::abs(domain.low), std::abs(domain.high));
    const double smallest = domain.low > 0 ? domain.low : std::min(kSmallest, largest);
    if (smallest <= 0) return domain.low;
    const double size = smallest * std::pow(largest / smallest, random.unit());
    const double number = domain.low < 0 && random.one_in(2) ? -size : size;
    return std::clamp(number, domain.low, domain.high);
}

bool InputField::is_vector() const {
    return is_float() && (type == "vec2" || type == "vec3" || type == "vec4");
}

Domain InputField::last_domain() const {
    return plain_domain(name, domain.last.at(0), domain.last.at(1));
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
    for (const evaluate::ImagePort& image : program.images) {
        InputField field;
        field.name = image.name;
        field.type = "vec4";
        field.is_texture = true;
        field.domain = plain_domain(image.name, 0, 1);
        field.hard = {0, 1};
        field.components = 4;
        add_field(space, std::move(field));
    }
    return space;
}

void bring_into_domain(const InputField& field, std::span<double> all) {
    if (field.ranged() < all.size())
        all.back() =
            static_cast<double>(static_cast<float>(nearest_allowed(field.last_domain(), all.back())));
    const std::span<double> numbers = all.first(field.ranged());
    if (field.domain.of_length) {
        const double length = length_of(numbers);
        const double allowed = nearest_allowed(field.domain, length);
        if (length == 0 && allowed != 0) numbers[0] = allowed;
        for (double& number : numbers)
            number = length == 0 ? number : number * (allowed == length ? 1 : allowed / length);
    } else {
        for (double& number : numbers) number = nearest_allowed(field.domain, number);
    }
    for (double& number : numbers)
        number = field.is_float() ? static_cast<double>(static_cast<float>(number)) : std::round(number);
}

evaluate::Invocations invocations_of(const InputSpace& space, const PointSet& points) {
    evaluate::Invocations invocations;
    const std::size_t count = points.count;
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

PointSet point_set(const InputSpace& space, const evaluate::EvalPoint& point) {
    PointSet points(space.numbers, 1);
    for (const InputField& field : space.fields)
        for (const auto* values : {&point.inputs, &point.uniforms, &point.samplers})
            if (const auto given = values->find(field.name); given != values->end())
                std::copy_n(given->second.begin(), std::min(given->second.size(), field.components),
                            points[0].begin() + static_cast<std::ptrdiff_t>(field.first));
    return points;
}

}  // namespace gobo::sanitize
