#include "lab/sanitize/sanitize.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "core/remembered.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/evaluate/functions.hpp"
#include "lab/sanitize/constant_faults.hpp"
#include "lab/sanitize/guide.hpp"
#include "lab/sanitize/kept.hpp"
#include "lab/sanitize/shrink.hpp"
#include "lab/verify/random_points.hpp"
#include "validate/preprocess.hpp"

namespace gobo::sanitize {
namespace {

/// What makes two findings the same: file, line, message.
using Signature = std::tuple<std::string, int, std::string>;

Signature signature_of(const Finding& finding) {
    return {finding.place.file, finding.place.line, finding.message};
}

void add_consequences(Finding& finding, const Finding& other) {
    for (const Consequence& one : other.consequences) {
        const auto is_same = [&](const Consequence& known) {
            return known.place == one.place && known.message == one.message;
        };
        if (std::ranges::none_of(finding.consequences, is_same)) finding.consequences.push_back(one);
    }
}

/// What a search came to.
struct Searched {
    std::vector<Finding> findings;
    std::uint64_t points = 0;
    Diagnostics diagnostics;
};
GOBO_FIELDS(Searched, findings, points, diagnostics)

/// Points are made and run in portions, so that they stay in the cache and their rows are not mapped anew
/// each time.
constexpr std::size_t kPortion = 256;

/// One stage, searched portion by portion as long as nothing fails.
class StageSearch {
  public:
    /// `key` is any of those that share the stage.
    StageSearch(const Family& family, const Key& key, StageKind kind, Result<evaluate::Program> program,
                DepthPromise promise, const SanitizeOptions& options)
        : kind_(kind), options_(options) {
        if (!program) {
            diagnostics_ = program.error();
            return;
        }
        program_ = std::move(*program);
        space_ = input_space_of(program_, family.domains, true);
        if (const Constraint* const constraint = contradiction_in(space_)) {
            diagnostics_.push_back(contradiction_error(*constraint));
            return;
        }
        bounds_.emplace(family, key, kind, program_, space_, promise);
        if (options.guided > 0 || options.minutes > 0) guide_.emplace(program_, space_, options.seed);
    }
    StageSearch(const StageSearch&) = delete;
    StageSearch& operator=(const StageSearch&) = delete;

    /// What compilers fold, to be given before anything runs.
    void add(const std::vector<Finding>& of_constants) {
        has_constants_ = !of_constants.empty();
        for (const Finding& finding : of_constants) findings_.try_emplace(signature_of(finding), finding);
    }
    void run_hard(std::size_t count) {
        run(count, [&](std::size_t first, std::size_t portion) {
            return hard_points(space_, portion, options_.seed + first / kPortion);
        });
    }
    /// At points made of what earlier ones reached.
    void run_guided(std::size_t count) {
        run(count, [&](std::size_t, std::size_t portion) { return guide_->next(portion); });
    }

    /// A finding of this stage at an input made simple.
    [[nodiscard]] Finding simplified(const Finding& finding) {
        return sanitize::simplified(program_, space_, *bounds_, finding);
    }
    [[nodiscard]] Searched searched() const {
        Searched searched{{}, points_, diagnostics_};
        for (const auto& [signature, finding] : findings_) searched.findings.push_back(finding);
        return searched;
    }
    void take(Searched searched) {
        findings_.clear();
        for (Finding& finding : searched.findings)
            findings_.try_emplace(signature_of(finding), std::move(finding));
        points_ = searched.points;
        diagnostics_ = std::move(searched.diagnostics);
    }
    [[nodiscard]] const std::map<Signature, Finding>& findings() const { return findings_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }
    [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }

  private:
    template <class Make>
    void run(std::size_t count, const Make& make) {
        const std::size_t pixels = space_.pixels;
        for (std::size_t done = 0; done < count && diagnostics_.empty(); done += kPortion) {
            const std::size_t portion = std::min(kPortion, count - done);
            PointSet points = make(done, (portion + pixels - 1) / pixels);
            for (std::size_t i = 0; i < points.count; ++i) constrain(space_, points[i]);
            if (const auto ran = run(points); !ran) diagnostics_ = ran.error();
        }
    }

