#include "lab/sanitize/constraints.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/matrix.hpp>

#include "core/numbers.hpp"
#include "core/text.hpp"
#include "lab/sanitize/input_space.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::sanitize {
namespace {

/// As little as inputs of that size differ.
double step_of(double number, bool is_float) {
    return is_float ? std::max(kSmallest, std::abs(number) * 0x1p-22) : 1;
}
double above(double number, bool is_float) {
    return is_float ? nearest_float(number + step_of(number, true)) : std::floor(number) + 1;
}
double below(double number, bool is_float) {
    return is_float ? nearest_float(number - step_of(number, true)) : std::ceil(number) - 1;
}

/// What stands between the first brackets of a name: which element it is of.
std::string_view subscript_of(std::string_view name) {
    const auto open = name.find('[');
    return open == std::string_view::npos ? "" : name.substr(open, name.find(']') - open);
}

/// Numbers of a field.
struct Part {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// What a constraint's name means of a field: all of it, a component, or nothing.
std::optional<Part> part_of(const InputField& field, const std::string& stated) {
    if (field.is_texture) return std::nullopt;
    const std::string name = without_subscripts(field.name);
    if (name == stated) return Part{0, field.components};
    const auto component = component_name(stated);
    if (!component || component->of != name || !field.has_named_components() ||
        component->component >= field.components)
        return std::nullopt;
    return Part{component->component, 1};
}

/// Of vectors of two sizes, as far as both go.
bool are_equal(std::span<const double> one, std::span<const double> other) {
    const std::size_t count = std::min(one.size(), other.size());
    return std::ranges::equal(one.first(count), other.first(count));
}

class Keeper {
  public:
    Keeper(const InputSpace& space, std::span<double> point) : space_(space), point_(point) {}

    void keep(const Constraint& constraint) {
        if (constraint.is_comparison()) return keep_comparison(constraint);
        for (const InputField& field : space_.fields) {
            if (field.is_texture || without_subscripts(field.name) != constraint.names.front()) continue;
            if (constraint.names.size() == 1) keep(constraint.kind, field, nullptr);
            for (const InputField& other : space_.fields)
                if (constraint.names.size() > 1 && !other.is_texture &&
                    without_subscripts(other.name) == constraint.names[1] &&
                    is_partner(field, other, constraint.names[1]))
                    keep(constraint.kind, field, &other);
        }
    }

  private:
    [[nodiscard]] std::span<double> numbers(const InputField& field) const {
        return point_.subspan(field.first, field.components);
    }

    /// Whether the field, which has that name, is of the same element and pixel.
    static bool is_partner(const InputField& of, const InputField& field, const std::string& name) {
        const bool is_of_element = subscript_of(name).empty() || subscript_of(of.name).empty() ||
                                   subscript_of(field.name) == subscript_of(of.name);
        const bool is_of_pixel = of.pixel < 0 || field.pixel < 0 || of.pixel == field.pixel;
        return is_of_element && is_of_pixel;
    }

    void keep(Constraint::Kind kind, const InputField& field, const InputField* other) {
        switch (kind) {
            case Constraint::Kind::less:
            case Constraint::Kind::less_equal:
            case Constraint::Kind::differ:
                return;
            case Constraint::Kind::unit:
                return normalise(numbers(field), 0);
            case Constraint::Kind::not_zero:
                if (length_of(numbers(field)) == 0)
                    numbers(field).front() = std::max(field.domain_of(0).high, 1e-6);
                return;
            case Constraint::Kind::distinct:
                if (are_equal(numbers(field), numbers(*other))) move(*other);
                return;
            case Constraint::Kind::orthonormal:
                return make_orthonormal(field);
            case Constraint::Kind::inverse_transpose:
                return make_inverse_transpose(field, *other);
        }
    }

    /// Away from what it equals, and not out of its range.
    void move(const InputField& field) {
        double& number = numbers(field).front();
        number = number < field.domain_of(0).high ? above(number, true) : below(number, true);
    }

    void keep_comparison(const Constraint& constraint) {
        for (const InputField& field : space_.fields) {
            const auto part = part_of(field, constraint.names[0]);
            if (!part) continue;
            if (constraint.has_number()) {
                if (constraint.kind != Constraint::Kind::differ) continue;
                for (double& number : numbers(field).subspan(part->first, part->count))
                    if (number == constraint.number) number = above(number, field.is_float());
                continue;
            }
            for (const InputField& other : space_.fields) {
                const auto others = part_of(other, constraint.names[1]);
                if (!others || !is_partner(field, other, constraint.names[1])) continue;
                const std::size_t count = part->count == 1     ? others->count
                                          : others->count == 1 ? part->count
                                                               : std::min(part->count, others->count);
                for (std::size_t i = 0; i < count; ++i)  // a single number is compared with each
                    keep_pair(constraint.kind, field, part->first + std::min(i, part->count - 1), other,
                              others->first + std::min(i, others->count - 1));
            }
        }
    }

    void keep_pair(Constraint::Kind kind, const InputField& field, std::size_t i, const InputField& other,
                   std::size_t j) {
        double& less = numbers(field)[i];
        double& more = numbers(other)[j];
        const Domain& of_less = field.domain_of(i);
        const Domain& of_more = other.domain_of(j);
        if (kind == Constraint::Kind::less_equal ? less <= more
            : kind == Constraint::Kind::less     ? less < more
                                                 : less != more)
            return;
        const auto is_in = [](const Domain& of, double number) {
            return number >= of.low && number <= of.high;
        };
        if (less > more && is_in(of_less, more) && is_in(of_more, less)) return std::swap(less, more);
        const bool may_be_equal = kind == Constraint::Kind::less_equal;
        const double over = may_be_equal ? less : above(less, other.is_float());
        const double under = may_be_equal ? more : below(more, field.is_float());
        if (is_in(of_more, over)) {
            more = over;
        } else if (is_in(of_less, under)) {
            less = under;
        } else {
            less = of_less.low;
            more = of_more.high;
        }
    }

