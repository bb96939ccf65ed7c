// Variables, loads, stores, and parts of composites. Most loads and extractions cost nothing: their result
// shares the slots of what they read.
#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {

void Decoder::decode_local_variable(const Instruction& instruction) {
    const Type& type = types_[instruction.type];
    const std::uint32_t slots = types_[type.element].slots;
    if (type.shape != Type::Shape::pointer || slots == 0)
        return report(instruction, "a variable has a type that the evaluator does not know");
    const std::uint32_t slot = permanent(slots);
    program_.variables.emplace_back(slot, slots);
    const std::string path = module_.name_of(instruction.result);
    frame().pointers[instruction.result] = {type.element, slot,         static_cast<int>(variables_.size()),
                                            std::nullopt, intern(path), path};
    variables_.push_back({false});
    if (instruction.words.size() > 4)
        store(instruction, frame().pointers[instruction.result], value(instruction, instruction.word(4)));
}

/// The result is the given value: the same slots where that is safe, otherwise a copy.
void Decoder::share_or_copy(const Instruction& instruction, const Value& value) {
    if (types_[instruction.type].slots != types_[value.type].slots)
        return report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
    const std::uint32_t count = types_[value.type].slots;
    const std::uint32_t row =
        *find_row(instruction.opcode == spv::OpLoad ? spv::OpLoad : spv::OpCompositeExtract);
    if (may_share(instruction, value)) {
        share(instruction, value);
        emit_row(row, instruction, count, value.slot, {value});
        is_quick_.back() = false;
    } else {
        emit_row(row, instruction, count, define(instruction), {value});
    }
}

void Decoder::decode_load(const Instruction& instruction) {
    const Pointer from = pointer(instruction, instruction.word(3));
    if (error_) return;
    if (from.type != instruction.type) return report(instruction, "OpLoad has a result of the wrong type");
    const bool is_read_only = variables_[static_cast<std::size_t>(from.variable)].is_read_only;
    const Value source{from.type, from.slot, -1, is_read_only ? -1 : from.variable, from.name};
    if (!from.offset) return share_or_copy(instruction, source);
    const Value offset{0, *from.offset, -1, -1, 0};
    emit(kGather, instruction, types_[from.type].slots, define(instruction), {source, offset});
    frame().values[instruction.result].name = from.name;
}

void Decoder::decode_store(const Instruction& instruction) {
    const Pointer to = pointer(instruction, instruction.word(1));
    const Value from = value(instruction, instruction.word(2));
    if (error_) return;
    if (to.type != from.type || variables_[static_cast<std::size_t>(to.variable)].is_read_only)
        return report(instruction, "OpStore has operands of the wrong types");
    store(instruction, to, from);
}

void Decoder::store(const Instruction& instruction, const Pointer& target, const Value& from) {
    const std::uint32_t count = types_[target.type].slots;
    if (types_[from.type].slots != count && from.type != target.type && from.type != 0)
        return report(instruction, "a store has operands of the wrong types");
    if (target.offset)
        emit(kScatter, instruction, count, target.slot, {from, Value{0, *target.offset, -1, -1, 0}});
    else
        emit(spv::OpStore, instruction, count, target.slot, {from});
    program_.infos.back().result = slice({target.type, target.slot, -1, -1, target.name});
}

/// One level down by an index known now. False (and reported) where there is no such part.
bool Decoder::step_into(const Instruction& instruction, std::uint32_t& type, std::uint32_t& slot,
                        std::uint32_t index) {
    const std::uint32_t part = types_.part(type, index);
    if (part == 0) {
        report(instruction, fmt::format("index {} is outside of what {} reaches into", index,
                                        opcode_name(instruction.opcode)));
        return false;
    }
    slot += types_.offset(type, index);
    type = part;
    return true;
}

void Decoder::decode_access_chain(const Instruction& instruction) {
    Pointer at = pointer(instruction, instruction.word(3));
    std::vector<std::uint32_t> words{at.offset ? *at.offset + 1 : 0};
    std::vector<Value> indices;
    for (std::size_t word = 4; word < instruction.words.size() && !error_; ++word) {
        const std::uint32_t id = instruction.words[word];
        const Type type = types_[at.type];
        const std::optional<std::uint32_t> index = constant_index(id);
        if (type.shape == Type::Shape::structure) {
            if (!index) return report(instruction, "a member of a structure is chosen by a variable");
            const std::string member = module_.member_name(at.type, *index);
            at.path += at.path.empty() ? member : "." + member;
        } else if (type.shape == Type::Shape::vector && index && *index < 4) {
            at.path += std::string(".") + "xyzw"[*index];
        } else if (index) {
            at.path += fmt::format("[{}]", *index);
        }
        if (index) {
            if (!step_into(instruction, at.type, at.slot, *index)) return;
            continue;
        }
        const Value dynamic = value(instruction, id);
        if (types_[dynamic.type].slots != 1 || !is_integer(types_[dynamic.type].scalar))
            return report(instruction, "an index is no integer");
        const std::string& name = program_.names[dynamic.name];
        at.path += fmt::format("[{}]", name.empty() ? "..." : name);
        std::uint32_t first = 0;
        if (!step_into(instruction, at.type, first, 0)) return;
        words.insert(words.end(), {dynamic.slot, type.count, types_[at.type].slots});
        indices.push_back(dynamic);
    }
    if (error_) return;
    if (at.type != types_[instruction.type].element)
        return report(instruction, "OpAccessChain has a result of the wrong type");
    at.name = intern(at.path);
    if (!indices.empty()) {
        // An address outlives its block rarely; slots of its own spare the bookkeeping.
        at.offset = permanent(1);
        int scratch = -1;
        const std::uint32_t computed = temporary(1, 0, scratch);
        emit(spv::OpAccessChain, instruction, 1, computed, indices, words);
        program_.infos.back().result = {at.slot, types_[at.type].slots, types_[at.type].scalar, at.name};
        emit(kKeep, instruction, 1, *at.offset, {Value{0, computed}});
    }
    frame().pointers[instruction.result] = std::move(at);
}

