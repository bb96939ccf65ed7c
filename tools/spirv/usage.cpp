#include "spirv/usage.hpp"

#include <algorithm>

namespace gobo::spirv {
namespace {

/// A set of outputs, one bit each; outputs beyond the last bit count as always written.
using Outputs = std::uint64_t;
constexpr std::size_t kMostOutputs = 64;
constexpr Outputs kAll = ~Outputs{0};

bool touches(const std::set<Part>& parts, Id variable) {
    const auto first = parts.lower_bound({variable, kWhole});
    return first != parts.end() && first->first == variable;
}

struct BasicBlock {
    Outputs writes = 0;
    std::vector<Id> next;
    bool returns = false;
};

/// The basic blocks of one function, in the order of the module.
struct Function {
    std::vector<BasicBlock> blocks;
    std::vector<std::pair<std::size_t, Id>> calls;  ///< block, callee
};

class UsageReader {
  public:
    explicit UsageReader(const Module& module)
        : module_(module), parts_(module.definitions.size()), places_(module.definitions.size()) {}

    Usage read() {
        for (const Variable& variable : module_.variables)
            if (variable.storage != spv::StorageClassPrivate) part_of(variable.id) = {variable.id, kWhole};
        for (const Instruction& instruction : module_.instructions) read_instruction(instruction);
        for (const EntryPoint& entry : module_.entry_points) {
            const Outputs always = written_by(entry.function);
            for (std::size_t i = 0; i < outputs_.size(); ++i)
                if (i >= kMostOutputs || (always >> i & 1U) != 0) usage_.always_written.insert(outputs_[i]);
        }
        return std::move(usage_);
    }

  private:
    Part& part_of(Id id) {
        const auto index = static_cast<std::size_t>(id);
        return index < parts_.size() ? parts_[index] : nobody_;
    }

    /// That of a block in its function, by its label.
    [[nodiscard]] std::size_t place_of(Id label) const {
        const auto index = static_cast<std::size_t>(label);
        return index < places_.size() ? places_[index] : places_.size();
    }

    void read_part(Id pointer) {
        if (part_of(pointer).first != Id::none) usage_.read.insert(part_of(pointer));
    }

    void write_part(Id pointer) {
        const Part part = part_of(pointer);
        if (part.first == Id::none) return;
        usage_.written.insert(part);
        const auto number = static_cast<std::size_t>(std::ranges::find(outputs_, part) - outputs_.begin());
        if (number == outputs_.size()) outputs_.push_back(part);
        if (BasicBlock* const block = current_block(); block != nullptr && number < kMostOutputs)
            block->writes |= Outputs{1} << number;
    }

    BasicBlock* current_block() {
        return function_ == nullptr || function_->blocks.empty() ? nullptr : &function_->blocks.back();
    }

    void follow_chain(const Instruction& chain) {
        Part part = part_of(chain.id(3));
        if (part.first == Id::none) return;
        // glslang makes one chain of all indices, so only the first can choose a member of the variable.
        const Instruction* const variable = module_.definition(chain.id(3));
        const bool is_variable = variable != nullptr && variable->opcode == spv::OpVariable;
        const Id type = is_variable ? module_.type(variable->type).element : Id::none;
        if (module_.type(type).opcode == spv::OpTypeStruct)
            if (const auto index = module_.integers.find(chain.id(4)); index != module_.integers.end())
                part.second = static_cast<int>(index->second);
        part_of(chain.result) = part;
    }

