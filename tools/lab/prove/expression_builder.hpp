// Expressions as they are made, one after the other, each with what it may be: equal ones are one, and what
// is known to be one number is a constant.
#pragma once

#include <map>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "lab/prove/expression.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {

class ExpressionBuilder {
  public:
    using Id = std::uint32_t;

    explicit ExpressionBuilder(const sanitize::InputSpace& space) : ranges_(expressions_, space) {
        ranges_.begin({}, nullptr);
    }

    [[nodiscard]] Expressions& expressions() { return expressions_; }
    [[nodiscard]] const Ranges& ranges() const { return ranges_; }
    [[nodiscard]] std::uint32_t context() const { return context_; }
    [[nodiscard]] Scalar scalar_of(Id id) const { return expressions_.all[id].scalar; }

    /// A new expression in the context at hand; `known` is what an input or a constant may be.
    Id add(Expression expression, const std::vector<Id>& operands, const Range& known = kAnything);
    Id constant(double value, Scalar scalar);
    /// The expression of an operation; an earlier one of the same operands where there is one.
    Id make(const Expression& expression, std::vector<Id> operands);

    /// What is made from now on belongs to the context.
    void enter(std::uint32_t context);
    /// The context inside `parent` where the condition has that value.
    std::uint32_t inside(std::uint32_t parent, Id condition, bool is_true);
    /// The index of these numbers among the lists.
    std::uint32_t list(std::vector<std::uint32_t> numbers);

    /// Variants of arithmetic that know terms and factors forget them here.
    Id plain(Id id);
    /// That of `all` whose offset it is.
    Id indexed(Id offset, const std::vector<Id>& all, const std::vector<std::uint32_t>& offsets);
    /// What stands at `at` once `given` has been written to the offset.
    Id replaced(Id offset, std::uint32_t at, Id given, Id old);
    /// `yes` or `no`, each in the context of its case.
    Id selected(Id condition, Id yes, Id no);

  private:
    /// Equal operations of equal operands are one expression.
    struct Key {
        std::uint32_t code;
        std::uint32_t part;
        std::uint32_t field;
        bool is_precise;
        std::vector<Id> operands;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct HashOfKey {
        std::size_t operator()(const Key& key) const;
    };

    Expressions expressions_;
    Ranges ranges_;
    std::uint32_t context_ = 0;
    std::map<std::pair<std::uint64_t, Scalar>, Id> constants_;
    std::map<std::tuple<std::uint32_t, Id, bool>, std::uint32_t> inner_contexts_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> lists_;
    std::unordered_map<Key, std::vector<Id>, HashOfKey> known_expressions_;
};

}  // namespace gobo::prove
