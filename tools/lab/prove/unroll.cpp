#include "lab/prove/unroll.hpp"

#include <bit>
#include <map>
#include <unordered_map>

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/image_call.hpp"
#include "lab/prove/input_range.hpp"
#include "lab/prove/ranges.hpp"

namespace gobo::prove {
namespace {

using evaluate::Block;
using evaluate::Operation;
using evaluate::OperationInfo;
using evaluate::Program;
using evaluate::Slice;
using Id = std::uint32_t;

constexpr std::size_t kMostExpressions = 300000;
constexpr std::uint32_t kMostTurns = 1U << 16U;

/// Which expression each slot holds, in a context.
struct State {
    std::uint32_t context = 0;
    std::vector<Id> slots;
};

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
    std::size_t operator()(const Key& key) const {
        std::size_t hash = key.code * 31U + key.part * 7U + key.field * 131U + (key.is_precise ? 1 : 0);
        for (const Id operand : key.operands) hash = hash * 1000003U ^ operand;
        return hash;
    }
};

class Unroller {
  public:
    Unroller(const Program& program, const sanitize::InputSpace& space, bool has_tiny_inputs)
        : program_(program), space_(space), ranges_(expressions_, space), has_tiny_inputs_(has_tiny_inputs) {}

    Result<Expressions> run() {
        begin();
        while (!waiting_.empty()) {
            const auto first = waiting_.begin();
            const std::uint32_t block = first->first;
            std::vector<State> states = std::move(first->second);
            waiting_.erase(first);
            State state = joined(std::move(states));
            if (program_.blocks[block].is_loop && ++turns_[block] > kMostTurns)
                return fail(evaluate::error_at(
                    program_.places[program_.blocks[block].place],
                    fmt::format("the loop may take more than {} turns: nothing is proven of this stage",
                                kMostTurns)));
            run_block(program_.blocks[block], state);
            if (expressions_.all.size() > kMostExpressions)
                return fail(
                    evaluate::error_at(program_.places[program_.blocks[block].place],
                                       "the stage is too long to be proven: its loops unrolled are more than "
                                       "300000 operations"));
        }
        finish();
        return std::move(expressions_);
    }

  private:
    // ---- Expressions ----

    Id add(Expression expression, const std::vector<Id>& operands, const Range& known = kAnything) {
        expression.first = static_cast<std::uint32_t>(expressions_.operands.size());
        expression.count = static_cast<std::uint32_t>(operands.size());
        expression.context = context_;
        expressions_.operands.insert(expressions_.operands.end(), operands.begin(), operands.end());
        const auto id = static_cast<Id>(expressions_.all.size());
        expressions_.all.push_back(expression);
        expressions_.known.push_back(known);
        expressions_.events.push_back({Event::Kind::expression, id});
        ranges_.compute(id);
        return id;
    }

    Id constant(double value, Scalar scalar) {
        // By bits, since no order holds a NaN; both zeros are one.
        const auto bits = std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value);
        const auto [found, is_new] = constants_.try_emplace({bits, scalar}, 0);
        if (is_new) {
            // Constants belong to no context.
            const std::uint32_t context = context_;
            enter(0);
            found->second = add({.code = kConstant, .scalar = scalar}, {}, exactly(value));
            enter(context);
        }
        return found->second;
    }

    /// The expression of an operation; an earlier one of the same operands where there is one.
    Id make(const Expression& expression, std::vector<Id> operands) {
        Key key{expression.code, expression.part, expression.field, expression.is_precise,
                std::move(operands)};
        std::vector<Id>& same = known_expressions_[key];
        for (const Id id : same)
            if (expression.code == kKept
                    ? context_ == expressions_.all[id].context
                    : is_within(expressions_.contexts, context_, expressions_.all[id].context))
                return id;
        const Id id = add(expression, key.operands);
        const Known& known = ranges_[id];
        Id result = id;
        if (expression.code != kKept && known.range.is_one() && !known.has_product && !known.has_terms &&
            !known.makes_infinity && ranges_.is_reached())
            result = constant(known.range.low, expression.scalar);
        known_expressions_[key].push_back(result);
        return result;
    }

