#include "lab/sanitize/constraints.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/matrix.hpp>

#include "core/text.hpp"
#include "lab/sanitize/input_space.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::sanitize {
namespace {

struct Form {
    std::string_view name;
    Constraint::Kind kind;
    std::size_t names;
};
constexpr std::array kForms = {
    Form{"unit", Constraint::Kind::unit, 1}, Form{"not_zero", Constraint::Kind::not_zero, 1},
    Form{"distinct", Constraint::Kind::distinct, 2}, Form{"orthonormal", Constraint::Kind::orthonormal, 1},
    Form{"inverse_transpose_of", Constraint::Kind::inverse_transpose, 2}};

double as_float(double number) {
    return static_cast<double>(static_cast<float>(number));
}

/// What stands between the first brackets of a name: which element it is of.
std::string_view subscript_of(std::string_view name) {
    const auto open = name.find('[');
    return open == std::string_view::npos ? "" : name.substr(open, name.find(']') - open);
}

class Keeper {
  public:
    Keeper(const InputSpace& space, std::span<double> point) : space_(space), point_(point) {}

    void keep(const Constraint& constraint) {
        for (const InputField& field : space_.fields) {
            if (field.is_texture || verify::without_subscripts(field.name) != constraint.names.front())
                continue;
            const InputField* const other =
                constraint.names.size() > 1 ? partner(field, constraint.names[1]) : nullptr;
            if (constraint.names.size() > 1 && other == nullptr) continue;
            keep(constraint.kind, field, other);
        }
    }

  private:
    [[nodiscard]] std::span<double> numbers(const InputField& field) const {
        return point_.subspan(field.first, field.components);
    }

    /// The field of that name and of the same element and pixel.
    [[nodiscard]] const InputField* partner(const InputField& of, const std::string& name) const {
        const auto found = std::ranges::find_if(space_.fields, [&](const InputField& field) {
            const bool is_of_element =
                subscript_of(name).empty() || subscript_of(field.name) == subscript_of(of.name);
            const bool is_of_pixel = of.pixel < 0 || field.pixel < 0 || of.pixel == field.pixel;
            return is_of_element && is_of_pixel && verify::without_subscripts(field.name) == name;
        });
        return found == space_.fields.end() ? nullptr : &*found;
    }

    void keep(Constraint::Kind kind, const InputField& field, const InputField* other) {
        switch (kind) {
            case Constraint::Kind::less:
                return keep_less(numbers(field).front(), numbers(*other).front());
            case Constraint::Kind::unit:
                return normalise(numbers(field), 0);
            case Constraint::Kind::not_zero:
                if (length_of(numbers(field)) == 0)
                    numbers(field).front() = std::max(field.domain.high, 1e-6);
                return;
            case Constraint::Kind::distinct:
                if (std::ranges::equal(numbers(field), numbers(*other))) move(numbers(field).front());
                return;
            case Constraint::Kind::orthonormal:
                return make_orthonormal(field);
            case Constraint::Kind::inverse_transpose:
                return make_inverse_transpose(field, *other);
        }
    }

    /// As little as inputs of that size differ.
    static void move(double& number) {
        number = as_float(number + std::max(kSmallest, std::abs(number) * 0x1p-22));
    }

    static void keep_less(double& less, double& more) {
        if (less > more) std::swap(less, more);
        if (less == more) move(more);
    }

    /// Of zero the axis of that index.
    static void normalise(std::span<double> vector, std::size_t axis) {
        const double length = length_of(vector);
        for (std::size_t i = 0; i < vector.size(); ++i)
            vector[i] = length == 0 ? (i == axis ? 1 : 0) : as_float(vector[i] / length);
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
                numbers(field)[column * 3 + row] = as_float(result[c][r]);
                if (is_singular) numbers(of)[column * rows + row] = matrix[c][r];
            }
    }

    const InputSpace& space_;
    std::span<double> point_;
};

}  // namespace

bool is_constraint(std::string_view text) {
    return text.find_first_of("<(") != std::string_view::npos;
}

std::optional<Constraint> constraint_of(std::string_view text) {
    const auto trimmed = [](std::string_view part) { return std::string(trim(part)); };
    if (const auto sign = text.find('<'); sign != std::string_view::npos)
        return Constraint{Constraint::Kind::less,
                          {trimmed(text.substr(0, sign)), trimmed(text.substr(sign + 1))}};
    const auto open = text.find('(');
    if (open == std::string_view::npos || !text.ends_with(')')) return std::nullopt;
    const std::string name = trimmed(text.substr(0, open));
    const auto form = std::ranges::find(kForms, std::string_view(name), &Form::name);
    if (form == kForms.end()) return std::nullopt;
    Constraint constraint{form->kind, {}};
    for (const std::string& part : split(text.substr(open + 1, text.size() - open - 2), ','))
        constraint.names.push_back(trimmed(part));
    if (constraint.names.size() != form->names) return std::nullopt;
    return constraint;
}

std::vector<Constraint> constraints_of(const std::vector<Domain>& domains) {
    std::vector<Constraint> constraints;
    for (const Domain& domain : domains)
        if (is_constraint(domain.name))
            if (const auto constraint = constraint_of(domain.name)) constraints.push_back(*constraint);
    return constraints;
}

void constrain(const InputSpace& space, std::span<double> point) {
    if (space.constraints.empty()) return;
    Keeper keeper(space, point);
    for (const Constraint& constraint : space.constraints) keeper.keep(constraint);
}

}  // namespace gobo::sanitize
