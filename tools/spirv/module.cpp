#define SPV_ENABLE_UTILITY_CODE  // HasResultAndType()
#include "spirv/module.hpp"

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace gobo::spirv {
namespace {

constexpr std::size_t kHeaderWords = 5;
/// SPIR-V's universal limit on the nesting of structs (specification, 2.17).
constexpr std::uint32_t kDeepest = 255;
/// Far above what any shader declares; keeps structs of structs of structs from growing without end.
constexpr std::uint64_t kMostParts = 1 << 20;

/// The fewest words with which an instruction makes sense to the reader.
struct LeastWords {
    spv::Op opcode;
    std::size_t count;
};
constexpr LeastWords kLeastWords[] = {
    {spv::OpTypeImage, 9},      {spv::OpEntryPoint, 4},   {spv::OpMemberName, 4},
    {spv::OpMemberDecorate, 4}, {spv::OpTypeInt, 4},      {spv::OpTypeVector, 4},
    {spv::OpTypeMatrix, 4},     {spv::OpTypeArray, 4},    {spv::OpTypePointer, 4},
    {spv::OpConstant, 4},       {spv::OpSpecConstant, 4}, {spv::OpSpecConstantOp, 4},
    {spv::OpVariable, 4},       {spv::OpName, 3},         {spv::OpString, 3},
    {spv::OpDecorate, 3},       {spv::OpTypeFloat, 3},    {spv::OpTypeSampledImage, 3},
    {spv::OpTypeStruct, 2},     {spv::OpTypeFunction, 3}, {spv::OpTypeRuntimeArray, 3},
};

std::optional<Scalar> scalar_of(const Instruction& number) {
    using enum Scalar;
    constexpr Scalar kBySize[3][4] = {
        {uint8, uint16, uint32, uint64}, {int8, int16, int32, int64}, {float16, float16, float32, float64}};
    const std::uint32_t size = number.word(2) / 8;
    if (!std::has_single_bit(size) || size > 8) return std::nullopt;
    const std::size_t kind = number.opcode == spv::OpTypeFloat ? 2 : number.word(3) == 1 ? 1 : 0;
    return kBySize[kind][std::countr_zero(size)];
}

std::uint32_t limited(std::uint64_t scalars) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(scalars, Type::kMostScalars));
}

auto key_of(const Name& name) {
    return std::tuple(name.id, name.member);
}
auto key_of(const Decoration& decoration) {
    return std::tuple(decoration.id, decoration.member, decoration.kind);
}
constexpr auto kByKey = [](const auto& entry) { return key_of(entry); };

/// The entry with that key in a list sorted by key, or null.
template <class Entry, class... Key>
const Entry* find(const std::vector<Entry>& sorted, Key... key) {
    const auto found = std::ranges::lower_bound(sorted, std::tuple(key...), {}, kByKey);
    return found != sorted.end() && key_of(*found) == std::tuple(key...) ? &*found : nullptr;
}

/// Reads instruction after instruction into a module; stops at the first problem.
class Reader {
  public:
    explicit Reader(std::span<const std::uint32_t> words) : words_(words) {}

    Result<Module> read() {
        read_header();
        while (problem_.empty() && position_ < words_.size()) read_instruction();
        if (!problem_.empty())
            return fail(Fault::internal,
                        fmt::format("malformed SPIR-V module at word {}: {}", position_, problem_));
        std::ranges::stable_sort(module_.names, {}, kByKey);
        std::ranges::stable_sort(module_.decorations, {}, kByKey);
        return std::move(module_);
    }

  private:
    void stop(std::string problem) {
        if (problem_.empty()) problem_ = std::move(problem);
    }

    void read_header() {
        module_.lines.emplace_back();
        if (words_.size() < kHeaderWords) return stop("it is shorter than a header");
        if (words_[0] != spv::MagicNumber) return stop("it does not begin with SPIR-V's magic number");
        const std::uint32_t bound = words_[3];
        // Each id needs an instruction of its own; a bound far above that would only eat memory.
        if (bound > words_.size() * 4 + 1024)
            return stop(fmt::format("it claims {} ids in {} words", bound, words_.size()));
        module_.definitions.assign(bound, 0);
        position_ = kHeaderWords;
    }