    void enter(std::uint32_t context) {
        if (context == context_) return;
        context_ = context;
        std::vector<Event>& events = expressions_.events;
        // A context in which nothing was computed leaves no trace.
        if (!events.empty() && events.back().kind == Event::Kind::context) events.pop_back();
        events.push_back({Event::Kind::context, context});
        ranges_.enter(context);
    }

    /// The context inside `parent` where the condition has that value.
    std::uint32_t inside(std::uint32_t parent, Id condition, bool is_true) {
        const auto [found, is_new] = inner_contexts_.try_emplace({parent, condition, is_true}, 0);
        if (is_new) {
            found->second = static_cast<std::uint32_t>(expressions_.contexts.size());
            expressions_.contexts.push_back(
                {parent, condition, is_true, expressions_.contexts[parent].depth + 1});
        }
        return found->second;
    }

    std::uint32_t list(std::vector<std::uint32_t> numbers) {
        const auto [found, is_new] =
            lists_.try_emplace(numbers, static_cast<std::uint32_t>(expressions_.lists.size()));
        if (is_new) expressions_.lists.push_back(std::move(numbers));
        return found->second;
    }

    [[nodiscard]] Scalar scalar_of(Id id) const { return expressions_.all[id].scalar; }

    // ---- Beginning and end ----

    void begin() {
        turns_.resize(program_.blocks.size());
        ranges_.begin({}, nullptr);
        expressions_.has_relaxed = std::ranges::any_of(program_.infos, &OperationInfo::is_relaxed);
        add({.code = kUnknown}, {});
        is_carried_.assign(program_.slots, false);
        for (const auto& [slot, count] : program_.variables)
            std::fill_n(is_carried_.begin() + slot, count, true);
        for (const Block& block : program_.blocks) {
            std::vector<bool> is_written(program_.slots, false);
            for (std::uint32_t at = block.first; at < block.first + block.count; ++at) {
                const Operation& operation = program_.operations[at];
                const std::uint32_t code = evaluate::row_of(operation).code;
                const auto read = [&](std::uint32_t first, std::uint32_t count) {
                    for (std::uint32_t slot = first; slot < first + count; ++slot)
                        if (!is_written[slot]) is_carried_[slot] = true;
                };
                for (const Slice& operand : program_.infos[at].operands) read(operand.slot, operand.count);
                // Addresses, which have no type.
                if (code == evaluate::kCopy) read(operation.operands[0], operation.count);
                if (code == evaluate::kGather || code == evaluate::kScatter) read(operation.operands[1], 1);
                if (code == spv::OpAccessChain && program_.words[operation.extra] != 0)
                    read(program_.words[operation.extra] - 1, 1);
                const bool is_copy = code == evaluate::kCopy;
                const std::uint32_t results = is_copy ? operation.count : program_.infos[at].result.count;
                if (code == spv::OpAccessChain) {
                    is_written[operation.result] = true;
                    continue;
                }
                for (std::uint32_t i = 0; i < results && operation.result + i < program_.slots; ++i)
                    is_written[operation.result + i] = true;
            }
            is_carried_[block.condition] = true;
            for (std::uint32_t edge = block.edge; edge < block.edge + block.edges; ++edge)
                for (std::uint32_t copy = program_.edges[edge].first_copy;
                     copy < program_.edges[edge].first_copy + program_.edges[edge].copies; ++copy)
                    for (std::uint32_t i = 0; i < program_.copies[copy].count; ++i) {
                        is_carried_[program_.copies[copy].operands[0] + i] = true;
                        is_carried_[program_.copies[copy].result + i] = true;
                    }
        }
        State state;
        state.slots.assign(program_.slots, 0);
        for (const evaluate::ConstantSlot& slot : program_.constants)
            state.slots[slot.slot] = constant(
                slot.scalar == Scalar::float32 ? static_cast<double>(std::bit_cast<float>(slot.bits))
                                               : static_cast<double>(std::bit_cast<std::int32_t>(slot.bits)),
                slot.scalar);
        for (const auto* ports : {&program_.inputs, &program_.uniforms})
            for (const evaluate::Port& port : *ports) {
                const auto field =
                    std::find_if(space_.fields.begin(), space_.fields.end(),
                                 [&](const sanitize::InputField& one) { return one.name == port.name; });
                if (field == space_.fields.end()) continue;
                for (std::uint32_t i = 0; i < port.components; ++i)
                    state.slots[port.slot + i] =
                        add({.code = kInput,
                             .part = i,
                             .field = static_cast<std::uint32_t>(field - space_.fields.begin()),
                             .scalar = port.scalar},
                            {}, range_of(*field, i, has_tiny_inputs_));
            }
        for (const evaluate::Port& port : program_.outputs) {
            OutputValues output;
            output.name = port.name;
            output.expressions.assign(port.components, 0);
            expressions_.outputs.push_back(std::move(output));
        }
        waiting_[0].push_back(std::move(state));
    }

