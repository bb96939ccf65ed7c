#define SPV_ENABLE_UTILITY_CODE  // HasResultAndType()
#include "spirv/module.hpp"

#include <array>
#include <bit>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "spirv/constants.hpp"

namespace gobo::spirv {
namespace {

constexpr std::size_t kHeaderWords = 5;
constexpr std::size_t kUsualWords = 4;  ///< of an instruction
/// SPIR-V's universal limit on the nesting of structs (specification, 2.17).
constexpr std::uint32_t kDeepest = 255;
/// Far above what any shader declares; keeps structs of structs of structs from growing without end.
constexpr std::uint64_t kMostParts = 1 << 20;

/// The fewest words with which an instruction makes sense to the reader, by opcode.
constexpr auto kLeastWords = [] {
    std::array<std::uint8_t, spv::OpMemberDecorate + 1> least{};
    for (const spv::Op opcode :
         {spv::OpEntryPoint, spv::OpMemberName, spv::OpMemberDecorate, spv::OpTypeInt, spv::OpTypeVector,
          spv::OpTypeMatrix, spv::OpTypeArray, spv::OpTypePointer, spv::OpConstant, spv::OpSpecConstant,
          spv::OpSpecConstantOp, spv::OpVariable})
        least[opcode] = 4;
    for (const spv::Op opcode : {spv::OpName, spv::OpString, spv::OpDecorate, spv::OpTypeFloat,
                                 spv::OpTypeSampledImage, spv::OpTypeFunction, spv::OpTypeRuntimeArray})
        least[opcode] = 3;
    least[spv::OpTypeImage] = 9;
    return least;
}();

/// What a name is of: Module::names is sorted by it.
constexpr auto kPlace = [](const auto& name) { return name.first; };

std::optional<Scalar> scalar_of(const Instruction& number) {
    using enum Scalar;
    constexpr Scalar kBySize[3][4] = {
        {uint8, uint16, uint32, uint64}, {int8, int16, int32, int64}, {float16, float16, float32, float64}};
    const std::uint32_t size = number.word(2) / 8;
    if (!std::has_single_bit(size) || size > 8) return std::nullopt;
    const std::size_t kind = number.opcode == spv::OpTypeFloat ? 2 : number.word(3) == 1 ? 1 : 0;
    return kBySize[kind][std::countr_zero(size)];
}

/// Also those that extensions add: nothing else has a result and no type, but labels and what stands before
/// all types.
bool declares_type(const Instruction& instruction) {
    return instruction.opcode >= spv::OpTypeVoid && instruction.opcode != spv::OpDecorationGroup &&
           instruction.opcode != spv::OpLabel && instruction.result != Id::none &&
           instruction.type == Id::none;
}

std::uint32_t limited(std::uint64_t scalars) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(scalars, Type::kMostScalars));
}

/// Reads instruction after instruction into a module; stops at the first problem.
class Reader {
  public:
    explicit Reader(std::span<const std::uint32_t> words) : words_(words) {}

    Result<Module> read() {
        try {
            read_header();
            module_.instructions.reserve(words_.size() / kUsualWords);
            while (position_ < words_.size()) read_instruction();
            std::ranges::stable_sort(module_.names, {}, kPlace);
        } catch (Diagnostics& wrong) {
            return tl::unexpected(std::move(wrong));
        }
        return std::move(module_);
    }

