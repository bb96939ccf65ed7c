#include "lab/sanitize/input_space.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/numbers.hpp"
#include "core/text.hpp"
#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::sanitize {
namespace {

/// The domain of a stage's input or uniform: the family's where it declares one ("lights[]" is every
/// element); of built-in inputs what OpenGL gives; otherwise [-100, 100].
Domain range_of(const evaluate::Port& port, const std::vector<Domain>& domains) {
    const std::string name = without_subscripts(port.name);
    if (const Domain* declared = verify::domain_of(domains, port.name)) return *declared;
    if (port.scalar == evaluate::Scalar::boolean) return plain_domain(name, 0, 1);
    if (evaluate::is_unsigned(port.scalar)) return plain_domain(name, 0, 100);
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

/// The texels of each point.
evaluate::Image texels_of(const InputSpace& space, const InputField& field, const PointSet& points) {
    auto patterns = std::make_shared<std::vector<evaluate::TexelPattern>>(points.count);
    for (std::size_t i = 0; i < points.count; ++i) {
        const std::span<const double> numbers = points[i].subspan(field.first, field.components);
        evaluate::TexelPattern& pattern = (*patterns)[i];
        pattern.colors.resize(kTexelColors);
        for (std::size_t number = 0; number < 4 * kTexelColors; ++number)
            pattern.colors[number / 4][number % 4] = numbers[number];
        const auto last = numbers.last(3);
        pattern.seed = static_cast<int>(last[0]);
        pattern.side = static_cast<int>(last[1]);
        pattern.levels = static_cast<int>(last[2]);
    }
    return evaluate::PatternImage{std::move(patterns), space.pixels, field.type == "cube"};
}

/// What a texture's texels may hold: as stated, else what its kind of sampler gives of a usual format.
Domain texel_domain(const evaluate::ImagePort& image, const std::vector<Domain>& domains) {
    if (const Domain* declared = verify::domain_of(domains, image.name)) return *declared;
    if (image.type.depth || image.scalar == evaluate::Scalar::float32) return plain_domain(image.name, 0, 1);
    return plain_domain(image.name, image.scalar == evaluate::Scalar::uint32 ? 0 : -100, 100);
}

InputField texture_field(const evaluate::ImagePort& image, const std::vector<Domain>& domains) {
    InputField field;
    field.name = image.name;
    field.type = image.type.dimension == spv::DimCube ? "cube" : "vec4";
    field.scalar = image.scalar;
    field.is_texture = true;
    field.domain = texel_domain(image, domains);
    field.hard = hard_numbers(field.domain);
    field.components = kTextureNumbers;
    const auto declared = [&](const std::string& part) {
        return verify::domain_of(domains, image.name + part);
    };
    for (const char* channel : {".r", ".g", ".b", ".a"})
        field.channels.push_back(declared(channel) != nullptr ? *declared(channel) : field.domain);
    for (const char* extent : {".side", ".levels"})
        field.channels.push_back(declared(extent) != nullptr ? *declared(extent)
                                                             : plain_domain(image.name, 0, 0));
    return field;
}

/// The domain of a texture's number: of a channel, its seed, its side or its levels.
Domain domain_of_number(const InputField& texture, std::size_t number) {
    if (number < 4 * kTexelColors) return texture.channels[number % 4];
    if (number == 4 * kTexelColors) return plain_domain(texture.name, 0, 255);
    return texture.channels[number - 4 * kTexelColors + 3];
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

namespace {

/// What is stated of single components of a vector; nothing where nothing is.
std::vector<Domain> parts_of(const InputField& field, const std::vector<Domain>& domains,
                             const std::vector<Constraint>& constraints) {
    if (!field.has_named_components() || field.domain.of_length) return {};
    const std::string name = without_subscripts(field.name);
    std::vector<Domain> parts(field.ranged(), field.domain);
    bool is_stated = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (const Domain* const own = domain_of_component(domains, name, i)) {
            parts[i] = *own;
            is_stated = true;
        }
        is_stated |= narrow(parts[i], name, i, field.is_float(), constraints);
    }
    return is_stated ? parts : std::vector<Domain>();
}

}  // namespace

InputSpace input_space_of(const evaluate::Program& program, const std::vector<Domain>& domains,
                          bool in_quads) {
    InputSpace space;
    if (in_quads && evaluate::needs_quads(program)) space.pixels = 4;
    space.constraints = constraints_of(domains);
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            InputField field;
            field.name = port.name;
            field.type = port.type;
            field.scalar = port.scalar;
            field.domain = range_of(port, domains);
            if (!field.domain.of_length)
                narrow(field.domain, without_subscripts(port.name), {}, field.is_float(), space.constraints);
            field.hard = hard_numbers(field.domain);
            field.components = port.components;
            field.parts = parts_of(field, domains, space.constraints);
            const bool is_of_pixel = space.pixels > 1 && ports == &program.inputs && field.is_float();
            for (int pixel = 0; is_of_pixel && pixel < static_cast<int>(space.pixels); ++pixel) {
                field.pixel = pixel;
                add_field(space, field);
            }
            if (!is_of_pixel) add_field(space, std::move(field));
        }
    for (const evaluate::ImagePort& image : program.images) add_field(space, texture_field(image, domains));
    return space;
}

double drawn_texture_number(const InputField& field, std::size_t number, double hardness, Random& random) {
    const Domain domain = domain_of_number(field, number);
    if (domain.low == domain.high) return domain.low;
    const bool is_color = number < 4 * kTexelColors;
    const bool is_hard = random.unit() < hardness && is_color;
    const double drawn = is_hard ? random.pick(hard_numbers(domain)) : ordinary_number(domain, random);
    return is_color && field.is_float() ? nearest_float(drawn) : std::round(drawn);
}

void bring_into_domain(const InputField& field, std::span<double> all) {
    if (field.is_texture) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double allowed = nearest_allowed(domain_of_number(field, i), all[i]);
            const bool is_whole = i >= 4 * kTexelColors || !field.is_float();
            all[i] = is_whole ? std::round(allowed) : nearest_float(allowed);
        }
        return;
    }
    if (field.ranged() < all.size())
        all.back() = nearest_float(nearest_allowed(field.last_domain(), all.back()));
    const std::span<double> numbers = all.first(field.ranged());
    if (field.domain.of_length) {
        const double length = length_of(numbers);
        const double allowed = nearest_allowed(field.domain, length);
        if (length == 0 && allowed != 0) numbers[0] = allowed;
        for (double& number : numbers)
            number = length == 0 ? number : number * (allowed == length ? 1 : allowed / length);
    } else {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i] = nearest_allowed(field.domain_of(i), numbers[i]);
    }
    for (double& number : numbers) number = field.is_float() ? nearest_float(number) : std::round(number);
}

