#include "lab/evaluate/types.hpp"

#include <fmt/format.h>

namespace gobo::evaluate {
namespace {

constexpr std::uint64_t kLargestSlots = 1U << 18U;
constexpr std::uint32_t kDeepest = 32;

class TypeReader {
  public:
    explicit TypeReader(const Module& module) : module_(module) {}

    Result<Types> read() {
        for (const Instruction& instruction : module_.instructions) {
            Type type;
            if (!describe(instruction, type)) continue;
            if (!error_.empty()) return fail(error_at(module_.places[instruction.place], error_));
            types_.add(instruction.result, std::move(type));
        }
        return std::move(types_);
    }

  private:
    /// False where the instruction declares no type.
    bool describe(const Instruction& instruction, Type& type) {
        using Shape = Type::Shape;
        switch (instruction.opcode) {
            case spv::OpTypeVoid:
                type.shape = Shape::nothing;
                return true;
            case spv::OpTypeBool:
                scalar(type, Scalar::boolean);
                return true;
            case spv::OpTypeInt:
                scalar(type, instruction.word(3) != 0 ? Scalar::signed_integer : Scalar::unsigned_integer);
                check_width(instruction, "integers");
                return true;
            case spv::OpTypeFloat:
                scalar(type, Scalar::real);
                check_width(instruction, "floating-point numbers");
                return true;
            case spv::OpTypeVector:
                repeat(type, Shape::vector, instruction, Shape::scalar, 4);
                return true;
            case spv::OpTypeMatrix:
                repeat(type, Shape::matrix, instruction, Shape::vector, 4);
                return true;
            case spv::OpTypeArray:
                array(type, instruction);
                return true;
            case spv::OpTypeStruct:
                structure(type, instruction);
                return true;
            case spv::OpTypeImage:
                begin(type, Shape::image, instruction.word(2));
                type.scalar = Scalar::image;
                type.slots = 1;
                type.image = {instruction.word(3), instruction.word(4) == 1, instruction.word(5) != 0,
                              instruction.word(6) != 0};
                return true;
            case spv::OpTypeSampledImage:
                type = types_[instruction.word(2)];
                if (type.shape != Shape::image) error_ = "a sampled image of what is no image";
                return true;
            case spv::OpTypePointer:
                begin(type, Shape::pointer, instruction.word(3));
                type.storage = instruction.word(2);
                return true;
            case spv::OpTypeFunction:
                begin(type, Shape::function, instruction.word(2));
                return true;
            case spv::OpTypeSampler:
            case spv::OpTypeRuntimeArray:
            case spv::OpTypeOpaque:
                error_ = fmt::format("{} is not supported", opcode_name(instruction.opcode));
                return true;
            default:
                return false;
        }
    }

    static void begin(Type& type, Type::Shape shape, std::uint32_t element, std::uint32_t count = 0) {
        type.shape = shape;
        type.element = element;
        type.count = count;
    }

    static void scalar(Type& type, Scalar scalar) {
        type.shape = Type::Shape::scalar;
        type.scalar = scalar;
        type.slots = 1;
        type.count = 1;
    }

    void check_width(const Instruction& instruction, const char* what) {
        if (instruction.word(2) != 32)
            error_ = fmt::format("{}-bit {} are not supported", instruction.word(2), what);
    }

    void repeat(Type& type, Type::Shape shape, const Instruction& instruction, Type::Shape of,
                std::uint32_t most) {
        const Type& element = types_[instruction.word(2)];
        if (element.shape != of || instruction.word(3) < 2 || instruction.word(3) > most) {
            error_ = fmt::format("{} is malformed", opcode_name(instruction.opcode));
            return;
        }
        begin(type, shape, instruction.word(2), instruction.word(3));
        type.scalar = element.scalar;
        type.slots = type.count * element.slots;
        type.depth = element.depth + 1;
    }

