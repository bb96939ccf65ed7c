#include "lab/sanitize/hard_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.hpp"

namespace gobo::sanitize {
namespace {

// Fixed-size room for the values of a vector field, so that drawing points allocates nothing.
using Vector = std::array<double, 4>;

/// Fills in a unit vector: along an axis, a diagonal, nearly along an axis, or any.
void hard_direction(std::span<double> direction, Random& random) {
    const std::size_t components = direction.size();
    std::fill(direction.begin(), direction.end(), 0.0);
    switch (random.index(4)) {
        case 0:
            direction[random.index(components)] = random.one_in(2) ? 1 : -1;
            break;
        case 1:
            for (double& component : direction) component = random.one_in(2) ? 1 : -1;
            break;
        case 2:
            for (double& component : direction) component = random.between(-1e-6, 1e-6);
            direction[random.index(components)] = random.one_in(2) ? 1 : -1;
            break;
        default:
            for (double& component : direction) component = random.between(-1, 1);
            break;
    }
    const double length = length_of(direction);
    for (double& component : direction) component /= length;
}

/// Draws points into the place that it is given.
class PointMaker {
  public:
    PointMaker(const InputSpace& space, std::uint64_t seed)
        : space_(space), random_(seed), random_of_bounds_(~seed) {}

    void make(std::span<double> point) {
        point_ = point;
        hardness_ = random_.unit();
        for (const InputField& field : space_.fields) draw(field);
        if (space_.pixels > 1 && random_.one_in(2)) share_in_quad();
        for (std::size_t relations = random_.index(4); relations > 0; --relations) relate();
        if (random_of_bounds_.one_in(32)) bring_to_bounds();
        for (const InputField& field : space_.fields)
            if (field.is_float())
                for (double& number : value(field)) number = nearest_float(number);
    }

  private:
    /// Whole inputs at a bound, most at the upper one: sums over many numbers are largest there.
    void bring_to_bounds() {
        for (const InputField& field : space_.fields) {
            if (field.is_texture || field.is_pixel_place() || field.domain.of_length) continue;
            const bool is_low = random_of_bounds_.one_in(4);
            for (std::size_t i = 0; i < field.ranged(); ++i) {
                const Domain& domain = field.domain_of(i);
                value(field)[i] = is_low ? domain.low : domain.high;
            }
        }
    }

    /// Some inputs are the same in all pixels, or nearly so, as they are where pictures change little.
    void share_in_quad() {
        const InputField* first = nullptr;
        double change = 0;
        bool is_shared = false;
        for (const InputField& field : space_.fields) {
            if (field.pixel == 0) {
                first = &field;
                is_shared = random_.one_in(2);
                change = random_.one_in(2) ? 0 : std::exp2(random_.between(-24, 0));
            } else if (field.pixel > 0 && is_shared) {
                for (std::size_t i = 0; i < field.components; ++i)
                    value(field)[i] = value(*first)[i] * (1 + change * random_.between(-1, 1));
                bring_into_domain(field, value(field));
            }
        }
    }

    [[nodiscard]] std::span<double> value(const InputField& field) const {
        return point_.subspan(field.first, field.components);
    }

    double number(const InputField& field, std::size_t component = 0) {
        const bool is_hard = random_.unit() < hardness_;
        const double drawn = !is_hard              ? ordinary_number(field.domain_of(component), random_)
                             : field.parts.empty() ? random_.pick(field.hard)
                                                   : random_.pick(hard_numbers(field.parts[component]));
        return field.is_float() ? drawn : std::round(drawn);
    }

    void draw(const InputField& field) {
        if (field.is_texture) {
            for (std::size_t i = 0; i < field.components; ++i)
                value(field)[i] = drawn_texture_number(field, i, hardness_, random_);
            make_grey(field);
            return;
        }
        const std::span<double> numbers = value(field).first(field.ranged());
        if (field.ranged() < field.components) draw_last(field);
        if (field.domain.of_length) {
            hard_direction(numbers, random_);
            const double length = number(field);
            for (double& component : numbers) component *= length;
        } else if (field.components > 4) {
            draw_matrix(field);
        } else if (field.parts.empty() && random_.one_in(16)) {
            std::fill(numbers.begin(), numbers.end(), holds(field.domain, 0) ? 0.0 : number(field));
        } else {
            for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = number(field, i);
        }
    }

