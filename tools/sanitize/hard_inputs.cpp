#include "sanitize/hard_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "evaluate/images.hpp"
#include "sanitize/input_range.hpp"
#include "sanitize/random.hpp"

namespace gobo::sanitize {
namespace {

using Numbers = std::vector<double>;

double length_of(const Numbers& vector) {
    double square = 0;
    for (const double component : vector) square += component * component;
    return std::sqrt(square);
}

Numbers scaled(Numbers vector, double factor) {
    for (double& component : vector) component *= factor;
    return vector;
}

/// An input or uniform of the stage at the point being made.
struct Field {
    const evaluate::Port* port = nullptr;
    Domain domain;
    Numbers hard;
    Numbers value;

    [[nodiscard]] bool is_real() const { return port->scalar == evaluate::Scalar::real; }
    [[nodiscard]] bool is_vector() const {
        return is_real() && (port->type == "vec2" || port->type == "vec3" || port->type == "vec4");
    }
    [[nodiscard]] bool is_number() const { return is_real() && port->components == 1; }
};

class PointMaker {
  public:
    PointMaker(const evaluate::Program& program, const std::vector<Domain>& domains, std::uint64_t seed)
        : random_(seed) {
        for (const auto* ports : {&program.inputs, &program.uniforms})
            for (const evaluate::Port& port : *ports) {
                Field& field = fields_.emplace_back();
                field.port = &port;
                field.domain = range_of(port, domains);
                field.hard = hard_numbers(field.domain);
            }
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            if (fields_[i].is_vector()) vectors_.push_back(i);
            if (fields_[i].is_number()) numbers_.push_back(i);
        }
    }

    const std::vector<Field>& make() {
        hardness_ = random_.unit();
        for (Field& field : fields_) draw(field);
        for (std::size_t relations = random_.index(4); relations > 0; --relations) relate();
        return fields_;
    }

  private:
    double number(const Field& field) {
        const double drawn =
            random_.unit() < hardness_ ? random_.pick(field.hard) : ordinary_number(field.domain, random_);
        return field.is_real() ? drawn : std::round(drawn);
    }

    void draw(Field& field) {
        const std::size_t components = field.port->components;
        if (field.domain.of_length)
            field.value = scaled(hard_direction(components, random_), number(field));
        else if (components > 4)
            draw_matrix(field);
        else if (random_.one_in(16))
            field.value.assign(components, holds(field.domain, 0) ? 0.0 : number(field));
        else {
            field.value.clear();
            for (std::size_t i = 0; i < components; ++i) field.value.push_back(number(field));
        }
    }

