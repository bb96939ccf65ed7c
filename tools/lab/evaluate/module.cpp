#define SPV_ENABLE_UTILITY_CODE  // HasResultAndType()
#include "lab/evaluate/module.hpp"

#include <fmt/format.h>
#include <spirv-tools/libspirv.h>

namespace gobo::evaluate {
namespace {

constexpr std::size_t kHeaderWords = 5;

/// Reads the module instruction by instruction; `error` is set by the first fault.
class Reader {
  public:
    explicit Reader(std::span<const std::uint32_t> words) : words_(words) {}

    Result<Module> read() {
        if (!read_header()) return fail(*error_);
        for (std::size_t at = kHeaderWords; at < words_.size();) {
            const std::size_t length = words_[at] >> 16;
            if (length == 0 || at + length > words_.size()) {
                report(fmt::format("the SPIR-V module is truncated at word {}", at));
                break;
            }
            read_instruction(words_.subspan(at, length));
            if (error_) break;
            at += length;
        }
        if (!error_ && function_ != nullptr) report("the SPIR-V module ends inside a function");
        if (error_) return fail(*error_);
        return std::move(module_);
    }

  private:
    void report(std::string message) {
        if (!error_) error_ = error_at(module_.places[place_], std::move(message));
    }

    bool read_header() {
        module_.places.emplace_back();
        if (words_.size() < kHeaderWords || words_[0] != spv::MagicNumber) {
            report("this is not a SPIR-V module of this machine's byte order");
            return false;
        }
        module_.bound = words_[3];
        // Each id needs an instruction of its own; a bound far above that would only eat memory.
        if (module_.bound > words_.size() * 4 + 1024) {
            report(fmt::format("the SPIR-V module claims {} ids in {} words", module_.bound, words_.size()));
            return false;
        }
        module_.definitions.assign(module_.bound, 0);
        return true;
    }

    void read_instruction(std::span<const std::uint32_t> words) {
        Instruction instruction{static_cast<spv::Op>(words[0] & 0xffffU), words, place_, 0, 0};
        bool has_result = false;
        bool has_type = false;
        spv::HasResultAndType(instruction.opcode, &has_result, &has_type);
        if (has_type) instruction.type = instruction.word(1);
        if (has_result) instruction.result = instruction.word(has_type ? 2 : 1);
        if (has_result) define(instruction);
        if (has_type && instruction.type >= module_.bound) report("an id is outside the module's bound");
        if (error_) return;
        const auto index = static_cast<std::uint32_t>(module_.instructions.size());
        module_.instructions.push_back(instruction);
        if (!read_about_ids(instruction)) read_about_functions(instruction, index);
    }

    void define(const Instruction& instruction) {
        const std::uint32_t id = instruction.result;
        if (id == 0 || id >= module_.bound) {
            report("an id is outside the module's bound");
        } else if (module_.definitions[id] != 0) {
            report(fmt::format("id {} is defined twice", id));
        } else {
            module_.definitions[id] = static_cast<std::uint32_t>(module_.instructions.size()) + 1;
        }
    }

    /// Names, decorations, places, entry points. False where the instruction is none of these.
    bool read_about_ids(const Instruction& instruction) {
        switch (instruction.opcode) {
            case spv::OpString:
            case spv::OpName:
                module_.names[instruction.word(1)] = literal_string(instruction, 2).first;
                return true;
            case spv::OpMemberName:
                module_.member_names[{instruction.word(1), instruction.word(2)}] =
                    literal_string(instruction, 3).first;
                return true;
            case spv::OpDecorate:
                decorate({instruction.word(1), -1}, instruction, 2);
                return true;
            case spv::OpMemberDecorate:
                decorate({instruction.word(1), instruction.word(2)}, instruction, 3);
                return true;
            case spv::OpExtInstImport:
                if (literal_string(instruction, 2).first == "GLSL.std.450")
                    module_.std450 = instruction.result;
                return true;
            case spv::OpEntryPoint:
                module_.entry_points.push_back(
                    {instruction.word(1), instruction.word(2), literal_string(instruction, 3).first});
                return true;
            case spv::OpLine:
                set_place(instruction);
                return true;
            case spv::OpNoLine:
                place_ = 0;
                return true;
            default:
                return false;
        }
    }

    void decorate(std::pair<std::uint32_t, std::int64_t> target, const Instruction& instruction,
                  std::size_t at) {
        Decorations& decorations = module_.decorations[target];
        const std::uint32_t value = instruction.word(at + 1);
        switch (instruction.word(at)) {
            case spv::DecorationLocation:
                decorations.location = value;
                break;
            case spv::DecorationBuiltIn:
                decorations.builtin = value;
                break;
            case spv::DecorationOffset:
                decorations.offset = value;
                break;
            case spv::DecorationArrayStride:
                decorations.array_stride = value;
                break;
            case spv::DecorationMatrixStride:
                decorations.matrix_stride = value;
                break;
            case spv::DecorationSpecId:
                decorations.spec_id = value;
                break;
            case spv::DecorationRowMajor:
                decorations.row_major = true;
                break;
            case spv::DecorationNoContraction:
                decorations.no_contraction = true;
                break;
            default:
                break;  // the others say nothing about values
        }
    }

