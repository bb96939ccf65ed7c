// One instruction to one operation: most by the signature of their row, some by functions of their own.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {
namespace {

constexpr std::size_t kFirstOperand = 3;          // after the leading word, the type and the result
constexpr std::size_t kFirstExtendedOperand = 5;  // and after the instruction set and the number

bool holds(Scalar scalar, char wanted) {
    switch (std::tolower(wanted)) {
        case 'f':
            return is_float(scalar);
        case 'd':
            return scalar == Scalar::float64;
        case 'h':
            return scalar == Scalar::float16;
        case 'i':
            return is_index(scalar);
        case 'l':
            return is_wide(scalar) && !is_float(scalar);
        default:
            return is_boolean(scalar);
    }
}

bool is_scalar_or_vector(const Type& type) {
    return type.opcode == spv::OpTypeFloat || type.opcode == spv::OpTypeInt ||
           type.opcode == spv::OpTypeBool || type.opcode == spv::OpTypeVector;
}

/// A vector is one column.
bool is_float_matrix(const Type& type, std::uint32_t columns, std::uint32_t rows) {
    const spv::Op opcode = columns == 1 ? spv::OpTypeVector : spv::OpTypeMatrix;
    return type.opcode == opcode && is_float(type.value.scalar) &&
           type.value.columns == static_cast<int>(columns) && type.value.rows == static_cast<int>(rows);
}

}  // namespace

void Decoder::decode_instruction(const Instruction& instruction) {
    static const std::unordered_map<std::uint32_t, void (Decoder::*)(const Instruction&)> kOwn = {
        {spv::OpUndef, &Decoder::decode_constant},
        {spv::OpVariable, &Decoder::decode_local_variable},
        {spv::OpLoad, &Decoder::decode_load},
        {spv::OpStore, &Decoder::decode_store},
        {spv::OpAccessChain, &Decoder::decode_access_chain},
        {spv::OpInBoundsAccessChain, &Decoder::decode_access_chain},
        {spv::OpCopyObject, &Decoder::decode_copy},
        {spv::OpImage, &Decoder::decode_copy},
        {spv::OpSampledImage, &Decoder::decode_copy},
        {spv::OpCompositeExtract, &Decoder::decode_extract},
        {spv::OpCompositeConstruct, &Decoder::decode_construct},
        {spv::OpCompositeInsert, &Decoder::decode_insert},
        {spv::OpVectorShuffle, &Decoder::decode_shuffle},
        {spv::OpVectorExtractDynamic, &Decoder::decode_dynamic_component},
        {spv::OpVectorInsertDynamic, &Decoder::decode_dynamic_component},
        {spv::OpMatrixTimesVector, &Decoder::decode_product},
        {spv::OpVectorTimesMatrix, &Decoder::decode_product},
        {spv::OpMatrixTimesMatrix, &Decoder::decode_product},
        {spv::OpOuterProduct, &Decoder::decode_product},
        {spv::OpTranspose, &Decoder::decode_product},
        {spv::OpFunctionCall, &Decoder::decode_call},
        {spv::OpArrayLength, &Decoder::decode_length},
        {spv::OpImageWrite, &Decoder::decode_image_write},
        {spv::OpImageTexelPointer, &Decoder::decode_texel_pointer},
        {spv::OpExtInst, &Decoder::decode_extended}};
    if (is_one_of(instruction.opcode, {spv::OpNop, spv::OpLine, spv::OpNoLine, spv::OpSelectionMerge,
                                       spv::OpLoopMerge, spv::OpPhi, spv::OpMemoryBarrier}))
        return;  // each invocation is alone, and sees what it wrote
    if (is_atomic(instruction.opcode)) return decode_atomic(instruction);
    if (const auto own = kOwn.find(instruction.opcode); own != kOwn.end())
        return (this->*own->second)(instruction);
    if (!decode_image(instruction) && !decode_by_signature(instruction, instruction.opcode, kFirstOperand))
        report(instruction, "the evaluator does not know " + opcode_name(instruction.opcode));
}