  private:
    [[noreturn]] void stop(std::string_view problem) const {
        const std::string what = fmt::format("malformed SPIR-V module at word {}: {}", position_, problem);
        throw fail(Fault::internal, what).value();
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
        if (static_cast<std::size_t>(instruction.opcode) < kLeastWords.size() &&
            count < kLeastWords[instruction.opcode])
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
            case spv::OpConstantTrue:
            case spv::OpConstantFalse:
            case spv::OpConstantComposite:
            case spv::OpConstantNull:
            case spv::OpSpecConstant:
            case spv::OpSpecConstantTrue:
            case spv::OpSpecConstantFalse:
            case spv::OpSpecConstantComposite:
            case spv::OpSpecConstantOp:
                return read_constant(instruction);
            case spv::OpVariable:
                return read_variable(instruction);
            default:
                if (declares_type(instruction)) read_type(instruction);
        }
    }

    void read_name(const Instruction& instruction, int member, std::size_t first) {
        // Strings are filled up with zeros to whole words.
        if (instruction.words.back() >> 24 != 0) return stop("a string without an end");
        module_.names.emplace_back(std::pair(instruction.id(1), member), instruction.words.subspan(first));
    }

    void read_decoration(const Instruction& instruction, int member, std::size_t at) {
        module_.decorations.try_emplace({instruction.id(1), member, instruction.as<spv::Decoration>(at)},
                                        instruction.word(at + 1));
    }

    void read_line(const Line& line) {
        if (module_.lines.back() != line) module_.lines.push_back(line);
        line_ = static_cast<std::uint32_t>(module_.lines.size()) - 1;
    }

    void read_constant(const Instruction& instruction) {
        const Type& type = module_.type(instruction.type);
        if (type.opcode == spv::OpNop) return stop("a constant of an unknown type");
        constants_.add(instruction);
        const std::optional<std::int64_t> value = constants_.integer(instruction);
        // Values beyond 32 bits are of no use as sizes.
        if (value && *value >= std::numeric_limits<std::int32_t>::min() &&
            *value <= std::numeric_limits<std::uint32_t>::max())
            module_.integers[instruction.result] = *value;
    }

    void read_variable(const Instruction& instruction) {
        const Type& pointer = module_.type(instruction.type);
        if (pointer.opcode != spv::OpTypePointer) return stop("a variable whose type is not a pointer");
        const auto storage = instruction.as<spv::StorageClass>(3);
        if (storage != spv::StorageClassFunction)
            module_.variables.push_back({instruction.result, pointer.element, storage});
    }

    void read_type(const Instruction& instruction) {
        Type type;
        type.opcode = instruction.opcode;
        const auto is = [&](auto... opcodes) { return ((instruction.opcode == opcodes) || ...); };
        if (is(spv::OpTypeBool)) set_scalar(type, Scalar::boolean);
        if (is(spv::OpTypeInt, spv::OpTypeFloat)) set_scalar(type, scalar_of(instruction));
        if (is(spv::OpTypeVector, spv::OpTypeMatrix)) set_columns(type, instruction);
        if (is(spv::OpTypeArray)) set_element(type, instruction.id(2), array_extent(instruction));
        if (is(spv::OpTypeRuntimeArray)) set_element(type, instruction.id(2), 0);
        if (is(spv::OpTypeStruct)) set_members(type, instruction);
        if (is(spv::OpTypeImage)) set_image(type, instruction);
        if (is(spv::OpTypeSampledImage))
            type.image = set_element(type, instruction.id(2), 1, {spv::OpTypeImage}).image;
        if (is(spv::OpTypePointer)) {
            set_element(type, instruction.id(3), 0);
            type.storage = instruction.as<spv::StorageClass>(2);
        }
        if (type.depth > kDeepest || type.parts > kMostParts)
            throw fail(Fault::input,
                       fmt::format("types are nested more than {} deep, or hold more than {} members",
                                   kDeepest, kMostParts))
                .value();
        module_.types.emplace(instruction.result, std::move(type));
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
        type.value = {element.value.scalar};
        type.scalars = limited(std::uint64_t{count} * element.scalars);
        return element;
    }

    void set_members(Type& type, const Instruction& instruction) {
        std::uint64_t scalars = 0;
        for (std::size_t word = 2; word < instruction.words.size(); ++word) {
            const Type& member = part(type, instruction.id(word), {});
            if (type.members.empty()) type.value = {member.value.scalar};
            type.members.push_back(instruction.id(word));
            scalars += member.scalars;
        }
        type.count = static_cast<std::uint32_t>(type.members.size());
        type.scalars = limited(scalars);
    }

    void set_columns(Type& type, const Instruction& instruction) {
        const std::uint32_t count = instruction.word(3);
        if (count < 2 || count > 4) return stop("a vector or matrix of impossible size");
        if (instruction.opcode == spv::OpTypeVector) {
            set_element(type, instruction.id(2), count, {spv::OpTypeBool, spv::OpTypeInt, spv::OpTypeFloat});
            type.value.rows = static_cast<int>(count);
        } else {
            type.value.rows = set_element(type, instruction.id(2), count, {spv::OpTypeVector}).value.rows;
            type.value.columns = static_cast<int>(count);
        }
    }

    void set_image(Type& type, const Instruction& instruction) {
        set_element(type, instruction.id(2), 1, {spv::OpTypeBool, spv::OpTypeInt, spv::OpTypeFloat});
        type.value = {Scalar::uint32};
        type.image = {instruction.as<spv::Dim>(3), instruction.word(4) == 1,
                      instruction.word(5) == 1,    instruction.word(6) == 1,
                      instruction.word(7) == 2,    instruction.as<spv::ImageFormat>(8)};
    }

    std::uint32_t array_extent(const Instruction& array) {
        const auto extent = module_.integers.find(array.id(3));
        const bool is_known = extent != module_.integers.end();
        if (is_known && extent->second >= 1 && extent->second <= std::numeric_limits<std::int32_t>::max())
            return static_cast<std::uint32_t>(extent->second);
        const Instruction* const size = module_.definition(array.id(3));
        if (size == nullptr || (size->opcode != spv::OpSpecConstant && size->opcode != spv::OpSpecConstantOp))
            stop(is_known ? "an array of impossible size" : "an array whose size is not an integer constant");
        module_.unknown_sizes.insert(array.result);
        return 1;
    }

    std::span<const std::uint32_t> words_;
    Module module_;
    Constants constants_{module_};
    std::size_t position_ = 0;
    std::uint32_t line_ = 0;
};