    void read_instruction() {
        const std::size_t count = words_[position_] >> spv::WordCountShift;
        if (count == 0) return stop("an instruction of no words");
        if (count > words_.size() - position_) return stop("an instruction runs past the end");
        Instruction instruction;
        instruction.opcode = static_cast<spv::Op>(words_[position_] & spv::OpCodeMask);
        instruction.words = words_.subspan(position_, count);
        instruction.line = line_;
        const auto* least = std::ranges::find(kLeastWords, instruction.opcode, &LeastWords::opcode);
        if (least != std::end(kLeastWords) && count < least->count)
            return stop("an instruction lacks operands");
        bool has_result = false;
        bool has_type = false;
        spv::HasResultAndType(instruction.opcode, &has_result, &has_type);
        if (has_type) instruction.type = instruction.id(1);
        if (has_result) instruction.result = instruction.id(has_type ? 2 : 1);
        if (has_type && instruction.word(1) >= module_.definitions.size())
            return stop("an id outside the module's bound");
        if (has_result) define(instruction.word(has_type ? 2 : 1));
        interpret(instruction);
        if (!problem_.empty()) return;
        module_.instructions.push_back(instruction);
        position_ += count;
    }

    void define(std::uint32_t id) {
        if (id == 0 || id >= module_.definitions.size()) return stop("an id outside the module's bound");
        if (module_.definitions[id] != 0) return stop("an id declared twice");
        module_.definitions[id] = static_cast<std::uint32_t>(module_.instructions.size()) + 1;
    }

    void interpret(const Instruction& instruction) {
        switch (instruction.opcode) {
            case spv::OpEntryPoint:
                return void(module_.entry_points.push_back(
                    {instruction.as<spv::ExecutionModel>(1), instruction.id(2)}));
            case spv::OpName:
            case spv::OpString:
                return read_name(instruction, kWhole, 2);
            case spv::OpMemberName:
                return read_name(instruction, static_cast<int>(instruction.word(2)), 3);
            case spv::OpDecorate:
                return read_decoration(instruction, kWhole, 2);
            case spv::OpMemberDecorate:
                return read_decoration(instruction, static_cast<int>(instruction.word(2)), 3);
            case spv::OpGroupDecorate:
            case spv::OpGroupMemberDecorate:
                return stop("decoration groups are not supported");
            case spv::OpLine:
                return read_line({instruction.id(1), static_cast<int>(instruction.word(2))});
            case spv::OpNoLine:
            case spv::OpFunctionEnd:
                line_ = 0;
                return;
            case spv::OpConstant:
            case spv::OpSpecConstant:
            case spv::OpSpecConstantOp:
                return read_constant(instruction);
            case spv::OpVariable:
                return read_variable(instruction);
            default:
                if (instruction.opcode >= spv::OpTypeVoid && instruction.opcode <= spv::OpTypeFunction)
                    read_type(instruction);
        }
    }

    void read_name(const Instruction& instruction, int member, std::size_t first) {
        // Strings are filled up with zeros to whole words.
        if (instruction.words.back() >> 24 != 0) return stop("a string without an end");
        module_.names.push_back({instruction.id(1), member, instruction.words.subspan(first)});
    }

    void read_decoration(const Instruction& instruction, int member, std::size_t at) {
        const auto kind = instruction.as<spv::Decoration>(at);
        module_.decorations.push_back({instruction.id(1), member, kind, instruction.word(at + 1)});
    }

    void read_line(const Line& line) {
        if (module_.lines.back() != line) module_.lines.push_back(line);
        line_ = static_cast<std::uint32_t>(module_.lines.size()) - 1;
    }

    void read_constant(const Instruction& instruction) {
        const Type& type = module_.type(instruction.type);
        if (type.opcode == spv::OpNop) return stop("a constant of an unknown type");
        if (type.opcode != spv::OpTypeInt) return;
        std::optional<std::int64_t> value;
        if (instruction.opcode == spv::OpSpecConstantOp)
            value = folded(instruction);
        else if (type.value.scalar_size() == 8)
            value = static_cast<std::int64_t>(std::uint64_t{instruction.word(4)} << 32 | instruction.word(3));
        else if (type.value.scalar == Scalar::int32)
            value = static_cast<std::int32_t>(instruction.word(3));
        else
            value = instruction.word(3);
        // Values beyond 32 bits are of no use as sizes; without them the arithmetic below cannot overflow.
        if (value && *value >= std::numeric_limits<std::int32_t>::min() &&
            *value <= std::numeric_limits<std::uint32_t>::max())
            module_.integers[instruction.result] = *value;
    }

