#include "lab/evaluate/functions.hpp"

#include <fmt/format.h>
#include <spirv-tools/libspirv.h>

namespace gobo::evaluate {
namespace {

using spirv::Id;
using spirv::Instruction;

/// The labels that a terminator names; nothing where the instruction is none.
std::optional<std::vector<Id>> labels_of(const Instruction& instruction) {
    std::vector<Id> labels;
    switch (instruction.opcode) {
        case spv::OpBranch:
            return std::vector{instruction.id(1)};
        case spv::OpBranchConditional:
            return std::vector{instruction.id(2), instruction.id(3)};
        case spv::OpSwitch:
            for (std::size_t word = 2; word < instruction.words.size(); word += 2)
                labels.push_back(instruction.id(word));
            return labels;
        case spv::OpKill:
        case spv::OpReturn:
        case spv::OpReturnValue:
        case spv::OpUnreachable:
            return labels;
        default:
            return std::nullopt;
    }
}

/// The blocks that may follow, those that must come last in the order first.
std::vector<std::size_t> successors(const Function& function, const BasicBlock& block) {
    std::vector<Id> labels{block.merge, block.continue_to};
    labels.insert(labels.end(), block.next.begin(), block.next.end());
    std::vector<std::size_t> blocks;
    for (const Id label : labels)
        if (const auto found = function.block_of_label.find(label); found != function.block_of_label.end())
            blocks.push_back(found->second);
    return blocks;
}

}  // namespace

Result<Functions> read_functions(const spirv::Module& module) {
    Functions functions;
    Function* function = nullptr;
    BasicBlock* block = nullptr;
    for (std::uint32_t at = 0; at < module.instructions.size(); ++at) {
        const Instruction& instruction = module.instructions[at];
        const auto problem = [&](const char* message) {
            return fail(error_at(module.place(instruction.line), message));
        };
        if (function == nullptr && instruction.opcode != spv::OpFunction) continue;
        switch (instruction.opcode) {
            case spv::OpFunction:
                if (function != nullptr) return problem("a function begins inside another one");
                function = &functions[instruction.result];
                function->id = instruction.result;
                function->line = instruction.line;
                break;
            case spv::OpFunctionParameter:
                function->parameters.push_back(instruction.result);
                break;
            case spv::OpFunctionEnd:
                if (block != nullptr) return problem("a function ends inside a block");
                function = nullptr;
                break;
            case spv::OpLabel:
                if (block != nullptr) return problem("a block begins inside another one");
                function->block_of_label[instruction.result] = function->blocks.size();
                block = &function->blocks.emplace_back();
                block->label = instruction.result;
                block->first = at + 1;
                break;
            case spv::OpLine:
            case spv::OpNoLine:
                break;
            default:
                if (block == nullptr) return problem("an instruction stands outside any block");
                if (instruction.opcode == spv::OpLoopMerge) block->continue_to = instruction.id(2);
                if (is_one_of(instruction.opcode, {spv::OpLoopMerge, spv::OpSelectionMerge}))
                    block->merge = instruction.id(1);
                if (auto labels = labels_of(instruction)) {
                    block->next = std::move(*labels);
                    block->terminator = at;
                    block = nullptr;
                }
        }
    }
    if (function != nullptr) return fail(error_at({}, "the SPIR-V module ends inside a function"));
    return functions;
}

std::vector<std::size_t> structured_order(const Function& function) {
    struct Visit {
        std::size_t block;
        std::vector<std::size_t> next;
        std::size_t done = 0;
    };
    std::vector<std::size_t> finished;
    if (function.blocks.empty()) return finished;
    std::vector<bool> seen(function.blocks.size(), false);
    // An explicit stack: hostile modules may nest deeper than the processor's.
    std::vector<Visit> stack;
    const auto enter = [&](std::size_t block) {
        seen[block] = true;
        stack.push_back({block, successors(function, function.blocks[block])});
    };
    enter(0);
    while (!stack.empty()) {
        Visit& top = stack.back();
        if (top.done == top.next.size()) {
            finished.push_back(top.block);
            stack.pop_back();
        } else if (const std::size_t next = top.next[top.done++]; !seen[next]) {
            enter(next);
        }
    }
    std::ranges::reverse(finished);
    return finished;
}

UsesById uses_in(const spirv::Module& module, const Function& function) {
    UsesById uses;
    for (std::size_t block = 0; block < function.blocks.size(); ++block)
        for (std::uint32_t at = function.blocks[block].first; at <= function.blocks[block].terminator; ++at)
            if (const Id result = module.instructions[at].result; result != Id::none)
                uses[result].block = block;

    const auto use = [&](std::uint32_t id, std::size_t block, std::uint32_t at) {
        const auto found = uses.find(Id{id});
        if (found == uses.end()) return;
        ++found->second.count;
        if (found->second.block != block)
            found->second.is_local = false;
        else
            found->second.last = std::max(found->second.last, at);
    };
    for (std::size_t block = 0; block < function.blocks.size(); ++block) {
        for (std::uint32_t at = function.blocks[block].first; at <= function.blocks[block].terminator; ++at) {
            const Instruction& instruction = module.instructions[at];
            for (const std::uint32_t id : value_operands(instruction)) use(id, block, at);
            if (instruction.opcode != spv::OpPhi) continue;
            for (std::size_t word = 3; word + 1 < instruction.words.size(); word += 2) {
                const auto parent = function.block_of_label.find(instruction.id(word + 1));
                if (parent == function.block_of_label.end()) continue;
                use(instruction.word(word), parent->second, function.blocks[parent->second].terminator);
            }
        }
    }
    return uses;
}

std::span<const std::uint32_t> value_operands(const Instruction& instruction) {
    std::size_t first = 1;
    if (instruction.type != Id::none) ++first;
    if (instruction.result != Id::none) ++first;
    std::size_t count = instruction.words.size();
    const auto is = [&](std::initializer_list<spv::Op> list) { return is_one_of(instruction.opcode, list); };
    if (is({spv::OpPhi, spv::OpVariable, spv::OpLabel, spv::OpLine, spv::OpNoLine, spv::OpBranch,
            spv::OpSelectionMerge, spv::OpLoopMerge}))
        return {};
    if (is({spv::OpCompositeExtract, spv::OpSwitch, spv::OpBranchConditional, spv::OpLoad})) count = 1;
    if (is({spv::OpCompositeInsert, spv::OpVectorShuffle, spv::OpStore})) count = 2;
    if (is({spv::OpExtInst})) first += 2;
    if (is({spv::OpFunctionCall})) first += 1;
    const auto operands = instruction.words.subspan(std::min(first, instruction.words.size()));
    return operands.first(std::min(count, operands.size()));
}

Diagnostic error_at(const Place& place, std::string message, std::string help) {
    return {.place = place, .message = std::move(message), .help = std::move(help)};
}

std::string opcode_name(spv::Op opcode) {
    const std::string name = spvOpcodeString(opcode);
    return name == "unknown" ? fmt::format("instruction {}", static_cast<int>(opcode)) : "Op" + name;
}

}  // namespace gobo::evaluate
