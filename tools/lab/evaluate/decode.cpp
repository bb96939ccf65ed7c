// From words to a Program: the flow of decoding, and what can be wrong with a module as a whole.
#include <algorithm>

#include <fmt/format.h>

#include "lab/evaluate/decoder.hpp"

namespace gobo::evaluate {

Result<Program> decode(std::span<const std::uint32_t> words) {
    const Result<Module> module = read_module(words);
    if (!module) return tl::unexpected(module.error());
    const Result<Types> types = read_types(*module);
    if (!types) return tl::unexpected(types.error());
    return Decoder(*module, *types).decode();
}

Result<Program> Decoder::decode() {
    const EntryPoint* entry = find_entry_point();
    if (entry == nullptr) return fail(error_at({}, "the SPIR-V module has no vertex or fragment stage"));
    program_.is_fragment = entry->model == spv::ExecutionModelFragment;
    program_.places = module_.places;
    program_.names.emplace_back();
    permanent(1);  // slot 0 belongs to nobody
    decode_globals();
    const auto main = module_.functions.find(entry->function);
    if (!error_ && (main == module_.functions.end() || main->second.blocks.empty()))
        error_ = error_at({}, "the SPIR-V module's entry point is no function");
    if (!error_) {
        const std::uint32_t begin = new_label();
        begin_block(begin);
        initialise_globals();
        Frame frame;
        inline_function(main->second, std::move(frame));
    }
    if (!error_) finish_program();
    if (error_) return fail(*error_);
    return std::move(program_);
}

const EntryPoint* Decoder::find_entry_point() {
    for (const EntryPoint& entry : module_.entry_points)
        if (entry.model == spv::ExecutionModelVertex || entry.model == spv::ExecutionModelFragment)
            return &entry;
    return nullptr;
}

void Decoder::report(const Instruction& instruction, std::string message, std::string help) {
    if (!error_) error_ = error_at(module_.places[instruction.place], std::move(message), std::move(help));
}

void Decoder::report_unknown(const Instruction& instruction) {
    report(instruction, fmt::format("the evaluator does not know {}", opcode_name(instruction.opcode)));
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
        block.quick_first = static_cast<std::uint32_t>(program_.quick.size());
        for (std::uint32_t at = block.first; at < block.first + block.count; ++at)
            if (is_quick_[at]) program_.quick.push_back(program_.operations[at]);
        block.quick_count = static_cast<std::uint32_t>(program_.quick.size()) - block.quick_first;
    }
    const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
    std::sort(program_.inputs.begin(), program_.inputs.end(), by_name);
    std::sort(program_.outputs.begin(), program_.outputs.end(), by_name);
    std::sort(program_.uniforms.begin(), program_.uniforms.end(), by_name);
}

}  // namespace gobo::evaluate