    void array(Type& type, const Instruction& instruction) {
        const Type& element = types_[instruction.word(2)];
        const Instruction* length = module_.definition(instruction.word(3));
        const bool constant =
            length != nullptr && (length->opcode == spv::OpConstant || length->opcode == spv::OpSpecConstant);
        if (element.slots == 0 || !constant || length->word(3) == 0) {
            error_ = "an array's element or length is malformed";
            return;
        }
        begin(type, Type::Shape::array, instruction.word(2), length->word(3));
        finish(type, std::uint64_t{type.count} * element.slots, element.depth);
    }

    void structure(Type& type, const Instruction& instruction) {
        type.shape = Type::Shape::structure;
        std::uint64_t slots = 0;
        std::uint32_t depth = 0;
        for (std::size_t index = 2; index < instruction.words.size(); ++index) {
            const Type& member = types_[instruction.words[index]];
            if (member.slots == 0) error_ = "a member's type is malformed";
            type.members.push_back(instruction.words[index]);
            slots += member.slots;
            depth = std::max(depth, member.depth);
        }
        type.count = static_cast<std::uint32_t>(type.members.size());
        finish(type, slots, depth);
    }

    void finish(Type& type, std::uint64_t slots, std::uint32_t depth) {
        if (slots > kLargestSlots) error_ = fmt::format("a type of {} scalars is too large", slots);
        if (depth >= kDeepest) error_ = fmt::format("types are nested more than {} deep", kDeepest);
        type.slots = static_cast<std::uint32_t>(slots);
        type.depth = depth + 1;
    }

    const Module& module_;
    Types types_;
    std::string error_;
};

}  // namespace

const Type& Types::operator[](std::uint32_t id) const {
    static const Type none;
    const auto found = types_.find(id);
    return found == types_.end() ? none : found->second;
}

std::vector<Scalar> Types::layout(std::uint32_t id) const {
    const Type& type = (*this)[id];
    if (type.shape == Type::Shape::structure) {
        std::vector<Scalar> all;
        for (const std::uint32_t member : type.members) {
            const std::vector<Scalar> part = layout(member);
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }
    if (type.shape != Type::Shape::array) return std::vector<Scalar>(type.slots, type.scalar);
    const std::vector<Scalar> element = layout(type.element);
    std::vector<Scalar> all;
    for (std::uint32_t index = 0; index < type.count; ++index)
        all.insert(all.end(), element.begin(), element.end());
    return all;
}

std::uint32_t Types::part(std::uint32_t id, std::uint32_t index) const {
    const Type& type = (*this)[id];
    if (index >= type.count) return 0;
    switch (type.shape) {
        case Type::Shape::vector:
        case Type::Shape::matrix:
        case Type::Shape::array:
            return type.element;
        case Type::Shape::structure:
            return type.members[index];
        default:
            return 0;
    }
}

std::uint32_t Types::offset(std::uint32_t id, std::uint32_t index) const {
    const Type& type = (*this)[id];
    if (type.shape != Type::Shape::structure) return index * (*this)[type.element].slots;
    std::uint32_t slots = 0;
    for (std::uint32_t member = 0; member < index; ++member) slots += (*this)[type.members[member]].slots;
    return slots;
}

std::string Types::glsl_name(std::uint32_t id) const {
    const Type& type = (*this)[id];
    const auto of_scalar = [&](const char* real, const char* integer, const char* natural,
                               const char* truth) {
        switch (type.scalar) {
            case Scalar::real:
                return real;
            case Scalar::signed_integer:
                return integer;
            case Scalar::unsigned_integer:
                return natural;
            case Scalar::boolean:
                return truth;
            default:
                return "";
        }
    };
    switch (type.shape) {
        case Type::Shape::scalar:
            return of_scalar("float", "int", "uint", "bool");
        case Type::Shape::vector:
            return fmt::format("{}{}", of_scalar("vec", "ivec", "uvec", "bvec"), type.count);
        case Type::Shape::matrix: {
            const std::uint32_t rows = (*this)[type.element].count;
            return rows == type.count ? fmt::format("mat{}", rows)
                                      : fmt::format("mat{}x{}", type.count, rows);
        }
        default:
            return {};
    }
}

Result<Types> read_types(const Module& module) {
    return TypeReader(module).read();
}

}  // namespace gobo::evaluate