/// False where the table has no row for the code.
bool Decoder::decode_by_signature(const Instruction& instruction, std::uint32_t code,
                                  std::size_t first_operand) {
    std::optional<std::uint32_t> row = find_row(code);
    const std::span<const Row> table = instruction_table();
    if (!row || table[*row].signature.empty()) return false;
    const Values operands = values(instruction, first_operand);
    for (; *row < table.size() && table[*row].code == code; ++*row) {
        const auto count = components(table[*row].signature, instruction.type, operands);
        if (!count) continue;
        emit_row(*row, instruction, *count, define(instruction), operands);
        return true;
    }
    report_types(instruction);
    return true;
}

/// How many components an operation of that signature has; nothing where it does not fit.
std::optional<std::uint32_t> Decoder::components(std::string_view signature, Id result,
                                                 const Values& operands) const {
    std::uint32_t demanded = 0;
    if (std::isdigit(static_cast<unsigned char>(signature.back())) != 0) {
        demanded = static_cast<std::uint32_t>(signature.back() - '0');
        signature.remove_suffix(1);
    }
    if (operands.size() != signature.size() - 2) return std::nullopt;
    std::uint32_t count = 0;
    for (std::size_t index = 0; index <= operands.size(); ++index) {
        const Id id = index == 0 ? result : operands[index - 1].type;
        const char wanted = index == 0 ? signature[0] : signature[index + 1];
        const Type& of = type(id);
        if (wanted == 's') {
            if (of.opcode != spv::OpTypeStruct || of.scalars != 2 * type(operands[0]).scalars)
                return std::nullopt;
            continue;
        }
        if (wanted == '*' || wanted == 'm') {
            if (id != result || of.scalars == 0 || (wanted == 'm' && of.opcode != spv::OpTypeMatrix))
                return std::nullopt;
        } else {
            if (!is_scalar_or_vector(of) || !holds(of.value.scalar, wanted)) return std::nullopt;
            if (std::isupper(static_cast<unsigned char>(wanted)) != 0) {
                if (of.scalars != 1) return std::nullopt;
                continue;
            }
        }
        if (count != 0 && count != of.scalars) return std::nullopt;
        count = of.scalars;
    }
    count = std::max(count, 1U);
    return demanded == 0 || demanded == count ? std::optional(count) : std::nullopt;
}

void Decoder::decode_extended(const Instruction& instruction) {
    if (instruction.id(3) != std450_ || std450_ == Id::none)
        return report(instruction, "the evaluator knows no extended instructions but those of GLSL.std.450");
    const std::uint32_t number = instruction.word(4);
    const std::uint32_t code = kExtended + number;
    switch (number) {
        case GLSLstd450Determinant:
        case GLSLstd450MatrixInverse:
            return decode_square(instruction, code);
        case GLSLstd450Modf:
            return decode_split(instruction, kExtended + GLSLstd450ModfStruct);
        case GLSLstd450Frexp:
            return decode_split(instruction, kExtended + GLSLstd450FrexpStruct);
        case GLSLstd450InterpolateAtCentroid:
        case GLSLstd450InterpolateAtSample:
        case GLSLstd450InterpolateAtOffset:
            return decode_interpolate(instruction, code);
        default:
            if (!decode_by_signature(instruction, code, kFirstExtendedOperand))
                report(instruction,
                       fmt::format("the evaluator does not know instruction {} of GLSL.std.450", number));
    }
}

/// Products of matrices: of `columns` columns and `rows` rows, each a sum of `terms` products.
void Decoder::decode_product(const Instruction& instruction) {
    const bool is_transpose = instruction.opcode == spv::OpTranspose;
    const Value a = value(instruction, 3);
    const Value b = is_transpose ? a : value(instruction, 4);
    const Type& result = type(instruction.type);
    auto columns = static_cast<std::uint32_t>(result.value.columns);
    auto rows = static_cast<std::uint32_t>(result.value.rows);
    std::uint32_t terms = 1;
    bool fits = is_float_matrix(result, columns, rows);
    switch (instruction.opcode) {
        case spv::OpMatrixTimesVector:
        case spv::OpMatrixTimesMatrix:
            terms = type(a).count;
            fits = fits && is_float_matrix(type(a), terms, rows) &&
                   is_float_matrix(type(b), columns, terms) &&
                   (columns == 1) == (instruction.opcode == spv::OpMatrixTimesVector);
            break;
        case spv::OpVectorTimesMatrix:
            std::swap(columns, rows);
            terms = type(a).count;
            fits = fits && rows == 1 && is_float_matrix(type(a), 1, terms) &&
                   is_float_matrix(type(b), columns, terms);
            break;
        case spv::OpOuterProduct:
            fits = fits && is_float_matrix(type(a), 1, rows) && is_float_matrix(type(b), 1, columns);
            break;
        default:
            fits = fits && is_float_matrix(type(a), rows, columns);
            break;
    }
    if (!fits) return report_types(instruction);
    const Values operands = is_transpose ? std::vector{a} : std::vector{a, b};
    emit(instruction.opcode, instruction, columns * rows * terms, define(instruction), operands,
         {columns, rows, terms});
    charge(Kind::add, columns * rows * (terms - 1));
}

