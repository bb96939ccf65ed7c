// Constants, variables outside functions, and the names of inputs, outputs and uniforms.
#include <algorithm>

#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {
void Decoder::decode_globals() {
    for (const Instruction& instruction : module_.instructions) {
        if (error_ || instruction.opcode == spv::OpFunction) return;
        if (instruction.opcode == spv::OpVariable) decode_variable(instruction);
        if (instruction.opcode == spv::OpExtInstImport &&
            spirv::literal_text(instruction.words.subspan(2)) == "GLSL.std.450")
            std450_ = instruction.result;
        if (is_one_of(
                instruction.opcode,
                {spv::OpConstant, spv::OpConstantTrue, spv::OpConstantFalse, spv::OpConstantComposite,
                 spv::OpConstantNull, spv::OpSpecConstant, spv::OpSpecConstantTrue, spv::OpSpecConstantFalse,
                 spv::OpSpecConstantComposite, spv::OpSpecConstantOp, spv::OpUndef}))
            decode_constant(instruction);
    }
}

/// The bits of each slot of a constant; nothing where it is malformed. What is undefined is 0.
std::optional<Bits> Decoder::constant_bits(const Instruction& instruction) const {
    const std::uint32_t slots = type(instruction.type).scalars;
    const auto is = [&](std::initializer_list<spv::Op> list) { return is_one_of(instruction.opcode, list); };
    if (is({spv::OpConstant, spv::OpSpecConstant}))
        return Bits{instruction.word(3) | std::uint64_t{instruction.word(4)} << 32U};
    if (is({spv::OpConstantTrue, spv::OpSpecConstantTrue})) return Bits{1};
    if (is({spv::OpConstantFalse, spv::OpSpecConstantFalse})) return Bits{0};
    if (is({spv::OpConstantNull, spv::OpUndef})) return Bits(slots, 0);
    if (is({spv::OpSpecConstantOp})) return computed_bits(instruction);
    Bits bits;
    for (std::size_t word = 3; word < instruction.words.size() && bits.size() <= slots; ++word) {
        const auto part = constant_bits_.find(instruction.id(word));
        if (part == constant_bits_.end()) return std::nullopt;
        bits.insert(bits.end(), part->second.begin(), part->second.end());
    }
    return bits;
}

/// Of what SPIRV-Tools leaves of constants computed from specialisation constants: those that are no integers
/// and are chosen, or parts of others. Nothing for other operations.
std::optional<Bits> Decoder::computed_bits(const Instruction& instruction) const {
    const auto bits_of = [&](std::size_t word) {
        const auto found = constant_bits_.find(instruction.id(word));
        return found == constant_bits_.end() ? Bits{} : found->second;
    };
    const auto operation = static_cast<spv::Op>(instruction.word(3));
    Bits first = bits_of(4);
    const std::size_t slots = type(instruction.type).scalars;
    if (operation == spv::OpSelect) {
        const Bits yes = bits_of(5);
        const Bits no = bits_of(6);
        if (first.size() == 1) first.resize(slots, first.front());
        if (first.size() != slots || yes.size() != slots || no.size() != slots) return std::nullopt;
        for (std::size_t i = 0; i < slots; ++i) first[i] = first[i] != 0 ? yes[i] : no[i];
        return first;
    }
    if (operation == spv::OpCompositeExtract) {
        const Instruction* whole = module_.definition(instruction.id(4));
        if (whole == nullptr) return std::nullopt;
        Id part = whole->type;
        std::size_t offset = 0;
        for (std::size_t word = 5; word < instruction.words.size(); ++word) {
            if (instruction.word(word) >= type(part).count) return std::nullopt;
            offset += part_offset(part, instruction.word(word));
            part = part_type(part, instruction.word(word));
        }
        if (offset + slots > first.size()) return std::nullopt;
        return Bits(&first[offset], &first[offset] + slots);
    }
    if (operation != spv::OpVectorShuffle) return std::nullopt;
    const Bits second = bits_of(5);
    first.insert(first.end(), second.begin(), second.end());
    Bits bits;
    for (std::size_t word = 6; word < instruction.words.size(); ++word)
        bits.push_back(instruction.word(word) < first.size() ? first[instruction.word(word)] : 0);
    return bits;
}