std::string image_name(const Module& module, const Type& type, std::string_view kind) {
    constexpr std::string_view kDimensions[] = {"1D", "2D", "3D", "Cube", "2DRect", "Buffer", ""};
    const Scalar texel = module.type(type.element).value.scalar;
    const std::string_view prefix = texel == Scalar::int32 ? "i" : texel == Scalar::uint32 ? "u" : "";
    return fmt::format(
        "{}{}{}{}{}{}", prefix, kind,
        kDimensions[type.image.dimension <= spv::DimSubpassData ? type.image.dimension : spv::Dim2D],
        type.image.multisampled ? "MS" : "", type.image.arrayed ? "Array" : "",
        type.image.depth ? "Shadow" : "");
}

}  // namespace

std::string_view format_name(spv::ImageFormat format) {
    constexpr std::array<std::string_view, 40> kFormats = {"",          "rgba32f",      "rgba16f",
                                                           "r32f",      "rgba8",        "rgba8_snorm",
                                                           "rg32f",     "rg16f",        "r11f_g11f_b10f",
                                                           "r16f",      "rgba16",       "rgb10_a2",
                                                           "rg16",      "rg8",          "r16",
                                                           "r8",        "rgba16_snorm", "rg16_snorm",
                                                           "rg8_snorm", "r16_snorm",    "r8_snorm",
                                                           "rgba32i",   "rgba16i",      "rgba8i",
                                                           "r32i",      "rg32i",        "rg16i",
                                                           "rg8i",      "r16i",         "r8i",
                                                           "rgba32ui",  "rgba16ui",     "rgba8ui",
                                                           "r32ui",     "rgb10_a2ui",   "rg32ui",
                                                           "rg16ui",    "rg8ui",        "r16ui",
                                                           "r8ui"};
    const auto number = static_cast<std::size_t>(format);
    return number < kFormats.size() ? kFormats[number] : "";
}

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
    const std::size_t place = index < definitions.size() ? definitions[index] : 0;
    return place == 0 || place > instructions.size() ? nullptr : &instructions[place - 1];
}

std::string Module::name(Id id, int member) const {
    const std::pair place(id, member);
    const auto found = std::ranges::lower_bound(names, place, {}, kPlace);
    return found == names.end() || found->first != place ? std::string() : literal_text(found->second);
}

std::optional<std::uint32_t> Module::decoration(Id id, spv::Decoration kind, int member) const {
    const auto found = decorations.find({id, member, kind});
    return found == decorations.end() ? std::nullopt : std::optional(found->second);
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
            if (type.image.dimension == spv::DimSubpassData) return image_name(module, type, "subpassInput");
            return image_name(module, type, type.image.storage ? "image" : "texture");
        case spv::OpTypeSampler:
            return "sampler";
        case spv::OpTypeAccelerationStructureKHR:
            return "accelerationStructureEXT";
        default:
            return type.value.name();
    }
}

}  // namespace gobo::spirv
