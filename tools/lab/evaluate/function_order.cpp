#include "lab/evaluate/function_order.hpp"

#include <algorithm>

namespace gobo::evaluate {
namespace {

/// The blocks that may follow, those that must come last in the order first.
std::vector<std::size_t> successors(const Function& function, const BasicBlock& block) {
    std::vector<std::uint32_t> labels;
    if (block.merge != 0) labels.push_back(block.merge);
    if (block.continue_to != 0) labels.push_back(block.continue_to);
    labels.insert(labels.end(), block.next.begin(), block.next.end());
    std::vector<std::size_t> blocks;
    for (const std::uint32_t label : labels) {
        const auto found = function.block_of_label.find(label);
        if (found != function.block_of_label.end()) blocks.push_back(found->second);
    }
    return blocks;
}

}  // namespace

std::vector<std::size_t> structured_order(const Function& function) {
    struct Visit {
        std::size_t block;
        std::vector<std::size_t> next;
        std::size_t done = 0;
    };
    std::vector<std::size_t> finished;
    if (function.blocks.empty()) return finished;
    std::vector<bool> seen(function.blocks.size(), false);
    // An explicit stack: hostile modules may nest deeper than the machine's.
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
    std::reverse(finished.begin(), finished.end());
    return finished;
}

UsesById uses_in(const Module& module, const Function& function) {
    UsesById uses;
    for (std::size_t block = 0; block < function.blocks.size(); ++block)
        for (std::uint32_t at = function.blocks[block].first; at <= function.blocks[block].terminator; ++at)
            if (module.instructions[at].result != 0) uses[module.instructions[at].result].block = block;

    const auto use = [&](std::uint32_t id, std::size_t block, std::uint32_t at) {
        const auto found = uses.find(id);
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
            for_each_value_operand(instruction, [&](std::uint32_t id) { use(id, block, at); });
            if (instruction.opcode != spv::OpPhi) continue;
            for (std::size_t word = 3; word + 1 < instruction.words.size(); word += 2) {
                const auto parent = function.block_of_label.find(instruction.words[word + 1]);
                if (parent == function.block_of_label.end()) continue;
                use(instruction.words[word], parent->second, function.blocks[parent->second].terminator);
            }
        }
    }
    return uses;
}

}  // namespace gobo::evaluate
