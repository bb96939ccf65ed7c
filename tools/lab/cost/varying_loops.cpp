#include "lab/cost/varying_loops.hpp"

#include <map>
#include <set>

namespace gobo::cost {
namespace {

using spirv::Id;
using spirv::Instruction;
using spirv::Module;

/// A block: from behind its label to its last instruction.
using Block = std::vector<const Instruction*>;

class Function {
  public:
    explicit Function(const Module& module) : module_(&module) {}

    void add(const Instruction& instruction) {
        if (instruction.opcode == spv::OpLabel) {
            label_ = instruction.result;
            blocks_[label_];
        } else {
            blocks_[label_].push_back(&instruction);
        }
        if (instruction.opcode == spv::OpStore) stores_.emplace(instruction.id(1), instruction.id(2));
    }

    bool has_varying_loop() const {
        for (const auto& [label, block] : blocks_)
            for (const Instruction* instruction : block)
                if (instruction->opcode == spv::OpLoopMerge && varies(label, instruction->id(1))) return true;
        return false;
    }

  private:
    static std::vector<Id> followers(const Instruction& last) {
        if (last.opcode == spv::OpBranch) return {last.id(1)};
        if (last.opcode == spv::OpBranchConditional) return {last.id(2), last.id(3)};
        if (last.opcode != spv::OpSwitch) return {};
        std::vector<Id> ids = {last.id(2)};
        for (std::size_t i = 4; i < last.words.size(); i += 2) ids.push_back(last.id(i));
        return ids;
    }

    /// The loop from its header to where it ends: each way out must be decided by a counter.
    bool varies(Id header, Id end) const {
        std::set<Id> seen = {header};
        std::vector<Id> open = {header};
        while (!open.empty()) {
            const auto block = blocks_.find(open.back());
            open.pop_back();
            if (block == blocks_.end() || block->second.empty()) continue;
            const Instruction& last = *block->second.back();
            if (last.opcode == spv::OpReturn || last.opcode == spv::OpReturnValue) return true;
            for (const Id next : followers(last)) {
                if (next == end) {
                    if (last.opcode != spv::OpBranchConditional || !is_counted(last.id(1))) return true;
                } else if (seen.insert(next).second) {
                    open.push_back(next);
                }
            }
        }
        return false;
    }

    /// What is made of constants alone, specialised ones too, is OpSpecConstantOp.
    bool is_constant(Id id) const {
        const Instruction* made = module_->definition(id);
        return made != nullptr && made->opcode >= spv::OpConstantTrue &&
               made->opcode <= spv::OpSpecConstantOp;
    }

    /// Compares a counter with a constant, or two counters.
    bool is_counted(Id condition) const {
        const Instruction* made = module_->definition(condition);
        if (made == nullptr) return false;
        if (made->opcode == spv::OpLogicalNot) return is_counted(made->id(3));
        const bool compares = made->opcode >= spv::OpIEqual && made->opcode <= spv::OpFUnordGreaterThanEqual;
        return is_constant(condition) || (compares && is_counter(made->id(3)) && is_counter(made->id(4)));
    }

    /// A constant, or the value of a variable that is only ever set to constants and to what they make of
    /// itself.
    bool is_counter(Id id) const {
        if (is_constant(id)) return true;
        const Instruction* made = module_->definition(id);
        if (made == nullptr || made->opcode != spv::OpLoad) return false;
        const auto [first, last] = stores_.equal_range(made->id(3));
        if (first == last) return false;
        for (auto store = first; store != last; ++store)
            if (!is_step(store->second, made->id(3))) return false;
        return true;
    }

    bool is_step(Id value, Id variable) const {
        if (is_constant(value)) return true;
        const Instruction* made = module_->definition(value);
        if (made == nullptr) return false;
        if (made->opcode == spv::OpLoad) return made->id(3) == variable;
        const bool computes = (made->opcode >= spv::OpSNegate && made->opcode <= spv::OpSMod) ||
                              (made->opcode >= spv::OpShiftRightLogical && made->opcode <= spv::OpNot);
        for (std::size_t i = 3; computes && i < made->words.size(); ++i)
            if (!is_step(made->id(i), variable)) return false;
        return computes;
    }

    const Module* module_;
    Id label_ = Id::none;
    std::map<Id, Block> blocks_;
    std::multimap<Id, Id> stores_;  ///< values by variable
};

}  // namespace

bool has_varying_loop(const Module& module) {
    Function function(module);
    for (const Instruction& instruction : module.instructions) {
        if (instruction.opcode == spv::OpFunction) function = Function(module);
        function.add(instruction);
        if (instruction.opcode == spv::OpFunctionEnd && function.has_varying_loop()) return true;
    }
    return false;
}

}  // namespace gobo::cost
