#include "lab/prove/unroll.hpp"

#include <bit>
#include <map>

#include <fmt/format.h>
#include <spirv/unified1/spirv.hpp>

#include "lab/evaluate/functions.hpp"
#include "lab/prove/input_range.hpp"
#include "lab/prove/unroll_operations.hpp"
#include "lab/sanitize/finding.hpp"

namespace gobo::prove {
namespace {

using evaluate::Block;
using evaluate::Operation;
using evaluate::OperationInfo;
using evaluate::Program;
using evaluate::Slice;
using Id = ExpressionBuilder::Id;

constexpr std::size_t kMostExpressions = 300000;
constexpr std::uint32_t kMostTurns = 1U << 16U;
constexpr std::size_t kMostOpenTurns = 256;  ///< the work grows with their square

/// Which expression each slot holds, in a context.
struct State {
    std::uint32_t context = 0;
    Slots slots;
};

class Unroller {
  public:
    Unroller(const Program& program, const sanitize::InputSpace& space, bool has_tiny_inputs)
        : program_(program),
          space_(space),
          builder_(space),
          operations_(program, space, builder_),
          has_tiny_inputs_(has_tiny_inputs) {}

    Result<Expressions> run() {
        begin();
        while (!waiting_.empty()) {
            const auto first = waiting_.begin();
            const std::uint32_t block = first->first;
            std::vector<State> states = std::move(first->second);
            waiting_.erase(first);
            State state = joined(std::move(states));
            if (program_.blocks[block].is_loop && turns_[block] > kMostOpenTurns &&
                depth_of(state.context) > kMostOpenTurns)
                return fail(evaluate::error_at(
                    program_.places[program_.blocks[block].place],
                    fmt::format(
                        "whether the loop ends stays open for {} turns: nothing is proven of this stage",
                        kMostOpenTurns)));
            if (program_.blocks[block].is_loop && ++turns_[block] > kMostTurns)
                return fail(evaluate::error_at(
                    program_.places[program_.blocks[block].place],
                    fmt::format("the loop may take more than {} turns: nothing is proven of this stage",
                                kMostTurns)));
            run_block(program_.blocks[block], state);
            if (expressions().all.size() > kMostExpressions)
                return fail(
                    evaluate::error_at(program_.places[program_.blocks[block].place],
                                       "the stage is too long to be proven: its loops unrolled are more than "
                                       "300000 operations"));
        }
        finish();
        return std::move(expressions());
    }

  private:
    void begin() {
        turns_.resize(program_.blocks.size());
        expressions().has_relaxed = std::ranges::any_of(program_.infos, &OperationInfo::is_relaxed);
        builder_.add({.code = kUnknown}, {});
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
        for (const evaluate::ConstantSlot& slot : program_.constants) {
            Id& id = state.slots[slot.slot];
            id = builder_.constant(slot.scalar == Scalar::float32
                                       ? static_cast<double>(std::bit_cast<float>(slot.bits))
                                       : static_cast<double>(std::bit_cast<std::int32_t>(slot.bits)),
                                   slot.scalar);
            if (slot.is_relaxed) id = builder_.make({.code = kHalf}, {id});
        }
        for (const auto* ports : {&program_.inputs, &program_.uniforms})
            for (const evaluate::Port& port : *ports) {
                const auto field = std::ranges::find(space_.fields, port.name, &sanitize::InputField::name);
                if (field == space_.fields.end()) continue;
                for (std::uint32_t i = 0; i < port.components; ++i)
                    state.slots[port.slot + i] =
                        builder_.add({.code = kInput,
                                      .part = i,
                                      .field = static_cast<std::uint32_t>(field - space_.fields.begin()),
                                      .scalar = port.scalar},
                                     {}, range_of(*field, i, has_tiny_inputs_));
            }
        for (const evaluate::Port& port : program_.outputs) {
            OutputValues output;
            output.name = port.name;
            output.expressions.assign(port.components, 0);
            expressions().outputs.push_back(std::move(output));
        }
        waiting_[0].push_back(std::move(state));
    }

    void finish() {
        if (ended_.empty()) return;
        const State state = joined(std::move(ended_));
        for (std::size_t i = 0; i < program_.outputs.size(); ++i)
            for (std::uint32_t c = 0; c < program_.outputs[i].components; ++c)
                expressions().outputs[i].expressions[c] = state.slots[program_.outputs[i].slot + c];
    }

    /// Ways that meet: a slot that differs holds the value of the way that was taken.
    State joined(std::vector<State> states) {
        if (states.size() == 1) {
            builder_.enter(states.front().context);
            return std::move(states.front());
        }
        std::uint32_t outer = states.front().context;
        for (const State& state : states)
            outer = common_context(expressions().contexts, outer, state.context);
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
            builder_.enter(state.context);
            for (const std::uint32_t slot : differing) {
                const Id id = state.slots[slot];
                if (expressions().all[id].context != state.context)
                    state.slots[slot] =
                        builder_.make({.code = kKept, .scalar = builder_.scalar_of(id)}, {id});
            }
        }
        builder_.enter(outer);
        const std::uint32_t ways = builder_.list(from);
        State result = std::move(states.front());
        result.context = outer;
        for (const std::uint32_t slot : differing) {
            std::vector<Id> operands{result.slots[slot]};
            Scalar scalar = builder_.scalar_of(operands.front());
            for (std::size_t i = 1; i < states.size(); ++i) {
                operands.push_back(states[i].slots[slot]);
                if (operands.back() != 0) scalar = builder_.scalar_of(operands.back());
            }
            result.slots[slot] = builder_.make({.code = kJoined, .field = ways, .scalar = scalar}, operands);
        }
        return result;
    }