    /// Any numbers, the identity, or one that maps a plane or everything to nothing.
    void draw_matrix(Field& field) {
        const std::size_t components = field.port->components;
        field.value.clear();
        for (std::size_t i = 0; i < components; ++i) field.value.push_back(number(field));
        const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(components)));
        const std::size_t kind = random_.index(4);
        if (rows * rows != components || kind == 0) return;
        for (std::size_t i = 0; i < components; ++i)
            if (kind != 3) field.value[i] = i / rows == i % rows ? 1 : 0;
        if (kind != 1) std::fill_n(field.value.begin(), rows, 0.0);
    }

    /// Brings two inputs into a relation.
    void relate() {
        if (numbers_.size() > 1 && (vectors_.size() < 2 || random_.one_in(3))) return relate_numbers();
        if (vectors_.size() < 2) return;
        Field& from = fields_[random_.pick(vectors_)];
        Field& to = fields_[random_.pick(vectors_)];
        if (&from == &to) return;
        if (random_.one_in(3)) return set_cosine(to, from);
        Numbers direction = from.value;
        direction.resize(to.value.size(), 0.0);
        if (random_.one_in(2)) direction = scaled(std::move(direction), -1);
        if (random_.one_in(3))
            for (double& component : direction) component *= 1 + random_.between(-1e-6, 1e-6);
        align(to, direction);
    }

    /// Equal where the domain lets it, otherwise along it.
    void align(Field& to, const Numbers& direction) {
        const double length = length_of(direction);
        if (to.domain.of_length) {
            if (length > 0) to.value = scaled(direction, length_of(to.value) / length);
            return;
        }
        const double factor =
            length > 0 && random_.one_in(2) ? std::abs(ordinary_number(to.domain, random_)) / length : 1;
        for (std::size_t i = 0; i < to.value.size(); ++i) {
            const double component = direction[i] * factor;
            if (holds(to.domain, component)) to.value[i] = component;
        }
    }

    /// `from` along z and `to` at a cosine k / n from it, or a rounding beside that; numbers of the right
    /// range take the cosine or versine, so that it is exactly an edge of theirs.
    void set_cosine(Field& to, Field& from) {
        const double bands = static_cast<double>(1 + random_.index(8));
        const double band = static_cast<double>(random_.index(static_cast<std::size_t>(bands) + 1));
        const double ulps = static_cast<double>(random_.index(3)) - 1;
        const double cosine = std::min(band / bands + ulps * 0x1p-24, 1.0);
        Numbers along(from.value.size(), 0.0);
        Numbers at(to.value.size(), 0.0);
        along[along.size() - 1 - (along.size() == 4 ? 1 : 0)] = 1;
        at[0] = std::sqrt(1 - cosine * cosine);
        at[at.size() - 1 - (at.size() == 4 ? 1 : 0)] = cosine;
        align(from, along);
        align(to, at);
        for (const std::size_t index : numbers_) {
            Field& field = fields_[index];
            const double edge = random_.one_in(2) ? cosine : 1 - cosine;
            if (field.domain.high <= 2 && holds(field.domain, edge) && random_.one_in(2))
                field.value[0] = edge;
        }
    }

    void relate_numbers() {
        const Field& from = fields_[random_.pick(numbers_)];
        Field& to = fields_[random_.pick(numbers_)];
        const double moved = from.value[0] * (1 + static_cast<double>(random_.index(3)) * 0x1p-23 - 0x1p-23);
        if (holds(to.domain, moved)) to.value[0] = moved;
    }

    Random random_;
    std::vector<Field> fields_;
    std::vector<std::size_t> vectors_;
    std::vector<std::size_t> numbers_;
    double hardness_ = 0;  ///< share of hard numbers at this point
};

/// Pixels of quads: neighbours differ by one.
void place_pixels(evaluate::Invocations& invocations) {
    const auto found = invocations.values.find("gl_FragCoord");
    if (found == invocations.values.end()) return;
    const std::size_t count = invocations.count;
    for (std::size_t i = 0; i < count; ++i) {
        found->second[i] = static_cast<double>(i / 4 % 32 * 2 + i % 2) + 0.5;
        found->second[count + i] = static_cast<double>(i / 128 % 32 * 2 + i / 2 % 2) + 0.5;
        found->second[3 * count + i] = 1;
    }
}

using Texel = std::array<double, 4>;

/// Textures hold hard values too. Each is of one colour, its own at every point: an input file can say that.
Texel draw_texel(Random& random) {
    Texel texel{};
    for (double& channel : texel)
        channel = random.one_in(2) ? static_cast<double>(random.index(2)) : random.index(257) / 256.0;
    return texel;
}

evaluate::Image one_colour_at_each_point(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    auto texels = std::make_shared<std::vector<Texel>>();
    for (std::size_t i = 0; i < count; ++i) texels->push_back(draw_texel(random));
    return [texels](const evaluate::ImageRequest& request) {
        return evaluate::answer((*texels)[request.invocation], request);
    };
}

}  // namespace

evaluate::Invocations hard_inputs(const evaluate::Program& program, const std::vector<Domain>& domains,
                                  std::size_t count, std::uint64_t seed) {
    PointMaker maker(program, domains, seed);
    evaluate::Invocations invocations;
    invocations.count = count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            invocations.values[port.name].resize(port.components * count);
    for (std::size_t i = 0; i < count; ++i)
        for (const Field& field : maker.make()) {
            std::vector<double>& values = invocations.values[field.port->name];
            for (std::size_t c = 0; c < field.value.size(); ++c)
                values[c * count + i] = static_cast<double>(static_cast<float>(field.value[c]));
        }
    place_pixels(invocations);
    for (const evaluate::ImagePort& image : program.images)
        invocations.images[image.name] = one_colour_at_each_point(count, ++seed);
    return invocations;
}

}  // namespace gobo::sanitize
