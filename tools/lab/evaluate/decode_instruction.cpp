// One instruction to one operation: most by the signature of their row, some by functions of their own.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {
namespace {

constexpr std::size_t kFirstOperand = 3;          // after the leading word, the type and the result
constexpr std::size_t kFirstExtendedOperand = 5;  // and after the instruction set and the number

bool is_scalar_or_vector(const Type& type) {
    return type.shape == Type::Shape::scalar || type.shape == Type::Shape::vector;
}

bool holds(Scalar scalar, char wanted) {
    switch (std::tolower(wanted)) {
        case 'f':
            return scalar == Scalar::real;
        case 'i':
            return is_integer(scalar);
        case 'b':
            return scalar == Scalar::boolean;
        default:
            return false;
    }
}

}  // namespace

void Decoder::decode_instruction(const Instruction& instruction) {
    switch (instruction.opcode) {
        case spv::OpNop:
        case spv::OpLine:
        case spv::OpNoLine:
        case spv::OpSelectionMerge:
        case spv::OpLoopMerge:
        case spv::OpPhi:
            return;
        case spv::OpUndef:
            return decode_constant(instruction);
        case spv::OpVariable:
            return decode_local_variable(instruction);
        case spv::OpLoad:
            return decode_load(instruction);
        case spv::OpStore:
            return decode_store(instruction);
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
            return decode_access_chain(instruction);
        case spv::OpCopyObject:
            return share_or_copy(instruction, value(instruction, instruction.word(3)));
        case spv::OpCompositeExtract:
            return decode_extract(instruction);
        case spv::OpCompositeConstruct:
            return decode_construct(instruction);
        case spv::OpCompositeInsert:
            return decode_insert(instruction);
        case spv::OpVectorShuffle:
            return decode_shuffle(instruction);
        case spv::OpVectorExtractDynamic:
        case spv::OpVectorInsertDynamic:
            return decode_dynamic_component(instruction);
        case spv::OpMatrixTimesVector:
        case spv::OpVectorTimesMatrix:
        case spv::OpMatrixTimesMatrix:
        case spv::OpOuterProduct:
        case spv::OpTranspose:
            return decode_product(instruction);
        case spv::OpMatrixTimesScalar:
            return decode_matrix_times_scalar(instruction);
        case spv::OpIAddCarry:
        case spv::OpISubBorrow:
        case spv::OpUMulExtended:
        case spv::OpSMulExtended:
            return decode_two_results(instruction);
        case spv::OpFunctionCall:
            return decode_call(instruction);
        case spv::OpExtInst:
            return decode_extended(instruction);
        default:
            break;
    }
    if (decode_image(instruction) || decode_by_signature(instruction, instruction.opcode, kFirstOperand))
        return;
    report_unknown(instruction);
}

/// False where the table has no row for the code.
bool Decoder::decode_by_signature(const Instruction& instruction, std::uint32_t code,
                                  std::size_t first_operand) {
    std::optional<std::uint32_t> row = find_row(code);
    const std::span<const Row> table = instruction_table();
    if (!row || table[*row].signature.empty()) return false;
    std::vector<Value> operands;
    for (std::size_t word = first_operand; word < instruction.words.size(); ++word)
        operands.push_back(value(instruction, instruction.words[word]));
    for (; *row < table.size() && table[*row].code == code; ++*row) {
        std::uint32_t count = 0;
        if (!fits(table[*row].signature, instruction.type, operands, count)) continue;
        emit_row(*row, instruction, count, define(instruction), operands);
        return true;
    }
    report(instruction, fmt::format("{} has operands of the wrong types", opcode_name(instruction.opcode)));
    return true;
}