    void finish() {
        if (ended_.empty()) return;
        const State state = joined(std::move(ended_));
        for (std::size_t i = 0; i < program_.outputs.size(); ++i)
            for (std::uint32_t c = 0; c < program_.outputs[i].components; ++c)
                expressions_.outputs[i].expressions[c] = state.slots[program_.outputs[i].slot + c];
    }

    // ---- Control flow ----

    /// Ways that meet: a slot that differs holds the value of the way that was taken.
    State joined(std::vector<State> states) {
        if (states.size() == 1) {
            enter(states.front().context);
            return std::move(states.front());
        }
        std::uint32_t outer = states.front().context;
        for (const State& state : states) outer = common_context(expressions_.contexts, outer, state.context);
        std::vector<std::uint32_t> differing;
        for (std::uint32_t slot = 0; slot < program_.slots; ++slot) {
            if (!is_carried_[slot]) continue;
            for (const State& state : states)
                if (state.slots[slot] != states.front().slots[slot]) {
                    differing.push_back(slot);
                    break;
                }
        }
        std::vector<std::uint32_t> from;
        for (State& state : states) {
            from.push_back(state.context);
            enter(state.context);
            for (const std::uint32_t slot : differing) {
                const Id id = state.slots[slot];
                if (expressions_.all[id].context != state.context)
                    state.slots[slot] = make({.code = kKept, .scalar = scalar_of(id)}, {id});
            }
        }
        enter(outer);
        const std::uint32_t ways = list(from);
        State result = std::move(states.front());
        result.context = outer;
        for (const std::uint32_t slot : differing) {
            std::vector<Id> operands{result.slots[slot]};
            Scalar scalar = scalar_of(operands.front());
            for (std::size_t i = 1; i < states.size(); ++i) {
                operands.push_back(states[i].slots[slot]);
                if (operands.back() != 0) scalar = scalar_of(operands.back());
            }
            result.slots[slot] = make({.code = kJoined, .field = ways, .scalar = scalar}, operands);
        }
        return result;
    }

    void run_block(const Block& block, State& state) {
        for (std::uint32_t at = block.first; at < block.first + block.count; ++at) run_operation(at, state);
        switch (block.end) {
            case Block::End::jump:
            case Block::End::finish:
                return take(program_.edges[block.edge], state);
            case Block::End::kill:
                return;
            case Block::End::branch: {
                const Id condition = state.slots[block.condition];
                choose(condition, program_.edges[block.edge], program_.edges[block.edge + 1], state);
                return;
            }
            case Block::End::select: {
                for (std::uint32_t label = 0; label + 1 < block.edges; ++label) {
                    const auto number = std::bit_cast<std::int32_t>(program_.words[block.labels + label]);
                    const Id condition =
                        make({.code = spv::OpIEqual, .scalar = Scalar::boolean},
                             {state.slots[block.condition], constant(number, Scalar::int32)});
                    const std::uint32_t outer = context_;
                    if (const std::uint32_t chosen = inside(outer, condition, true);
                        is_possible(condition, chosen, true)) {
                        State other = state;
                        other.context = chosen;
                        take(program_.edges[block.edge + label + 1], other);
                    }
                    const std::uint32_t rest = inside(outer, condition, false);
                    if (!is_possible(condition, rest, false)) return;
                    state.context = rest;
                    enter(rest);
                }
                return take(program_.edges[block.edge], state);
            }
        }
    }

