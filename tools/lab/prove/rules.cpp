#include "lab/prove/rules.hpp"

#include <algorithm>
#include <optional>

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/image_call.hpp"
#include "lab/sanitize/finding.hpp"
#include "lab/sanitize/image_rules.hpp"
#include "lab/sanitize/trap_rules.hpp"

namespace gobo::prove {
namespace {

using evaluate::Kind;

Range below(double limit) {
    return {-kInfinity, limit, 0, kFinestGrid, true, false};
}
Range above(double limit) {
    return {limit, kInfinity, 0, kFinestGrid, true, false};
}
/// Floats beyond, and not equal to, a limit.
Range less_than(double limit) {
    return below(float_below(limit));
}
Range more_than(double limit) {
    return above(float_above(limit));
}

/// For each component the operands of those numbers as expressions: false as soon as one test is.
template <class Test>
bool each(View& view, std::size_t operands, const Test& test) {
    std::uint32_t components = 0;
    for (std::size_t i = 0; i < operands; ++i)
        components = std::max(components, view.info().operands[i].count);
    for (std::uint32_t c = 0; c < components; ++c)
        if (!test(c)) return false;
    return true;
}

/// That operand never lies in the range.
template <std::size_t operand>
bool never(View& view, const Range& range) {
    return each(view, operand + 1, [&](std::uint32_t c) {
        const std::uint32_t one = view.operand(operand, c);
        Range numbers = view.ranges.range(one);
        numbers.nan = false;
        return both(numbers, range).is_empty() || view.ranges.excludes({{one, range}});
    });
}

bool divisor_is_not_zero(View& view) {
    return never<1>(view, exactly(0));
}
bool is_not_negative(View& view) {
    return never<0>(view, less_than(0));
}
bool is_positive(View& view) {
    return never<0>(view, below(0));
}
bool is_within_one(View& view) {
    return never<0>(view, less_than(-1)) && never<0>(view, more_than(1));
}
bool is_below_one(View& view) {
    return never<0>(view, below(-1)) && never<0>(view, above(1));
}
bool is_at_least_one(View& view) {
    return never<0>(view, less_than(1));
}
bool are_not_negative(View& view) {
    return never<0>(view, below(-1)) && never<1>(view, below(-1));
}
bool shifts_within_word(View& view) {
    return never<1>(view, below(-1)) && never<1>(view, above(32));
}

/// The operands never lie in their ranges at once.
bool never_both(View& view, const Range& first, const Range& second) {
    return each(view, 2, [&](std::uint32_t c) {
        return view.ranges.excludes({{view.operand(0, c), first}, {view.operand(1, c), second}});
    });
}

bool quotient_fits(View& view) {
    return never_both(view, exactly(kAnyInt.low), exactly(-1));
}
template <std::int64_t low, std::int64_t high>
bool lies_between(View& view) {
    return each(view, 1, [&](std::uint32_t c) {
        const Range& range = view.range(0, c);
        return !range.nan && range.low > static_cast<double>(low) && range.high < static_cast<double>(high);
    });
}
bool field_within_word(View& view) {
    const std::size_t count = view.info().operands.size();
    const Range& offset = view.range(count - 2, 0);
    const Range& bits = view.range(count - 1, 0);
    return offset.low >= 0 && bits.low >= 0 && offset.high + bits.high <= 32;
}
bool power_is_defined_at_zero(View& view) {
    return never_both(view, exactly(0), below(0));
}
bool angle_is_defined(View& view) {
    return never_both(view, exactly(0), exactly(0));
}
bool edges_differ(View& view) {
    return each(view, 2, [&](std::uint32_t c) {
        Range low = view.range(0, c);
        Range high = view.range(1, c);
        low.nan = high.nan = false;
        return both(low, high).is_empty();
    });
}
template <std::size_t low, std::size_t high>
bool is_in_order(View& view) {
    return each(view, 3, [&](std::uint32_t c) {
        return view.range(low, c).high <= view.range(high, c).low ||
               view.ranges.is_at_most(view.operand(low, c), view.operand(high, c));
    });
}
/// Numbers above 2147483647 are held as the negative ones of the same bits.
bool are_unsigned_in_order(View& view) {
    return is_in_order<1, 2>(view) && each(view, 3, [&](std::uint32_t c) {
               return view.range(1, c).low >= 0 && view.range(2, c).low >= 0;
           });
}
template <std::size_t operands>
bool has_no_nan(View& view) {
    for (std::size_t i = 0; i < operands; ++i)
        for (std::uint32_t c = 0; c < view.info().operands[i].count; ++c)
            if (view.range(i, c).nan) return false;
    return true;
}

/// The components of a vector are never 0 at once.
bool never_all_zero(View& view, std::size_t operand, std::uint32_t count) {
    std::vector<Cut> all;
    for (std::uint32_t c = 0; c < count; ++c) all.push_back({view.operand(operand, c), exactly(0)});
    return view.ranges.excludes(all);
}

bool vector_is_not_zero(View& view) {
    const std::uint32_t count = view.info().operands[0].count;
    const Range of_squares = view.ranges.sum_of_products(view.vector(0), view.vector(0), count);
    if (!of_squares.holds_zero()) return true;
    return never_all_zero(view, 0, count);
}

/// What length(), distance() and normalize() square: a vector or the difference of two.
class Squared {
  public:
    explicit Squared(View& view) : is_half_(view.info().is_relaxed) {
        const std::uint32_t count = view.info().operands[0].count;
        const bool is_one = view.info().operands.size() == 1;
        for (std::uint32_t c = 0; c < count; ++c)
            components_.push_back(is_one ? view.range(0, c)
                                         : rounded(sum(view.range(0, c), negated(view.range(1, c)))));
        if (!is_one) return;
        limit_ = view.ranges.length_limit(view.vector(0), count);
        // Of what is read as 16-bit floats the domain states the length before it is rounded to them.
        std::vector<std::uint32_t> vector(view.vector(0), view.vector(0) + count);
        bool is_rounded = false;
        for (std::uint32_t& one : vector) {
            const std::uint32_t origin = view.expressions.origin(one);
            if (view.expressions.all[origin].code != kHalf) continue;
            one = view.expressions.operand(origin, 0);
            is_rounded = true;
        }
        declared_ = view.ranges.declared_length(vector.data(), count);
        if (!declared_) return;
        if (is_rounded) {
            const double tiny = std::sqrt(count) * 0x1p-24;
            declared_->least = declared_->least * (1 - 0x1p-10) - tiny;
            declared_->high = declared_->high * (1 + 0x1p-10) + tiny;
        }
        limit_ = std::min(limit_, declared_->high);
    }

