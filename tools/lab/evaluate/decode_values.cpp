// Slots of values: how long they live, when two values may share them.
#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {
namespace {

/// How far ahead a write to a variable is looked for before a load copies instead of sharing.
constexpr std::uint32_t kLookAhead = 4096;

}  // namespace

/// Slots that nothing else ever uses.
std::uint32_t Decoder::permanent(std::uint32_t count) {
    const std::uint32_t slot = program_.slots;
    if (count > kLargestProgram - std::min(slot, kLargestProgram)) {
        if (!error_) error_ = error_at({}, "the stage needs more memory than an evaluation may have");
        return 0;
    }
    program_.slots += count;
    return slot;
}

/// Slots for a value of that many uses, given back after the last one.
std::uint32_t Decoder::temporary(std::uint32_t count, std::uint32_t uses, int& allocation) {
    std::vector<std::uint32_t>& free = free_slots_[count];
    std::uint32_t slot = 0;
    if (free.empty()) {
        slot = permanent(count);
    } else {
        slot = free.back();
        free.pop_back();
    }
    allocation = static_cast<int>(allocations_.size());
    allocations_.push_back({slot, count, uses});
    if (uses == 0) to_free_.push_back(allocation);
    return slot;
}

void Decoder::release(std::uint32_t id) {
    const auto found = frame().values.find(id);
    if (found == frame().values.end() || found->second.allocation < 0) return;
    Allocation& allocation = allocations_[static_cast<std::size_t>(found->second.allocation)];
    if (allocation.remaining > 0 && --allocation.remaining == 0) to_free_.push_back(found->second.allocation);
}

void Decoder::free_allocation(int index) {
    Allocation& allocation = allocations_[static_cast<std::size_t>(index)];
    if (allocation.is_free || allocation.remaining > 0) return;
    allocation.is_free = true;
    free_slots_[allocation.count].push_back(allocation.slot);
}

/// Where the instruction shall write its result. Operations write all lanes; a result that is used outside
/// its block is copied by those lanes only that are in it, since others may have left a loop with an older
/// value.
std::uint32_t Decoder::define(const Instruction& instruction) {
    const std::uint32_t count = types_[instruction.type].slots;
    const Uses& uses = frame().uses[instruction.result];
    Value& value = frame().values[instruction.result];
    value = {instruction.type, 0, -1, -1, intern(module_.name_of(instruction.result))};
    if (count == 0) {
        report(instruction, fmt::format("{} has a result without a value", opcode_name(instruction.opcode)));
        return 0;
    }
    if (uses.is_local) {
        value.slot = temporary(count, uses.count, value.allocation);
        return value.slot;
    }
    value.slot = permanent(count);
    int scratch = -1;
    kept_ = Kept{value.slot, temporary(count, 0, scratch), count};
    return kept_->temporary;
}

/// The result is part of a value that exists already.
void Decoder::share(const Instruction& instruction, const Value& value) {
    frame().values[instruction.result] = value;
    if (value.allocation < 0) return;
    Allocation& allocation = allocations_[static_cast<std::size_t>(value.allocation)];
    allocation.remaining += frame().uses[instruction.result].count;
}

bool Decoder::may_share(const Instruction& instruction, const Value& value) {
    if (value.allocation < 0 && value.variable < 0) return true;
    const Uses& uses = frame().uses[instruction.result];
    if (!uses.is_local) return false;
    return value.variable < 0 || !is_written(value.variable, frame().at + 1, uses.last);
}

/// Whether an instruction after `from` up to `to`, all of one block, may write the variable. The last one
/// reads before it writes if it is a store.
bool Decoder::is_written(int variable, std::uint32_t from, std::uint32_t to) {
    if (to > from + kLookAhead) return true;
    for (std::uint32_t at = from; at <= to && at < module_.instructions.size(); ++at) {
        const Instruction& instruction = module_.instructions[at];
        switch (instruction.opcode) {
            case spv::OpStore: {
                const int written = variable_of(instruction.word(1));
                if (at != to && (written == variable || written < 0)) return true;
                break;
            }
            case spv::OpFunctionCall:
            case spv::OpCopyMemory:
                return true;
            case spv::OpExtInst: {
                const auto number = static_cast<GLSLstd450>(instruction.word(4));
                if (number == GLSLstd450Modf || number == GLSLstd450Frexp) return true;
                break;
            }
            default:
                break;
        }
    }
    return false;
}

/// The variable that a pointer leads into, -1 where that cannot be told yet.
int Decoder::variable_of(std::uint32_t pointer) const {
    for (std::uint32_t level = 0; level < 64; ++level) {
        const auto& local = frames_.back()->pointers;
        if (const auto found = local.find(pointer); found != local.end()) return found->second.variable;
        if (const auto found = globals_.find(pointer); found != globals_.end()) return found->second.variable;
        const Instruction* definition = module_.definition(pointer);
        if (definition == nullptr) return -1;
        pointer = definition->word(3);
    }
    return -1;
}