    bool is_possible(Id condition, std::uint32_t context, bool is_true) {
        const std::uint32_t outer = context_;
        const Range& range = ranges_.range(condition);
        if (range.is_one() && (range.low != 0) != is_true) return false;
        enter(context);
        const bool is_reached = ranges_.is_reached();
        enter(outer);
        return is_reached;
    }

    void choose(Id condition, const evaluate::Edge& if_true, const evaluate::Edge& if_false, State& state) {
        const Range range = ranges_.range(condition);
        if (range.is_one()) return take(range.low != 0 ? if_true : if_false, state);
        const std::uint32_t outer = context_;
        const std::uint32_t yes = inside(outer, condition, true);
        const std::uint32_t no = inside(outer, condition, false);
        const bool may_be_true = is_possible(condition, yes, true);
        const bool may_be_false = is_possible(condition, no, false);
        if (may_be_true) {
            State other = state;
            other.context = yes;
            take(if_true, other);
        }
        if (may_be_false) {
            state.context = no;
            take(if_false, state);
        }
    }

    void take(const evaluate::Edge& edge, State& state) {
        for (std::uint32_t at = edge.first_copy; at < edge.first_copy + edge.copies; ++at) {
            const Operation& copy = program_.copies[at];
            for (std::uint32_t i = 0; i < copy.count; ++i)
                state.slots[copy.result + i] = state.slots[copy.operands[0] + i];
        }
        if (edge.target == Program::kEnd)
            ended_.push_back(std::move(state));
        else
            waiting_[edge.target].push_back(std::move(state));
    }

    // ---- Operations ----

    void run_operation(std::uint32_t at, State& state) {
        const Operation& operation = program_.operations[at];
        const OperationInfo& info = program_.infos[at];
        const evaluate::Row& row = evaluate::row_of(operation);
        std::vector<Id> before;
        for (const Slice& operand : info.operands)
            for (std::uint32_t i = 0; i < operand.count; ++i) before.push_back(state.slots[operand.slot + i]);
        std::vector<Id> results = results_of(operation, info, row, before, state);
        if (info.is_relaxed && info.result.scalar == Scalar::float32)
            for (Id& result : results) result = make({.code = kHalf}, {result});
        if (row.code != evaluate::kScatter)
            for (std::uint32_t i = 0; i < results.size(); ++i) state.slots[operation.result + i] = results[i];
        if (row.is_bookkeeping || row.kind == evaluate::Kind::load || row.kind == evaluate::Kind::store)
            return;
        Site site;
        site.operation = at;
        site.context = context_;
        site.first_operand = static_cast<std::uint32_t>(expressions_.site_operands.size());
        expressions_.site_operands.insert(expressions_.site_operands.end(), before.begin(), before.end());
        site.first_result = static_cast<std::uint32_t>(expressions_.site_operands.size());
        site.results = static_cast<std::uint32_t>(results.size());
        expressions_.site_operands.insert(expressions_.site_operands.end(), results.begin(), results.end());
        expressions_.events.push_back(
            {Event::Kind::site, static_cast<std::uint32_t>(expressions_.sites.size())});
        expressions_.sites.push_back(site);
    }