void Decoder::decode_constant(const Instruction& instruction) {
    const std::uint32_t slots = type(instruction.type).scalars;
    std::optional<Bits> bits = constant_bits(instruction);
    if (!bits && instruction.opcode == spv::OpSpecConstantOp)
        return report(instruction, fmt::format("the evaluator does not know {} of specialisation constants",
                                               opcode_name(static_cast<spv::Op>(instruction.word(3)))));
    if (!bits || slots == 0 || bits->size() != slots) return report(instruction, "a constant is malformed");
    const std::uint32_t slot = permanent(slots);
    add_constants(instruction.type, slot, *bits);
    globals_[instruction.result] = {instruction.type, slot, -1, -1, intern(module_.name(instruction.result))};
    constant_bits_[instruction.result] = std::move(*bits);
}

/// Fills the slots of a value of that type.
void Decoder::add_constants(Id id, std::uint32_t slot, std::span<const std::uint64_t> bits) {
    const Type& of = type(id);
    if (!of.is_array() && of.opcode != spv::OpTypeStruct) {
        for (const std::uint64_t value : bits)
            program_.constants.push_back({slot++, of.value.scalar, static_cast<std::uint32_t>(value),
                                          static_cast<std::uint32_t>(value >> 32U)});
        return;
    }
    for (std::uint32_t index = 0; index < of.count; ++index) {
        const Id part = part_type(id, index);
        const std::uint32_t offset = part_offset(id, index);
        add_constants(part, slot + offset, bits.subspan(offset, type(part).scalars));
    }
}

/// Slots for a variable; nothing (and reported) where its type is unknown.
std::optional<Value> Decoder::new_variable(const Instruction& instruction, const std::string& name,
                                           bool is_read_only) {
    const Id id = type(instruction.type).element;
    const std::uint32_t slots = type(id).scalars;
    if (slots == 0) {
        report(instruction,
               fmt::format("the variable '{}' has a type that the evaluator does not know", name));
        return std::nullopt;
    }
    const auto index = static_cast<int>(is_read_only_.size());
    is_read_only_.push_back(is_read_only);
    const Value variable{
        id, permanent(slots), -1, index, intern(name), true, 0, is_relaxed(instruction.result)};
    return variable;
}

void Decoder::decode_variable(const Instruction& instruction) {
    std::string name = module_.name(instruction.result);
    if (name.empty()) name = module_.name(type(instruction.type).element);
    if (name == "gl_PerVertex") name.clear();
    const auto storage = instruction.as<spv::StorageClass>(3);
    const bool is_written = storage == spv::StorageClassOutput || storage == spv::StorageClassPrivate ||
                            storage == spv::StorageClassFunction;
    const auto variable = new_variable(instruction, name, !is_written && !may_write(instruction));
    if (!variable) return;
    globals_[instruction.result] = *variable;
    if (is_written) program_.variables.emplace_back(variable->slot, type(*variable).scalars);
    // A uniform that is declared with a value has it unless the application sets another.
    const auto bits = constant_bits_.find(instruction.id(4));
    if (!is_written && bits != constant_bits_.end() && bits->second.size() == type(*variable).scalars)
        add_constants(variable->type, variable->slot, bits->second);
    name_interface(instruction, variable->type, variable->slot);
}

/// Whether the variable is a storage block or an array of them.
bool Decoder::is_storage_block(const Instruction& variable) const {
    Id block = type(variable.type).element;
    while (type(block).is_array()) block = type(block).element;
    return variable.word(3) == spv::StorageClassStorageBuffer ||
           (variable.word(3) == spv::StorageClassUniform &&
            module_.decoration(block, spv::DecorationBufferBlock));
}

/// Whether it is a variable of the application's that the stage may write.
bool Decoder::may_write(const Instruction& variable) const {
    return variable.word(3) == spv::StorageClassAtomicCounter || is_storage_block(variable);
}

void Decoder::name_interface(const Instruction& variable, Id id, std::uint32_t slot) {
    const Id named = variable.result;
    std::string name = module_.name(named);
    int number = static_cast<int>(module_.decoration(named, spv::DecorationLocation).value_or(~0U));
    Location at{slot};
    at.is_written = may_write(variable);
    switch (variable.word(3)) {
        case spv::StorageClassInput:
            return add_ports(program_.inputs, name, id, number, at);
        case spv::StorageClassOutput:
            return add_ports(program_.outputs, name, id, number, at);
        case spv::StorageClassUniform:
        case spv::StorageClassStorageBuffer:
        case spv::StorageClassPushConstant: {
            Id block = id;
            while (type(block).is_array()) block = type(block).element;
            // OpenGL names members of a block by the block, not by its instance.
            if (type(block).opcode == spv::OpTypeStruct) name = module_.name(block);
            return add_blocks(name, id, number, at);
        }
        case spv::StorageClassUniformConstant:
        case spv::StorageClassAtomicCounter:
            return add_ports(program_.uniforms, name, id, number, at);
        case spv::StorageClassPrivate:
        case spv::StorageClassFunction:
            return;
        default:
            report(variable, fmt::format("'{}' is a kind of variable that is not evaluated", name));
    }
}

