#include "reflect/spirv_module.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "reflect/spirv_constant.hpp"

namespace gobo::spirv {
namespace {

constexpr std::size_t header_words = 5;
constexpr int largest = std::numeric_limits<int>::max();
/// SPIR-V's universal limit on the nesting of structs (specification, 2.17).
constexpr int deepest = 255;
/// Far above what any shader declares; keeps structs of structs of structs from growing without end.
constexpr std::int64_t most_parts = 1 << 20;

/// The fewest operands with which the instruction makes sense to this reader.
std::size_t least_operands(spv::Op opcode) {
    switch (opcode) {
        case spv::Op::OpTypeImage:
            return 8;
        case spv::Op::OpEntryPoint:
        case spv::Op::OpMemberName:
        case spv::Op::OpMemberDecorate:
        case spv::Op::OpTypeInt:
        case spv::Op::OpTypeVector:
        case spv::Op::OpTypeMatrix:
        case spv::Op::OpTypeArray:
        case spv::Op::OpTypePointer:
        case spv::Op::OpConstant:
        case spv::Op::OpSpecConstant:
        case spv::Op::OpSpecConstantOp:
        case spv::Op::OpVariable:
            return 3;
        case spv::Op::OpName:
        case spv::Op::OpDecorate:
        case spv::Op::OpTypeFloat:
        case spv::Op::OpTypeSampledImage:
        case spv::Op::OpTypeRuntimeArray:
            return 2;
        case spv::Op::OpTypeVoid:
        case spv::Op::OpTypeBool:
        case spv::Op::OpTypeSampler:
        case spv::Op::OpTypeStruct:
        case spv::Op::OpTypeFunction:
            return 1;
        default:
            return 0;
    }
}

bool has_element(spv::Op opcode) {
    switch (opcode) {
        case spv::Op::OpTypeVector:
        case spv::Op::OpTypeMatrix:
        case spv::Op::OpTypeImage:
        case spv::Op::OpTypeSampledImage:
        case spv::Op::OpTypeArray:
        case spv::Op::OpTypeRuntimeArray:
        case spv::Op::OpTypePointer:
            return true;
        default:
            return false;
    }
}

bool is_scalar(spv::Op opcode) {
    return opcode == spv::Op::OpTypeBool || opcode == spv::Op::OpTypeInt || opcode == spv::Op::OpTypeFloat;
}

/// Whether a type of one kind may be made of the other.
bool may_hold(spv::Op opcode, spv::Op part) {
    if (opcode == spv::Op::OpTypeVector || opcode == spv::Op::OpTypeImage) return is_scalar(part);
    if (opcode == spv::Op::OpTypeMatrix) return part == spv::Op::OpTypeVector;
    if (opcode == spv::Op::OpTypeSampledImage) return part == spv::Op::OpTypeImage;
    return opcode == spv::Op::OpTypePointer ||
           (part != spv::Op::OpTypeVoid && part != spv::Op::OpTypeFunction);
}

/// A literal string: bytes from the lowest of each word up to a zero.
std::string literal_string(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words) {
        for (int shift = 0; shift < 32; shift += 8) {
            const auto byte = static_cast<char>((word >> shift) & 0xffu);
            if (byte == '\0') return text;
            text += byte;
        }
    }
    return text;
}

/// Whether some byte of the literal string is zero.
bool ends(std::span<const std::uint32_t> words) {
    const auto has_zero = [](std::uint32_t word) {
        return (word & 0xffu) == 0 || (word & 0xff00u) == 0 || (word & 0xff0000u) == 0 || (word >> 24) == 0;
    };
    return std::ranges::any_of(words, has_zero);
}

using NameKey = std::tuple<Id, int>;
NameKey key_of(const Name& name) {
    return {name.id, name.member};
}

using DecorationKey = std::tuple<Id, int, spv::Decoration>;
DecorationKey key_of(const Decoration& decoration) {
    return {decoration.id, decoration.member, decoration.kind};
}

/// The entry with that key in a list sorted by key, or null.
template <class Entry, class Key>
const Entry* find(const std::vector<Entry>& sorted, const Key& key) {
    const auto by_key = [](const Entry& entry) { return key_of(entry); };
    const auto found = std::ranges::lower_bound(sorted, key, {}, by_key);
    return found != sorted.end() && key_of(*found) == key ? &*found : nullptr;
}

Image image_of(std::span<const std::uint32_t> operands) {
    Image image;
    image.dimension = static_cast<spv::Dim>(operands[2]);
    image.depth = operands[3] == 1;
    image.arrayed = operands[4] == 1;
    image.multisampled = operands[5] == 1;
    image.storage = operands[6] == 2;
    return image;
}

/// Reads instruction after instruction into a module; stops at the first problem.
class Reader {
  public:
    explicit Reader(std::vector<std::uint32_t> words) { module_.words = std::move(words); }