    /// Some texels hold one number in all their channels.
    void make_grey(const InputField& texture) {
        const std::span<double> numbers = value(texture);
        for (std::size_t color = 0; color < 4 * kTexelColors; color += 4) {
            if (!random_.one_in(4)) continue;
            for (std::size_t channel = 1; channel < 4; ++channel)
                if (holds(texture.channels[channel], numbers[color]))
                    numbers[color + channel] = numbers[color];
        }
    }

    void draw_last(const InputField& field) {
        const Domain last = field.last_domain();
        value(field).back() =
            random_.unit() < hardness_ ? random_.pick(hard_numbers(last)) : ordinary_number(last, random_);
    }

    /// Any numbers, the identity, or one that maps a plane or everything to nothing.
    void draw_matrix(const InputField& field) {
        const std::size_t components = field.components;
        const std::span<double> numbers = value(field);
        for (double& component : numbers) component = number(field);
        const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(components)));
        const std::size_t kind = random_.index(4);
        if (rows * rows != components || kind == 0) return;
        for (std::size_t i = 0; i < components; ++i)
            if (kind != 3) numbers[i] = i / rows == i % rows ? 1 : 0;
        if (kind != 1) std::fill_n(numbers.begin(), rows, 0.0);
        bring_into_domain(field, numbers);  // it may hold neither 0 nor 1
    }

    /// Brings two inputs into a relation.
    void relate() {
        if (space_.floats.size() > 1 && (space_.vectors.size() < 2 || random_.one_in(3)))
            return relate_numbers();
        if (space_.vectors.size() < 2) return;
        const InputField& from = space_.fields[random_.pick(space_.vectors)];
        const InputField& to = space_.fields[random_.pick(space_.vectors)];
        if (&from == &to) return;
        if (random_.one_in(3)) return random_.one_in(3) ? set_reflection(to, from) : set_cosine(to, from);
        Vector direction{};
        std::copy(value(from).begin(), value(from).end(), direction.begin());
        if (random_.one_in(2))
            for (double& component : direction) component *= -1;
        if (random_.one_in(3))
            for (double& component : direction) component *= 1 + random_.between(-1e-6, 1e-6);
        align(to, std::span(direction).first(to.components));
    }

    /// Equal where the domain lets it, otherwise along it.
    void align(const InputField& to, std::span<const double> whole) {
        const std::span<const double> direction =
            whole.first(to.ranged());  // a last quantity keeps its value
        const double length = length_of(direction);
        const std::span<double> numbers = value(to).first(to.ranged());
        if (to.domain.of_length) {
            const double factor = length > 0 ? length_of(numbers) / length : 0;
            for (std::size_t i = 0; i < numbers.size() && length > 0; ++i) numbers[i] = direction[i] * factor;
            return;
        }
        const double factor =
            length > 0 && random_.one_in(2) ? std::abs(ordinary_number(to.domain, random_)) / length : 1;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const double component = direction[i] * factor;
            if (holds(to.domain_of(i), component)) numbers[i] = component;
        }
    }

    /// `from` along z and `to` at a cosine k / n from it, or a rounding beside that; numbers of the right
    /// range take the cosine or one minus cosine, so that it is exactly an edge of theirs.
    void set_cosine(const InputField& to, const InputField& from) {
        const double bands = static_cast<double>(1 + random_.index(8));
        const double band = static_cast<double>(random_.index(static_cast<std::size_t>(bands) + 1));
        const double ulps = static_cast<double>(random_.index(3)) - 1;
        const double cosine = std::min(band / bands + ulps * 0x1p-24, 1.0);
        const auto last = [](const InputField& field) {
            return std::min<std::size_t>(field.components, 3) - 1;
        };
        Vector along{};
        Vector at{};
        along[last(from)] = 1;
        at[0] = std::sqrt(1 - cosine * cosine);
        at[last(to)] = cosine;
        align(from, std::span(along).first(from.components));
        align(to, std::span(at).first(to.components));
        for (const std::size_t index : space_.floats) {
            const InputField& field = space_.fields[index];
            const double edge = random_.one_in(2) ? cosine : 1 - cosine;
            if (field.domain.high <= 2 && holds(field.domain, edge) && random_.one_in(2))
                value(field)[0] = edge;
        }
    }

    /// `to` halfway between `from` and an axis: each mirrors the other about it, and their components along
    /// the axis come out as 1, or a rounding above.
    void set_reflection(const InputField& to, const InputField& from) {
        const std::size_t components = std::min(from.ranged(), to.ranged());
        const std::span<const double> numbers = value(from).first(components);
        const double length = length_of(numbers);
        Vector halfway{};
        for (std::size_t i = 0; i < components && length > 0; ++i) halfway[i] = numbers[i] / length;
        halfway[random_.index(components)] += random_.one_in(2) ? 1 : -1;
        align(to, std::span(halfway).first(to.components));
    }

    void relate_numbers() {
        const InputField& from = space_.fields[random_.pick(space_.floats)];
        const InputField& to = space_.fields[random_.pick(space_.floats)];
        const double ulps = static_cast<double>(random_.index(3)) - 1;
        const double moved = value(from)[0] * (1 + ulps * 0x1p-23);
        if (holds(to.domain, moved)) value(to)[0] = moved;
    }

    const InputSpace& space_;
    Random random_;
    Random random_of_bounds_;  ///< its own, so that the other points are the same without it
    std::span<double> point_;  ///< being made
    double hardness_ = 0;      ///< share of hard numbers at this point
};

