// What every expression of a stage may be, for all inputs of a box at once and on all variants of arithmetic.
#pragma once

#include <array>
#include <vector>

#include "lab/prove/expression.hpp"

namespace gobo::prove {

/// The two numbers whose sum a value is, where sums are regrouped or reordered.
struct Terms {
    Range first = kNothing;
    Range second = kNothing;
    friend bool operator==(const Terms&, const Terms&) = default;
};

/// What these may be, case by case as long as there are few.
struct TermsCases {
    std::array<Terms, 4> cases{};
    std::size_t count = 0;

    void add(const Terms& terms) {
        if (terms.first.has_no_number() || terms.second.has_no_number()) return;
        for (std::size_t i = 0; i < count; ++i)
            if (cases[i] == terms) return;
        if (count < cases.size()) {
            cases[count++] = terms;
            return;
        }
        Terms& last = cases.back();
        last = {hull(last.first, terms.first), hull(last.second, terms.second)};
    }
    void add(const TermsCases& others) {
        for (std::size_t i = 0; i < others.count; ++i) add(others.cases[i]);
    }
    void negate() {
        for (std::size_t i = 0; i < count; ++i)
            cases[i] = {negated(cases[i].first), negated(cases[i].second)};
    }
};

/// What is known of an expression.
struct Known {
    Range range = kNothing;
    bool has_product =
        false;  ///< on some variant a sum takes the factors of this product instead of the rounded product
    bool has_terms = false;             ///< likewise the terms of this sum
    bool always_has_terms = false;      ///< whichever way it was computed
    Range product = kNothing;           ///< before it is rounded
    std::array<TermsCases, 2> terms{};  ///< regrouped, reordered
    Range of_finite = kNothing;         ///< of finite operands; nothing of what passes on its operands
    bool makes_infinity = false;        ///< of finite operands
    bool makes_nan = false;             ///< of finite operands
};

/// By how much v * inversesqrt(dot(v, v)) may be longer than 1, on any variant of arithmetic: 1.5 roundings
/// of the sum's root, 2 and the 4 allowed of inversesqrt(), 1 of the product.
inline constexpr double kUnitSlack = 6e-7;
/// And normalize(v): 3 roundings, and the 14 allowed.
inline constexpr double kDirectionSlack = 1.2e-6;

/// A part of the values: of an expression, as soon as it is computed.
struct Cut {
    std::uint32_t expression;
    Range range;
    friend bool operator==(const Cut&, const Cut&) = default;
};

/// Goes through the expressions in order, context by context. In a context, its conditions narrow what is
/// known.
class Ranges {
  public:
    Ranges(const Expressions& expressions, const sanitize::InputSpace& space)
        : expressions_(expressions), space_(space) {}

    /// Nothing is computed yet. Of the expressions named by `cuts` only those values count. `is_wanted`,
    /// unless empty, says which expressions are computed at all.
    void begin(const std::vector<Cut>& cuts, const std::vector<bool>* is_wanted);
    /// Computes the expression, the last one so far.
    void compute(std::uint32_t expression);
    /// What follows runs under the conditions of the context.
    void enter(std::uint32_t context);

    /// Whether inputs of the box reach the context entered last.
    [[nodiscard]] bool is_reached() const { return is_reached_; }
    [[nodiscard]] const Known& operator[](std::uint32_t expression) const { return known_[expression]; }
    /// What it is at neighbouring pixels, which a condition or a cut of this pixel's inputs says nothing of.
    [[nodiscard]] Range across_pixels(std::uint32_t expression) const;
    [[nodiscard]] const Range& range(std::uint32_t expression) const { return known_[expression].range; }

    /// Whether it follows from what is known that not all of these hold at once.
    [[nodiscard]] bool excludes(const std::vector<Cut>& assumptions);

    /// At least |v|, in doubles; of the vector made of these expressions.
    [[nodiscard]] double length_limit(const std::uint32_t* vector, std::uint32_t count, int depth = 0) const;
    /// What the length of a vector may be where it is all of an input whose domain says so.
    [[nodiscard]] std::optional<Range> declared_length(const std::uint32_t* vector,
                                                       std::uint32_t count) const;
    /// Whether |a| <= b is known from how they are computed or from the conditions.
    [[nodiscard]] bool is_at_most(std::uint32_t a, std::uint32_t b, int depth = 0) const;

    /// The sum of the products of components, or of a vector's squares where both are the same, as a float.
    [[nodiscard]] Range sum_of_products(const std::uint32_t* left, const std::uint32_t* right,
                                        std::uint32_t terms) const;

