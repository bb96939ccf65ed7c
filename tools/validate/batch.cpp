#include "validate/batch.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "spirv/transform.hpp"
#include "validate/glslang_stage.hpp"
#include "validate/module_rules.hpp"

namespace gobo {
namespace {

constexpr std::size_t kMostPrograms = 32;
/// How many batches each thread gets at least, where there are so many pairs: one may take longer.
constexpr std::size_t kBatchesPerJob = 8;

/// The module as it is shipped. What the optimizer makes is asked about, too.
Result<SpirvModule> shipped(SpirvModule module, const ValidateOptions& options, spv_target_env environment) {
    if (options.optimize) {
        GOBO_TRY(module, spirv::optimized(module, environment));
        GOBO_TRY_DO(refuse_optimized(module, environment));
    }
    if (options.strip) {
        GOBO_TRY(module, spirv::without_names(module));
    }
    return module;
}

/// FNV-1a, word by word.
std::uint64_t hash_of(const SpirvModule& module) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const std::uint32_t word : module) hash = (hash ^ word) * 0x100000001b3;
    return hash;
}

}  // namespace

std::vector<Batch> batches_of(const std::vector<Program>& programs, int jobs) {
    std::map<int, int> first_with;  // by the last stage, the first one that goes with it
    for (const Program& program : programs) first_with.try_emplace(program.back(), program.front());
    std::vector<std::size_t> order(programs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::pair<int, int>> places;
    for (const Program& program : programs) places.emplace_back(first_with[program.back()], program.back());
    std::ranges::stable_sort(order, {}, [&](std::size_t program) { return places[program]; });
    const std::size_t size = std::clamp(programs.size() / (static_cast<std::size_t>(jobs) * kBatchesPerJob),
                                        std::size_t{1}, kMostPrograms);
    std::vector<Batch> batches;
    std::set<int> seen;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i % size == 0) batches.emplace_back();
        batches.back().programs.push_back(order[i]);
        for (const int stage : programs[order[i]])
            if (seen.insert(stage).second) batches.back().own.push_back(stage);
    }
    for (Batch& batch : batches) std::ranges::sort(batch.own);
    return batches;
}

std::vector<const Piece*> pieces_of(const Composition& composition, int stage) {
    std::vector<const Piece*> pieces;
    for (const int piece : composition.stage(stage).pieces) pieces.push_back(&composition.piece(piece));
    return pieces;
}

std::set<int> placing_stages(const Composition& composition, const std::vector<Program>& programs) {
    std::set<int> placing;
    for (const Program& program : programs) {
        int last = -1;  // before the rasteriser
        for (const int stage : program) {
            const StageKind kind = composition.stage(stage).kind;
            if (kind < StageKind::fragment && kind != StageKind::tess_control) last = stage;
        }
        if (last >= 0) placing.insert(last);
    }
    return placing;
}

BatchWorker::BatchWorker(const Composition& composition, const std::vector<Program>& programs,
                         const std::set<int>& placing, const ValidateOptions& options)
    : composition_(composition), programs_(programs), placing_(placing), options_(options) {}

BatchWorker::~BatchWorker() = default;

BatchResult BatchWorker::work_off(const Batch& batch, const GivenUp& given_up, Note& note) {
    std::map<int, int> programs_left;  // by stage
    for (const std::size_t program : batch.programs)
        for (const int stage : programs_[program]) ++programs_left[stage];
    std::erase_if(parsed_, [&](const auto& entry) { return !programs_left.contains(entry.first); });
    std::set<int> linked;
    BatchResult result;
    for (const std::size_t number : batch.programs) {
        const Program& program = programs_[number];
        const auto stopped = given_up.find(note_of_program(number));
        bool are_fine = true;
        for (const int stage : program) are_fine = parsed(stage, given_up, note).is_fine && are_fine;
        if (are_fine && program.size() > 1)
            result.programs.push_back({number, link_program(number, given_up, note)});
        if (stopped == given_up.end()) linked.insert(program.begin(), program.end());
        for (const int stage : program) {
            if (--programs_left[stage] > 0) continue;
            // What took linking too long, generating would take too long again.
            if (stage == program.back() && !linked.contains(stage) && parsed_.at(stage).is_fine)
                parsed_.at(stage) = {nullptr, false, stopped->second};
            // Not before its last program: glslang assigns locations then, which would disturb later links.
            if (std::ranges::binary_search(batch.own, stage)) result.stages.push_back(generate(stage, note));
            // Trees are large, and memory is fast that was used just before. The next batch may go on with
            // the first stages of the last program.
            const auto at = parsed_.find(stage);
            const bool may_go_on = number == batch.programs.back() && stage != program.back();
            if (!may_go_on || (at->second.glslang && at->second.glslang->is_changed())) parsed_.erase(at);
        }
    }
    note = 0;
    return result;
}

BatchWorker::Parsed& BatchWorker::parsed(int stage, const GivenUp& given_up, Note& note) {
    const auto [at, is_new] = parsed_.try_emplace(stage);
    Parsed& parsed = at->second;
    if (!is_new) return parsed;
    note = note_of_stage(stage);
    if (const auto reason = given_up.find(note); reason != given_up.end()) {
        parsed.diagnostics = reason->second;
        return parsed;
    }
    parsed.glslang = std::make_unique<GlslangStage>(
        composition_.stage(stage).kind, pieces_of(composition_, stage), composition_.dialect, read_);
    parsed.diagnostics = parsed.glslang->parse();
    parsed.is_fine = exit_status(parsed.diagnostics) == 0;
    return parsed;
}

Diagnostics BatchWorker::link_program(std::size_t program, const GivenUp& given_up, Note& note) {
    note = note_of_program(program);
    if (const auto reason = given_up.find(note); reason != given_up.end()) return reason->second;
    std::vector<GlslangStage*> stages;
    for (const int stage : programs_[program]) stages.push_back(parsed_.at(stage).glslang.get());
    Diagnostics found = link(stages);
    // glslang keeps a failed link's errors in the stages, which other programs may share.
    if (exit_status(found) != 0)
        for (GlslangStage* const stage : stages) stage->parse();
    return found;
}

BatchResult::OfStage BatchWorker::generate(int stage, Note& note) {
    note = note_of_stage(stage);
    const Parsed& parsed = parsed_.at(stage);
    BatchResult::OfStage result{stage, parsed.is_fine, parsed.diagnostics, {}};
    if (!parsed.is_fine) return result;
    Result<ValidatedStage> generated =
        parsed.glslang->generate(options_.debug_information, placing_.contains(stage));
    if (!generated) {
        append(result.diagnostics, generated.error());
        result.is_fine = false;
        return result;
    }
    append(result.diagnostics, generated->diagnostics);
    const spv_target_env environment = environment_of(composition_.dialect);
    const bool is_shipped = is_spirv(composition_.dialect);
    generated->hash = hash_of(generated->spirv);
    if ((options_.spirv_val || is_shipped) && exit_status(result.diagnostics) == 0)
        append(result.diagnostics,
               check_module(generated->spirv, environment, pieces_of(composition_, stage)));
    if (is_shipped && exit_status(result.diagnostics) == 0) {
        auto ready = shipped(std::move(generated->spirv), options_, environment);
        if (!ready) {
            append(result.diagnostics, ready.error());
            result.is_fine = false;
            return result;
        }
        generated->spirv = *std::move(ready);
    }
    if (!options_.keep_spirv) generated->spirv = {};
    result.validated = *std::move(generated);
    return result;
}

}  // namespace gobo
