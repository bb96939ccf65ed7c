#include "lab/cost/stage_cost.hpp"

#include <algorithm>
#include <set>

#include "lab/cost/nvidia_assembly.hpp"

namespace gobo::cost {
namespace {

/// The first word of a line, and the rest.
std::pair<std::string_view, std::string_view> first_word(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::size_t end = std::min(line.find_first_of(" \t;:"), line.size());
    return {line.substr(0, end), line.substr(end)};
}

Kind kind_of(std::string_view name) {
    using enum Kind;
    struct Row {
        std::string_view begins;
        Kind kind;
    };
    // The first that fits.
    static constexpr Row kRows[] = {
        {"v_interp", interpolation},
        {"lds_param_load", interpolation},
        {"lds_direct_load", interpolation},
        {"v_rcp", transcendental},
        {"v_rsq", transcendental},
        {"v_sqrt", transcendental},
        {"v_exp", transcendental},
        {"v_log", transcendental},
        {"v_sin", transcendental},
        {"v_cos", transcendental},
        {"v_s_", transcendental},
        {"v_mov", move},
        {"v_readlane", move},
        {"v_readfirstlane", move},
        {"v_writelane", move},
        {"v_swap", move},
        {"v_", arithmetic},
        {"s_branch", branch},
        {"s_cbranch", branch},
        {"s_endpgm", branch},
        {"s_setpc", branch},
        {"s_swappc", branch},
        {"s_wait", wait},
        {"s_nop", wait},
        {"s_delay_alu", wait},
        {"s_clause", wait},
        {"s_inst_prefetch", wait},
        {"s_set_inst", wait},
        {"s_sleep", wait},
        {"s_sendmsg", output},
        {"s_barrier", wait},
        {"s_load", memory},
        {"s_buffer", memory},
        {"s_store", memory},
        {"s_mov", move},
        {"s_", scalar},
        {"image_", texture},
        {"exp", output},
    };
    for (const Row& row : kRows)
        if (name.starts_with(row.begins)) return row.kind;
    return memory;  // buffer_, tbuffer_, global_, flat_, scratch_, ds_
}

/// Calls `work` with each line that is an instruction or a label.
template <class Work>
void for_each_line(std::string_view text, const Work& work) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        if (const auto [word, rest] = first_word(line); !word.empty()) work(word, rest);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// Waves of which a SIMD keeps track. RADV's statistic counts twice as many for waves of 32 on RDNA, which
/// registers alone would allow.
std::uint64_t wave_slots(std::string_view architecture) {
    if (architecture == "RDNA1") return 20;
    return architecture.starts_with("RDNA") ? 16 : 10;
}

}  // namespace

ByKind count_kinds(std::string_view assembly) {
    ByKind counts{};
    for_each_line(assembly, [&](std::string_view word, std::string_view rest) {
        if (!rest.starts_with(':')) ++counts[static_cast<std::size_t>(kind_of(word))];
    });
    return counts;
}

bool branches_back(std::string_view assembly) {
    std::set<std::string_view> labels;
    bool found = false;
    for_each_line(assembly, [&](std::string_view word, std::string_view rest) {
        if (rest.starts_with(':'))
            labels.insert(word);
        else if (word.starts_with("s_branch") || word.starts_with("s_cbranch"))
            found = found || labels.contains(first_word(rest).first);
    });
    return found;
}

StageCost cost_of(CompiledStage compiled, const Chip& chip, bool loop_varies) {
    const auto statistic = [&](const char* name) {
        const auto found = compiled.statistics.find(name);
        return found == compiled.statistics.end() ? 0 : found->second;
    };
    StageCost cost;
    cost.stage = compiled.stage;
    if (chip.maker == Maker::nvidia) {
        const NvidiaCode code = read_nvidia_assembly(compiled.assembly, chip.architecture);
        cost.instructions = statistic("Instruction count");
        cost.vector_registers = statistic("Number of GPRs");
        cost.scalar_registers = code.uniform_registers;
        cost.occupancy = nvidia_occupancy(cost.vector_registers, chip.architecture);
        cost.cycles = code.cycles * 64 / std::max(compiled.invocations, 1U);
        cost.latency = code.latency;
        cost.code_bytes = statistic("Code Size");
        cost.spills = statistic("SLM Size") / 4;  // bytes of an invocation's own memory
        cost.has_loop = code.has_loop;
        cost.kinds = code.kinds;
    } else {
        cost.instructions = statistic("Instructions");
        cost.vector_registers = statistic("VGPRs");
        cost.scalar_registers = statistic("SGPRs");
        cost.occupancy = std::min(statistic("Subgroups per SIMD"), wave_slots(chip.architecture));
        cost.cycles = statistic("Inverse Throughput") * 64 / std::max(compiled.invocations, 1U);
        cost.latency = statistic("Latency");
        cost.code_bytes = statistic("Code size");
        cost.spills = statistic("Spilled SGPRs") + statistic("Spilled VGPRs");
        cost.has_loop = branches_back(compiled.assembly);
        cost.kinds = count_kinds(compiled.assembly);
    }
    cost.has_loop = cost.has_loop || loop_varies;
    cost.assembly = std::move(compiled.assembly);
    return cost;
}

}  // namespace gobo::cost