bool Decoder::fits(std::string_view signature, std::uint32_t result, const std::vector<Value>& operands,
                   std::uint32_t& count) const {
    std::uint32_t demanded = 0;
    if (std::isdigit(static_cast<unsigned char>(signature.back())) != 0) {
        demanded = static_cast<std::uint32_t>(signature.back() - '0');
        signature.remove_suffix(1);
    }
    if (operands.size() != signature.size() - 2) return false;
    count = 0;
    for (std::size_t index = 0; index <= operands.size(); ++index) {
        const std::uint32_t id = index == 0 ? result : operands[index - 1].type;
        const char wanted = index == 0 ? signature[0] : signature[index + 1];
        const Type& type = types_[id];
        if (wanted == '*') {
            if (id != result || type.slots == 0) return false;
        } else {
            if (!is_scalar_or_vector(type) || !holds(type.scalar, wanted)) return false;
            if (std::isupper(static_cast<unsigned char>(wanted)) != 0) {
                if (type.slots != 1) return false;
                continue;
            }
        }
        if (count != 0 && count != type.slots) return false;
        count = type.slots;
    }
    if (count == 0) count = 1;
    return demanded == 0 || demanded == count;
}

void Decoder::decode_extended(const Instruction& instruction) {
    if (instruction.word(3) != module_.std450 || module_.std450 == 0)
        return report(instruction, "the evaluator knows no extended instructions but those of GLSL.std.450");
    const std::uint32_t number = instruction.word(4);
    const std::uint32_t code = kExtended + number;
    switch (number) {
        case GLSLstd450Determinant:
        case GLSLstd450MatrixInverse:
            return decode_square(instruction, code);
        case GLSLstd450Modf:
            return decode_split(instruction, kExtended + GLSLstd450ModfStruct, true);
        case GLSLstd450Frexp:
            return decode_split(instruction, kExtended + GLSLstd450FrexpStruct, true);
        case GLSLstd450ModfStruct:
        case GLSLstd450FrexpStruct:
            return decode_split(instruction, code, false);
        case GLSLstd450InterpolateAtCentroid:
        case GLSLstd450InterpolateAtSample:
        case GLSLstd450InterpolateAtOffset:
            return decode_interpolate(instruction, code);
        default:
            break;
    }
    if (!decode_by_signature(instruction, code, kFirstExtendedOperand))
        report(instruction,
               fmt::format("the evaluator does not know instruction {} of GLSL.std.450", number));
}

/// Products of matrices: of `columns` columns and `rows` rows, each a sum of `terms` products.
void Decoder::decode_product(const Instruction& instruction) {
    using Shape = Type::Shape;
    const bool is_transpose = instruction.opcode == spv::OpTranspose;
    const Value a = value(instruction, instruction.word(3));
    const Value b = is_transpose ? a : value(instruction, instruction.word(4));
    const Type& type = types_[instruction.type];
    const Type& left = types_[a.type];
    const Type& right = types_[b.type];
    std::uint32_t columns = type.shape == Shape::matrix ? type.count : 1;
    std::uint32_t rows = type.shape == Shape::matrix ? types_[type.element].count : type.count;
    std::uint32_t terms = 1;
    bool fits = type.scalar == Scalar::real && left.scalar == Scalar::real && right.scalar == Scalar::real;
    const auto has = [&](const Type& matrix, std::uint32_t of_columns, std::uint32_t of_rows) {
        return matrix.shape == Shape::matrix && matrix.count == of_columns &&
               types_[matrix.element].count == of_rows;
    };
    const auto is_vector = [](const Type& vector, std::uint32_t of) {
        return vector.shape == Shape::vector && vector.count == of;
    };
    switch (instruction.opcode) {
        case spv::OpMatrixTimesVector:
            terms = left.count;
            fits = fits && has(left, terms, rows) && is_vector(right, terms) && type.shape == Shape::vector;
            break;
        case spv::OpVectorTimesMatrix:
            std::swap(columns, rows);
            terms = left.count;
            fits =
                fits && is_vector(left, terms) && has(right, columns, terms) && type.shape == Shape::vector;
            break;
        case spv::OpMatrixTimesMatrix:
            terms = left.count;
            fits =
                fits && has(left, terms, rows) && has(right, columns, terms) && type.shape == Shape::matrix;
            break;
        case spv::OpOuterProduct:
            fits = fits && is_vector(left, rows) && is_vector(right, columns) && type.shape == Shape::matrix;
            break;
        default:
            fits = fits && has(left, rows, columns) && type.shape == Shape::matrix;
            break;
    }
    if (!fits)
        return report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
    const std::vector<Value> operands = is_transpose ? std::vector<Value>{a} : std::vector<Value>{a, b};
    emit(instruction.opcode, instruction, columns * rows * terms, define(instruction), operands,
         {columns, rows, terms});
    charge(Kind::add, columns * rows * (terms - 1));
}