    /// Runs the points on every machine, and keeps what is found.
    Result<void> run(const PointSet& points) {
        const evaluate::Invocations invocations = invocations_of(space_, points);
        const std::vector<Interval> bounds = bounds_->at(points);
        std::map<Signature, Finding> all;
        for (const Machine machine : options_.machines) {
            GOBO_TRY(auto found,
                     find_traps(program_, invocations, machine, bounds, guide_ ? &*guide_ : nullptr));
            if (guide_) guide_->learn(points);
            std::map<Signature, std::uint64_t> on_this_machine;
            for (Finding& finding : found) {
                on_this_machine[signature_of(finding)] += finding.points;
                finding.stage = kind_;
                const auto [known, is_new] = all.try_emplace(signature_of(finding), finding);
                if (!is_new) add_consequences(known->second, finding);
            }
            // A point that traps on several machines is still one.
            for (const auto& [signature, count] : on_this_machine)
                all[signature].points = std::max(all[signature].points, count);
        }
        for (const auto& [signature, finding] : all) {
            if (finding.follows_from_constants && has_constants_) continue;
            const auto [known, is_new] =
                findings_.try_emplace(signature, finding);  // the first example is kept
            if (is_new) continue;
            known->second.points += finding.points;
            add_consequences(known->second, finding);
        }
        points_ += invocations.count;
        return {};
    }

    StageKind kind_;
    const SanitizeOptions& options_;
    evaluate::Program program_;
    InputSpace space_;
    std::optional<OutputBounds> bounds_;
    std::optional<Guide> guide_;  ///< nothing where nothing is to be learnt
    std::map<Signature, Finding> findings_;
    bool has_constants_ = false;  ///< findings of constants
    std::uint64_t points_ = 0;
    Diagnostics diagnostics_;  ///< why the stage could not be evaluated
};

/// The line of a piece that stands at a line of the stage's source.
Place place_of(const Composition& composition, const Stage& stage, int line) {
    for (const int number : stage.pieces) {
        const Piece& piece = composition.piece(number);
        const auto lines = static_cast<int>(std::ranges::count(piece.text, '\n'));
        if (line <= lines) return {piece.path, piece.line_in_file(line), 0};
        line -= lines;
    }
    return {};
}

std::vector<Finding> findings_of_constants(const Composition& composition, const Stage& stage) {
    std::vector<Finding> findings;
    const std::optional<std::string> source = preprocessed(composition, stage);
    if (!source) return findings;
    for (const ConstantFault& fault : faults_of_constants(*source)) {
        Finding finding;
        finding.stage = stage.kind;
        finding.place = place_of(composition, stage, fault.line);
        finding.message = fault.message;
        finding.operation = fault.operation;
        finding.is_of_constants = true;
        findings.push_back(std::move(finding));
    }
    return findings;
}

/// What stages share is reported once. What has no line of its own is the template's.
void add(SanitizeReport& report, const StageSearch& search, const Composition& composition, std::size_t stage,
         const std::vector<std::size_t>& permutations) {
    report.points += search.points();
    for (auto [signature, finding] : search.findings()) {
        if (finding.place.file.empty())
            finding.place.file = composition.piece(composition.stages[stage].pieces.back()).path;
        const auto shared = std::find_if(report.findings.begin(), report.findings.end(),
                                         [known = signature_of(finding)](const SharedFinding& other) {
                                             return signature_of(other.finding) == known;
                                         });
        if (shared == report.findings.end()) {
            report.findings.push_back({finding, stage, permutations});
            continue;
        }
        shared->finding.points += finding.points;
        add_consequences(shared->finding, finding);
        std::vector<std::size_t>& all = shared->permutations;
        all.insert(all.end(), permutations.begin(), permutations.end());
    }
}

}  // namespace

std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage) {
    std::vector<std::size_t> permutations;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const auto& stages = composition.permutations[i].stages.values;
        if (std::ranges::count(stages, static_cast<int>(stage)) > 0) permutations.push_back(i);
    }
    return permutations;
}

SanitizeReport sanitize(const Family& family, const Composition& composition, const Validated& validated,
                        const SanitizeOptions& options) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(options.minutes);
    std::vector<std::optional<StageSearch>> stages(composition.stages.size());
    const bool shares_total = options.total > 0 && !stages.empty();
    const std::size_t points =
        shares_total ? (options.total + stages.size() - 1) / stages.size() : options.points;
    Remembered remembered(options.minutes > 0 ? nullptr : options.cache);
    parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
        const std::vector<std::size_t> permutations = permutations_of(composition, i);
        const Key key = permutations.empty() ? Key{} : composition.permutations[permutations.front()].key;
        const SpirvModule& spirv = validated.stages[i].spirv;
        stages[i].emplace(family, key, composition.stages[i].kind, evaluate::decode(spirv),
                          depth_promise_of(spirv), options);
        const auto search = [&] {
            stages[i]->add(findings_of_constants(composition, composition.stages[i]));
            stages[i]->run_hard(points);
            stages[i]->run_guided(options.guided);
            return stages[i]->searched();
        };
        const Digest all =
            digest_of(to_bytes(program_identity(), std::string("sanitize"), composition.stages[i].kind, spirv,
                               source_of(composition, composition.stages[i]), key_text(family, key),
                               family.domains, points, options.seed, options.machines, options.guided));
        stages[i]->take(remembered.get<Searched>(all, search));
    });
    while (Clock::now() < end)
        parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
            if (Clock::now() < end) stages[i]->run_guided(kPortion);
        });
    SanitizeReport report;
    report.stages = stages.size();
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const std::vector<std::size_t> permutations = permutations_of(composition, i);
        for (Diagnostic error : stages[i]->diagnostics()) {
            if (!permutations.empty())
                error.subject = key_text(family, composition.permutations[permutations.front()].key);
            report.diagnostics.push_back(std::move(error));
        }
        add(report, *stages[i], composition, i, permutations);
    }
    parallel_for(options.jobs, stages.size(), [&](std::size_t stage) {
        for (SharedFinding& shared : report.findings)
            if (shared.stage == stage && !shared.finding.is_of_constants)
                shared.finding = stages[stage]->simplified(shared.finding);
    });
    std::sort(report.findings.begin(), report.findings.end(),
              [](const SharedFinding& a, const SharedFinding& b) {
                  return signature_of(a.finding) < signature_of(b.finding);
              });
    return report;
}

