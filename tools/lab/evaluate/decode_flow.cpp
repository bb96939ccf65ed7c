// Blocks, branches, and functions put in place of their calls.
#include <algorithm>

#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {

std::uint32_t Decoder::new_label() {
    label_blocks_.push_back(0);
    return static_cast<std::uint32_t>(label_blocks_.size()) - 1;
}

void Decoder::begin_block(std::uint32_t label) {
    label_blocks_[label] = static_cast<std::uint32_t>(program_.blocks.size());
    Block& next = program_.blocks.emplace_back();
    next.first = static_cast<std::uint32_t>(program_.operations.size());
    next.edge = static_cast<std::uint32_t>(program_.edges.size());
}

/// Ends the block; its edges have been added.
void Decoder::end_block(Block::End end, std::uint32_t place) {
    block().count = static_cast<std::uint32_t>(program_.operations.size()) - block().first;
    block().edges = static_cast<std::uint32_t>(program_.edges.size()) - block().edge;
    block().end = end;
    block().place = place;
}

void Decoder::jump(std::uint32_t label, std::uint32_t place) {
    block().edge = static_cast<std::uint32_t>(program_.edges.size());
    program_.edges.push_back({label, 0, 0});
    end_block(label == Program::kEnd ? Block::End::finish : Block::End::jump, place);
}

/// Decodes the function after the current block, and leaves its last block ended.
void Decoder::inline_function(const Function& function, Frame new_frame) {
    new_frame.function = &function;
    new_frame.uses = uses_in(module_, function);
    frames_.push_back(&new_frame);
    for (const BasicBlock& basic : function.blocks) new_frame.labels[basic.label] = new_label();
    jump(new_frame.labels[function.blocks.front().label], function.place);
    for (const std::size_t index : structured_order(function)) {
        if (program_.blocks.size() >= kLargestProgram) {
            if (!error_)
                error_ = error_at(module_.places[function.place], "the stage is too long to evaluate");
        }
        if (error_) break;
        decode_block(function.blocks[index]);
    }
    frames_.pop_back();
}

void Decoder::decode_block(const BasicBlock& basic) {
    begin_block(frame().labels[basic.label]);
    // Phis get slots of their own before anything reads them; those who come here fill them.
    for (std::uint32_t at = basic.first; at < basic.terminator; ++at) {
        const Instruction& phi = module_.instructions[at];
        if (phi.opcode == spv::OpPhi) phi_value(phi);
    }
    for (std::uint32_t at = basic.first; at < basic.terminator && !error_; ++at) {
        frame().at = at;
        decode_instruction(module_.instructions[at]);
        if (!error_) finish_instruction(module_.instructions[at]);
    }
    if (error_) return;
    frame().at = basic.terminator;
    decode_terminator(basic, module_.instructions[basic.terminator]);
    for_each_value_operand(module_.instructions[basic.terminator], [&](std::uint32_t id) { release(id); });
    for (const int allocation : to_free_) free_allocation(allocation);
    to_free_.clear();
}

/// The slots of a phi.
Value Decoder::phi_value(const Instruction& phi) {
    const auto [found, is_new] = frame().values.try_emplace(phi.result);
    if (is_new)
        found->second = {phi.type, permanent(types_[phi.type].slots), -1, -1,
                         intern(module_.name_of(phi.result))};
    return found->second;
}

void Decoder::decode_call(const Instruction& instruction) {
    const auto callee = module_.functions.find(instruction.word(3));
    if (callee == module_.functions.end() || callee->second.blocks.empty() ||
        callee->second.parameters.size() + 4 != instruction.words.size())
        return report(instruction, "a call of a function that is not there");
    const Function& function = callee->second;
    const bool is_recursive = std::any_of(frames_.begin(), frames_.end(),
                                          [&](const Frame* caller) { return caller->function == &function; });
    if (is_recursive || frames_.size() >= kDeepestCall)
        return report(instruction,
                      fmt::format("the function '{}' calls itself", module_.name_of(function.id)));
    Frame callee_frame;
    for (std::size_t index = 0; index < function.parameters.size(); ++index) {
        const std::uint32_t parameter = function.parameters[index];
        const std::uint32_t argument = instruction.words[index + 4];
        const Instruction* declared = module_.definition(parameter);
        std::uint32_t given = 0;
        if (types_[declared->type].shape == Type::Shape::pointer) {
            const Pointer target = pointer(instruction, argument);
            given = target.type;
            callee_frame.pointers[parameter] = target;
            if (given != types_[declared->type].element) given = 0;
        } else {
            Value by_value = value(instruction, argument);
            given = by_value.type == declared->type ? by_value.type : 0;
            by_value.allocation = -1;  // the caller gives it back
            by_value.variable = -1;
            callee_frame.values[parameter] = by_value;
        }
        if (given == 0) report(instruction, "a call has arguments of the wrong types");
    }
    if (error_) return;
    charge(Kind::call, 1);
    const std::uint32_t slots = types_[instruction.type].slots;
    callee_frame.result_type = instruction.type;
    callee_frame.result_slot = slots == 0 ? 0 : permanent(slots);
    callee_frame.return_label = new_label();
    if (slots != 0)
        frame().values[instruction.result] = {instruction.type, callee_frame.result_slot, -1, -1, 0};
    const std::uint32_t after = callee_frame.return_label;
    inline_function(function, std::move(callee_frame));
    if (!error_) begin_block(after);
}