void Decoder::decode_square(const Instruction& instruction, std::uint32_t code) {
    const Value matrix = value(instruction, 5);
    const Type& square = type(matrix);
    const bool gives_matrix = code == kExtended + GLSLstd450MatrixInverse;
    const bool fits = gives_matrix ? instruction.type == matrix.type : is_one({instruction.type}, is_float);
    if (!square.value.is_matrix() || square.value.rows != square.value.columns || !fits)
        return report(instruction, "a matrix function has operands of the wrong types");
    emit(code, instruction, square.scalars, define(instruction), {matrix},
         {square.count, square.count, square.count});
}

/// modf() and frexp() with a second result that is written through a pointer.
void Decoder::decode_split(const Instruction& instruction, std::uint32_t code) {
    const Value operand = value(instruction, 5);
    const Value second = pointer(instruction, 6);
    const std::uint32_t count = type(operand).scalars;
    if (!is_float(type(operand).value.scalar) || type(instruction.type).scalars != count ||
        type(second).scalars != count)
        return report(instruction, "a function with two results has operands of the wrong types");
    const std::uint32_t both = temporary(2 * count);
    emit(code, instruction, count, both, {operand});
    copy(instruction, count, define(instruction), {instruction.type, both});
    store(instruction, second, {second.type, both + count});
}

void Decoder::decode_interpolate(const Instruction& instruction, std::uint32_t code) {
    Values operands{pointer(instruction, 5)};
    const bool has_offset = code == kExtended + GLSLstd450InterpolateAtOffset;
    if (has_offset) operands.push_back(value(instruction, 6));
    const Type& input = type(operands[0]);
    if (operands[0].offset != 0 || operands[0].type != instruction.type || !is_float(input.value.scalar) ||
        (has_offset && type(operands[1]).scalars != 2))
        return report(instruction, "an interpolation function has operands that the evaluator does not know");
    emit(code, instruction, input.scalars, define(instruction), operands);
}

// Variables, loads, stores, and parts of composites. Most loads and extractions cost nothing: their result
// shares the slots of what they read.

void Decoder::decode_local_variable(const Instruction& instruction) {
    const auto variable = new_variable(instruction, module_.name(instruction.result), false);
    if (!variable) return;
    frame().values[instruction.result] = *variable;
    program_.variables.emplace_back(variable->slot, type(*variable).scalars);
    if (instruction.words.size() > 4) store(instruction, *variable, value(instruction, 4));
}

/// The result is the given value: the same slots where that is safe, otherwise a copy.
void Decoder::share_or_copy(const Instruction& instruction, const Value& value) {
    const std::uint32_t count = type(value).scalars;
    if (type(instruction.type).scalars != count) return report_types(instruction);
    const std::uint32_t code = instruction.opcode == spv::OpLoad ? spv::OpLoad : spv::OpCompositeExtract;
    if (may_share(instruction, value)) {
        share(instruction, value);
        emit(code, instruction, count, value.slot, {value});
        is_quick_.back() = false;
    } else {
        emit(code, instruction, count, define(instruction), {value});
    }
}

void Decoder::decode_copy(const Instruction& instruction) {
    share_or_copy(instruction, value(instruction, 3));
}

void Decoder::decode_load(const Instruction& instruction) {
    Value from = pointer(instruction, 3);
    if (error_) return;
    if (from.type != instruction.type) return report(instruction, "OpLoad has a result of the wrong type");
    const Value offset{Id::none, from.offset};
    if (is_read_only_[static_cast<std::size_t>(from.variable)]) from.variable = -1;
    from.is_pointer = false;
    from.offset = 0;
    if (offset.slot == 0) return share_or_copy(instruction, from);
    emit(kGather, instruction, type(from).scalars, define(instruction), {from, offset});
    frame().values[instruction.result].name = from.name;
}