void Decoder::decode_matrix_times_scalar(const Instruction& instruction) {
    const Value matrix = value(instruction, instruction.word(3));
    const Value factor = value(instruction, instruction.word(4));
    if (matrix.type != instruction.type || types_[matrix.type].shape != Type::Shape::matrix ||
        types_[factor.type].slots != 1 || types_[factor.type].scalar != Scalar::real)
        return report(instruction, "OpMatrixTimesScalar has operands of the wrong types");
    emit(instruction.opcode, instruction, types_[matrix.type].slots, define(instruction), {matrix, factor});
}

void Decoder::decode_square(const Instruction& instruction, std::uint32_t code) {
    const Value matrix = value(instruction, instruction.word(5));
    const Type& type = types_[matrix.type];
    const bool is_square = type.shape == Type::Shape::matrix && types_[type.element].count == type.count;
    const bool gives_matrix = code == kExtended + GLSLstd450MatrixInverse;
    const bool fits =
        gives_matrix ? instruction.type == matrix.type
                     : types_[instruction.type].slots == 1 && types_[instruction.type].scalar == Scalar::real;
    if (!is_square || !fits) return report(instruction, "a matrix function has operands of the wrong types");
    emit(code, instruction, type.slots, define(instruction), {matrix}, {type.count, type.count, type.count});
}

/// A structure of two results, low word or sum first.
void Decoder::decode_two_results(const Instruction& instruction) {
    const Value a = value(instruction, instruction.word(3));
    const Value b = value(instruction, instruction.word(4));
    const std::uint32_t count = types_[a.type].slots;
    if (types_[b.type].slots != count || types_[instruction.type].slots != 2 * count ||
        !is_integer(types_[a.type].scalar) || !is_integer(types_[b.type].scalar))
        return report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
    emit(instruction.opcode, instruction, count, define(instruction), {a, b});
}

/// modf() and frexp(): a structure of two results, or one result and one written through a pointer.
void Decoder::decode_split(const Instruction& instruction, std::uint32_t code, bool through_pointer) {
    const Value operand = value(instruction, instruction.word(5));
    const std::uint32_t count = types_[operand.type].slots;
    const std::uint32_t results = through_pointer ? count : 2 * count;
    if (types_[operand.type].scalar != Scalar::real || types_[instruction.type].slots != results)
        return report(instruction, "a function with two results has operands of the wrong types");
    if (!through_pointer) {
        emit(code, instruction, count, define(instruction), {operand});
        return;
    }
    const Pointer second = pointer(instruction, instruction.word(6));
    if (types_[second.type].slots != count)
        return report(instruction, "a function with two results has operands of the wrong types");
    int scratch = -1;
    const std::uint32_t both = temporary(2 * count, 0, scratch);
    emit(code, instruction, count, both, {operand});
    emit(kKeep, instruction, count, define(instruction), {Value{instruction.type, both}});
    store(instruction, second, Value{second.type, both + count});
}

void Decoder::decode_interpolate(const Instruction& instruction, std::uint32_t code) {
    const Pointer input = pointer(instruction, instruction.word(5));
    const bool has_offset = code == kExtended + GLSLstd450InterpolateAtOffset;
    std::vector<Value> operands{{input.type, input.slot, -1, input.variable, input.name}};
    if (has_offset) operands.push_back(value(instruction, instruction.word(6)));
    if (input.offset || input.type != instruction.type || types_[input.type].scalar != Scalar::real ||
        (has_offset && types_[operands[1].type].slots != 2))
        return report(instruction, "an interpolation function has operands that the evaluator does not know");
    emit(code, instruction, types_[input.type].slots, define(instruction), operands);
}

}  // namespace gobo::evaluate