void Decoder::decode_terminator(const BasicBlock& basic, const Instruction& instruction) {
    block().edge = static_cast<std::uint32_t>(program_.edges.size());
    switch (instruction.opcode) {
        case spv::OpBranch:
            add_edge(basic, instruction.word(1), instruction);
            return end_block(Block::End::jump, instruction.place);
        case spv::OpBranchConditional:
            return decode_branch(basic, instruction);
        case spv::OpSwitch:
            return decode_switch(basic, instruction);
        case spv::OpKill:
            return end_block(Block::End::kill, instruction.place);
        case spv::OpReturnValue: {
            const Value result = value(instruction, instruction.word(1));
            if (result.type != frame().result_type)
                return report(instruction, "a function returns the wrong type");
            emit(kKeep, instruction, types_[result.type].slots, frame().result_slot, {result});
            [[fallthrough]];
        }
        case spv::OpReturn:
            return jump(frame().return_label, instruction.place);
        default:
            return jump(Program::kEnd, instruction.place);  // OpUnreachable
    }
}

void Decoder::decode_branch(const BasicBlock& basic, const Instruction& instruction) {
    const Value condition = value(instruction, instruction.word(1));
    if (types_[condition.type].slots != 1 || types_[condition.type].scalar != Scalar::boolean)
        return report(instruction, "a branch has a condition that is no boolean");
    block().condition = condition.slot;
    charge(Kind::branch, 1);
    add_edge(basic, instruction.word(2), instruction);
    add_edge(basic, instruction.word(3), instruction);
    end_block(Block::End::branch, instruction.place);
}

void Decoder::decode_switch(const BasicBlock& basic, const Instruction& instruction) {
    const Value selector = value(instruction, instruction.word(1));
    if (types_[selector.type].slots != 1 || !is_integer(types_[selector.type].scalar))
        return report(instruction, "a switch has a selector that is no integer");
    block().condition = selector.slot;
    block().labels = static_cast<std::uint32_t>(program_.words.size());
    charge(Kind::branch, 1);
    add_edge(basic, instruction.word(2), instruction);
    for (std::size_t word = 3; word + 1 < instruction.words.size(); word += 2) {
        program_.words.push_back(instruction.words[word]);
        add_edge(basic, instruction.words[word + 1], instruction);
    }
    end_block(Block::End::select, instruction.place);
}

void Decoder::add_edge(const BasicBlock& from, std::uint32_t spirv_label, const Instruction& instruction) {
    const auto target = frame().function->block_of_label.find(spirv_label);
    if (target == frame().function->block_of_label.end())
        return report(instruction, "a branch leads nowhere");
    Edge edge{frame().labels[spirv_label], static_cast<std::uint32_t>(program_.copies.size()), 0};
    add_phi_copies(from, frame().function->blocks[target->second], instruction);
    edge.copies = static_cast<std::uint32_t>(program_.copies.size()) - edge.first_copy;
    program_.edges.push_back(edge);
}

/// What those who take this edge bring to the phis of the block. All read before any is written.
void Decoder::add_phi_copies(const BasicBlock& from, const BasicBlock& to, const Instruction& instruction) {
    std::vector<Operation> reads;
    std::vector<Operation> writes;
    for (std::uint32_t at = to.first; at < to.terminator; ++at) {
        const Instruction& phi = module_.instructions[at];
        if (phi.opcode == spv::OpLine) continue;
        if (phi.opcode != spv::OpPhi) break;  // they stand first
        for (std::size_t word = 3; word + 1 < phi.words.size(); word += 2) {
            if (phi.words[word + 1] != from.label) continue;
            const Value brought = value(instruction, phi.words[word]);
            if (brought.type != phi.type) return report(phi, "OpPhi has operands of the wrong types");
            const std::uint32_t count = types_[phi.type].slots;
            int scratch = -1;
            const std::uint32_t between = temporary(count, 0, scratch);
            const std::uint32_t row = *find_row(kKeep);
            reads.push_back({row, count, between, {brought.slot, 0, 0}, 0, 0});
            writes.push_back({row, count, phi_value(phi).slot, {between, 0, 0}, 0, 0});
            release(phi.words[word]);
        }
    }
    program_.copies.insert(program_.copies.end(), reads.begin(), reads.end());
    program_.copies.insert(program_.copies.end(), writes.begin(), writes.end());
}

}  // namespace gobo::evaluate