evaluate::Invocations invocations_of(const InputSpace& space, const PointSet& points) {
    evaluate::Invocations invocations;
    const std::size_t count = points.count * space.pixels;
    invocations.count = count;
    for (const InputField& field : space.fields) {
        if (field.is_texture) {
            invocations.images[field.name] = texels_of(space, field, points);
            continue;
        }
        std::vector<double>& values = invocations.values[field.name];
        values.resize(field.components * count);
        const auto first = static_cast<std::size_t>(std::max(field.pixel, 0));
        const std::size_t step = field.pixel < 0 ? 1 : space.pixels;
        for (std::size_t c = 0; c < field.components; ++c) {
            const double* from = points.values.data() + field.first + c;
            for (std::size_t i = first; i < count; i += step)
                values[c * count + i] = from[i / space.pixels * space.numbers];
        }
    }
    return invocations;
}

namespace {

/// What a file says of a texture.
void set_texture(const InputField& field, const evaluate::EvalPoint& point, std::span<double> numbers) {
    const auto given = [&](const std::string& part) -> const std::vector<double>* {
        const auto found = point.samplers.find(field.name + part);
        return found == point.samplers.end() || found->second.empty() ? nullptr : &found->second;
    };
    const std::vector<double>* const texels = given(".texels") != nullptr ? given(".texels") : given("");
    for (std::size_t i = 0; texels != nullptr && i < 4 * kTexelColors; ++i)
        numbers[i] = (*texels)[i % texels->size()];
    const std::span<double> last = numbers.last(3);
    if (const auto* seed = given(".seed")) last[0] = seed->front();
    if (const auto* side = given(".side")) last[1] = side->front();
    if (const auto* levels = given(".levels")) last[2] = levels->front();
}

}  // namespace

PointSet point_set(const InputSpace& space, const evaluate::EvalPoint& point) {
    PointSet points(space.numbers, 1);
    for (const InputField& field : space.fields) {
        const std::span<double> numbers = points[0].subspan(field.first, field.components);
        if (field.is_texture) {
            set_texture(field, point, numbers);
            continue;
        }
        for (const auto* values : {&point.inputs, &point.uniforms}) {
            const auto given = values->find(field.name);
            if (given == values->end()) continue;
            const std::size_t of_pixel =
                field.components * static_cast<std::size_t>(std::max(field.pixel, 0));
            const bool is_of_quad = given->second.size() >= of_pixel + field.components;
            std::copy_n(given->second.begin() + static_cast<std::ptrdiff_t>(is_of_quad ? of_pixel : 0),
                        std::min(given->second.size(), field.components), numbers.begin());
        }
    }
    return points;
}

}  // namespace gobo::sanitize
