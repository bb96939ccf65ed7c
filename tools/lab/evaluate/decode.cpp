// From a module to a Program: blocks, branches, and functions put in place of their calls.
#include <algorithm>

#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"
#include "spirv/transform.hpp"

namespace gobo::evaluate {
namespace {

constexpr std::size_t kDeepestCall = 64;
constexpr std::uint32_t kMostScalars = 1U << 18U;
constexpr std::int64_t kLongestUnstated = 1024;

/// Gives a size to types that state none: arrays that length, or that of the largest constant index, and what
/// holds them its scalars.
void state_sizes(spirv::Module& module, std::uint32_t length) {
    for (const Instruction& instruction : module.instructions)
        for (std::size_t word = 4;
             word < instruction.words.size() && instruction.opcode == spv::OpAccessChain; ++word)
            if (const auto index = module.integers.find(instruction.id(word));
                index != module.integers.end() && index->second < kLongestUnstated)
                length = std::max(length,
                                  static_cast<std::uint32_t>(std::max<std::int64_t>(index->second, 0)) + 1);
    for (const Instruction& instruction : module.instructions) {
        const auto found = module.types.find(instruction.result);
        if (found == module.types.end()) continue;
        Type& type = found->second;
        if (type.opcode == spv::OpTypeRuntimeArray) type.count = length;
        // Apart from its texture, which alone is asked.
        if (type.opcode == spv::OpTypeSampler) type.scalars = 1;
        std::uint64_t scalars = 0;
        if (type.is_array())
            scalars = std::uint64_t{type.count} * module.type(type.element).scalars;
        else if (type.opcode == spv::OpTypeStruct)
            for (const Id member : type.members) scalars += module.type(member).scalars;
        else
            continue;
        type.scalars = static_cast<std::uint32_t>(std::min<std::uint64_t>(scalars, Type::kMostScalars));
    }
}

}  // namespace

Result<Program> decode(std::span<const std::uint32_t> words, const DecodeOptions& options) {
    GOBO_TRY(spirv::Module module, spirv::read_module(words));
    const bool computes_specially = std::ranges::any_of(
        module.instructions, [](const Instruction& one) { return one.opcode == spv::OpSpecConstantOp; });
    if (!computes_specially) {
        state_sizes(module, options.unstated_length);
        return Decoder(module, options.widths).decode();
    }
    // Specialisation constants stand at their defaults, and what is computed from them too.
    GOBO_TRY(const spirv::Words fixed, spirv::specialized({words.begin(), words.end()}, {}));
    GOBO_TRY(spirv::Module special, spirv::read_module(fixed));
    state_sizes(special, options.unstated_length);
    return Decoder(special, options.widths).decode();
}

Result<Program> Decoder::decode() {
    check_types();
    if (error_) return fail(*error_);
    GOBO_TRY(functions_, read_functions(module_));
    const auto entry = std::ranges::find_if(module_.entry_points, [](const spirv::EntryPoint& one) {
        return one.model == spv::ExecutionModelVertex || one.model == spv::ExecutionModelFragment;
    });
    if (entry == module_.entry_points.end())
        return fail(error_at({}, "the SPIR-V module has no vertex or fragment stage"));
    program_.is_fragment = entry->model == spv::ExecutionModelFragment;
    for (std::uint32_t line = 0; line < module_.lines.size(); ++line)
        program_.places.push_back(module_.place(line));
    program_.names.emplace_back();
    permanent(1);  // slot 0 belongs to nobody
    decode_globals();
    const auto main = functions_.find(entry->function);
    if (!error_ && (main == functions_.end() || main->second.blocks.empty()))
        error_ = error_at({}, "the SPIR-V module's entry point is not a function");
    if (!error_) {
        begin_block(new_label());
        initialise_globals();
        inline_function(main->second, {});
    }
    if (!error_) finish_program();
    if (error_) return fail(*error_);
    return std::move(program_);
}

void Decoder::report(const Instruction& instruction, std::string message) {
    if (!error_) error_ = error_at(module_.place(instruction.line), std::move(message));
}

void Decoder::report_types(const Instruction& instruction) {
    report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
}

/// Whether values of the one type hold values of the other, or point to them.
bool Decoder::contains(Id whole, Id part) const {
    if (whole == part) return true;
    const Type& of = type(whole);
    return (of.element != Id::none && contains(of.element, part)) ||
           std::ranges::any_of(of.members, [&](Id member) { return contains(member, part); });
}

/// At the first line that has such a value; else by the name of a variable that holds one.
void Decoder::report_type(const Instruction& type, std::string message) {
    const auto holds_one = [&](const Instruction& one) {
        return one.type != Id::none && contains(one.type, type.result);
    };
    const auto& all = module_.instructions;
    const auto at = std::ranges::find_if(all, [&](const Instruction& one) {
        return one.line != 0 && one.opcode != spv::OpVariable && holds_one(one);  // else the function's line
    });
    if (at != all.end()) return report(*at, std::move(message));
    for (const Instruction& one : all)
        if (one.opcode == spv::OpVariable && holds_one(one) && !module_.name(one.result).empty())
            return report(one, fmt::format("'{}': {}", module_.name(one.result), message));
    report(type, std::move(message));
}

void Decoder::check_width(const Instruction& number) {
    const Scalar scalar = type(number.result).value.scalar;
    program_.has_narrow = program_.has_narrow || is_narrow(scalar);
    program_.has_wide = program_.has_wide || is_wide(scalar);
    const bool is_known = is_wide(scalar)     ? widths_ == Widths::up_to_64
                          : is_narrow(scalar) ? widths_ != Widths::of_32
                                              : true;
    if (!is_known)
        report_type(number, fmt::format("{}-bit {} are evaluated by gobo eval{} alone{}", number.word(2),
                                        is_float(scalar) ? "floating-point numbers" : "integers",
                                        is_wide(scalar) ? "" : ", gobo sanitize and gobo test",
                                        is_wide(scalar) ? ": searches compute in 32 bits" : ""));
}

/// Types that evaluation does not know are errors, used or not.
void Decoder::check_types() {
    for (const Instruction& instruction : module_.instructions) {
        const auto is = [&](std::initializer_list<spv::Op> list) {
            return is_one_of(instruction.opcode, list);
        };
        if (is({spv::OpTypeOpaque})) report_type(instruction, "opaque types are not evaluated");
        if (is({spv::OpTypeInt, spv::OpTypeFloat})) check_width(instruction);
        if (!is({spv::OpTypeArray, spv::OpTypeRuntimeArray, spv::OpTypeStruct})) continue;
        const Type& found = type(instruction.result);
        const auto is_empty = [&](Id part) { return type(part).scalars == 0; };
        if (found.scalars > kMostScalars)
            report_type(instruction, fmt::format("a type of {} scalars is too large", found.scalars));
        if (found.is_array() ? is_empty(found.element) : std::ranges::any_of(found.members, is_empty))
            report_type(instruction, "a type is made of parts that have no values");
    }
}

/// Resolves labels, separates what only observers see, and sorts the interface.
void Decoder::finish_program() {
    for (std::size_t index = 0; index < program_.blocks.size(); ++index) {
        Block& block = program_.blocks[index];
        for (std::uint32_t at = block.edge; at < block.edge + block.edges; ++at) {
            Edge& edge = program_.edges[at];
            if (edge.target != Program::kEnd) edge.target = label_blocks_[edge.target];
            if (edge.target <= index) program_.blocks[edge.target].is_loop = true;
        }
        block.quick_first = length_of(program_.quick);
        for (std::uint32_t at = block.first; at < block.first + block.count; ++at)
            if (is_quick_[at]) program_.quick.push_back(program_.operations[at]);
        block.quick_count = length_of(program_.quick) - block.quick_first;
    }
    for (std::vector<Port>* const ports : {&program_.inputs, &program_.outputs, &program_.uniforms})
        std::ranges::sort(*ports, {}, &Port::name);
}

std::uint32_t Decoder::new_label() {
    label_blocks_.push_back(0);
    return length_of(label_blocks_) - 1;
}

void Decoder::begin_block(std::uint32_t label) {
    label_blocks_[label] = length_of(program_.blocks);
    Block& next = program_.blocks.emplace_back();
    next.first = length_of(program_.operations);
    next.edge = length_of(program_.edges);
}

/// Ends the block; its edges have been added.
void Decoder::end_block(Block::End end, std::uint32_t line) {
    block().count = length_of(program_.operations) - block().first;
    block().edges = length_of(program_.edges) - block().edge;
    block().end = end;
    block().place = line;
}

void Decoder::jump(std::uint32_t label, std::uint32_t line) {
    block().edge = length_of(program_.edges);
    program_.edges.push_back({label, 0, 0});
    end_block(label == Program::kEnd ? Block::End::finish : Block::End::jump, line);
}

/// Decodes the function after the current block, and leaves its last block ended.
void Decoder::inline_function(const Function& function, Frame new_frame) {
    new_frame.function = &function;
    new_frame.uses = uses_in(module_, function);
    frames_.push_back(&new_frame);
    for (const BasicBlock& basic : function.blocks) new_frame.labels[basic.label] = new_label();
    jump(new_frame.labels[function.blocks.front().label], function.line);
    for (const std::size_t index : structured_order(function)) {
        if (program_.blocks.size() >= kLargestProgram && !error_)
            error_ = error_at(module_.place(function.line), "the stage is too long to evaluate");
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
    release_operands(module_.instructions[basic.terminator]);
    free_released();
}

/// The slots of a phi.
Value Decoder::phi_value(const Instruction& phi) {
    const auto [found, is_new] = frame().values.try_emplace(phi.result);
    if (is_new)
        found->second = {phi.type, permanent(type(phi.type).scalars), -1, -1,
                         intern(module_.name(phi.result))};
    return found->second;
}

void Decoder::decode_call(const Instruction& instruction) {
    const auto callee = functions_.find(instruction.id(3));
    if (callee == functions_.end() || callee->second.blocks.empty() ||
        callee->second.parameters.size() + 4 != instruction.words.size())
        return report(instruction, "a call of a function that is not there");
    const Function& function = callee->second;
    const bool is_recursive =
        std::ranges::any_of(frames_, [&](const Frame* caller) { return caller->function == &function; });
    if (is_recursive || frames_.size() >= kDeepestCall)
        return report(instruction, fmt::format("the function '{}' calls itself", module_.name(function.id)));
    Frame new_frame;
    for (std::size_t index = 0; index < function.parameters.size(); ++index) {
        const Id parameter = function.parameters[index];
        const Id declared = module_.definition(parameter)->type;
        const bool is_pointer = type(declared).opcode == spv::OpTypePointer;
        Value given = is_pointer ? pointer(instruction, index + 4) : value(instruction, index + 4);
        if (given.type != (is_pointer ? type(declared).element : declared))
            report(instruction, "a call has arguments of the wrong types");
        given.allocation = -1;  // the caller gives it back
        given.is_relaxed = given.is_relaxed || (is_pointer && is_relaxed(parameter));
        if (!is_pointer) given.variable = -1;
        if (!is_pointer && is_relaxed(parameter) && !is_relaxed(instruction.id(index + 4))) {
            const Value narrow{declared, permanent(type(declared).scalars), -1, -1, given.name};
            store_relaxed(instruction, narrow, given);
            given = narrow;
        }
        new_frame.values[parameter] = given;
    }
    if (error_) return;
    charge(Kind::call, 1);
    const std::uint32_t slots = type(instruction.type).scalars;
    new_frame.result = {instruction.type, slots == 0 ? 0 : permanent(slots)};
    new_frame.return_label = new_label();
    if (slots != 0) frame().values[instruction.result] = new_frame.result;
    const std::uint32_t after = new_frame.return_label;
    inline_function(function, std::move(new_frame));
    if (!error_) begin_block(after);
}

void Decoder::decode_terminator(const BasicBlock& basic, const Instruction& instruction) {
    block().edge = length_of(program_.edges);
    switch (instruction.opcode) {
        case spv::OpBranch:
            add_edge(basic, instruction.id(1), instruction);
            return end_block(Block::End::jump, instruction.line);
        case spv::OpBranchConditional:
            return decode_branch(basic, instruction);
        case spv::OpSwitch:
            return decode_switch(basic, instruction);
        case spv::OpKill:
            return end_block(Block::End::kill, instruction.line);
        case spv::OpReturnValue: {
            const Value result = value(instruction, 1);
            const std::uint32_t count = type(result).scalars;
            if (result.type != frame().result.type)
                return report(instruction, "a function returns the wrong type");
            Value returned = result;
            const Instruction* const definition = module_.definition(instruction.id(1));
            if (definition != nullptr && definition->opcode == spv::OpUndef) {
                // glslang returns this where the function ends without a return.
                returned.slot = permanent(count);
                const Function& function = *frame().function;
                const std::string name = module_.name(function.id);
                program_.undefined.push_back(
                    {returned.slot, count, function.line, name.substr(0, name.find('('))});
            }
            if (is_relaxed(frame().function->id) && !is_relaxed(instruction.id(1)))
                store_relaxed(instruction, frame().result, returned);
            else
                copy(instruction, count, frame().result.slot, returned);
            [[fallthrough]];
        }
        case spv::OpReturn:
            return jump(frame().return_label, instruction.line);
        default:
            return jump(Program::kEnd, instruction.line);  // OpUnreachable
    }
}

void Decoder::decode_branch(const BasicBlock& basic, const Instruction& instruction) {
    const Value condition = value(instruction, 1);
    if (!is_one(condition, is_boolean))
        return report(instruction, "a branch has a condition that is not a boolean");
    block().condition = condition.slot;
    charge(Kind::branch, 1);
    add_edge(basic, instruction.id(2), instruction);
    add_edge(basic, instruction.id(3), instruction);
    end_block(Block::End::branch, instruction.line);
}

void Decoder::decode_switch(const BasicBlock& basic, const Instruction& instruction) {
    const Value selector = value(instruction, 1);
    if (!is_one(selector, is_index))
        return report(instruction, "a switch has a selector that is not an integer");
    block().condition = selector.slot;
    block().labels = length_of(program_.words);
    charge(Kind::branch, 1);
    add_edge(basic, instruction.id(2), instruction);
    for (std::size_t word = 3; word + 1 < instruction.words.size(); word += 2) {
        program_.words.push_back(instruction.words[word]);
        add_edge(basic, instruction.id(word + 1), instruction);
    }
    end_block(Block::End::select, instruction.line);
}

void Decoder::add_edge(const BasicBlock& from, Id label, const Instruction& instruction) {
    const auto target = frame().function->block_of_label.find(label);
    if (target == frame().function->block_of_label.end())
        return report(instruction, "a branch leads nowhere");
    Edge edge{frame().labels[label], length_of(program_.copies), 0};
    add_phi_copies(from, frame().function->blocks[target->second]);
    edge.copies = length_of(program_.copies) - edge.first_copy;
    program_.edges.push_back(edge);
}

/// What those who take this edge bring to the phis of the block. All read before any is written.
void Decoder::add_phi_copies(const BasicBlock& from, const BasicBlock& to) {
    std::vector<Operation> writes;
    for (std::uint32_t at = to.first; at < to.terminator; ++at) {
        const Instruction& phi = module_.instructions[at];
        if (phi.opcode == spv::OpLine) continue;
        if (phi.opcode != spv::OpPhi) break;  // they stand first
        for (std::size_t word = 3; word + 1 < phi.words.size(); word += 2) {
            if (phi.id(word + 1) != from.label) continue;
            const Value brought = value(phi, word);
            if (brought.type != phi.type) return report_types(phi);
            const std::uint32_t count = type(phi.type).scalars;
            const std::uint32_t between = temporary(count);
            const std::uint32_t row = *find_row(kCopy);
            program_.copies.push_back({row, count, between, {brought.slot, 0, 0}, 0, 0});
            writes.push_back({row, count, phi_value(phi).slot, {between, 0, 0}, 0, 0});
            release(phi.id(word));
        }
    }
    program_.copies.insert(program_.copies.end(), writes.begin(), writes.end());
}

}  // namespace gobo::evaluate