    void set_place(const Instruction& instruction) {
        Place place{module_.name_of(instruction.word(1)), static_cast<int>(instruction.word(2)), 0};
        if (module_.places.back() != place) module_.places.push_back(std::move(place));
        place_ = static_cast<std::uint32_t>(module_.places.size()) - 1;
    }

    void read_about_functions(const Instruction& instruction, std::uint32_t index) {
        if (instruction.opcode == spv::OpFunction) {
            if (function_ != nullptr) return report("a function begins inside another one");
            function_ = &module_.functions[instruction.result];
            function_->id = instruction.result;
            function_->place = place_;
            return;
        }
        if (function_ == nullptr) return;
        switch (instruction.opcode) {
            case spv::OpFunctionParameter:
                function_->parameters.push_back(instruction.result);
                return;
            case spv::OpFunctionEnd:
                if (block_ != nullptr) report("a function ends inside a block");
                function_ = nullptr;
                place_ = 0;
                return;
            case spv::OpLabel:
                return begin_block(instruction, index);
            default:
                break;
        }
        if (block_ == nullptr) return report("an instruction stands outside any block");
        read_inside_block(instruction, index);
    }

    void begin_block(const Instruction& instruction, std::uint32_t index) {
        if (block_ != nullptr) return report("a block begins inside another one");
        function_->block_of_label[instruction.result] = function_->blocks.size();
        block_ = &function_->blocks.emplace_back();
        block_->label = instruction.result;
        block_->first = index + 1;
    }

    void read_inside_block(const Instruction& instruction, std::uint32_t index) {
        switch (instruction.opcode) {
            case spv::OpLoopMerge:
                block_->continue_to = instruction.word(2);
                [[fallthrough]];
            case spv::OpSelectionMerge:
                block_->merge = instruction.word(1);
                return;
            case spv::OpBranch:
                block_->next = {instruction.word(1)};
                break;
            case spv::OpBranchConditional:
                block_->next = {instruction.word(2), instruction.word(3)};
                break;
            case spv::OpSwitch:
                block_->next = {instruction.word(2)};
                for (std::size_t at = 4; at < instruction.words.size(); at += 2)
                    block_->next.push_back(instruction.words[at]);
                break;
            case spv::OpKill:
            case spv::OpReturn:
            case spv::OpReturnValue:
            case spv::OpUnreachable:
                break;
            default:
                return;
        }
        block_->terminator = index;
        block_ = nullptr;
    }

    std::span<const std::uint32_t> words_;
    Module module_;
    std::uint32_t place_ = 0;
    Function* function_ = nullptr;
    BasicBlock* block_ = nullptr;
    std::optional<Diagnostic> error_;
};

}  // namespace

const Instruction* Module::definition(std::uint32_t id) const {
    if (id >= definitions.size() || definitions[id] == 0) return nullptr;
    return &instructions[definitions[id] - 1];
}

std::string Module::name_of(std::uint32_t id) const {
    const auto found = names.find(id);
    return found == names.end() ? std::string() : found->second;
}

std::string Module::member_name(std::uint32_t type, std::uint32_t member) const {
    const auto found = member_names.find({type, member});
    return found == member_names.end() || found->second.empty() ? fmt::format("member{}", member)
                                                                : found->second;
}

const Decorations& Module::decorations_of(std::uint32_t id, std::int64_t member) const {
    static const Decorations none;
    const auto found = decorations.find({id, member});
    return found == decorations.end() ? none : found->second;
}

Result<Module> read_module(std::span<const std::uint32_t> words) {
    return Reader(words).read();
}

std::pair<std::string, std::size_t> literal_string(const Instruction& instruction, std::size_t index) {
    std::string text;
    for (; index < instruction.words.size(); ++index) {
        for (int byte = 0; byte < 4; ++byte) {
            const char letter = static_cast<char>(instruction.words[index] >> (8 * byte) & 0xffU);
            if (letter == '\0') return {std::move(text), index + 1};
            text.push_back(letter);
        }
    }
    return {std::move(text), index};
}

Diagnostic error_at(const Place& place, std::string message, std::string help) {
    Diagnostic diagnostic;
    diagnostic.place = place;
    diagnostic.message = std::move(message);
    diagnostic.help = std::move(help);
    return diagnostic;
}

std::string opcode_name(spv::Op opcode) {
    const std::string name = spvOpcodeString(opcode);
    return name == "unknown" ? fmt::format("instruction {}", static_cast<int>(opcode)) : "Op" + name;
}

}  // namespace gobo::evaluate
