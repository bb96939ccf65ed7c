#include "lab/sanitize/shrink.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gobo::sanitize {
namespace {

constexpr int kMostRounds = 4;

/// How much there is to read in a number: nothing in 0, little in 1.
std::size_t length_of(double number) {
    if (number == 0) return 0;
    if (number == 1) return 1;
    return 1 + fmt::format("{}", static_cast<float>(number)).size();
}

/// Whether there is less to read in some numbers than in as many others.
bool are_simpler(const std::vector<double>& some, const std::vector<double>& others) {
    std::size_t length = 0;
    std::size_t other_length = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
        if (some[i] == others[i]) continue;
        length += length_of(some[i]);
        other_length += length_of(others[i]);
    }
    return length < other_length;
}

/// The number with so many significant digits.
double rounded(double number, int digits) {
    if (number == 0 || !std::isfinite(number)) return number;
    const double size = std::pow(10.0, std::floor(std::log10(std::abs(number))) - digits + 1);
    return std::round(number / size) * size;
}

class Shrinking {
  public:
    Shrinking(const evaluate::Program& program, const InputSpace& space, OutputBounds& bounds,
              const Finding& finding)
        : program_(program),
          space_(space),
          bounds_(bounds),
          wanted_(finding),
          point_(point_set(space, finding.point)) {}

    Finding run() {
        if (!shows()) return wanted_;
        clear(space_.fields);
        bool is_simpler = true;
        for (int round = 0; round < kMostRounds && is_simpler; ++round) {
            is_simpler = false;
            for (const InputField& field : space_.fields) is_simpler |= simplify(field);
            is_simpler |= simplify_equal_numbers();
        }
        shown_.stage = wanted_.stage;
        shown_.points = wanted_.points;
        shown_.consequences = wanted_.consequences;
        return shown_;
    }

  private:
    [[nodiscard]] std::span<double> numbers_of(const InputField& field) {
        return point_[0].subspan(field.first, field.components);
    }

    /// Whether the point shows what is wanted.
    bool shows() {
        Result<std::vector<Finding>> found =
            find_traps(program_, invocations_of(space_, point_), wanted_.machine, bounds_.at(point_));
        if (!found) return false;
        const auto same = std::find_if(found->begin(), found->end(), [&](const Finding& finding) {
            return finding.message == wanted_.message && finding.place == wanted_.place;
        });
        if (same == found->end()) return false;
        shown_ = std::move(*same);
        return true;
    }

    /// Changes the numbers of some fields if that makes the point simpler and it still shows the finding.
    template <class Change>
    bool attempt(const Change& change, std::span<const InputField> fields) {
        const std::vector<double> before = point_.values;
        for (const InputField& field : fields) {
            if (field.is_pixel_place()) continue;
            change(numbers_of(field));
            bring_into_domain(field, numbers_of(field));
        }
        constrain(space_, point_[0]);
        if (are_simpler(point_.values, before) && shows()) return true;
        point_.values = before;
        return false;
    }

    /// Most of what a large shader reads does not matter: it becomes 0 in halves, quarters and so on, where
    /// all of such a part can.
    void clear(std::span<const InputField> fields) {
        const auto to_zeros = [](std::span<double> numbers) { std::ranges::fill(numbers, 0.0); };
        if (fields.size() < 2 || attempt(to_zeros, fields)) return;
        clear(fields.first(fields.size() / 2));
        clear(fields.subspan(fields.size() / 2));
    }

    /// What needs two inputs to be equal, or opposed, keeps them so: they change together.
    bool simplify_equal_numbers() {
        bool is_simpler = false;
        for (std::size_t i = 0; i < space_.numbers; ++i) {
            const double number = point_.values[i];
            const auto is_equal = [&](double other) { return std::abs(other) == std::abs(number); };
            if (number == 0 || std::ranges::count_if(point_.values, is_equal) < 2) continue;
            for (const double simple : {1.0, 2.0, rounded(number, 1), rounded(number, 2), rounded(number, 3)})
                is_simpler |= attempt(
                    [&](std::span<double> numbers) {
                        for (double& other : numbers)
                            if (is_equal(other)) other = other == number ? simple : -simple;
                    },
                    space_.fields);
        }
        return is_simpler;
    }

    bool simplify(const InputField& field) {
        const std::size_t count = field.components;
        if (field.pixel > 0 && attempt_first_pixels(field)) return true;
        const auto attempt_all = [&](const std::vector<double>& simple) {
            return attempt(
                [&](std::span<double> numbers) { std::copy(simple.begin(), simple.end(), numbers.begin()); },
                {&field, 1});
        };
        bool is_simpler = attempt_all(std::vector<double>(count, 0.0));
        is_simpler |= attempt_all(std::vector<double>(count, 1.0));
        const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
        if (count > 4 && rows * rows == count) {
            std::vector<double> identity(count);
            for (std::size_t i = 0; i < rows; ++i) identity[i * rows + i] = 1;
            is_simpler |= attempt_all(identity);
        }
        for (std::size_t c = 0; c < count; ++c) is_simpler |= simplify_component(field, c);
        return is_simpler;
    }

    /// A pixel that is like the first is simpler than any other.
    bool attempt_first_pixels(const InputField& field) {
        const auto first = std::ranges::find_if(space_.fields, [&](const InputField& other) {
            return other.name == field.name && other.pixel == 0;
        });
        const std::span<double> numbers = numbers_of(field);
        const std::vector<double> before(numbers.begin(), numbers.end());
        std::ranges::copy(numbers_of(*first), numbers.begin());
        if (std::ranges::equal(numbers, before)) return false;
        if (shows()) return true;
        std::ranges::copy(before, numbers.begin());
        return false;
    }

    bool simplify_component(const InputField& field, std::size_t component) {
        const double number = numbers_of(field)[component];
        std::vector<double> candidates = {0, 1, -1, number < 0 ? -2.0 : 2.0};
        for (int digits = 1; digits <= 6; ++digits) candidates.push_back(rounded(number, digits));
        return std::any_of(candidates.begin(), candidates.end(), [&](double candidate) {
            return attempt([&](std::span<double> numbers) { numbers[component] = candidate; }, {&field, 1});
        });
    }

    const evaluate::Program& program_;
    const InputSpace& space_;
    OutputBounds& bounds_;
    const Finding& wanted_;
    PointSet point_;
    Finding shown_;  ///< by the point
};

}  // namespace

Finding simplified(const evaluate::Program& program, const InputSpace& space, OutputBounds& bounds,
                   const Finding& finding) {
    return Shrinking(program, space, bounds, finding).run();
}

}  // namespace gobo::sanitize
