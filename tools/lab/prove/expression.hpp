// What a stage computes, as one list of expressions of scalars: calls put in place, loops unrolled, ways that
// meet joined.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/prove/range.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::prove {

/// What expressions are made of beside operations of the instruction table.
enum Code : std::uint32_t {
    kUnknown = 0x30000,  ///< never written: anything
    kConstant,           ///< Expression::known
    kInput,              ///< `part` of the field `field`
    kTexel,              ///< what a texture function answers; known to lie in Expression::known
    kKept,               ///< the operand, as it is under the conditions of a context
    kPlain,              ///< the operand, of which no variant of arithmetic knows how it was computed
    kHalf,      ///< the operand, or the 16-bit float nearest to it; `part` is 1 where it is only passed on
    kJoined,    ///< of its operands, each from a context of its own, the one whose way was taken
    kIndexed,   ///< first operand: the offset; then what stands at the offsets Expression::offsets
    kReplaced,  ///< operands: an offset, a new value, the old one; new where the offset is `part`
    kSumOfProducts,  ///< of dot() and matrices: the factors on the left, then those on the right
};

/// The code of an instruction of GLSL.std.450.
constexpr std::uint32_t extended(std::uint32_t number) {
    return evaluate::kExtended + number;
}

struct Expression {
    std::uint32_t code = kUnknown;
    std::uint32_t first = 0;  ///< of its operands in Expressions::operands
    std::uint32_t count = 0;
    std::uint32_t part = 0;     ///< which component of the operation's result
    std::uint32_t field = 0;    ///< index into InputSpace::fields, or into Expressions::lists
    std::uint32_t context = 0;  ///< that it is computed in
    gobo::Scalar scalar = gobo::Scalar::float32;
    bool is_precise = false;
};

/// A condition under which something runs, inside those of `parent`. Context 0 has none.
struct Context {
    std::uint32_t parent = 0;
    std::uint32_t condition = 0;  ///< expression of a truth value
    bool is_true = true;          ///< which truth value it has
    std::uint32_t depth = 0;
};

/// An operation of the program as it is executed once in the list: of an unrolled loop once for each turn.
struct Site {
    std::uint32_t operation = 0;  ///< index into Program::operations
    std::uint32_t context = 0;
    std::uint32_t first_operand =
        0;  ///< in Expressions::site_operands: those of all operands' components in a row
    std::uint32_t first_result = 0;  ///< likewise; as many as the operation's result has components
    std::uint32_t results = 0;
};

/// In the order of execution.
struct Event {
    enum class Kind : std::uint8_t { expression, site, context } kind;
    std::uint32_t index;  ///< of the expression or site to look at, or the context that what follows runs in
};

struct OutputValues {
    std::string name;
    std::vector<std::uint32_t> expressions;  ///< of each component
    bool is_written = false;
};

struct Expressions {
    std::vector<Expression> all;  ///< the first is unknown
    std::vector<std::uint32_t> operands;
    std::vector<Range> known;  ///< of each expression: of constants, inputs and texels what they may be
    std::vector<std::vector<std::uint32_t>>
        lists;  ///< contexts that a value comes from, offsets of indexed values
    std::vector<Context> contexts{Context{}};
    std::vector<Site> sites;
    std::vector<std::uint32_t> site_operands;
    std::vector<Event> events;
    std::vector<OutputValues> outputs;
    bool has_relaxed =
        false;  ///< some result is a 16-bit float on some variants: what is known of roundings does not hold

    [[nodiscard]] const std::uint32_t* operands_of(std::uint32_t expression) const {
        return operands.data() + all[expression].first;
    }
    [[nodiscard]] std::uint32_t operand(std::uint32_t expression, std::uint32_t index) const {
        return operands[all[expression].first + index];
    }
    /// The expression whose value it has, whatever context it is seen in.
    [[nodiscard]] std::uint32_t origin(std::uint32_t expression) const {
        while (all[expression].code == kKept || all[expression].code == kPlain)
            expression = operand(expression, 0);
        return expression;
    }
};

/// The innermost context that holds both.
[[nodiscard]] std::uint32_t common_context(const std::vector<Context>& contexts, std::uint32_t a,
                                           std::uint32_t b);
/// Whether `inner` is `outer` or inside it.
[[nodiscard]] bool is_within(const std::vector<Context>& contexts, std::uint32_t inner, std::uint32_t outer);

}  // namespace gobo::prove