namespace {

using Names = std::set<std::string>;
using Vectors = std::map<std::string, std::size_t>;  ///< by name, with their components

/// Whether the name is of a component of one of the vectors.
bool is_component(const std::string& name, const Vectors& vectors) {
    const auto part = component_name(name);
    const auto vector = part ? vectors.find(part->of) : vectors.end();
    return vector != vectors.end() && part->component < vector->second;
}

/// What is wrong with a constraint, if anything.
Diagnostics wrong_constraint(const Domain& domain, const Names& names, const Vectors& vectors) {
    const Constraint constraint = constraint_of(domain.name).value_or(Constraint{});
    Diagnostics errors;
    for (const std::string& name : constraint.names)
        if (!name.empty() && !names.contains(name) &&
            !(constraint.is_comparison() && is_component(name, vectors)))
            errors.push_back(evaluate::error_at(domain.place, fmt::format("no stage reads '{}'", name),
                                                suggestion(name, {names.begin(), names.end()})));
    return errors;
}

}  // namespace

Diagnostics domains_of_nothing(const std::vector<Domain>& domains, const std::vector<Domain>& known,
                               const Validated& validated) {
    Names names;
    for (const ValidatedStage& stage : validated.stages)
        if (const Result<evaluate::Program> program = evaluate::decode(stage.spirv))
            for (const auto* ports : {&program->inputs, &program->uniforms, &program->outputs})
                for (const evaluate::Port& port : *ports) names.insert(without_subscripts(port.name));
    for (const ValidatedStage& stage : validated.stages)
        if (const Result<evaluate::Program> program = evaluate::decode(stage.spirv))
            for (const evaluate::ImagePort& image : program->images)
                for (const char* part : {"", ".r", ".g", ".b", ".a", ".side", ".levels"})
                    names.insert(without_subscripts(image.name + part));
    Names inputs;
    Vectors vectors;
    for (const ValidatedStage& stage : validated.stages)
        if (const Result<evaluate::Program> program = evaluate::decode(stage.spirv))
            for (const auto* ports : {&program->inputs, &program->uniforms, &program->outputs})
                for (const evaluate::Port& port : *ports) {
                    const std::string name = without_subscripts(port.name);
                    if (ports != &program->outputs) inputs.insert(name);
                    if (port.type.find("vec") != std::string::npos) vectors[name] = port.components;
                }
    for (const Domain& domain : known)
        if (!is_constraint(domain.name)) {
            inputs.insert(domain.name);
            vectors.emplace(domain.name, 4);
        }
    Diagnostics errors;
    for (const Domain& domain : domains) {
        if (is_constraint(domain.name)) {
            const auto constraint = constraint_of(domain.name);
            for (const std::string& name : constraint ? constraint->names : std::vector<std::string>())
                if (const Domain* const of =
                        verify::domain_of(domains, component_name(name).value_or(ComponentName{name}).of);
                    constraint->is_comparison() && of != nullptr && of->of_length)
                    errors.push_back(evaluate::error_at(
                        domain.place, fmt::format("the range of '{}' is one of its length", name),
                        "state the length's range there, or compare another input"));
            for (Diagnostic& error : wrong_constraint(domain, inputs, vectors))
                errors.push_back(std::move(error));
            continue;
        }
        if (!names.contains(domain.name) && !is_component(domain.name, vectors))
            errors.push_back(evaluate::error_at(domain.place,
                                                fmt::format("no stage reads or writes '{}'", domain.name),
                                                suggestion(domain.name, {names.begin(), names.end()})));
    }
    return errors;
}

}  // namespace gobo::sanitize