/// A block, or each element of an array of them, which is a block of its own.
void Decoder::add_blocks(const std::string& name, Id id, int& number, Location at) {
    const Type& of = type(id);
    if (!of.is_array()) {
        at.block = static_cast<int>(program_.uniform_blocks.size());
        program_.uniform_blocks.push_back({name, 0});
        return add_ports(program_.uniforms, name, id, number, at);
    }
    const std::uint32_t first = at.slot;
    for (std::uint32_t index = 0; index < of.count; ++index) {
        at.slot = first + part_offset(id, index);
        add_blocks(fmt::format("{}[{}]", name, index), of.element, number, at);
    }
}

/// `number` is the location, and moves on behind what is added.
void Decoder::add_ports(std::vector<Port>& ports, const std::string& name, Id id, int& number,
                        const Location& at) {
    const Type& of = type(id);
    if (!of.is_array() && of.opcode != spv::OpTypeStruct) return add_leaf(ports, name, id, number, at);
    for (std::uint32_t index = 0; index < of.count; ++index) {
        Location inner = at;
        inner.slot += part_offset(id, index);
        std::string full;
        if (of.is_array()) {
            inner.offset += index * module_.decoration(id, spv::DecorationArrayStride).value_or(0);
            full = fmt::format("{}[{}]", name, index);
        } else {
            const auto decoration = [&](spv::Decoration kind) {
                return module_.decoration(id, kind, static_cast<int>(index));
            };
            number = static_cast<int>(
                decoration(spv::DecorationLocation).value_or(static_cast<std::uint32_t>(number)));
            inner.offset += decoration(spv::DecorationOffset).value_or(0);
            inner.matrix_stride = decoration(spv::DecorationMatrixStride).value_or(0);
            inner.is_row_major = decoration(spv::DecorationRowMajor).has_value();
            full = part_name(decoration(spv::DecorationBuiltIn) ? "" : name, id, index);
        }
        add_ports(ports, full, part_type(id, index), number, inner);
    }
}

/// A scalar, vector, matrix or image.
void Decoder::add_leaf(std::vector<Port>& ports, const std::string& name, Id id, int& number,
                       const Location& at) {
    const Type& of = type(id);
    if (of.opcode == spv::OpTypeSampler) return;
    if (of.is_image()) {
        program_.constants.push_back({at.slot, of.value.scalar, length_of(program_.images)});
        const Type& image = of.opcode == spv::OpTypeSampledImage ? type(of.element) : of;
        program_.images.push_back({name, of.image, at.slot, type(image.element).value.scalar});
        return;
    }
    Port port{name, of.value.name(), number, at.slot, of.scalars, of.value.scalar, at.block,
              {},   at.is_written};
    const auto rows = static_cast<std::uint32_t>(of.value.rows);
    const auto size = static_cast<std::uint32_t>(of.value.scalar_size());
    for (std::uint32_t component = 0; component < of.scalars && at.block >= 0; ++component) {
        const std::uint32_t column = component / rows;
        const std::uint32_t row = component % rows;
        const std::uint32_t offset = at.offset + (at.is_row_major ? row * at.matrix_stride + column * size
                                                                  : column * at.matrix_stride + row * size);
        port.offsets.push_back(offset);
        UniformBlock& block = program_.uniform_blocks[static_cast<std::size_t>(at.block)];
        block.size = std::max(block.size, offset + size);
    }
    if (number >= 0) number += of.value.columns;
    ports.push_back(std::move(port));
}

/// Variables of the stage that are declared with a value get it when the stage begins.
void Decoder::initialise_globals() {
    Frame frame;
    frames_.push_back(&frame);
    for (const Instruction& instruction : module_.instructions) {
        if (error_ || instruction.opcode == spv::OpFunction) break;
        if (instruction.opcode != spv::OpVariable || instruction.words.size() < 5) continue;
        const Value variable = globals_[instruction.result];
        if (!is_read_only_[static_cast<std::size_t>(variable.variable)])
            store(instruction, variable, value(instruction, 4));
    }
    frames_.pop_back();
}

}  // namespace gobo::evaluate