    /// The components of an operand.
    static std::vector<Id> part(const OperationInfo& info, const std::vector<Id>& all, std::size_t operand) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < operand; ++i) first += info.operands[i].count;
        return {all.begin() + static_cast<std::ptrdiff_t>(first),
                all.begin() + static_cast<std::ptrdiff_t>(first + info.operands[operand].count)};
    }

    std::vector<Id> results_of(const Operation& operation, const OperationInfo& info,
                               const evaluate::Row& row, const std::vector<Id>& operands, State& state) {
        const std::uint32_t* words = program_.words.data() + operation.extra;
        std::vector<Id> results;
        const auto whole = [&](std::uint32_t code, std::uint32_t count) {
            for (std::uint32_t i = 0; i < count; ++i)
                results.push_back(make(
                    {.code = code, .part = i, .scalar = info.result.scalar, .is_precise = info.is_precise},
                    operands));
        };
        switch (row.code) {
            case evaluate::kCopy:
            case spv::OpLoad:
            case spv::OpStore:
            case spv::OpCopyObject:
            case spv::OpCompositeExtract:
                results.assign(state.slots.begin() + operation.operands[0],
                               state.slots.begin() + operation.operands[0] + operation.count);
                return results;
            case spv::OpCompositeConstruct:
                for (std::uint32_t word = 0; word < operation.extras; word += 2)
                    for (std::uint32_t i = 0; i < words[word + 1]; ++i)
                        results.push_back(state.slots[words[word] + i]);
                return results;
            case spv::OpVectorShuffle:
                for (std::uint32_t i = 0; i < operation.count; ++i) results.push_back(state.slots[words[i]]);
                return results;
            case spv::OpCompositeInsert: {
                results.assign(state.slots.begin() + operation.operands[1],
                               state.slots.begin() + operation.operands[1] + operation.count);
                for (std::uint32_t i = 0; i < words[1]; ++i)
                    results[words[0] + i] = state.slots[operation.operands[0] + i];
                return results;
            }
            case spv::OpAccessChain: {
                Id offset = words[0] == 0 ? constant(0, Scalar::int32) : state.slots[words[0] - 1];
                std::vector<std::uint32_t> all =
                    words[0] == 0 ? std::vector<std::uint32_t>{0} : possible_offsets(offset);
                for (std::uint32_t word = 1; word < operation.extras; word += 3) {
                    const Id index = clamped_index(state.slots[words[word]], words[word + 1]);
                    const Id step = make({.code = spv::OpIMul, .scalar = Scalar::int32},
                                         {index, constant(words[word + 2], Scalar::int32)});
                    offset = make({.code = spv::OpIAdd, .scalar = Scalar::int32}, {offset, step});
                    std::vector<std::uint32_t> further;
                    for (const std::uint32_t start : all)
                        for (std::uint32_t i = 0; i < words[word + 1]; ++i)
                            further.push_back(start + i * words[word + 2]);
                    all = std::move(further);
                }
                offsets_[offset] = std::move(all);
                return {offset};
            }
            case evaluate::kGather:
                return gather(operation, state);
            case evaluate::kScatter:
                return scatter(operation, state);
            case spv::OpVectorExtractDynamic: {
                std::vector<Id> all = part(info, operands, 0);
                const Id index = clamped_index(part(info, operands, 1)[0], all.size());
                return {indexed(index, all, counting(all.size(), 1))};
            }
            case spv::OpVectorInsertDynamic: {
                const std::vector<Id> all = part(info, operands, 0);
                const Id index = clamped_index(part(info, operands, 2)[0], all.size());
                for (std::uint32_t i = 0; i < all.size(); ++i)
                    results.push_back(replaced(index, i, part(info, operands, 1)[0], all[i]));
                return results;
            }
            case spv::OpSelect: {
                const std::vector<Id> conditions = part(info, operands, 0);
                const std::vector<Id> yes = part(info, operands, 1);
                const std::vector<Id> no = part(info, operands, 2);
                for (std::size_t i = 0; i < yes.size(); ++i)
                    results.push_back(selected(conditions[conditions.size() == 1 ? 0 : i], yes[i], no[i]));
                return results;
            }
            case spv::OpAny:
            case spv::OpAll: {
                Id all = operands[0];
                for (std::size_t i = 1; i < operands.size(); ++i)
                    all = make({.code = row.code == spv::OpAny ? spv::OpLogicalOr : spv::OpLogicalAnd,
                                .scalar = Scalar::boolean},
                               {all, operands[i]});
                return {all};
            }
            case spv::OpDot:
                return {make({.code = kSumOfProducts, .is_precise = info.is_precise}, operands)};
            case spv::OpMatrixTimesVector:
            case spv::OpVectorTimesMatrix:
            case spv::OpMatrixTimesMatrix:
            case spv::OpOuterProduct:
                for (std::uint32_t column = 0; column < words[0]; ++column)
                    for (std::uint32_t line = 0; line < words[1]; ++line) {
                        std::vector<Id> factors;
                        for (std::uint32_t term = 0; term < words[2]; ++term)
                            factors.push_back(state.slots[operation.operands[0] + line + term * words[1]]);
                        for (std::uint32_t term = 0; term < words[2]; ++term)
                            factors.push_back(state.slots[operation.operands[1] + column * words[2] + term]);
                        results.push_back(make({.code = kSumOfProducts}, factors));
                    }
                return results;
            case spv::OpTranspose:
                for (std::uint32_t column = 0; column < words[0]; ++column)
                    for (std::uint32_t line = 0; line < words[1]; ++line)
                        results.push_back(operands[line * words[0] + column]);
                return results;
            case extended(GLSLstd450Length):
            case extended(GLSLstd450Distance):
            case extended(GLSLstd450Determinant):
                return {make({.code = row.code}, operands)};
            case extended(GLSLstd450Normalize):
            case extended(GLSLstd450Cross):
            case extended(GLSLstd450Reflect):
            case extended(GLSLstd450Refract):
            case extended(GLSLstd450FaceForward):
            case extended(GLSLstd450MatrixInverse):
                whole(row.code, operation.count);
                return results;
            case extended(GLSLstd450ModfStruct):
            case extended(GLSLstd450FrexpStruct):
            case spv::OpIAddCarry:
            case spv::OpISubBorrow:
            case spv::OpUMulExtended:
            case spv::OpSMulExtended:
                for (std::uint32_t half = 0; half < 2; ++half)
                    for (std::uint32_t i = 0; i < operation.count; ++i)
                        results.push_back(
                            make({.code = row.code,
                                  .part = half,
                                  .scalar = row.code == extended(GLSLstd450ModfStruct) ||
                                                    (row.code == extended(GLSLstd450FrexpStruct) && half == 0)
                                                ? Scalar::float32
                                                : Scalar::int32},
                                 {operands[i],
                                  operands[operands.size() > operation.count ? operation.count + i : i]}));
                return results;
            case extended(GLSLstd450PackSnorm4x8):
            case extended(GLSLstd450PackUnorm4x8):
            case extended(GLSLstd450PackSnorm2x16):
            case extended(GLSLstd450PackUnorm2x16):
            case extended(GLSLstd450PackHalf2x16):
                return {make({.code = row.code, .scalar = info.result.scalar}, operands)};
            default:
                break;
        }
        if (row.kind == evaluate::Kind::image) return texels(operation, info, row, state);
        // Component by component; an operand of one component goes with all.
        const std::uint32_t count = std::max(info.result.count, 1U);
        for (std::uint32_t i = 0; i < count; ++i) {
            std::vector<Id> own;
            std::size_t first = 0;
            for (const Slice& operand : info.operands) {
                own.push_back(operands[first + (operand.count == 1 ? 0 : std::min(i, operand.count - 1))]);
                first += operand.count;
            }
            results.push_back(make({.code = row.code,
                                    .part = row.signature.empty() ? i : 0,
                                    .scalar = info.result.scalar,
                                    .is_precise = info.is_precise},
                                   std::move(own)));
        }
        return results;
    }

    std::vector<Id> texels(const Operation& operation, const OperationInfo& info, const evaluate::Row& row,
                           const State& state) {
        const evaluate::ImageCall call = evaluate::image_call_of(program_, operation);
        std::vector<Id> results;
        for (std::uint32_t i = 0; i < operation.count; ++i) {
            Range known = texel(call, state, i);
            if (row.code == spv::OpImageQuerySizeLod || row.code == spv::OpImageQuerySize)
                known = whole_between(1, 16384);
            else if (row.code == spv::OpImageQueryLevels)
                known = whole_between(1, 15);
            else if (row.code == spv::OpImageQueryLod)
                known = between(-1000, 1000);
            results.push_back(add({.code = kTexel, .part = i, .scalar = info.result.scalar}, {}, known));
        }
        return results;
    }

    /// What a texture may answer: what its domain says of the channel, or 0, as beyond a border.
    Range texel(const evaluate::ImageCall& call, const State& state, std::uint32_t component) {
        if (call.reference != 0) return between(0, 1);
        // The stage itself may have written it.
        if (call.is_storage != 0) return call.has_int_result != 0 ? kAnyInt : kAnything;
        const Id image = expressions_.origin(state.slots[call.image - 1]);
        Range all = kNothing;
        for (std::size_t index = 0; index < program_.images.size(); ++index) {
            if (expressions_.all[image].code == kConstant &&
                expressions_.known[image].low != static_cast<double>(index))
                continue;
            const auto field =
                std::ranges::find(space_.fields, program_.images[index].name, &sanitize::InputField::name);
            if (field == space_.fields.end()) return call.has_int_result != 0 ? kAnyInt : kAnything;
            for (std::size_t channel = 0; channel < std::min<std::size_t>(4, field->channels.size());
                 ++channel) {
                if (call.component == 0 && channel != component) continue;  // else which one a gather is told
                const Domain& domain = field->channels[channel];
                all = hull(all, call.has_int_result != 0
                                    ? whole_numbers(field->scalar, domain.low, domain.high)
                                    : between(nearest_float(domain.low), nearest_float(domain.high)));
                for (const double also : domain.also)
                    all = hull(all, call.has_int_result != 0 ? whole_numbers(field->scalar, also, also)
                                                             : exactly(nearest_float(also)));
            }
        }
        return hull(all, exactly(0));
    }

    static std::vector<std::uint32_t> counting(std::size_t count, std::uint32_t step) {
        std::vector<std::uint32_t> numbers;
        for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<std::uint32_t>(i) * step);
        return numbers;
    }

    Id clamped_index(Id index, std::size_t count) {
        return make(
            {.code = extended(GLSLstd450SClamp), .scalar = Scalar::int32},
            {index, constant(0, Scalar::int32), constant(static_cast<double>(count) - 1, Scalar::int32)});
    }

    /// Of the offset in that slot; only those within what is known of it.
    std::vector<std::uint32_t> possible_offsets(Id offset) {
        const Range& range = ranges_.range(offset);
        if (range.is_one()) return {static_cast<std::uint32_t>(range.low)};
        std::vector<std::uint32_t> all;
        const auto known = offsets_.find(expressions_.origin(offset));
        if (known != offsets_.end())
            for (const std::uint32_t one : known->second)
                if (one >= range.low && one <= range.high) all.push_back(one);
        if (known == offsets_.end())
            for (double one = std::max(0.0, range.low); one <= std::min(range.high, 4096.0); ++one)
                all.push_back(static_cast<std::uint32_t>(one));
        return all;
    }

    std::vector<Id> gather(const Operation& operation, State& state) {
        const Id offset = state.slots[operation.operands[1]];
        std::vector<Id> results;
        const std::vector<std::uint32_t> offsets = possible_offsets(offset);
        for (std::uint32_t i = 0; i < operation.count; ++i) {
            std::vector<Id> all;
            for (const std::uint32_t at : offsets)
                all.push_back(slot_at(state, operation.operands[0] + i + at));
            results.push_back(all.size() == 1 ? plain(all.front()) : indexed(offset, all, offsets));
        }
        return results;
    }

    Id slot_at(const State& state, std::uint32_t slot) const {
        return slot < state.slots.size() ? state.slots[slot] : 0;
    }

    std::vector<Id> scatter(const Operation& operation, State& state) {
        const Id offset = state.slots[operation.operands[1]];
        const std::vector<std::uint32_t> offsets = possible_offsets(offset);
        for (const std::uint32_t at : offsets)
            for (std::uint32_t i = 0; i < operation.count; ++i) {
                const std::uint32_t slot = operation.result + i + at;
                if (slot >= state.slots.size()) continue;
                const Id given = state.slots[operation.operands[0] + i];
                state.slots[slot] =
                    offsets.size() == 1 ? plain(given) : replaced(offset, at, given, state.slots[slot]);
            }
        return {};
    }

    /// Variants of arithmetic that know terms and factors forget them here.
    Id plain(Id id) {
        const Known& known = ranges_[id];
        if (!known.has_product && !known.has_terms) return id;
        return make({.code = kPlain, .scalar = scalar_of(id)}, {id});
    }

    Id indexed(Id offset, const std::vector<Id>& all, const std::vector<std::uint32_t>& offsets) {
        const Range& range = ranges_.range(offset);
        if (range.is_one())
            for (std::size_t i = 0; i < offsets.size(); ++i)
                if (offsets[i] == range.low) return plain(all[i]);
        std::vector<Id> operands{offset};
        operands.insert(operands.end(), all.begin(), all.end());
        return make({.code = kIndexed, .field = list(offsets), .scalar = scalar_of(all.back())}, operands);
    }

    Id replaced(Id offset, std::uint32_t at, Id given, Id old) {
        const Range& range = ranges_.range(offset);
        if (range.is_one()) return range.low == at ? plain(given) : old;
        if (range.low > at || range.high < at) return old;
        return make({.code = kReplaced, .part = at, .scalar = scalar_of(given)}, {offset, given, old});
    }

    Id selected(Id condition, Id yes, Id no) {
        const Range& range = ranges_.range(condition);
        if (range.is_one()) return range.low != 0 ? yes : no;
        if (yes == no) return yes;
        const std::uint32_t outer = context_;
        const std::uint32_t contexts[] = {inside(outer, condition, true), inside(outer, condition, false)};
        std::vector<Id> operands;
        for (std::size_t i = 0; i < 2; ++i) {
            enter(contexts[i]);
            const Id id = i == 0 ? yes : no;
            operands.push_back(make({.code = kKept, .scalar = scalar_of(id)}, {id}));
        }
        enter(outer);
        return make({.code = kJoined, .field = list({contexts[0], contexts[1]}), .scalar = scalar_of(yes)},
                    operands);
    }

    const Program& program_;
    const sanitize::InputSpace& space_;
    Expressions expressions_;
    Ranges ranges_;
    bool has_tiny_inputs_;
    std::uint32_t context_ = 0;
    std::map<std::uint32_t, std::vector<State>> waiting_;  ///< by the block that they wait at
    std::vector<State> ended_;
    std::vector<std::uint32_t> turns_;  ///< of each block
    std::vector<bool> is_carried_;      ///< of each slot: read in another block than it is written in
    std::map<std::pair<std::uint64_t, Scalar>, Id> constants_;
    std::map<std::tuple<std::uint32_t, Id, bool>, std::uint32_t> inner_contexts_;
    std::map<std::vector<std::uint32_t>, std::uint32_t> lists_;
    std::unordered_map<Key, std::vector<Id>, HashOfKey> known_expressions_;
    std::unordered_map<Id, std::vector<std::uint32_t>> offsets_;  ///< of each address all that it may be
};

}  // namespace

Result<Expressions> unroll(const evaluate::Program& program, const sanitize::InputSpace& space,
                           bool has_tiny_inputs) {
    return Unroller(program, space, has_tiny_inputs).run();
}

}  // namespace gobo::prove