    /// Sums, differences, products, quotients, remainders and negations of known integers.
    [[nodiscard]] std::optional<std::int64_t> folded(const Instruction& instruction) const {
        const auto left = module_.integers.find(instruction.id(4));
        const auto right = module_.integers.find(instruction.id(5));
        if (left == module_.integers.end()) return std::nullopt;
        if (instruction.word(3) == spv::OpSNegate) return -left->second;
        if (right == module_.integers.end()) return std::nullopt;
        const std::int64_t a = left->second;
        const std::int64_t b = right->second;
        const auto is = [&](auto... opcodes) { return ((instruction.word(3) == opcodes) || ...); };
        if (is(spv::OpIAdd)) return a + b;
        if (is(spv::OpISub)) return a - b;
        if (is(spv::OpIMul)) return a * b;
        if (b != 0 && is(spv::OpSDiv, spv::OpUDiv)) return a / b;
        if (b != 0 && is(spv::OpSMod, spv::OpSRem, spv::OpUMod)) return a % b;
        return std::nullopt;
    }

    void read_variable(const Instruction& instruction) {
        const Type& pointer = module_.type(instruction.type);
        if (pointer.opcode != spv::OpTypePointer) return stop("a variable whose type is no pointer");
        const auto storage = instruction.as<spv::StorageClass>(3);
        if (storage != spv::StorageClassFunction)
            module_.variables.push_back({instruction.result, pointer.element, storage});
    }

    void read_type(const Instruction& instruction) {
        Type type;
        type.opcode = instruction.opcode;
        switch (instruction.opcode) {
            case spv::OpTypeBool:
                set_scalar(type, Scalar::boolean);
                break;
            case spv::OpTypeInt:
            case spv::OpTypeFloat:
                set_scalar(type, scalar_of(instruction));
                break;
            case spv::OpTypeVector:
                set_element(type, instruction.id(2), extent(instruction),
                            {spv::OpTypeBool, spv::OpTypeInt, spv::OpTypeFloat});
                type.value.rows = static_cast<int>(type.count);
                break;
            case spv::OpTypeMatrix:
                set_element(type, instruction.id(2), extent(instruction), {spv::OpTypeVector});
                type.value.columns = static_cast<int>(type.count);
                break;
            case spv::OpTypeArray:
                set_element(type, instruction.id(2), array_extent(instruction.id(3)));
                break;
            case spv::OpTypeRuntimeArray:
                set_element(type, instruction.id(2), 0);
                break;
            case spv::OpTypeStruct:
                set_members(type, instruction);
                break;
            case spv::OpTypeImage:
                set_element(type, instruction.id(2), 1, {spv::OpTypeBool, spv::OpTypeInt, spv::OpTypeFloat});
                type.value = {Scalar::uint32};
                type.image = {instruction.as<spv::Dim>(3), instruction.word(4) == 1, instruction.word(5) == 1,
                              instruction.word(6) == 1, instruction.word(7) == 2};
                break;
            case spv::OpTypeSampledImage:
                type.image = set_element(type, instruction.id(2), 1, {spv::OpTypeImage}).image;
                break;
            case spv::OpTypePointer:
                set_element(type, instruction.id(3), 0);
                type.storage = instruction.as<spv::StorageClass>(2);
                break;
            default:
                break;
        }
        if (type.depth > kDeepest || type.parts > kMostParts) stop("types nested without end");
        if (problem_.empty()) module_.types.emplace(instruction.result, std::move(type));
    }

    void set_scalar(Type& type, std::optional<Scalar> scalar) {
        if (!scalar) return stop("a number of an unknown width");
        type.value = {*scalar};
        type.scalars = 1;
        type.count = 1;
    }

    /// What the type is made of must be declared before it and be one of `fitting`; any type that has values
    /// where that is empty.
    const Type& part(Type& type, Id id, std::initializer_list<spv::Op> fitting) {
        const Type& found = module_.type(id);
        const bool is_value = found.opcode != spv::OpTypeVoid && found.opcode != spv::OpTypeFunction;
        if (found.opcode == spv::OpNop)
            stop("a type made of an unknown type");
        else if (fitting.size() == 0 ? !is_value : std::ranges::count(fitting, found.opcode) == 0)
            stop("a type made of the wrong type");
        type.depth = std::max(type.depth, found.depth + 1);
        type.parts += found.parts;
        return found;
    }