    Result<Module> read() {
        if (!read_header()) return failure();
        while (problem_.empty() && position_ < module_.words.size()) read_instruction();
        if (!problem_.empty()) return failure();
        sort();
        return std::move(module_);
    }

  private:
    using Operands = std::span<const std::uint32_t>;

    bool read_header() {
        if (module_.words.size() < header_words)
            problem_ = "it is shorter than a header";
        else if (module_.words[0] != spv::MagicNumber)
            problem_ = "it does not begin with SPIR-V's magic number";
        position_ = problem_.empty() ? header_words : 0;
        return problem_.empty();
    }

    [[nodiscard]] tl::unexpected<Diagnostics> failure() const {
        return fail(Fault::internal,
                    fmt::format("malformed SPIR-V module at word {}: {}", position_, problem_));
    }

    void read_instruction() {
        const std::uint32_t first = module_.words[position_];
        const std::size_t count = first >> spv::WordCountShift;
        if (count == 0) return stop("an instruction of no words");
        if (count > module_.words.size() - position_) return stop("an instruction runs past the end");
        Instruction instruction;
        instruction.opcode = static_cast<spv::Op>(first & spv::OpCodeMask);
        instruction.operands = Operands(module_.words).subspan(position_ + 1, count - 1);
        if (instruction.operands.size() < least_operands(instruction.opcode)) {
            return stop("an instruction lacks operands");
        }
        interpret(instruction.opcode, instruction.operands);
        if (!problem_.empty()) return;
        module_.instructions.push_back(instruction);
        position_ += count;
    }

    void interpret(spv::Op opcode, Operands operands) {
        switch (opcode) {
            case spv::Op::OpEntryPoint:
                return read_entry_point(operands);
            case spv::Op::OpName:
                return read_name(operands[0], whole, operands.subspan(1));
            case spv::Op::OpMemberName:
                return read_name(operands[0], static_cast<int>(operands[1]), operands.subspan(2));
            case spv::Op::OpDecorate:
                return read_decoration(operands[0], whole, operands.subspan(1));
            case spv::Op::OpMemberDecorate:
                return read_decoration(operands[0], static_cast<int>(operands[1]), operands.subspan(2));
            case spv::Op::OpGroupDecorate:
            case spv::Op::OpGroupMemberDecorate:
                return stop("decoration groups are not supported");
            case spv::Op::OpConstant:
            case spv::Op::OpSpecConstant:
            case spv::Op::OpSpecConstantOp:
                return read_constant(opcode, operands);
            case spv::Op::OpVariable:
                return read_variable(operands);
            default:
                if (is_type(opcode)) read_type(opcode, operands);
        }
    }

    void read_entry_point(Operands operands) {
        const Operands name = operands.subspan(2);
        if (!ends(name)) return stop("a string without an end");
        module_.entry_points.push_back(
            {static_cast<spv::ExecutionModel>(operands[0]), operands[1], literal_string(name)});
    }

    void read_name(Id id, int member, Operands literal) {
        if (!ends(literal)) return stop("a string without an end");
        module_.names.push_back({id, member, literal});
    }

    void read_decoration(Id id, int member, Operands operands) {
        const std::uint32_t value = operands.size() > 1 ? operands[1] : 0;
        module_.decorations.push_back({id, member, static_cast<spv::Decoration>(operands[0]), value});
    }

    void read_constant(spv::Op opcode, Operands operands) {
        const auto type = module_.types.find(operands[0]);
        if (type == module_.types.end()) return stop("a constant of an unknown type");
        if (type->second.opcode != spv::Op::OpTypeInt) return;
        const std::optional<std::int64_t> value =
            opcode == spv::Op::OpSpecConstantOp
                ? folded_integer(static_cast<spv::Op>(operands[2]), operands.subspan(3), module_.integers)
                : literal_integer(operands.subspan(2), type->second.width, type->second.is_signed);
        if (value) module_.integers[operands[1]] = *value;
    }