/// Copies a result that outlives its block, and gives back what was used for the last time.
void Decoder::finish_instruction(const Instruction& instruction) {
    for_each_value_operand(instruction, [&](std::uint32_t id) { release(id); });
    if (kept_) {
        Value temporary_value{instruction.type, kept_->temporary};
        emit(kKeep, instruction, kept_->count, kept_->slot, {temporary_value});
        kept_.reset();
    }
    for (const int allocation : to_free_) free_allocation(allocation);
    to_free_.clear();
}

Value Decoder::value(const Instruction& instruction, std::uint32_t id) {
    if (!frames_.empty()) {
        const auto found = frame().values.find(id);
        if (found != frame().values.end()) return found->second;
    }
    const auto constant = constants_.find(id);
    if (constant != constants_.end()) return constant->second;
    report(instruction,
           fmt::format("{} uses id {}, which has no value here", opcode_name(instruction.opcode), id));
    return {};
}

Pointer Decoder::pointer(const Instruction& instruction, std::uint32_t id) {
    const auto local = frame().pointers.find(id);
    if (local != frame().pointers.end()) return local->second;
    const auto global = globals_.find(id);
    if (global != globals_.end()) return global->second;
    report(instruction,
           fmt::format("{} uses id {}, which is no variable", opcode_name(instruction.opcode), id));
    return {};
}

std::optional<std::uint32_t> Decoder::constant_index(std::uint32_t id) const {
    const auto found = constant_bits_.find(id);
    if (found == constant_bits_.end() || found->second.size() != 1) return std::nullopt;
    return found->second.front();
}

std::uint32_t Decoder::intern(const std::string& name) {
    if (name.empty()) return 0;
    const auto [found, is_new] =
        name_indices_.try_emplace(name, static_cast<std::uint32_t>(program_.names.size()));
    if (is_new) program_.names.push_back(name);
    return found->second;
}

Slice Decoder::slice(const Value& value) const {
    const Type& type = types_[value.type];
    Scalar scalar = type.scalar;
    if (type.shape == Type::Shape::array || type.shape == Type::Shape::structure) {
        const std::vector<Scalar> layout = types_.layout(value.type);
        if (!layout.empty()) scalar = layout.front();
    }
    return {value.slot, type.slots, scalar, value.name};
}

void Decoder::charge(Kind kind, std::uint32_t count) {
    if (count == 0) return;
    for (auto& [known, number] : block().costs)
        if (known == kind) {
            number += count;
            return;
        }
    block().costs.emplace_back(kind, count);
}

Operation& Decoder::emit(std::uint32_t code, const Instruction& instruction, std::uint32_t count,
                         std::uint32_t result, const std::vector<Value>& operands,
                         std::vector<std::uint32_t> words) {
    return emit_row(*find_row(code), instruction, count, result, operands, std::move(words));
}

/// Appends an operation to the block; it counts as `count` of its row's kind. Operands beyond the third stand
/// in the words, from the third on.
Operation& Decoder::emit_row(std::uint32_t row, const Instruction& instruction, std::uint32_t count,
                             std::uint32_t result, const std::vector<Value>& operands,
                             std::vector<std::uint32_t> words) {
    if (program_.operations.size() >= kLargestProgram)
        report(instruction, "the stage is too long to evaluate");
    Operation operation;
    operation.row = row;
    operation.count = count;
    operation.result = result;
    for (std::size_t index = 0; index < operands.size() && index < operation.operands.size(); ++index)
        operation.operands[index] = operands[index].slot;
    if (words.empty() && operands.size() > operation.operands.size())
        for (std::size_t index = 2; index < operands.size(); ++index) words.push_back(operands[index].slot);
    operation.extra = static_cast<std::uint32_t>(program_.words.size());
    operation.extras = static_cast<std::uint32_t>(words.size());
    program_.words.insert(program_.words.end(), words.begin(), words.end());

    OperationInfo info;
    info.place = instruction.place;
    info.is_precise = module_.decorations_of(instruction.result).no_contraction;
    info.result = {result, types_[instruction.type].slots, types_[instruction.type].scalar, 0};
    if (instruction.type != 0)
        info.result = slice({instruction.type, result, -1, -1, intern(module_.name_of(instruction.result))});
    for (const Value& operand : operands) info.operands.push_back(slice(operand));

    const Row& known = instruction_table()[row];
    if (!known.name.empty()) charge(known.kind, known.kind == Kind::image ? 1 : count);
    program_.operations.push_back(operation);
    program_.infos.push_back(std::move(info));
    is_quick_.push_back(true);
    return program_.operations.back();
}

}  // namespace gobo::evaluate
