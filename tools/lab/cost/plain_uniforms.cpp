#include "lab/cost/plain_uniforms.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/numbers.hpp"
#include "core/text.hpp"

namespace gobo::cost {
namespace {

using spirv::Id;
using spirv::Instruction;
using spirv::Module;
using spirv::Type;
using spirv::Variable;

/// A type's place in a block, by std140.
struct Extent {
    std::uint32_t size = 0;
    std::uint32_t alignment = 4;
};

bool holds_image(const Module& module, Id id) {
    const Type& type = module.type(id);
    if (type.is_array()) return holds_image(module, type.element);
    return type.is_image() || type.opcode == spv::OpTypeSampler ||
           std::any_of(type.members.begin(), type.members.end(),
                       [&](Id member) { return holds_image(module, member); });
}

bool holds_boolean(const Module& module, Id id) {
    const Type& type = module.type(id);
    if (type.is_array()) return holds_boolean(module, type.element);
    if (type.opcode == spv::OpTypeStruct)
        return std::any_of(type.members.begin(), type.members.end(),
                           [&](Id member) { return holds_boolean(module, member); });
    return type.value.scalar == Scalar::boolean;
}

class Gathering {
  public:
    Gathering(const Module& module, const Words& words, const std::string& name)
        : module_(module), words_(words), name_(name), bound_(words[3]) {}

    Result<Words> run() {
        std::vector<std::string> with_images;
        for (const Variable& variable : module_.variables) {
            if (variable.storage != spv::StorageClassUniformConstant) continue;
            if (holds_image(module_, variable.type)) {
                Id element = variable.type;
                while (module_.type(element).is_array()) element = module_.type(element).element;
                if (module_.type(element).opcode == spv::OpTypeStruct)
                    with_images.push_back(module_.name(variable.id));
                continue;
            }
            members_[variable.id] = static_cast<std::uint32_t>(order_.size());
            order_.push_back(&variable);
        }
        if (!with_images.empty())
            return fail({.message = fmt::format("Vulkan has no samplers within structs, and here {} such: {}",
                                                with_images.size() == 1 ? "is one" : "are some",
                                                join(with_images, ", ")),
                         .help = "samplers of a struct become variables of their own",
                         .subject = with_images.front()});
        if (order_.empty()) return words_;
        declare_block();
        for (const Instruction& instruction : module_.instructions) GOBO_TRY_DO(rewrite(instruction));
        Words out(words_.begin(), words_.begin() + 5);
        out[3] = bound_;
        for (const Words* part : {&before_, &names_, &decorations_, &types_, &declarations_, &functions_})
            out.insert(out.end(), part->begin(), part->end());
        return out;
    }

  private:
    Id new_id() { return Id{bound_++}; }

    static void emit(Words& to, spv::Op opcode, const std::vector<std::uint32_t>& operands) {
        to.push_back(static_cast<std::uint32_t>(operands.size() + 1) << spv::WordCountShift | opcode);
        to.insert(to.end(), operands.begin(), operands.end());
    }
    static std::uint32_t word(Id id) { return static_cast<std::uint32_t>(id); }

    void decorate(Id id, spv::Decoration kind, std::vector<std::uint32_t> literals = {}) {
        literals.insert(literals.begin(), {word(id), static_cast<std::uint32_t>(kind)});
        emit(decorations_, spv::OpDecorate, literals);
    }
    void decorate_member(Id id, std::uint32_t member, spv::Decoration kind,
                         std::vector<std::uint32_t> literals = {}) {
        literals.insert(literals.begin(), {word(id), member, static_cast<std::uint32_t>(kind)});
        emit(decorations_, spv::OpMemberDecorate, literals);
    }

    /// A declaration of a number or vector, which a module holds once.
    Id numeric_type(spv::Op opcode, const std::vector<std::uint32_t>& operands) {
        for (const Instruction& instruction : module_.instructions)
            if (instruction.opcode == opcode && instruction.words.size() == operands.size() + 2 &&
                std::equal(operands.begin(), operands.end(), instruction.words.begin() + 2))
                return instruction.id(1);
        std::vector<std::uint32_t> key = operands;
        key.insert(key.begin(), opcode);
        const auto [known, is_new] = made_.try_emplace(key, Id::none);
        if (is_new) {
            known->second = new_id();
            std::vector<std::uint32_t> all = operands;
            all.insert(all.begin(), word(known->second));
            emit(declarations_, opcode, all);
        }
        return known->second;
    }
    Id whole_number(bool is_signed) {
        return numeric_type(spv::OpTypeInt, {32, static_cast<std::uint32_t>(is_signed)});
    }