    void read_variable(Operands operands) {
        const auto pointer = module_.types.find(operands[0]);
        if (pointer == module_.types.end() || pointer->second.opcode != spv::Op::OpTypePointer) {
            return stop("a variable whose type is no pointer");
        }
        const auto storage = static_cast<spv::StorageClass>(operands[2]);
        if (storage == spv::StorageClass::Function) return;
        module_.variables.push_back({operands[1], pointer->second.element, storage});
    }

    static bool is_type(spv::Op opcode) {
        return opcode >= spv::Op::OpTypeVoid && opcode <= spv::Op::OpTypeFunction &&
               opcode != spv::Op::OpTypeOpaque;
    }

    void read_type(spv::Op opcode, Operands operands) {
        Type type;
        type.opcode = opcode;
        if (opcode == spv::Op::OpTypeInt || opcode == spv::Op::OpTypeFloat) {
            type.width = static_cast<int>(std::min<std::uint32_t>(operands[1], 64));
            type.is_signed = opcode == spv::Op::OpTypeInt && operands[2] == 1;
        } else if (opcode == spv::Op::OpTypeStruct) {
            type.members.assign(operands.begin() + 1, operands.end());
        } else if (opcode == spv::Op::OpTypePointer) {
            type.element = operands[2];
        } else if (has_element(opcode)) {
            type.element = operands[1];
            read_shape(type, operands);
        }
        check_nesting(type);
        if (!problem_.empty()) return;
        if (!module_.types.emplace(operands[0], std::move(type)).second) stop("a type declared twice");
    }

    /// What vectors, matrices, arrays and images have beside an element.
    void read_shape(Type& type, Operands operands) {
        if (type.opcode == spv::Op::OpTypeImage) type.image = image_of(operands);
        if (type.opcode == spv::Op::OpTypeVector || type.opcode == spv::Op::OpTypeMatrix) {
            if (operands[2] < 2 || operands[2] > 4) return stop("a vector or matrix of impossible size");
            type.count = static_cast<int>(operands[2]);
        }
        if (type.opcode == spv::Op::OpTypeArray) type.count = array_extent(operands[2]);
    }

    int array_extent(Id id) {
        const auto extent = module_.integers.find(id);
        if (extent == module_.integers.end())
            stop("an array whose size is no integer constant");
        else if (extent->second < 1 || extent->second > largest)
            stop("an array of impossible size");
        return problem_.empty() ? static_cast<int>(extent->second) : 0;
    }

    /// What a type is made of must be declared before it, fit, and not be nested without end.
    void check_nesting(Type& type) {
        std::vector<Id> parts = type.members;
        if (has_element(type.opcode)) parts.push_back(type.element);
        for (const Id part : parts) {
            const auto found = module_.types.find(part);
            if (found == module_.types.end()) return stop("a type made of an unknown type");
            if (!may_hold(type.opcode, found->second.opcode)) return stop("a type made of the wrong type");
            type.depth = std::max(type.depth, found->second.depth + 1);
            type.parts += found->second.parts;
        }
        if (type.depth > deepest || type.parts > most_parts) stop("types nested without end");
    }

    void sort() {
        std::ranges::stable_sort(module_.names, {}, [](const Name& name) { return key_of(name); });
        std::ranges::stable_sort(module_.decorations, {},
                                 [](const Decoration& decoration) { return key_of(decoration); });
    }

    void stop(std::string problem) {
        if (problem_.empty()) problem_ = std::move(problem);
    }

    Module module_;
    std::size_t position_ = 0;
    std::string problem_;
};

}  // namespace

std::string Module::name(Id id, int member) const {
    const Name* const found = find(names, NameKey(id, member));
    return found == nullptr ? std::string() : literal_string(found->literal);
}

std::optional<int> Module::decoration(Id id, spv::Decoration kind, int member) const {
    const Decoration* const found = find(decorations, DecorationKey(id, member, kind));
    if (found == nullptr) return std::nullopt;
    return static_cast<int>(std::min<std::uint32_t>(found->value, largest));
}

Result<Module> read_module(std::vector<std::uint32_t> words) {
    return Reader(std::move(words)).read();
}

}  // namespace gobo::spirv