    /// Whether it holds 16-bit floats wherever what is mediump does.
    [[nodiscard]] bool is_half(std::uint32_t expression, int depth = 0) const;
    /// Whether, finite, it may be more than a 16-bit float holds.
    [[nodiscard]] bool overflows_half(std::uint32_t expression) const;

    [[nodiscard]] const sanitize::InputSpace& space() const { return space_; }

    /// To be called when an expression has been added to the list.
    void grow();

  private:
    struct Frame {
        std::uint32_t context;
        std::size_t saved;
        std::size_t orders;
        bool was_reached;
    };
    struct Saved {
        std::uint32_t expression;
        Known known;
    };
    /// first <= second, or first < second.
    struct Order {
        std::uint32_t first;
        std::uint32_t second;
        bool is_strict;
    };

    /// The lower end of an expression in a context, by its conditions too.
    [[nodiscard]] double least_in(std::uint32_t context, std::uint32_t expression) const;
    /// Whether the scale, being above `least`, is the largest |component| of the vector.
    [[nodiscard]] bool is_largest_of(std::uint32_t scale, const std::uint32_t* vector, std::uint32_t count,
                                     double least) const;
    /// What x - y may be where x is (s + y') of `precise` sums less s: y' but for roundings, or, where y is
    /// y', those alone.
    [[nodiscard]] std::optional<Range> rounding_of_sum(std::uint32_t x, std::uint32_t y) const;
    /// Whether the divisor is the length of a vector that has these components, and has lost no digits.
    [[nodiscard]] bool divides_by_length(const std::uint32_t* vector, std::uint32_t count,
                                         std::uint32_t divisor) const;
    /// At least |n.h / |h|| of such a product of `sum` with `inverse_length`; infinite where it is none.
    [[nodiscard]] double cosine_limit(std::uint32_t sum, std::uint32_t inverse_length) const;
    /// The vector whose square the number is at least, its three components, known to be of some length;
    /// nothing where it is none.
    [[nodiscard]] std::optional<std::array<std::uint32_t, 3>> vector_of_square(std::uint32_t square) const;
    /// At least |n x h|^2 / |h|^2 of such a quotient; infinite where it is none.
    [[nodiscard]] double sine_limit(std::uint32_t square_of_cross, std::uint32_t square) const;
    /// Whether each product scales its component of a vector, which all have, by 1 / length.
    [[nodiscard]] bool makes_unit(const std::uint32_t* products, std::uint32_t count) const;
    void leave_to(std::uint32_t context);
    void push(std::uint32_t context);
    [[nodiscard]] Known evaluate(std::uint32_t expression) const;
    void evaluate_join(const Expression& expression, const std::uint32_t* operands, Known& known) const;
    void evaluate_sum(const Expression& expression, const std::uint32_t* operands, Known& known) const;
    void evaluate_floats(const Expression& expression, std::uint32_t index, Known& known) const;
    [[nodiscard]] Range evaluate_whole(const Expression& expression, const std::uint32_t* operands) const;
    [[nodiscard]] Range compare(const Expression& expression, const std::uint32_t* operands) const;
    bool narrow(std::uint32_t expression, const Range& to);
    bool narrow_operands(std::uint32_t expression);
    bool assume(std::uint32_t condition, bool is_true);
    bool assume_comparison(const Expression& comparison, const std::uint32_t* operands, bool is_true);
    bool assume_order(std::uint32_t first, std::uint32_t second, bool is_strict);
    bool assume_context(std::uint32_t context, std::uint32_t outer);
    bool spread();
    void mark_users(std::uint32_t expression);
    [[nodiscard]] bool is_wanted(std::uint32_t expression) const {
        return wanted_ == nullptr || (*wanted_)[expression];
    }
    [[nodiscard]] bool is_before(std::uint32_t a, std::uint32_t b, bool& is_strict) const;

    const Expressions& expressions_;
    const sanitize::InputSpace& space_;
    const std::vector<bool>* wanted_ = nullptr;
    std::vector<Known> known_;
    std::vector<Range> whole_;  ///< computed outside of conditions and cuts; else nothing
    std::vector<bool> is_computed_;
    std::vector<std::vector<std::uint32_t>> users_;
    std::vector<std::uint32_t> waiting_;  ///< a heap of expressions to be computed again, the earliest first
    std::vector<bool> is_waiting_;
    std::vector<Frame> frames_;
    std::vector<Saved> saved_;
    std::vector<Order> orders_;
    std::vector<bool> reached_;  ///< of each context, when it was entered last
    std::vector<Cut> cuts_;
    std::vector<std::int32_t> cut_of_;  ///< of each expression, or -1
    bool is_reached_ = true;
    int work_ = 0;  ///< of one assumption, so that it ends
};

}  // namespace gobo::prove