    /// No vector but the zero vector has a square below the smallest normal number.
    [[nodiscard]] bool does_not_underflow() const {
        const double enough = (is_half_ ? 0x1p-14 : kSmallestNormal) * 1.0001;
        const auto has_large_square = [&](const Range& r) { return r.smallest() * r.smallest() >= enough; };
        if (std::ranges::any_of(components_, has_large_square)) return true;
        // Each is 0 or large enough.
        const auto is_zero_or_large = [&](const Range& r) {
            return !r.nan && ((r.low == 0 && r.high == 0) || r.least * r.least >= enough);
        };
        if (std::ranges::all_of(components_, is_zero_or_large)) return true;
        return declared_ && declared_->least > 0 && declared_->least * declared_->least >= enough;
    }
    [[nodiscard]] bool does_not_overflow() const {
        double square = 0;
        for (const Range& component : components_) square += component.size() * component.size();
        return std::min(square, limit_ * limit_) < (is_half_ ? 65520 : kLargestFloat) * 0.9999;
    }

  private:
    bool is_half_;  ///< some variant has no more than 16 bits for it
    std::vector<Range> components_;
    double limit_ = kInfinity;  ///< of the length
    std::optional<Range> declared_;
};

bool square_does_not_underflow(View& view) {
    return Squared(view).does_not_underflow();
}
bool square_does_not_overflow(View& view) {
    return Squared(view).does_not_overflow();
}

template <bool Known::*makes>
bool makes_no(View& view) {
    for (std::uint32_t i = 0; i < view.site.results; ++i)
        if (view.ranges[view.expressions.site_operands[view.site.first_result + i]].*makes) return false;
    return true;
}

/// Of a store whose place is computed, which has no results.
bool stores_no_infinity(View& view) {
    return each(view, 1, [&](std::uint32_t c) { return !view.ranges.overflows_half(view.operand(0, c)); });
}

bool index_is_within(View& view) {
    const evaluate::Operation& operation = view.program.operations[view.site.operation];
    const std::uint32_t code = evaluate::row_of(operation).code;
    const std::uint32_t* words = view.program.words.data() + operation.extra;
    const auto holds = [&](std::size_t operand, double extent) {
        const std::uint32_t index = view.operand(operand, 0);
        const Range& range = view.ranges.range(index);
        if (range.low >= 0 && range.high < extent) return true;
        return view.ranges.excludes({{index, below(-1)}}) && view.ranges.excludes({{index, above(extent)}});
    };
    if (code == spv::OpVectorExtractDynamic) return holds(1, words[0]);
    if (code == spv::OpVectorInsertDynamic) return holds(2, words[0]);
    std::size_t operand = 0;
    for (std::uint32_t word = 1; word < operation.extras; word += 3, ++operand) {
        const bool is_stated = !view.program.unstated_extents.contains(operation.extra + word + 1);
        if (!holds(operand, is_stated ? words[word + 1] : 0x1p31)) return false;
    }
    return true;
}

// Texture functions and derivatives: what tools/lab/sanitize/image_rules.cpp watches.

evaluate::ImageCall call_of(const View& view) {
    return evaluate::image_call_of(view.program, view.program.operations[view.site.operation]);
}

/// What a texture's size or number of levels is stated to be at least; nothing where it is not stated.
std::optional<double> stated_extent(const View& view, std::size_t channel) {
    const std::uint32_t image = view.expressions.origin(view.operand(0, 0));
    if (view.expressions.all[image].code != kConstant) return 0;  // one of several
    const auto index = static_cast<std::size_t>(view.expressions.known[image].low);
    const std::string& name = view.program.images.at(index).name;
    for (const sanitize::InputField& field : view.ranges.space().fields)
        if (field.is_texture && field.name == name && channel < field.channels.size())
            return field.channels[channel].high > 0 ? std::optional(field.channels[channel].low)
                                                    : std::nullopt;
    return std::nullopt;
}

/// All pixels of a quad come here or none does: no condition depends on what is a pixel's own.
bool comes_in_quads(View& view) {
    std::vector<std::uint32_t> waiting;
    std::vector<bool> is_seen(view.expressions.all.size(), false);
    const auto visit = [&](std::uint32_t expression) {
        if (!is_seen[expression]) waiting.push_back(expression);
        is_seen[expression] = true;
    };
    const auto visit_context = [&](std::uint32_t context) {
        for (; context != 0; context = view.expressions.contexts[context].parent)
            visit(view.expressions.contexts[context].condition);
    };
    visit_context(view.site.context);
    while (!waiting.empty()) {
        const std::uint32_t expression = waiting.back();
        waiting.pop_back();
        const Expression& one = view.expressions.all[expression];
        if (one.code == kUnknown || one.code == kTexel) return false;
        if (one.code == kInput) {
            const std::string& name = view.ranges.space().fields[one.field].name;
            if (find_port(view.program.inputs, name) != nullptr) return false;
        }
        for (std::uint32_t i = 0; i < one.count; ++i) visit(view.expressions.operand(expression, i));
        if (one.code == kJoined)
            for (const std::uint32_t context : view.expressions.lists[one.field]) visit_context(context);
    }
    return true;
}

/// Nothing is discarded before the operation, or in an earlier turn of a loop around it.
bool comes_before_discards(View& view) {
    const std::vector<evaluate::Block>& blocks = view.program.blocks;
    const auto holds_it = [&](const evaluate::Block& block) {
        return view.site.operation >= block.first && view.site.operation < block.first + block.count;
    };
    const auto here = static_cast<std::uint32_t>(std::ranges::find_if(blocks, holds_it) - blocks.begin());
    std::uint32_t last = here;  // that may come before it
    for (std::uint32_t block = 0; block < blocks.size(); ++block)
        for (std::uint32_t i = 0; i < blocks[block].edges; ++i)
            if (view.program.edges[blocks[block].edge + i].target <= here) last = std::max(last, block);
    return std::none_of(blocks.begin(), blocks.begin() + last + 1,
                        [](const evaluate::Block& block) { return block.end == evaluate::Block::End::kill; });
}

bool projects_forwards(View& view) {
    const evaluate::ImageCall call = call_of(view);
    const std::uint32_t divisor = view.operand(1, call.divisor - call.coordinates);
    return view.ranges.range(divisor).low > 0 || view.ranges.excludes({{divisor, below(0)}});
}

bool direction_is_not_zero(View& view) {
    return never_all_zero(view, 1, 3);
}

bool fetches_inside(View& view) {
    const evaluate::ImageCall call = call_of(view);
    const std::optional<double> side = stated_extent(view, 4);
    if (call.sample != 0 && view.range(view.info().operands.size() - 1, 0).low < 0) return false;
    if (call.is_arrayed != 0 && view.range(1, call.dimensions).low < 0) return false;
    for (std::uint32_t axis = 0; axis < call.dimensions; ++axis) {
        const Range& at = view.range(1, axis);
        if (call.offset != 0 || at.low < 0 || (side && at.high >= *side)) return false;
    }
    return !side || (call.lod != 0 && view.range(2, 0).high <= 0);
}

bool has_level(View& view) {
    const evaluate::ImageCall call = call_of(view);
    const Range& level = view.range(call.coordinates == 0 ? 1 : 2, 0);
    const std::optional<double> levels = stated_extent(view, 5);
    return level.low >= 0 && !stated_extent(view, 4) && (!levels || level.high < *levels);
}

void add_image_rules(const evaluate::Program& program, const evaluate::Operation& operation,
                     std::vector<Rule>& rules) {
    using What = evaluate::ImageRequest::What;
    const auto add_derivatives = [&] {
        rules.push_back({sanitize::kParted, comes_in_quads, ~0U});
        rules.push_back({sanitize::kPartedByDiscard, comes_before_discards, ~0U});
    };
    const evaluate::Row& row = evaluate::row_of(operation);
    if (row.kind == Kind::derivative && row.name.starts_with("Interpolate") == false) add_derivatives();
    if (row.kind != Kind::image) return;
    const evaluate::ImageCall call = evaluate::image_call_of(program, operation);
    if (call.is_implicit != 0 && call.reference == 0) add_derivatives();
    if (call.divisor != 0)
        rules.push_back(
            {"a projected texture coordinate whose divisor is not above 0", projects_forwards, 2});
    const bool may_be_cube = std::ranges::any_of(program.images, [](const evaluate::ImagePort& image) {
        return image.type.dimension == spv::DimCube;
    });
    if (may_be_cube && call.coordinates != 0 && call.dimensions == 3 && call.has_int_coordinates == 0)
        rules.push_back({"a cube map is looked up along a zero vector", direction_is_not_zero, 2});
    if (static_cast<What>(call.what) == What::fetch && call.is_storage == 0)
        rules.push_back({"texelFetch() outside of the texture", fetches_inside, 2});
    if (call.has_int_level != 0 && call.lod != 0)
        rules.push_back(
            {"a level that the texture does not have", has_level, call.coordinates == 0 ? 2U : 4U});
}

#define GOBO_STD450(name) evaluate::kExtended + GLSLstd450##name

/// By code and by the beginning of the sanitizer's message, since an operation may have several.
struct Proof {
    std::uint32_t code;
    std::string_view message;
    bool (*is_impossible)(View&);
    std::uint32_t deciding;
};

constexpr Proof kProofs[] = {
    {spv::OpFDiv, "division by zero", divisor_is_not_zero, 2},
    {spv::OpFMod, "mod() by zero", divisor_is_not_zero, 2},
    {spv::OpFRem, "remainder of a division by zero", divisor_is_not_zero, 2},
    {spv::OpSDiv, "integer division by zero", divisor_is_not_zero, 2},
    {spv::OpSDiv, "integer division overflows", quotient_fits, 3},
    {spv::OpUDiv, "integer division by zero", divisor_is_not_zero, 2},
    {spv::OpSMod, "integer remainder by zero", divisor_is_not_zero, 2},
    {spv::OpSMod, "integer remainder of a negative number", are_not_negative, 3},
    {spv::OpSRem, "integer remainder by zero", divisor_is_not_zero, 2},
    {spv::OpUMod, "integer remainder by zero", divisor_is_not_zero, 2},
    {spv::OpShiftLeftLogical, "shift by more than 31 bits", shifts_within_word, 2},
    {spv::OpShiftRightLogical, "shift by more than 31 bits", shifts_within_word, 2},
    {spv::OpShiftRightArithmetic, "shift by more than 31 bits", shifts_within_word, 2},
    {spv::OpBitFieldInsert, "bit field beyond 32 bits", field_within_word, 12},
    {spv::OpBitFieldSExtract, "bit field beyond 32 bits", field_within_word, 6},
    {spv::OpBitFieldUExtract, "bit field beyond 32 bits", field_within_word, 6},
    {GOBO_STD450(Pow), "pow() of a negative number", is_not_negative, 1},
    {GOBO_STD450(Pow), "pow(0, y) with y not above 0", power_is_defined_at_zero, 3},
    {GOBO_STD450(Sqrt), "sqrt() of a negative number", is_not_negative, 1},
    {GOBO_STD450(InverseSqrt), "inversesqrt() of a number not above 0", is_positive, 1},
    {GOBO_STD450(Log), "log() of a number not above 0", is_positive, 1},
    {GOBO_STD450(Log2), "log2() of a number not above 0", is_positive, 1},
    {GOBO_STD450(Acos), "acos() of a number beyond [-1, 1]", is_within_one, 1},
    {GOBO_STD450(Asin), "asin() of a number beyond [-1, 1]", is_within_one, 1},
    {GOBO_STD450(Acosh), "acosh() of a number below 1", is_at_least_one, 1},
    {GOBO_STD450(Atanh), "atanh() of a number not within (-1, 1)", is_below_one, 1},
    {GOBO_STD450(Atan2), "atan(0, 0)", angle_is_defined, 3},
    {GOBO_STD450(SmoothStep), "smoothstep() with equal edges", edges_differ, 3},
    {GOBO_STD450(SmoothStep), "smoothstep() with its first edge above its second", is_in_order<0, 1>, 3},
    {GOBO_STD450(FMin), "min() fed a NaN", has_no_nan<2>, 3},
    {GOBO_STD450(FMax), "max() fed a NaN", has_no_nan<2>, 3},
    {GOBO_STD450(FClamp), "clamp() fed a NaN", has_no_nan<3>, 7},
    {GOBO_STD450(FClamp), "clamp() with its minimum above its maximum", is_in_order<1, 2>, 6},
    {GOBO_STD450(SClamp), "clamp() with its minimum above its maximum", is_in_order<1, 2>, 6},
    {GOBO_STD450(UClamp), "clamp() with its minimum above its maximum", are_unsigned_in_order, 6},
    {GOBO_STD450(Normalize), "normalize() of a zero vector", vector_is_not_zero, 1},
    {GOBO_STD450(Normalize), "normalize() underflows: the square of the length is too small",
     square_does_not_underflow, 1},
    {GOBO_STD450(Normalize), "normalize() overflows: the square of the length is too large",
     square_does_not_overflow, 1},
    {GOBO_STD450(Length), "length() underflows: its square is too small", square_does_not_underflow, 1},
    {GOBO_STD450(Length), "length() overflows: its square is too large", square_does_not_overflow, 1},
    {GOBO_STD450(Distance), "distance() underflows: its square is too small", square_does_not_underflow, 3},
    {GOBO_STD450(Distance), "distance() overflows: its square is too large", square_does_not_overflow, 3},
    {spv::OpConvertFToS, "conversion to int out of range", lies_between<-2147483904, 2147483648>, 1},
    {spv::OpConvertFToU, "conversion to uint out of range", lies_between<-1, 4294967296>, 1},
};

const Proof* proof_of(std::uint32_t code, std::string_view message) {
    const auto* found = std::ranges::find_if(
        kProofs, [&](const Proof& proof) { return proof.code == code && proof.message == message; });
    return found == std::end(kProofs) ? nullptr : found;
}

}  // namespace

std::uint32_t View::operand(std::size_t index, std::uint32_t component) const {
    return vector(index)[info().operands[index].count == 1 ? 0 : component];
}

const std::uint32_t* View::vector(std::size_t index) const {
    std::uint32_t first = site.first_operand;
    for (std::size_t i = 0; i < index; ++i) first += info().operands[i].count;
    return expressions.site_operands.data() + first;
}

std::vector<std::vector<Rule>> rules_of(const evaluate::Program& program) {
    std::vector<std::vector<Rule>> all(program.operations.size());
    for (std::size_t at = 0; at < program.operations.size(); ++at) {
        const evaluate::Row& row = evaluate::row_of(program.operations[at]);
        if (row.is_bookkeeping) continue;
        for (const sanitize::TrapRule& rule : sanitize::rules_of(sanitize::trap_rules(), row.code)) {
            const Proof* proof = proof_of(row.code, rule.message);
            all[at].push_back({rule.message, proof == nullptr ? nullptr : proof->is_impossible,
                               proof == nullptr ? ~0U : proof->deciding});
        }
        if (row.code == spv::OpAccessChain || row.code == spv::OpVectorExtractDynamic ||
            row.code == spv::OpVectorInsertDynamic)
            all[at].push_back({kOutOfBounds, index_is_within,
                               row.code == spv::OpAccessChain            ? ~0U
                               : row.code == spv::OpVectorExtractDynamic ? 2U
                                                                         : 4U});
        add_image_rules(program, program.operations[at], all[at]);
        const bool has_floats = program.infos[at].result.scalar == Scalar::float32;
        if (has_floats && row.code == evaluate::kScatter && sanitize::narrows_to_half(program, at))
            all[at].push_back({kMakesInfinity, stores_no_infinity, 1, true});
        else if (has_floats && (row.kind <= Kind::matrix || sanitize::narrows_to_half(program, at)))
            all[at].push_back({kMakesInfinity, makes_no<&Known::makes_infinity>, ~0U, true});
        if (has_floats && row.kind <= Kind::matrix) {
            all[at].push_back({kMakesNaN, makes_no<&Known::makes_nan>, ~0U, true});
        }
    }
    return all;
}

std::vector<std::string_view> rules_without_proof() {
    std::vector<std::string_view> without;
    for (const sanitize::TrapRule& rule : sanitize::trap_rules())
        if (proof_of(rule.code, rule.message) == nullptr) without.push_back(rule.message);
    return without;
}

}  // namespace gobo::prove