/// Pixels of quads: neighbours differ by one.
void place_pixels(const InputField& field, PointSet& points) {
    for (std::size_t i = 0; i < points.count; ++i) {
        const std::span<double> coordinate = points[i].subspan(field.first, field.components);
        const std::size_t pixel = field.pixel < 0 ? i : i * 4 + static_cast<std::size_t>(field.pixel);
        coordinate[0] = static_cast<double>(pixel / 4 % 32 * 2 + pixel % 2) + 0.5;
        coordinate[1] = static_cast<double>(pixel / 128 % 32 * 2 + pixel / 2 % 2) + 0.5;
        coordinate[3] = 1;
    }
}

double changed_number(std::span<const double> point, const InputField& field, double number, Random& random) {
    const double sign = random.one_in(2) ? 1 : -1;
    switch (random.index(8)) {
        case 0:
            return random.pick(field.hard);
        case 1:
            return ordinary_number(field.domain, random);
        case 2:  // a few roundings away
            return number * (1 + sign * static_cast<double>(1 + random.index(3)) * 0x1p-23);
        case 3:  // some other number of the point
            return sign * point[random.index(point.size())];
        case 4:
            return number + sign * (field.domain.high - field.domain.low) * std::exp2(random.between(-30, 0));
        case 5:
            return -number;
        default:
            return number + sign * std::max(std::abs(number), 1.0) * std::exp2(random.between(-24, 1));
    }
}

}  // namespace

PointSet hard_points(const InputSpace& space, std::size_t count, std::uint64_t seed) {
    PointMaker maker(space, seed);
    PointSet points(space.numbers, count);
    for (std::size_t i = 0; i < count; ++i) maker.make(points[i]);
    for (const InputField& field : space.fields)
        if (field.is_pixel_place()) place_pixels(field, points);
    return points;
}

void change(const InputSpace& space, std::span<double> point, std::size_t number, Random& random) {
    const InputField& field = space.fields[space.field_of[number]];
    if (field.is_pixel_place() && number - field.first != 2) return;  // of which only the depth is free
    const std::span<double> numbers = point.subspan(field.first, field.components);
    if (field.is_texture && random.one_in(2)) {
        point[number] = drawn_texture_number(field, number - field.first, 0.5, random);
    } else if (field.components > 1 && !field.is_pixel_place() && random.one_in(8)) {
        const double factor = random.one_in(4) ? -1 : std::exp2(random.between(-8, 8));
        for (double& component : numbers) component *= factor;
    } else {
        point[number] = changed_number(point, field, point[number], random);
    }
    bring_into_domain(field, numbers);
}

void change_any(const InputSpace& space, std::span<double> point, std::size_t times, Random& random) {
    for (; times > 0; --times) change(space, point, random.index(space.numbers), random);
}

}  // namespace gobo::sanitize
