// Constants, variables outside functions, and the names of inputs, outputs and uniforms.
#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {
namespace {

/// The GLSL name of a built-in variable; empty for one that evaluation has no use for.
std::string builtin_name(std::uint32_t builtin) {
    switch (builtin) {
        case spv::BuiltInPosition:
            return "gl_Position";
        case spv::BuiltInPointSize:
            return "gl_PointSize";
        case spv::BuiltInClipDistance:
            return "gl_ClipDistance";
        case spv::BuiltInCullDistance:
            return "gl_CullDistance";
        case spv::BuiltInVertexId:
            return "gl_VertexID";
        case spv::BuiltInInstanceId:
            return "gl_InstanceID";
        case spv::BuiltInVertexIndex:
            return "gl_VertexIndex";
        case spv::BuiltInInstanceIndex:
            return "gl_InstanceIndex";
        case spv::BuiltInPrimitiveId:
            return "gl_PrimitiveID";
        case spv::BuiltInFragCoord:
            return "gl_FragCoord";
        case spv::BuiltInPointCoord:
            return "gl_PointCoord";
        case spv::BuiltInFrontFacing:
            return "gl_FrontFacing";
        case spv::BuiltInSampleId:
            return "gl_SampleID";
        case spv::BuiltInSamplePosition:
            return "gl_SamplePosition";
        case spv::BuiltInSampleMask:
            return "gl_SampleMask";
        case spv::BuiltInFragDepth:
            return "gl_FragDepth";
        case spv::BuiltInHelperInvocation:
            return "gl_HelperInvocation";
        case spv::BuiltInLayer:
            return "gl_Layer";
        case spv::BuiltInViewportIndex:
            return "gl_ViewportIndex";
        case spv::BuiltInBaseVertex:
            return "gl_BaseVertex";
        case spv::BuiltInBaseInstance:
            return "gl_BaseInstance";
        case spv::BuiltInDrawIndex:
            return "gl_DrawID";
        default:
            return {};
    }
}

bool is_scope(const Instruction& instruction, spv::StorageClass storage) {
    return instruction.word(3) == static_cast<std::uint32_t>(storage);
}

}  // namespace

void Decoder::decode_globals() {
    for (const Instruction& instruction : module_.instructions) {
        if (error_ || instruction.opcode == spv::OpFunction) return;
        switch (instruction.opcode) {
            case spv::OpConstant:
            case spv::OpConstantTrue:
            case spv::OpConstantFalse:
            case spv::OpConstantComposite:
            case spv::OpConstantNull:
            case spv::OpSpecConstant:
            case spv::OpSpecConstantTrue:
            case spv::OpSpecConstantFalse:
            case spv::OpSpecConstantComposite:
            case spv::OpUndef:
                decode_constant(instruction);
                break;
            case spv::OpSpecConstantOp:
                report_unknown(instruction);
                break;
            case spv::OpVariable:
                decode_variable(instruction);
                break;
            default:
                break;
        }
    }
}

/// The 32 bits of each slot of a constant; nothing where it is malformed. What is undefined is 0.
std::optional<std::vector<std::uint32_t>> Decoder::constant_bits(const Instruction& instruction) {
    const std::uint32_t slots = types_[instruction.type].slots;
    switch (instruction.opcode) {
        case spv::OpConstant:
        case spv::OpSpecConstant:
            return std::vector<std::uint32_t>{instruction.word(3)};
        case spv::OpConstantTrue:
        case spv::OpSpecConstantTrue:
            return std::vector<std::uint32_t>{1};
        case spv::OpConstantFalse:
        case spv::OpSpecConstantFalse:
            return std::vector<std::uint32_t>{0};
        case spv::OpConstantNull:
        case spv::OpUndef:
            return std::vector<std::uint32_t>(slots, 0);
        default:
            break;
    }
    std::vector<std::uint32_t> bits;
    for (std::size_t word = 3; word < instruction.words.size(); ++word) {
        const auto part = constant_bits_.find(instruction.words[word]);
        if (part == constant_bits_.end()) return std::nullopt;
        bits.insert(bits.end(), part->second.begin(), part->second.end());
        if (bits.size() > slots) return std::nullopt;
    }
    return bits;
}

