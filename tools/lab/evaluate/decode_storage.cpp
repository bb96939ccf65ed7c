// What a stage does to memory that it shares with others: atomic functions, images that are written, lengths
// of arrays without a size. Each invocation is alone here: nobody changes what it has read or written.
#include <bit>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/decoder.hpp"
#include "lab/evaluate/image_call.hpp"

namespace gobo::evaluate {
namespace {

/// The operation between the value that stands there and the one that is given; OpNop where the latter just
/// replaces it.
std::uint32_t operation_of(spv::Op atomic) {
    switch (atomic) {
        case spv::OpAtomicIIncrement:
        case spv::OpAtomicIAdd:
            return spv::OpIAdd;
        case spv::OpAtomicIDecrement:
        case spv::OpAtomicISub:
            return spv::OpISub;
        case spv::OpAtomicSMin:
            return kExtended + GLSLstd450SMin;
        case spv::OpAtomicUMin:
            return kExtended + GLSLstd450UMin;
        case spv::OpAtomicSMax:
            return kExtended + GLSLstd450SMax;
        case spv::OpAtomicUMax:
            return kExtended + GLSLstd450UMax;
        case spv::OpAtomicAnd:
            return spv::OpBitwiseAnd;
        case spv::OpAtomicOr:
            return spv::OpBitwiseOr;
        case spv::OpAtomicXor:
            return spv::OpBitwiseXor;
        case spv::OpAtomicFAddEXT:
            return spv::OpFAdd;
        default:
            return spv::OpNop;
    }
}

bool is_number(Scalar scalar) {
    return is_integer(scalar) || scalar == Scalar::float32;
}

}  // namespace

/// A number of the decoder's own.
Value Decoder::constant(Id type, std::uint32_t bits) {
    const std::uint32_t slot = permanent(1);
    program_.constants.push_back({slot, this->type(type).value.scalar, bits});
    return {type, slot};
}

/// A load, an operation and a store, in place of the function that does all three at once.
void Decoder::decode_atomic(const Instruction& instruction) {
    const bool is_store = instruction.opcode == spv::OpAtomicStore;
    const std::size_t pointer_word = is_store ? 1 : 3;
    const auto found = texels_.find(instruction.id(pointer_word));
    const Texel* const texel = found == texels_.end() ? nullptr : &found->second;
    const Value at = texel == nullptr ? pointer(instruction, pointer_word) : Value{};
    if (error_) return;
    const Value stored = is_store ? value(instruction, 4) : Value{};
    const Id number = is_store ? stored.type : instruction.type;
    if (!is_one({number}, is_number) || (texel == nullptr && at.type != number))
        return report_types(instruction);
    const auto write = [&](const Value& value) {
        if (texel == nullptr)
            store(instruction, at, value);
        else
            write_texel(instruction, *texel, value);
    };
    if (is_store) return write(stored);
    Value before{number};
    if (texel != nullptr) {
        before = read_texel(instruction, *texel);
    } else {
        before.slot = define(instruction);
        Value from{number, at.slot, -1, -1, at.name};
        if (at.offset == 0)
            emit(spv::OpLoad, instruction, 1, before.slot, {from});
        else
            emit(kGather, instruction, 1, before.slot, {from, Value{Id::none, at.offset}});
    }
    if (instruction.opcode == spv::OpAtomicLoad) return;
    if (instruction.opcode == spv::OpAtomicCompareExchange) {
        const Value wanted = value(instruction, 8);
        const Value given = value(instruction, 7);
        if (wanted.type != number || given.type != number) return report_types(instruction);
        const std::uint32_t is_equal = temporary(1);
        emit(spv::OpIEqual, instruction, 1, is_equal, {before, wanted});
        program_.infos.back().result.scalar = Scalar::boolean;
        const std::uint32_t chosen = temporary(1);
        emit(spv::OpSelect, instruction, 1, chosen, {Value{Id::none, is_equal}, given, before});
        return write({number, chosen});
    }
    const bool is_step = is_one_of(instruction.opcode, {spv::OpAtomicIIncrement, spv::OpAtomicIDecrement});
    const Value given = is_step ? constant(number, 1) : value(instruction, 6);
    if (given.type != number) return report_types(instruction);
    const std::uint32_t operation = operation_of(instruction.opcode);
    if (operation == spv::OpNop) return write(given);
    const std::uint32_t after = temporary(1);
    emit(operation, instruction, 1, after, {before, given});
    write({number, after});
}

/// Remembers the texel for the atomic function that follows.
void Decoder::decode_texel_pointer(const Instruction& instruction) {
    Texel texel{pointer(instruction, 3), value(instruction, 4), value(instruction, 5)};
    if (error_) return;
    if (!type(texel.image).is_image()) return report_types(instruction);
    // Slots of their own: theirs may be given away before the function comes.
    for (Value* const part : {&texel.coordinates, &texel.sample}) {
        const std::uint32_t count = type(*part).scalars;
        const std::uint32_t kept = permanent(count);
        copy(instruction, count, kept, *part);
        *part = {part->type, kept};
    }
    if (texel.image.offset != 0) {
        const std::uint32_t kept = permanent(1);
        emit(kGather, instruction, 1, kept, {texel.image, Value{Id::none, texel.image.offset}});
        texel.image.slot = kept;
    }
    texel.image.is_pointer = false;
    texels_[instruction.result] = texel;
}

Value Decoder::read_texel(const Instruction& instruction, const Texel& texel) {
    ImageCall call = call_of_texel(instruction, texel);
    const auto words = std::bit_cast<ImageWords>(call);
    const Value read{instruction.type, define(instruction)};
    emit(spv::OpImageRead, instruction, 1, read.slot, {texel.image, texel.coordinates},
         {words.begin(), words.end()});
    return read;
}

void Decoder::write_texel(const Instruction& instruction, const Texel& texel, const Value& value) {
    ImageCall call = call_of_texel(instruction, texel);
    call.texel = value.slot + 1;
    call.texel_components = type(value).scalars;
    call.has_int_result = is_float(type(value).value.scalar) ? 0 : 1;
    const auto words = std::bit_cast<ImageWords>(call);
    emit(spv::OpImageWrite, instruction, 1, temporary(1), {texel.image, texel.coordinates, value},
         {words.begin(), words.end()});
    program_.infos.back().result.count = 0;
}

void Decoder::decode_image_write(const Instruction& instruction) {
    Texel texel{value(instruction, 1), value(instruction, 2), {}};
    const Value written = value(instruction, 3);
    if (error_) return;
    if (!type(texel.image).is_image()) return report_types(instruction);
    const std::uint32_t mask = instruction.word(4);
    if ((mask & spv::ImageOperandsSampleMask) != 0) texel.sample = value(instruction, 5);
    write_texel(instruction, texel, written);
}

/// items.length()
void Decoder::decode_length(const Instruction& instruction) {
    const Value block = pointer(instruction, 3);
    const Id array = error_ ? Id::none : part_type(block.type, instruction.word(4));
    if (type(array).opcode != spv::OpTypeRuntimeArray) return report_types(instruction);
    frame().values[instruction.result] = constant(instruction.type, type(array).count);
}

}  // namespace gobo::evaluate