void Decoder::decode_store(const Instruction& instruction) {
    const Value to = pointer(instruction, 1);
    const Value from = value(instruction, 2);
    if (error_) return;
    if (to.type != from.type || is_read_only_[static_cast<std::size_t>(to.variable)])
        return report_types(instruction);
    store(instruction, to, from);
}

void Decoder::store(const Instruction& instruction, const Value& target, const Value& from) {
    const std::uint32_t count = type(target).scalars;
    if (type(from).scalars != count && from.type != target.type && from.type != Id::none)
        return report(instruction, "a store has operands of the wrong types");
    if (target.offset != 0)
        emit(kScatter, instruction, count, target.slot, {from, Value{Id::none, target.offset}});
    else
        emit(spv::OpStore, instruction, count, target.slot, {from});
    program_.infos.back().result = slice(target);
    program_.infos.back().is_relaxed = target.is_relaxed;
}

/// Into a mediump or lowp parameter or result of a function.
void Decoder::store_relaxed(const Instruction& instruction, Value target, const Value& from) {
    target.is_relaxed = true;
    store(instruction, target, from);
}

/// One level down by an index known now. False (and reported) where there is no such part.
bool Decoder::step_into(const Instruction& instruction, Id& id, std::uint32_t& slot, std::uint32_t index) {
    const Id part = part_type(id, index);
    if (part == Id::none) {
        report(instruction, fmt::format("index {} is outside of what {} reaches into", index,
                                        opcode_name(instruction.opcode)));
        return false;
    }
    slot += part_offset(id, index);
    id = part;
    return true;
}

/// "lights[2]", "position.x", "light.color".
std::string Decoder::part_name(const std::string& whole, Id id, std::uint32_t index) const {
    const spv::Op opcode = type(id).opcode;
    if (opcode == spv::OpTypeVector && index < 4) return whole + "." + "xyzw"[index];
    if (opcode != spv::OpTypeStruct) return fmt::format("{}[{}]", whole, index);
    std::string member = module_.name(id, static_cast<int>(index));
    if (member.empty()) member = fmt::format("member{}", index);
    return whole.empty() ? member : whole + "." + member;
}

void Decoder::decode_access_chain(const Instruction& instruction) {
    Value at = pointer(instruction, 3);
    std::string path = program_.names[at.name];
    Words words{at.offset == 0 ? 0 : at.offset + 1};
    Words unstated;  // of the words, extents that the shader does not state
    Values indices;
    for (std::size_t word = 4; word < instruction.words.size() && !error_; ++word) {
        const auto constant = constant_bits_.find(instruction.id(word));
        const bool is_unstated = type(at).opcode == spv::OpTypeRuntimeArray;
        // One beyond the end, as specialisation constants may be, is clamped as a variable is, and told of.
        const bool is_beyond = constant != constant_bits_.end() && constant->second.size() == 1 &&
                               type(at).opcode != spv::OpTypeStruct && !is_unstated &&
                               constant->second.front() >= type(at).count && type(at).count > 0;
        if (constant != constant_bits_.end() && constant->second.size() == 1 && !is_beyond) {
            if (is_unstated && constant->second.front() >= type(at).count)
                return report(instruction, fmt::format("'{}' has no size, and is evaluated with {} elements",
                                                       path, type(at).count));
            const auto index = static_cast<std::uint32_t>(constant->second.front());
            path = part_name(path, at.type, index);
            if (type(at).opcode == spv::OpTypeStruct)
                at.is_relaxed =
                    module_.decoration(at.type, spv::DecorationRelaxedPrecision, static_cast<int>(index))
                        .has_value();
            if (!step_into(instruction, at.type, at.slot, index)) return;
            continue;
        }
        const Type& whole = type(at);
        if (whole.opcode == spv::OpTypeStruct)
            return report(instruction, "a member of a structure is chosen by a variable");
        const Value dynamic = value(instruction, word);
        if (!is_one(dynamic, is_index)) return report(instruction, "an index is not an integer");
        const std::string& name = program_.names[dynamic.name];
        path += fmt::format("[{}]", name.empty() ? "..." : name);
        std::uint32_t first = 0;
        if (!step_into(instruction, at.type, first, 0)) return;
        if (is_unstated) unstated.push_back(length_of(words) + 1);
        words.insert(words.end(), {dynamic.slot, whole.count, type(at).scalars});
        indices.push_back(dynamic);
    }
    if (error_) return;
    if (at.type != type(instruction.type).element)
        return report(instruction, "OpAccessChain has a result of the wrong type");
    at.name = intern(path);
    if (!indices.empty()) {
        // An address outlives its block rarely; slots of its own spare the bookkeeping.
        at.offset = permanent(1);
        const std::uint32_t computed = temporary(1);
        emit(spv::OpAccessChain, instruction, 1, computed, indices, words);
        program_.infos.back().result = slice(at);
        for (const std::uint32_t word : unstated)
            program_.unstated_extents.insert(program_.operations.back().extra + word);
        copy(instruction, 1, at.offset, {Id::none, computed});
    }
    frame().values[instruction.result] = at;
}