void Decoder::decode_constant(const Instruction& instruction) {
    const std::uint32_t slots = types_[instruction.type].slots;
    std::optional<std::vector<std::uint32_t>> bits = constant_bits(instruction);
    if (!bits || slots == 0 || bits->size() != slots) return report(instruction, "a constant is malformed");
    const std::uint32_t slot = permanent(slots);
    const std::vector<Scalar> layout = types_.layout(instruction.type);
    for (std::uint32_t index = 0; index < slots; ++index)
        program_.constants.push_back({slot + index, layout[index], (*bits)[index]});
    constants_[instruction.result] = {instruction.type, slot, -1, -1,
                                      intern(module_.name_of(instruction.result))};
    constant_bits_[instruction.result] = std::move(*bits);
}

void Decoder::decode_variable(const Instruction& instruction) {
    const Type& pointer = types_[instruction.type];
    const Type& type = types_[pointer.element];
    if (pointer.shape != Type::Shape::pointer || type.slots == 0)
        return report(instruction,
                      fmt::format("the variable '{}' has a type that the evaluator does not know",
                                  module_.name_of(instruction.result)));
    const std::uint32_t slot = permanent(type.slots);
    const bool is_written = is_scope(instruction, spv::StorageClassOutput) ||
                            is_scope(instruction, spv::StorageClassPrivate) ||
                            is_scope(instruction, spv::StorageClassFunction);
    std::string path = module_.name_of(instruction.result);
    if (path.empty()) path = module_.name_of(pointer.element);
    if (path == "gl_PerVertex") path.clear();
    globals_[instruction.result] = {pointer.element, slot,         static_cast<int>(variables_.size()),
                                    std::nullopt,    intern(path), path};
    variables_.push_back({!is_written});
    if (is_written)
        program_.variables.emplace_back(slot, type.slots);
    else
        set_default(instruction, pointer.element, slot);
    name_interface(instruction, pointer, slot);
}

/// A uniform that is declared with a value has it unless the application sets another.
void Decoder::set_default(const Instruction& variable, std::uint32_t type, std::uint32_t slot) {
    const auto bits = constant_bits_.find(variable.word(4));
    if (bits == constant_bits_.end() || bits->second.size() != types_[type].slots) return;
    const std::vector<Scalar> layout = types_.layout(type);
    for (std::uint32_t index = 0; index < types_[type].slots; ++index)
        program_.constants.push_back({slot + index, layout[index], bits->second[index]});
}

void Decoder::name_interface(const Instruction& variable, const Type& pointer, std::uint32_t slot) {
    const Decorations& decorations = module_.decorations_of(variable.result);
    std::string name = module_.name_of(variable.result);
    if (decorations.builtin) name = builtin_name(*decorations.builtin);
    const Type& type = types_[pointer.element];
    const bool is_block = type.shape == Type::Shape::structure &&
                          module_.decorations_of(pointer.element).builtin == std::nullopt;
    int location = decorations.location ? static_cast<int>(*decorations.location) : -1;
    Layout layout;
    switch (variable.word(3)) {
        case spv::StorageClassInput:
            add_ports(program_.inputs, name, pointer.element, slot, location, layout);
            break;
        case spv::StorageClassOutput:
            add_ports(program_.outputs, name, pointer.element, slot, location, layout);
            break;
        case spv::StorageClassUniform:
        case spv::StorageClassPushConstant:
            // OpenGL names members of a block by the block, not by its instance.
            if (is_block) name = module_.name_of(pointer.element);
            layout.block = static_cast<int>(program_.uniform_blocks.size());
            program_.uniform_blocks.push_back({name, 0});
            add_ports(program_.uniforms, name, pointer.element, slot, location, layout);
            break;
        case spv::StorageClassUniformConstant:
            add_ports(program_.uniforms, name, pointer.element, slot, location, layout);
            break;
        case spv::StorageClassPrivate:
        case spv::StorageClassFunction:
            break;
        default:
            report(
                variable,
                fmt::format("the variable '{}' has a storage class that the evaluator does not know", name));
    }
}