    const Type& set_element(Type& type, Id id, std::uint32_t count,
                            std::initializer_list<spv::Op> fitting = {}) {
        const Type& element = part(type, id, fitting);
        type.element = id;
        type.count = count;
        type.value = element.value;
        type.scalars = limited(std::uint64_t{count} * element.scalars);
        return element;
    }

    void set_members(Type& type, const Instruction& instruction) {
        std::uint64_t scalars = 0;
        for (std::size_t word = 2; word < instruction.words.size(); ++word) {
            const Type& member = part(type, instruction.id(word), {});
            if (type.members.empty()) type.value = member.value;
            type.members.push_back(instruction.id(word));
            scalars += member.scalars;
        }
        type.count = static_cast<std::uint32_t>(type.members.size());
        type.scalars = limited(scalars);
    }

    /// Of a vector or matrix.
    std::uint32_t extent(const Instruction& instruction) {
        if (instruction.word(3) < 2 || instruction.word(3) > 4) stop("a vector or matrix of impossible size");
        return instruction.word(3);
    }

    std::uint32_t array_extent(Id id) {
        const auto extent = module_.integers.find(id);
        if (extent == module_.integers.end()) {
            stop("an array whose size is no integer constant");
            return 0;
        }
        if (extent->second < 1 || extent->second > std::numeric_limits<std::int32_t>::max())
            stop("an array of impossible size");
        return static_cast<std::uint32_t>(extent->second);
    }

    std::span<const std::uint32_t> words_;
    Module module_;
    std::size_t position_ = 0;
    std::uint32_t line_ = 0;
    std::string problem_;
};

std::string_view dimension_name(spv::Dim dimension) {
    constexpr std::string_view kNames[] = {"1D", "2D", "3D", "Cube", "2DRect", "Buffer"};
    return dimension <= spv::DimBuffer ? kNames[dimension] : "2D";
}

std::string image_name(const Module& module, const Type& type, std::string_view kind) {
    const Scalar texel = module.type(type.element).value.scalar;
    return fmt::format("{}{}{}{}{}{}",
                       texel == Scalar::int32    ? "i"
                       : texel == Scalar::uint32 ? "u"
                                                 : "",
                       kind, dimension_name(type.image.dimension), type.image.multisampled ? "MS" : "",
                       type.image.arrayed ? "Array" : "", type.image.depth ? "Shadow" : "");
}

}  // namespace

std::string literal_text(std::span<const std::uint32_t> literal) {
    std::string text;
    for (const std::uint32_t word : literal) {
        for (int shift = 0; shift < 32; shift += 8) {
            const auto letter = static_cast<char>(word >> shift & 0xffU);
            if (letter == '\0') return text;
            text += letter;
        }
    }
    return text;
}

const Type& Module::type(Id id) const {
    static const Type none;
    const auto found = types.find(id);
    return found == types.end() ? none : found->second;
}

const Instruction* Module::definition(Id id) const {
    const auto index = static_cast<std::size_t>(id);
    return index >= definitions.size() || definitions[index] == 0 ? nullptr
                                                                  : &instructions[definitions[index] - 1];
}

std::string Module::name(Id id, int member) const {
    const Name* const found = find(names, id, member);
    return found == nullptr ? std::string() : literal_text(found->literal);
}

std::optional<std::uint32_t> Module::decoration(Id id, spv::Decoration kind, int member) const {
    const Decoration* const found = find(decorations, id, member, kind);
    return found == nullptr ? std::nullopt : std::optional(found->value);
}

Place Module::place(std::uint32_t line) const {
    return {name(lines[line].file), lines[line].number, 0};
}

Result<Module> read_module(std::span<const std::uint32_t> words) {
    return Reader(words).read();
}

std::string type_name(const Module& module, Id id) {
    const Type& type = module.type(id);
    switch (type.opcode) {
        case spv::OpTypeStruct:
            return module.name(id);
        case spv::OpTypeSampledImage:
            return image_name(module, module.type(type.element), "sampler");
        case spv::OpTypeImage:
            return image_name(module, type, type.image.storage ? "image" : "texture");
        case spv::OpTypeSampler:
            return "sampler";
        default:
            return type.value.name();
    }
}

}  // namespace gobo::spirv