    /// How many conditions it stands behind.
    [[nodiscard]] std::size_t depth_of(std::uint32_t context) {
        std::size_t depth = 0;
        for (; context != 0; context = expressions().contexts[context].parent) ++depth;
        return depth;
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
                    const Id condition = builder_.make(
                        {.code = spv::OpIEqual, .scalar = Scalar::boolean},
                        {state.slots[block.condition], builder_.constant(number, Scalar::int32)});
                    const std::uint32_t outer = builder_.context();
                    if (const std::uint32_t chosen = builder_.inside(outer, condition, true);
                        is_possible(condition, chosen, true)) {
                        State other = state;
                        other.context = chosen;
                        take(program_.edges[block.edge + label + 1], other);
                    }
                    const std::uint32_t rest = builder_.inside(outer, condition, false);
                    if (!is_possible(condition, rest, false)) return;
                    state.context = rest;
                    builder_.enter(rest);
                }
                return take(program_.edges[block.edge], state);
            }
        }
    }

    bool is_possible(Id condition, std::uint32_t context, bool is_true) {
        const std::uint32_t outer = builder_.context();
        const Range& range = builder_.ranges().range(condition);
        if (range.is_one() && (range.low != 0) != is_true) return false;
        builder_.enter(context);
        const bool is_reached = builder_.ranges().is_reached();
        builder_.enter(outer);
        return is_reached;
    }

    void choose(Id condition, const evaluate::Edge& if_true, const evaluate::Edge& if_false, State& state) {
        const Range range = builder_.ranges().range(condition);
        if (range.is_one()) return take(range.low != 0 ? if_true : if_false, state);
        const std::uint32_t outer = builder_.context();
        const std::uint32_t yes = builder_.inside(outer, condition, true);
        const std::uint32_t no = builder_.inside(outer, condition, false);
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

    void run_operation(std::uint32_t at, State& state) {
        const Operation& operation = program_.operations[at];
        const OperationInfo& info = program_.infos[at];
        const evaluate::Row& row = evaluate::row_of(operation);
        std::vector<Id> before;
        for (const Slice& operand : info.operands)
            for (std::uint32_t i = 0; i < operand.count; ++i) before.push_back(state.slots[operand.slot + i]);
        std::vector<Id> results = operations_.results_of(operation, info, row, before, state.slots);
        using Kind = evaluate::Kind;
        const bool narrows = sanitize::narrows_to_half(program_, at);
        const bool is_passed_on = narrows && row.kind != Kind::convert && row.kind != Kind::derivative;
        if (info.is_relaxed && info.result.scalar == Scalar::float32)
            for (Id& result : results)
                result = builder_.make({.code = kHalf, .part = is_passed_on ? 1U : 0U}, {result});
        if (row.code != evaluate::kScatter)
            for (std::uint32_t i = 0; i < results.size(); ++i) state.slots[operation.result + i] = results[i];
        const bool is_wide =
            narrows && std::ranges::any_of(before, [&](Id id) { return !builder_.ranges().is_half(id); });
        const bool is_silent = row.is_bookkeeping || row.kind == Kind::load || row.kind == Kind::store;
        if (is_silent && !is_wide) return;
        Site site;
        site.operation = at;
        site.context = builder_.context();
        site.first_operand = static_cast<std::uint32_t>(expressions().site_operands.size());
        expressions().site_operands.insert(expressions().site_operands.end(), before.begin(), before.end());
        site.first_result = static_cast<std::uint32_t>(expressions().site_operands.size());
        site.results = static_cast<std::uint32_t>(results.size());
        expressions().site_operands.insert(expressions().site_operands.end(), results.begin(), results.end());
        expressions().events.push_back(
            {Event::Kind::site, static_cast<std::uint32_t>(expressions().sites.size())});
        expressions().sites.push_back(site);
    }

    [[nodiscard]] Expressions& expressions() { return builder_.expressions(); }

    const Program& program_;
    const sanitize::InputSpace& space_;
    ExpressionBuilder builder_;
    OperationUnroller operations_;
    bool has_tiny_inputs_;
    std::map<std::uint32_t, std::vector<State>> waiting_;  ///< by the block that they wait at
    std::vector<State> ended_;
    std::vector<std::uint32_t> turns_;  ///< of each block
    std::vector<bool> is_carried_;      ///< of each slot: read in another block than it is written in
};

}  // namespace

Result<Expressions> unroll(const evaluate::Program& program, const sanitize::InputSpace& space,
                           bool has_tiny_inputs) {
    return Unroller(program, space, has_tiny_inputs).run();
}

}  // namespace gobo::prove