void Decoder::decode_extract(const Instruction& instruction) {
    Value part = value(instruction, instruction.word(3));
    for (std::size_t word = 4; word < instruction.words.size() && !error_; ++word) {
        const Type::Shape shape = types_[part.type].shape;
        const std::uint32_t index = instruction.words[word];
        if (part.name != 0) {
            const std::string& whole = program_.names[part.name];
            if (shape == Type::Shape::vector && index < 4)
                part.name = intern(whole + "." + "xyzw"[index]);
            else if (shape == Type::Shape::structure)
                part.name = intern(whole + "." + module_.member_name(part.type, index));
            else
                part.name = intern(fmt::format("{}[{}]", whole, index));
        }
        if (!step_into(instruction, part.type, part.slot, index)) return;
    }
    if (!error_) share_or_copy(instruction, part);
}

void Decoder::decode_construct(const Instruction& instruction) {
    std::vector<Value> parts;
    std::vector<std::uint32_t> words;
    std::uint32_t count = 0;
    for (std::size_t word = 3; word < instruction.words.size(); ++word) {
        parts.push_back(value(instruction, instruction.words[word]));
        const std::uint32_t slots = types_[parts.back().type].slots;
        words.insert(words.end(), {parts.back().slot, slots});
        count += slots;
    }
    if (count != types_[instruction.type].slots)
        return report(instruction, "OpCompositeConstruct has operands of the wrong types");
    emit(instruction.opcode, instruction, count, define(instruction), parts, std::move(words));
}

void Decoder::decode_insert(const Instruction& instruction) {
    const Value part = value(instruction, instruction.word(3));
    const Value whole = value(instruction, instruction.word(4));
    std::uint32_t type = whole.type;
    std::uint32_t offset = 0;
    for (std::size_t word = 5; word < instruction.words.size() && !error_; ++word)
        if (!step_into(instruction, type, offset, instruction.words[word])) return;
    if (type != part.type || whole.type != instruction.type)
        return report(instruction, "OpCompositeInsert has operands of the wrong types");
    emit(instruction.opcode, instruction, types_[whole.type].slots, define(instruction), {part, whole},
         {offset, types_[type].slots});
}

void Decoder::decode_shuffle(const Instruction& instruction) {
    const Value a = value(instruction, instruction.word(3));
    const Value b = value(instruction, instruction.word(4));
    const std::uint32_t split = types_[a.type].slots;
    const std::uint32_t count = types_[instruction.type].slots;
    std::vector<std::uint32_t> words;
    bool is_run = true;  // of consecutive components of a
    for (std::size_t word = 5; word < instruction.words.size(); ++word) {
        // 0xffffffff asks for an undefined component.
        const std::uint32_t index = instruction.words[word] == 0xffffffffU ? 0 : instruction.words[word];
        if (index >= split + types_[b.type].slots)
            return report(instruction, "OpVectorShuffle reaches outside its operands");
        words.push_back(index < split ? a.slot + index : b.slot + index - split);
        is_run = is_run && index < split && words.back() == words.front() + words.size() - 1;
    }
    if (words.size() != count || types_[a.type].shape != Type::Shape::vector || count == 0)
        return report(instruction, "OpVectorShuffle has operands of the wrong types");
    Value part{instruction.type, words.front(), a.allocation, a.variable, 0};
    if (is_run && may_share(instruction, part)) {
        share(instruction, part);
        emit(instruction.opcode, instruction, count, part.slot, {a, b}, std::move(words));
        is_quick_.back() = false;
        return;
    }
    emit(instruction.opcode, instruction, count, define(instruction), {a, b}, std::move(words));
}

/// A component of a vector chosen by a variable: read, or replaced.
void Decoder::decode_dynamic_component(const Instruction& instruction) {
    std::vector<Value> operands;
    for (std::size_t word = 3; word < instruction.words.size(); ++word)
        operands.push_back(value(instruction, instruction.words[word]));
    const bool is_extract = instruction.opcode == spv::OpVectorExtractDynamic;
    if (operands.size() != (is_extract ? 2U : 3U) || types_[operands[0].type].shape != Type::Shape::vector ||
        !is_integer(types_[operands.back().type].scalar))
        return report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
    const std::uint32_t extent = types_[operands[0].type].count;
    if (types_[instruction.type].slots != (is_extract ? 1U : extent))
        return report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
    emit(instruction.opcode, instruction, is_extract ? 1 : extent, define(instruction), operands, {extent});
}

}  // namespace gobo::evaluate