void Decoder::decode_extract(const Instruction& instruction) {
    Value part = value(instruction, 3);
    for (std::size_t word = 4; word < instruction.words.size() && !error_; ++word) {
        const std::uint32_t index = instruction.words[word];
        if (part.name != 0) part.name = intern(part_name(program_.names[part.name], part.type, index));
        if (!step_into(instruction, part.type, part.slot, index)) return;
    }
    if (!error_) share_or_copy(instruction, part);
}

void Decoder::decode_construct(const Instruction& instruction) {
    const Values parts = values(instruction, 3);
    Words words;
    std::uint32_t count = 0;
    for (const Value& part : parts) {
        words.insert(words.end(), {part.slot, type(part).scalars});
        count += type(part).scalars;
    }
    if (count != type(instruction.type).scalars) return report_types(instruction);
    emit(instruction.opcode, instruction, count, define(instruction), parts, std::move(words));
}

void Decoder::decode_insert(const Instruction& instruction) {
    const Value part = value(instruction, 3);
    const Value whole = value(instruction, 4);
    Id id = whole.type;
    std::uint32_t offset = 0;
    for (std::size_t word = 5; word < instruction.words.size() && !error_; ++word)
        if (!step_into(instruction, id, offset, instruction.words[word])) return;
    if (id != part.type || whole.type != instruction.type) return report_types(instruction);
    emit(instruction.opcode, instruction, type(whole).scalars, define(instruction), {part, whole},
         {offset, type(part).scalars});
}

void Decoder::decode_shuffle(const Instruction& instruction) {
    const Value a = value(instruction, 3);
    const Value b = value(instruction, 4);
    const std::uint32_t split = type(a).scalars;
    const std::uint32_t count = type(instruction.type).scalars;
    Words words;
    bool is_run = true;  // of consecutive components of a
    for (std::size_t word = 5; word < instruction.words.size(); ++word) {
        // 0xffffffff asks for an undefined component.
        const std::uint32_t index = instruction.words[word] == 0xffffffffU ? 0 : instruction.words[word];
        if (index >= split + type(b).scalars)
            return report(instruction, "OpVectorShuffle reaches outside its operands");
        words.push_back(index < split ? a.slot + index : b.slot + index - split);
        is_run = is_run && index < split && words.back() == words.front() + words.size() - 1;
    }
    if (words.size() != count || type(a).opcode != spv::OpTypeVector || count == 0)
        return report_types(instruction);
    const Value part{instruction.type, words.front(), a.allocation, a.variable};
    const bool is_shared = is_run && may_share(instruction, part);
    if (is_shared) share(instruction, part);
    emit(instruction.opcode, instruction, count, is_shared ? part.slot : define(instruction), {a, b},
         std::move(words));
    if (is_shared) is_quick_.back() = false;
}

/// A component of a vector chosen by a variable: read, or replaced.
void Decoder::decode_dynamic_component(const Instruction& instruction) {
    const Values operands = values(instruction, 3);
    const bool is_extract = instruction.opcode == spv::OpVectorExtractDynamic;
    if (operands.size() != (is_extract ? 2U : 3U) || type(operands[0]).opcode != spv::OpTypeVector ||
        !is_index(type(operands.back()).value.scalar))
        return report_types(instruction);
    const std::uint32_t extent = type(operands[0]).count;
    const std::uint32_t count = is_extract ? 1 : extent;
    if (type(instruction.type).scalars != count) return report_types(instruction);
    emit(instruction.opcode, instruction, count, define(instruction), operands, {extent});
}

}  // namespace gobo::evaluate