    /// The type of the value as the block holds it: whole numbers for booleans.
    Id in_block(Id id) {
        if (!holds_boolean(module_, id)) return id;
        const auto known = in_block_.find(id);
        if (known != in_block_.end()) return known->second;
        const Type& type = module_.type(id);
        Id made = Id::none;
        if (type.is_array()) {
            const Id element = in_block(type.element);
            made = new_id();
            emit(declarations_, spv::OpTypeArray,
                 {word(made), word(element), module_.definition(id)->word(3)});
        } else if (type.opcode == spv::OpTypeStruct) {
            std::vector<std::uint32_t> operands = {0};
            for (const Id member : type.members) operands.push_back(word(in_block(member)));
            made = new_id();
            operands.front() = word(made);
            emit(declarations_, spv::OpTypeStruct, operands);
        } else {
            made = whole_number(false);
            if (type.value.rows > 1)
                made = numeric_type(spv::OpTypeVector,
                                    {word(made), static_cast<std::uint32_t>(type.value.rows)});
        }
        return in_block_[id] = made;
    }

    /// Lays a type out where it is not yet: strides of arrays, offsets of members.
    Extent lay_out(Id id) {
        const Type& type = module_.type(id);
        if (type.is_array()) {
            const Extent element = lay_out(type.element);
            const std::uint32_t stride = rounded_up(element.size, 16U);
            const Id array = in_block(id);
            if (!module_.decoration(id, spv::DecorationArrayStride) && laid_out_.emplace(array, 0).second)
                decorate(array, spv::DecorationArrayStride, {stride});
            return {stride * std::max(type.count, 1U), std::max(element.alignment, 16U)};
        }
        if (type.opcode == spv::OpTypeStruct) {
            const bool is_new = !module_.decoration(id, spv::DecorationOffset, 0) &&
                                laid_out_.emplace(in_block(id), 0).second;
            return lay_out_members(in_block(id), type.members, is_new);
        }
        const GlslType& value = type.value;
        if (value.is_matrix()) {
            const auto column = static_cast<std::uint32_t>(rounded_up(value.column_alignment(), 16));
            return {column * static_cast<std::uint32_t>(value.columns), column};
        }
        return {static_cast<std::uint32_t>(value.column_size()),
                static_cast<std::uint32_t>(value.column_alignment())};
    }

    Extent lay_out_members(Id structure, const std::vector<Id>& members, bool is_new) {
        std::uint32_t offset = 0;
        for (std::uint32_t i = 0; i < members.size(); ++i) {
            const Extent extent = lay_out(members[i]);
            offset = rounded_up(offset, extent.alignment);
            if (is_new) decorate_member(structure, i, spv::DecorationOffset, {offset});
            Id column = members[i];
            while (module_.type(column).is_array()) column = module_.type(column).element;
            const GlslType& value = module_.type(column).value;
            if (is_new && module_.type(column).opcode == spv::OpTypeMatrix) {
                decorate_member(structure, i, spv::DecorationColMajor);
                decorate_member(structure, i, spv::DecorationMatrixStride,
                                {static_cast<std::uint32_t>(rounded_up(value.column_alignment(), 16))});
            }
            offset += extent.size;
        }
        return {rounded_up(offset, 16U), 16};
    }

    void declare_block() {
        std::vector<Id> members;
        std::vector<std::uint32_t> operands = {0};
        for (const Variable* variable : order_) {
            members.push_back(variable->type);
            operands.push_back(word(in_block(variable->type)));
        }
        const Id structure = new_id();
        operands.front() = word(structure);
        emit(declarations_, spv::OpTypeStruct, operands);
        decorate(structure, spv::DecorationBlock);
        lay_out_members(structure, members, true);
        const Id pointer = new_id();
        emit(declarations_, spv::OpTypePointer, {word(pointer), spv::StorageClassUniform, word(structure)});
        block_ = new_id();
        emit(declarations_, spv::OpVariable, {word(pointer), word(block_), spv::StorageClassUniform});
        for (std::uint32_t i = 0; i < order_.size(); ++i) {
            indices_.push_back(new_id());
            emit(declarations_, spv::OpConstant, {word(whole_number(true)), word(indices_.back()), i});
        }
        std::vector<std::uint32_t> named = {word(structure)};
        std::string text = name_ + '\0';
        text.resize(rounded_up(text.size(), std::size_t{4}));
        for (std::size_t i = 0; i < text.size(); i += 4)
            named.push_back(static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) |
                            static_cast<std::uint32_t>(static_cast<unsigned char>(text[i + 1])) << 8 |
                            static_cast<std::uint32_t>(static_cast<unsigned char>(text[i + 2])) << 16 |
                            static_cast<std::uint32_t>(static_cast<unsigned char>(text[i + 3])) << 24);
        emit(names_, spv::OpName, named);
    }

    /// A pointer into the block to a value of that type of the module's.
    Id pointer_to(Id type) {
        const auto [known, is_new] = pointers_.try_emplace(type, Id::none);
        if (is_new) {
            const Id held = in_block(type);
            known->second = new_id();
            emit(declarations_, spv::OpTypePointer,
                 {word(known->second), spv::StorageClassUniform, word(held)});
        }
        return known->second;
    }

    bool is_member(Id id) const { return members_.contains(id); }

