// Slots of values: how long they live, when two values may share them.
#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/decoder.hpp"
#include "lab/evaluate/half.hpp"

namespace gobo::evaluate {
namespace {

/// How far ahead a write to a variable is looked for before a load copies instead of sharing.
constexpr std::uint32_t kLookAhead = 4096;

}  // namespace

/// The value is one scalar of a fitting kind.
bool Decoder::is_one(const Value& value, bool (*fits)(Scalar)) const {
    return type(value).scalars == 1 && fits(type(value).value.scalar);
}

/// The type of element or member `index`, or none where there is no such part.
Id Decoder::part_type(Id id, std::uint32_t index) const {
    const Type& whole = type(id);
    const bool has_parts = is_one_of(whole.opcode, {spv::OpTypeVector, spv::OpTypeMatrix, spv::OpTypeArray,
                                                    spv::OpTypeRuntimeArray, spv::OpTypeStruct});
    if (index >= whole.count || !has_parts) return Id::none;
    return whole.opcode == spv::OpTypeStruct ? whole.members[index] : whole.element;
}

/// The first slot of element or member `index` inside the value.
std::uint32_t Decoder::part_offset(Id id, std::uint32_t index) const {
    const Type& whole = type(id);
    if (whole.opcode != spv::OpTypeStruct) return index * type(whole.element).scalars;
    std::uint32_t slots = 0;
    for (std::uint32_t member = 0; member < index; ++member) slots += type(whole.members[member]).scalars;
    return slots;
}

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

/// Slots for a value of that many uses, given back after the last one, or after this instruction.
std::uint32_t Decoder::temporary(std::uint32_t count, std::uint32_t uses, int* allocation) {
    Words& free = free_slots_[count];
    std::uint32_t slot = 0;
    if (free.empty()) {
        slot = permanent(count);
    } else {
        slot = free.back();
        free.pop_back();
    }
    const int index = static_cast<int>(allocations_.size());
    allocations_.push_back({slot, count, uses});
    if (uses == 0) to_free_.push_back(index);
    if (allocation != nullptr) *allocation = index;
    return slot;
}

void Decoder::release_operands(const Instruction& instruction) {
    for (const std::uint32_t id : value_operands(instruction)) release(Id{id});
}

void Decoder::release(Id id) {
    const auto found = frame().values.find(id);
    if (found == frame().values.end() || found->second.allocation < 0) return;
    Allocation& allocation = allocations_[static_cast<std::size_t>(found->second.allocation)];
    if (allocation.remaining > 0 && --allocation.remaining == 0) to_free_.push_back(found->second.allocation);
}

void Decoder::free_released() {
    for (const int index : to_free_) {
        Allocation& allocation = allocations_[static_cast<std::size_t>(index)];
        if (allocation.is_free || allocation.remaining > 0) continue;
        allocation.is_free = true;
        free_slots_[allocation.count].push_back(allocation.slot);
    }
    to_free_.clear();
}

/// Where the instruction shall write its result. Operations write all lanes; a result that is used outside
/// its block is copied by those lanes only that are in it, since others may have left a loop with an older
/// value.
std::uint32_t Decoder::define(const Instruction& instruction) {
    const std::uint32_t count = type(instruction.type).scalars;
    const Uses& uses = frame().uses[instruction.result];
    Value& value = frame().values[instruction.result];
    value = {instruction.type, 0, -1, -1, intern(module_.name(instruction.result))};
    if (count == 0) {
        report(instruction, opcode_name(instruction.opcode) + " has a result without a value");
        return 0;
    }
    if (uses.is_local) return value.slot = temporary(count, uses.count, &value.allocation);
    value.slot = permanent(count);
    kept_ = temporary(count);
    return *kept_;
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
bool Decoder::is_written(int variable, std::uint32_t from, std::uint32_t to) const {
    if (to > from + kLookAhead) return true;
    for (std::uint32_t at = from; at <= to && at < module_.instructions.size(); ++at) {
        const Instruction& instruction = module_.instructions[at];
        if (is_one_of(instruction.opcode, {spv::OpFunctionCall, spv::OpCopyMemory})) return true;
        if (is_atomic(instruction.opcode)) return true;
        if (instruction.opcode == spv::OpExtInst &&
            (instruction.word(4) == GLSLstd450Modf || instruction.word(4) == GLSLstd450Frexp))
            return true;
        if (instruction.opcode != spv::OpStore || at == to) continue;
        const int written = variable_of(instruction.id(1));
        if (written == variable || written < 0) return true;
    }
    return false;
}

/// The variable that a pointer leads into, -1 where that cannot be told yet.
int Decoder::variable_of(Id pointer) const {
    for (std::uint32_t level = 0; level < 64; ++level) {
        if (const Value* const found = find(pointer, true)) return found->variable;
        const Instruction* const definition = module_.definition(pointer);
        if (definition == nullptr) return -1;
        pointer = definition->id(3);
    }
    return -1;
}

/// Copies a result that outlives its block, and gives back what was used for the last time.
void Decoder::finish_instruction(const Instruction& instruction) {
    release_operands(instruction);
    if (kept_) {
        copy(instruction, type(instruction.type).scalars, frame().values[instruction.result].slot,
             {instruction.type, *kept_});
        kept_.reset();
    }
    free_released();
}

const Value* Decoder::find(Id id, bool is_pointer) const {
    const auto among = [&](const std::unordered_map<Id, Value>& known) -> const Value* {
        const auto found = known.find(id);
        return found != known.end() && found->second.is_pointer == is_pointer ? &found->second : nullptr;
    };
    const Value* const local = frames_.empty() ? nullptr : among(frames_.back()->values);
    return local != nullptr ? local : among(globals_);
}

/// What the word of an instruction names.
Value Decoder::operand(const Instruction& instruction, std::size_t word, bool is_pointer) {
    if (const Value* const found = find(instruction.id(word), is_pointer)) return *found;
    report(instruction,
           fmt::format("{} uses id {}, which {}", opcode_name(instruction.opcode), instruction.word(word),
                       is_pointer ? "is not a variable" : "has no value here"));
    return {};
}

Values Decoder::values(const Instruction& instruction, std::size_t first_word) {
    Values all;
    for (std::size_t word = first_word; word < instruction.words.size(); ++word)
        all.push_back(value(instruction, word));
    return all;
}

std::uint32_t Decoder::intern(const std::string& name) {
    if (name.empty()) return 0;
    const auto [found, is_new] = name_indices_.try_emplace(name, length_of(program_.names));
    if (is_new) program_.names.push_back(name);
    return found->second;
}

Slice Decoder::slice(const Value& value) const {
    return {value.slot, type(value).scalars, type(value).value.scalar, value.name};
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

/// Of the active lanes.
void Decoder::copy(const Instruction& instruction, std::uint32_t count, std::uint32_t to, const Value& from) {
    emit(kCopy, instruction, count, to, {from});
}

void Decoder::emit(std::uint32_t code, const Instruction& instruction, std::uint32_t count,
                   std::uint32_t result, const Values& operands, Words words) {
    emit_row(*find_row(code), instruction, count, result, operands, std::move(words));
}

/// Of a constant that 16 bits do not hold, slots of its own for mediump operations; else the operand.
Value Decoder::of_relaxed(const Value& operand) {
    const Slice of = slice(operand);
    if (operand.is_pointer || of.count == 0 || of.scalar != Scalar::float32) return operand;
    const auto first = std::ranges::find(program_.constants, of.slot, &ConstantSlot::slot);
    if (program_.constants.end() - first < static_cast<std::ptrdiff_t>(of.count)) return operand;
    const std::vector<ConstantSlot> known(first, first + of.count);
    const auto is_exact = [](const ConstantSlot& constant) {
        const auto value = std::bit_cast<float>(constant.bits);
        return constant.scalar != Scalar::float32 || constant.is_relaxed || rounded_to_half(value) == value;
    };
    if (std::ranges::all_of(known, is_exact)) return operand;
    const auto [own, is_new] = relaxed_slots_.try_emplace(of.slot, 0);
    if (is_new) {
        own->second = permanent(of.count);
        for (std::uint32_t i = 0; i < of.count; ++i) {
            ConstantSlot& constant = program_.constants.emplace_back(known[i]);
            constant.slot = own->second + i;
            constant.is_relaxed = true;
        }
    }
    Value relaxed = operand;
    relaxed.slot = own->second;
    return relaxed;
}

/// Appends an operation to the block; it counts as `count` of its row's kind. Operands beyond the third stand
/// in the words, from the third on.
void Decoder::emit_row(std::uint32_t row, const Instruction& instruction, std::uint32_t count,
                       std::uint32_t result, const Values& given, Words words) {
    if (program_.operations.size() >= kLargestProgram)
        report(instruction, "the stage is too long to evaluate");
    const Row& known = instruction_table()[row];
    Values operands = given;
    const bool computes_relaxed = is_relaxed(instruction.result);
    if (computes_relaxed && known.kind < Kind::move)
        for (Value& operand : operands) operand = of_relaxed(operand);
    Operation operation{row, count, result, {}, length_of(program_.words), 0};
    for (std::size_t index = 0; index < operands.size() && index < operation.operands.size(); ++index)
        operation.operands[index] = operands[index].slot;
    if (words.empty() && operands.size() > operation.operands.size())
        for (std::size_t index = 2; index < operands.size(); ++index) words.push_back(operands[index].slot);
    operation.extras = length_of(words);
    program_.words.insert(program_.words.end(), words.begin(), words.end());

    OperationInfo info;
    info.place = instruction.line;
    info.result.slot = result;
    info.is_precise = module_.decoration(instruction.result, spv::DecorationNoContraction).has_value();
    info.is_relaxed = computes_relaxed;
    if (instruction.type != Id::none)
        info.result = slice({instruction.type, result, -1, -1, intern(module_.name(instruction.result))});
    for (const Value& operand : operands) info.operands.push_back(slice(operand));

    if (!known.is_bookkeeping) charge(known.kind, known.kind == Kind::image ? 1 : count);
    program_.operations.push_back(operation);
    program_.infos.push_back(std::move(info));
    is_quick_.push_back(true);
}

}  // namespace gobo::evaluate