void Decoder::add_ports(std::vector<Port>& ports, const std::string& name, std::uint32_t type,
                        std::uint32_t slot, int& location, const Layout& layout) {
    const Type& described = types_[type];
    if (described.shape == Type::Shape::structure)
        return add_member_ports(ports, name, type, slot, location, layout);
    if (described.shape != Type::Shape::array) return add_leaf(ports, name, type, slot, location, layout);
    const std::uint32_t stride = module_.decorations_of(type).array_stride.value_or(0);
    for (std::uint32_t index = 0; index < described.count; ++index) {
        Layout element = layout;
        element.offset += index * stride;
        add_ports(ports, fmt::format("{}[{}]", name, index), described.element,
                  slot + types_.offset(type, index), location, element);
    }
}

void Decoder::add_member_ports(std::vector<Port>& ports, const std::string& name, std::uint32_t type,
                               std::uint32_t slot, int& location, const Layout& layout) {
    for (std::uint32_t member = 0; member < types_[type].count; ++member) {
        const Decorations& decorations = module_.decorations_of(type, member);
        if (decorations.location) location = static_cast<int>(*decorations.location);
        Layout inner = layout;
        inner.offset += decorations.offset.value_or(0);
        inner.matrix_stride = decorations.matrix_stride.value_or(0);
        inner.is_row_major = decorations.row_major;
        const std::string full = decorations.builtin
                                     ? builtin_name(*decorations.builtin)
                                     : fmt::format("{}.{}", name, module_.member_name(type, member));
        add_ports(ports, full, types_[type].members[member], slot + types_.offset(type, member), location,
                  inner);
    }
}

/// A scalar, vector, matrix or image.
void Decoder::add_leaf(std::vector<Port>& ports, const std::string& name, std::uint32_t type,
                       std::uint32_t slot, int& location, const Layout& layout) {
    const Type& described = types_[type];
    if (described.shape == Type::Shape::image) {
        const auto index = static_cast<std::uint32_t>(program_.images.size());
        program_.constants.push_back({slot, Scalar::image, index});
        program_.images.push_back({name, described.image, slot});
        return;
    }
    Port port;
    port.name = name;
    port.type = types_.glsl_name(type);
    port.location = location;
    port.slot = slot;
    port.components = described.slots;
    port.scalar = described.scalar;
    port.block = layout.block;
    const bool is_matrix = described.shape == Type::Shape::matrix;
    const std::uint32_t rows = is_matrix ? types_[described.element].count : described.count;
    for (std::uint32_t component = 0; component < described.slots && layout.block >= 0; ++component) {
        const std::uint32_t column = component / rows;
        const std::uint32_t row = component % rows;
        const std::uint32_t offset = layout.is_row_major ? row * layout.matrix_stride + column * 4
                                                         : column * layout.matrix_stride + row * 4;
        port.offsets.push_back(layout.offset + offset);
        UniformBlock& block = program_.uniform_blocks[static_cast<std::size_t>(layout.block)];
        block.size = std::max(block.size, layout.offset + offset + 4);
    }
    if (location >= 0) location += static_cast<int>(is_matrix ? described.count : 1);
    ports.push_back(std::move(port));
}

/// Variables of the stage that are declared with a value get it when the stage begins.
void Decoder::initialise_globals() {
    Frame frame;
    frames_.push_back(&frame);
    for (const Instruction& instruction : module_.instructions) {
        if (error_ || instruction.opcode == spv::OpFunction) break;
        if (instruction.opcode != spv::OpVariable || instruction.words.size() < 5) continue;
        const Pointer& variable = globals_[instruction.result];
        if (!variables_[static_cast<std::size_t>(variable.variable)].is_read_only)
            store(instruction, variable, value(instruction, instruction.word(4)));
    }
    frames_.pop_back();
}

}  // namespace gobo::evaluate