    /// Of zero the axis of that index.
    static void normalise(std::span<double> vector, std::size_t axis) {
        const double length = length_of(vector);
        for (std::size_t i = 0; i < vector.size(); ++i)
            vector[i] = length == 0 ? (i == axis ? 1 : 0) : nearest_float(vector[i] / length);
    }

    /// Column by column, each without its part along the earlier ones.
    void make_orthonormal(const InputField& field) const {
        const auto rows =
            static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(field.components))));
        if (rows * rows != field.components) return;
        for (std::size_t column = 0; column < rows; ++column) {
            const std::span<double> own = numbers(field).subspan(column * rows, rows);
            normalise(own, column);
            for (std::size_t attempt = 0; attempt <= rows; ++attempt) {
                for (std::size_t before = 0; before < column; ++before) {
                    const std::span<double> earlier = numbers(field).subspan(before * rows, rows);
                    double along = 0;
                    for (std::size_t i = 0; i < rows; ++i) along += own[i] * earlier[i];
                    for (std::size_t i = 0; i < rows; ++i) own[i] -= along * earlier[i];
                }
                if (length_of(own) > 0.1) break;  // else it lay along those: another axis does not
                for (std::size_t i = 0; i < rows; ++i) own[i] = i == (column + attempt) % rows ? 1 : 0;
            }
            normalise(own, column);
        }
    }

    void make_inverse_transpose(const InputField& field, const InputField& of) const {
        const auto rows = static_cast<std::size_t>(of.components == 16 ? 4 : 3);
        if (field.components != 9 || rows * rows != of.components) return;
        glm::dmat3 matrix{1};
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                matrix[column][row] =
                    numbers(of)[static_cast<std::size_t>(column) * rows + static_cast<std::size_t>(row)];
        double largest = 0;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
        const bool is_singular = !(std::abs(glm::determinant(matrix)) > 1e-6 * largest * largest * largest);
        if (is_singular) matrix = glm::dmat3{1};
        const glm::dmat3 result = glm::transpose(glm::inverse(matrix));
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t row = 0; row < 3; ++row) {
                const auto c = static_cast<int>(column);
                const auto r = static_cast<int>(row);
                numbers(field)[column * 3 + row] = nearest_float(result[c][r]);
                if (is_singular) numbers(of)[column * rows + row] = matrix[c][r];
            }
    }

    const InputSpace& space_;
    std::span<double> point_;
};

}  // namespace

bool narrow(Domain& domain, const std::string& name, std::optional<std::size_t> component, bool is_float,
            const std::vector<Constraint>& constraints) {
    const auto is_of_this = [&](const std::string& stated) {
        if (!component) return stated == name;
        const auto part = component_name(stated);
        return part && part->of == name && part->component == *component;
    };
    bool is_stated = false;
    for (const Constraint& constraint : constraints) {
        if (!constraint.has_number()) continue;
        const bool is_upper = is_of_this(constraint.names[0]);  // name < number
        if (!is_upper && !is_of_this(constraint.names[1])) continue;
        is_stated = true;
        const double number = constraint.number;
        const bool is_strict = constraint.kind != Constraint::Kind::less_equal;
        const double over = is_strict ? above(number, is_float) : is_float ? number : std::ceil(number);
        const double under = is_strict ? below(number, is_float) : is_float ? number : std::floor(number);
        if (constraint.kind == Constraint::Kind::differ) {
            if (domain.low == number) domain.low = over;
            if (domain.high == number) domain.high = under;
            std::erase(domain.also, number);
        } else if (is_upper) {
            domain.high = std::min(domain.high, under);
            std::erase_if(domain.also, [&](double also) { return also > under; });
        } else {
            domain.low = std::max(domain.low, over);
            std::erase_if(domain.also, [&](double also) { return also < over; });
        }
    }
    return is_stated;
}

const Constraint* contradiction_in(const InputSpace& space) {
    std::map<std::string, NumberRange> ranges;
    const auto add = [&](const std::string& name, const Domain& domain, bool is_float) {
        NumberRange range{domain.low, domain.high, is_float};
        for (const double also : domain.also) {
            range.low = std::min(range.low, also);
            range.high = std::max(range.high, also);
        }
        ranges.emplace(name, range);
    };
    for (const InputField& field : space.fields) {
        if (field.is_texture) continue;
        add(without_subscripts(field.name), field.domain, field.is_float());
        for (const Constraint& constraint : space.constraints)
            for (const std::string& name : constraint.names)
                if (const auto part = part_of(field, name); part && part->count < field.components)
                    add(name, field.domain_of(part->first), field.is_float());
    }
    return gobo::contradiction_in(space.constraints, std::move(ranges), step_of);
}

void constrain(const InputSpace& space, std::span<double> point) {
    if (space.constraints.empty()) return;
    Keeper keeper(space, point);
    for (const Constraint& constraint : space.constraints) keeper.keep(constraint);
    // What keeps one comparison may break an earlier one.
    for (std::size_t round = 1; round < space.constraints.size(); ++round)
        for (const Constraint& constraint : space.constraints)
            if (constraint.is_comparison() || constraint.kind == Constraint::Kind::distinct)
                keeper.keep(constraint);
}

}  // namespace gobo::sanitize