    void read_instruction(const Instruction& instruction) {
        const auto end_block = [&](std::initializer_list<Id> next) {
            if (BasicBlock* const block = current_block()) block->next.insert(block->next.end(), next);
        };
        switch (instruction.opcode) {
            case spv::OpFunction:
                function_ = &functions_[instruction.result];
                return;
            case spv::OpFunctionEnd:
                function_ = nullptr;
                return;
            case spv::OpLabel:
                if (function_ == nullptr) return;
                places_[static_cast<std::size_t>(instruction.result)] = function_->blocks.size();
                function_->blocks.emplace_back();
                return;
            case spv::OpBranch:
                return end_block({instruction.id(1)});
            case spv::OpBranchConditional: {
                const Instruction* const condition = module_.definition(instruction.id(1));
                if (condition == nullptr || condition->opcode != spv::OpConstantFalse)
                    end_block({instruction.id(2)});
                if (condition == nullptr || condition->opcode != spv::OpConstantTrue)
                    end_block({instruction.id(3)});
                return;
            }
            case spv::OpSwitch:
                end_block({instruction.id(2)});
                for (std::size_t word = 4; word < instruction.words.size(); word += 2)
                    end_block({instruction.id(word)});
                return;
            case spv::OpReturn:
            case spv::OpReturnValue:
                if (BasicBlock* const block = current_block()) block->returns = true;
                return;
            case spv::OpKill:
            case spv::OpTerminateInvocation:
            case spv::OpDemoteToHelperInvocationEXT:
                usage_.discards = true;
                return;
            case spv::OpAccessChain:
            case spv::OpInBoundsAccessChain:
                return follow_chain(instruction);
            case spv::OpStore:
                return write_part(instruction.id(1));
            case spv::OpCopyMemory:
                write_part(instruction.id(1));
                return read_part(instruction.id(2));
            case spv::OpFunctionCall:
                if (function_ != nullptr && !function_->blocks.empty())
                    function_->calls.emplace_back(function_->blocks.size() - 1, instruction.id(3));
                for (std::size_t word = 4; word < instruction.words.size(); ++word) {
                    read_part(instruction.id(word));
                    if (part_of(instruction.id(word)).first != Id::none) write_part(instruction.id(word));
                }
                return;
            case spv::OpExtInst:
                for (std::size_t word = 5; word < instruction.words.size(); ++word)
                    read_part(instruction.id(word));
                return;
            case spv::OpAtomicStore:
                return write_part(instruction.id(1));
            case spv::OpVariable:
                return;
            default:
                // Loads, atomic operations, lengths of arrays, image texels: the pointer stands first.
                if (function_ != nullptr && instruction.result != Id::none) read_part(instruction.id(3));
        }
    }

    /// The outputs that every path through the function writes, by the callees too.
    Outputs written_by(Id id) {
        const auto found = functions_.find(id);
        if (found == functions_.end()) return 0;
        const auto [known, is_new] = written_by_.try_emplace(id, Outputs{0});
        if (!is_new) return known->second;  // 0 within a recursion, which OpenGL forbids
        Function& function = found->second;
        for (const auto& [block, callee] : function.calls)
            function.blocks[block].writes |= written_by(callee);
        std::vector<Outputs> before(function.blocks.size(), kAll);  // on every path that leads to the block
        if (!before.empty()) before.front() = 0;
        Outputs always = kAll;
        for (bool changed = true; changed;) {
            changed = false;
            always = kAll;
            for (std::size_t i = 0; i < before.size(); ++i) {
                const BasicBlock& block = function.blocks[i];
                const Outputs after = before[i] | block.writes;
                if (block.returns) always &= after;
                for (const Id next : block.next) {
                    const std::size_t place = place_of(next);
                    if (place >= before.size()) continue;  // of no function, or of a longer one
                    changed = changed || (before[place] & after) != before[place];
                    before[place] &= after;
                }
            }
        }
        return written_by_[id] = always;
    }

    const Module& module_;
    std::vector<Part> parts_;          ///< by pointer: the variable that it leads to
    std::vector<std::size_t> places_;  ///< by label: that of the block in its function
    Part nobody_;
    std::vector<Part> outputs_;
    std::unordered_map<Id, Function> functions_;
    Function* function_ = nullptr;
    std::unordered_map<Id, Outputs> written_by_;
    Usage usage_;
};

}  // namespace

bool Usage::reads(Id variable) const {
    return touches(read, variable);
}

bool Usage::writes(Id variable) const {
    return touches(written, variable);
}

Usage usage_of(const Module& module) {
    return UsageReader(module).read();
}

Part built_in_output(const Module& module, spv::BuiltIn built_in) {
    for (const Variable& variable : module.variables) {
        if (variable.storage != spv::StorageClassOutput) continue;
        if (module.decoration(variable.id, spv::DecorationBuiltIn) == built_in) return {variable.id, kWhole};
        const auto members = static_cast<int>(module.type(variable.type).members.size());
        for (int i = 0; i < members; ++i)
            if (module.decoration(variable.type, spv::DecorationBuiltIn, i) == built_in)
                return {variable.id, i};
    }
    return {Id::none, kWhole};
}

}  // namespace gobo::spirv