    Result<void> rewrite(const Instruction& instruction) {
        Words& part = part_of(instruction);
        const auto keep = [&] {
            part.insert(part.end(), instruction.words.begin(), instruction.words.end());
        };
        switch (instruction.opcode) {
            case spv::OpName:
            case spv::OpDecorate:
                if (!is_member(instruction.id(1))) keep();
                return {};
            case spv::OpVariable:
                if (!is_member(instruction.result)) keep();
                return {};
            case spv::OpEntryPoint: {
                const std::size_t at = part.size();
                for (std::size_t i = 0; i < instruction.words.size(); ++i)
                    if (i < 3 || !is_member(instruction.id(i))) part.push_back(instruction.words[i]);
                const std::size_t count = part.size() - at;
                part[at] = static_cast<std::uint32_t>(count) << spv::WordCountShift | spv::OpEntryPoint;
                return {};
            }
            case spv::OpAccessChain:
            case spv::OpInBoundsAccessChain: {
                const Id base = instruction.id(3);
                if (!is_member(base) && !inside_.contains(base)) break;
                const Id value = module_.type(instruction.type).element;
                inside_[instruction.result] = value;
                std::vector<std::uint32_t> operands(instruction.words.begin() + 1, instruction.words.end());
                operands[0] = word(pointer_to(value));
                if (is_member(base)) {
                    operands[2] = word(block_);
                    operands.insert(operands.begin() + 3, word(indices_[members_.at(base)]));
                }
                emit(part, instruction.opcode, operands);
                return {};
            }
            case spv::OpLoad:
                return rewrite_load(instruction, part);
            default:
                break;
        }
        keep();
        return {};
    }

    Result<void> rewrite_load(const Instruction& instruction, Words& part) {
        Id pointer = instruction.id(3);
        const bool is_whole = is_member(pointer);
        if (!is_whole && !inside_.contains(pointer)) {
            part.insert(part.end(), instruction.words.begin(), instruction.words.end());
            return {};
        }
        const Id value = instruction.type;
        if (is_whole) {
            const Id chain = new_id();
            emit(part, spv::OpAccessChain,
                 {word(pointer_to(value)), word(chain), word(block_), word(indices_[members_.at(pointer)])});
            pointer = chain;
        }
        const Id held = in_block(value);
        if (held == value) {
            emit(part, spv::OpLoad, {word(value), word(instruction.result), word(pointer)});
            return {};
        }
        const Type& type = module_.type(value);
        if (type.is_array() || type.opcode == spv::OpTypeStruct)
            return fail(Fault::input,
                        "a uniform outside blocks holds booleans and is read as a whole, which this driver "
                        "cannot be asked about",
                        "make its booleans ints");
        const Id loaded = new_id();
        emit(part, spv::OpLoad, {word(held), word(loaded), word(pointer)});
        const auto [zero, is_new] = zeros_.try_emplace(held, Id::none);
        if (is_new) {
            zero->second = new_id();
            emit(declarations_, spv::OpConstantNull, {word(held), word(zero->second)});
        }
        emit(part, spv::OpINotEqual,
             {word(value), word(instruction.result), word(loaded), word(zero->second)});
        return {};
    }

    /// Modules have their parts in this order: what comes before names, names, decorations, types, functions.
    Words& part_of(const Instruction& instruction) {
        switch (instruction.opcode) {
            case spv::OpDecorate:
            case spv::OpMemberDecorate:
            case spv::OpDecorationGroup:
            case spv::OpGroupDecorate:
            case spv::OpGroupMemberDecorate:
                return decorations_;
            case spv::OpName:
            case spv::OpMemberName:
            case spv::OpModuleProcessed:
                return names_;
            case spv::OpFunction:
                has_functions_ = true;
                break;
            default:
                has_types_ = has_types_ || (instruction.opcode >= spv::OpTypeVoid &&
                                            instruction.opcode <= spv::OpTypeForwardPointer);
        }
        return has_functions_ ? functions_ : has_types_ ? types_ : before_;
    }

    const Module& module_;
    const Words& words_;
    const std::string& name_;
    std::uint32_t bound_;
    std::map<Id, std::uint32_t> members_;            ///< the number of a variable among the block's
    std::vector<const Variable*> order_;             ///< of the members
    std::vector<Id> indices_;                        ///< constants: a member's number
    std::map<Id, Id> inside_;                        ///< pointers into the block, with the type of the value
    std::map<Id, Id> in_block_;                      ///< types that booleans change
    std::map<Id, Id> pointers_;                      ///< by the type of the value
    std::map<Id, Id> zeros_;                         ///< by type
    std::map<Id, int> laid_out_;                     ///< types that have been decorated
    std::map<std::vector<std::uint32_t>, Id> made_;  ///< numeric types that the module lacked
    Id block_ = Id::none;
    bool has_types_ = false;
    bool has_functions_ = false;
    Words before_, names_, decorations_, types_, declarations_, functions_;
};

}  // namespace

Result<Words> with_uniform_block(const Module& module, const Words& words, const std::string& name) {
    return Gathering(module, words, name).run();
}

}  // namespace gobo::cost
