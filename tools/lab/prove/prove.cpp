#include "lab/prove/prove.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/parallel.hpp"
#include "core/remembered.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "lab/prove/check.hpp"
#include "lab/prove/stage_proof.hpp"
#include "lab/sanitize/guide.hpp"
#include "lab/sanitize/hard_points.hpp"
#include "lab/sanitize/kept.hpp"
#include "lab/sanitize/sanitize.hpp"
#include "lab/sanitize/shrink.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::prove {

GOBO_FIELDS(Range, low, high, least, grid, zero, nan)
GOBO_FIELDS(PartLeft, name, range)

namespace {

/// A stage's program, what is proven of it, and why nothing is.
struct Proven {
    evaluate::Program program;
    sanitize::InputSpace space;
    std::vector<RuleAtOperation> rules;
    std::vector<std::vector<PartLeft>> left;  ///< of each rule
    std::vector<std::vector<Range>> outputs;
    std::vector<std::vector<Range>> results;
    Diagnostics diagnostics;
};

/// What of it takes long: all but the program and what follows from that.
struct KeptProof {
    struct KeptRule {
        std::uint32_t operation = 0;
        std::string message;
        bool is_proven = false;
        bool is_constant = false;
        bool ignores_tiny = false;
    };
    std::vector<KeptRule> rules;
    std::vector<std::vector<PartLeft>> left;
    std::vector<std::vector<Range>> outputs;
    std::vector<std::vector<Range>> results;
    Diagnostics diagnostics;
};
GOBO_FIELDS(KeptProof::KeptRule, operation, message, is_proven, is_constant, ignores_tiny)
GOBO_FIELDS(KeptProof, rules, left, outputs, results, diagnostics)

using PlaceAndName = std::tuple<std::string, int, std::string>;

/// Proves what can be proven of the stage's operations.
void prove_rules(Proven& proven, std::size_t splits) {
    StageProof proof(proven.program, proven.space);
    if (const auto ran = proof.run(0, true); !ran) proven.diagnostics = ran.error();
    proven.rules = proof.rules();
    proven.outputs = proof.outputs();
    proven.results = proof.results();
    proven.left.resize(proven.rules.size());
    if (!proven.diagnostics.empty()) return;
    // What is open: without tiny inputs, which no input has that the sanitizer draws; then with the domain
    // split.
    std::vector<bool> is_settled(proven.rules.size());
    const auto settle = [&](std::size_t most, bool has_tiny_inputs) {
        for (std::size_t i = 0; i < is_settled.size(); ++i) is_settled[i] = proven.rules[i].is_proven;
        if (std::ranges::count(is_settled, false) == 0) return;
        StageProof next(proven.program, proven.space);
        if (!next.run(most, has_tiny_inputs, is_settled)) return;
        if (!has_tiny_inputs) proven.outputs = next.outputs();
        for (std::size_t i = 0; i < is_settled.size(); ++i) {
            if (is_settled[i]) continue;
            const RuleAtOperation& other = next.rules()[i];
            proven.rules[i].is_proven = other.is_proven;
            proven.rules[i].ignores_tiny = other.is_proven && !has_tiny_inputs;
            proven.left[i] = next.inputs_of(other.left);
        }
    };
    settle(0, false);
    if (splits > 0) {
        settle(splits, true);
        settle(splits, false);
    }
}

KeptProof kept(const Proven& proven) {
    KeptProof kept{{}, proven.left, proven.outputs, proven.results, proven.diagnostics};
    for (const RuleAtOperation& one : proven.rules)
        kept.rules.push_back(
            {one.operation, std::string(one.rule.message), one.is_proven, one.is_constant, one.ignores_tiny});
    return kept;
}

void restore(Proven& proven, const KeptProof& kept) {
    const std::vector<std::vector<Rule>> rules = rules_of(proven.program);
    proven.rules.clear();
    for (const auto& [operation, message, is_proven, is_constant, ignores_tiny] : kept.rules) {
        const auto rule = std::ranges::find(rules[operation], message, &Rule::message);
        proven.rules.push_back({operation, *rule, is_proven, is_constant, ignores_tiny});
    }
    proven.left = kept.left;
    proven.outputs = kept.outputs;
    proven.results = kept.results;
    proven.diagnostics = kept.diagnostics;
}

Proven prove_stage(const SpirvModule& spirv, const std::vector<Domain>& domains, std::size_t splits,
                   Remembered& remembered) {
    Proven proven;
    auto program = evaluate::decode(spirv, {.widths = evaluate::Widths::of_32});
    if (!program) {
        proven.diagnostics = program.error();
        return proven;
    }
    proven.program = std::move(*program);
    proven.space = sanitize::input_space_of(proven.program, domains, true);
    bool is_new = false;
    const Digest all = digest_of(to_bytes(program_identity(), std::string("prove"), spirv, domains, splits));
    const KeptProof known = remembered.get<KeptProof>(all, [&] {
        prove_rules(proven, splits);
        is_new = true;
        return kept(proven);
    });
    if (!is_new) restore(proven, known);
    return proven;
}

std::string reason_of(const RuleAtOperation& one, const Proven& proven) {
    if (!proven.diagnostics.empty()) return proven.diagnostics.front().message;
    if (one.rule.is_impossible == nullptr) return "nothing proves this rule";
    return one.rule.is_of_results ? "what is known of the operands is too little"
                                  : "what is known of the operands allows it";
}

/// Adds what is proven of a stage to the operations of all.
void add(std::map<PlaceAndName, SourceOperation>& all, const Proven& proven, std::size_t stage) {
    for (std::size_t i = 0; i < proven.rules.size(); ++i) {
        const RuleAtOperation& one = proven.rules[i];
        const Place& place = proven.program.place_of(one.operation);
        const std::string name(evaluate::row_of(proven.program.operations[one.operation]).name);
        SourceOperation& operation = all[{place.file, place.line, name}];
        operation.place = place;
        operation.name = name;
        operation.is_constant = operation.is_constant && one.is_constant;
        if (operation.stages.empty() || operation.stages.back() != stage) operation.stages.push_back(stage);
        auto rule = std::ranges::find(operation.rules, one.rule.message, &ProvenRule::message);
        if (rule == operation.rules.end()) {
            operation.rules.emplace_back();
            rule = operation.rules.end() - 1;
            rule->message = one.rule.message;
            rule->is_of_results = one.rule.is_of_results;
        }
        rule->ignores_tiny = rule->ignores_tiny || one.ignores_tiny;
        if (one.is_proven || rule->status != Status::impossible) continue;
        rule->status = Status::undecided;
        rule->stage = stage;
        rule->reason = reason_of(one, proven);
        rule->left = proven.left[i];
    }
}

/// Points as hard as the sanitizer's, in the part of the domain that is left.
sanitize::PointSet points_in(const sanitize::InputSpace& space, const std::vector<PartLeft>& left,
                             std::size_t count, std::uint64_t seed) {
    sanitize::PointSet points = sanitize::hard_points(space, count, seed);
    for (std::size_t i = 0; i < count; i += 2)  // every other one anywhere
        for (const sanitize::InputField& field : space.fields)
            for (std::size_t c = 0; c < field.components; ++c) {
                const std::string name =
                    field.components == 1 ? field.name : fmt::format("{}[{}]", field.name, c);
                const auto part = std::ranges::find(left, name, &PartLeft::name);
                if (part == left.end()) continue;
                double& number = points[i][field.first + c];
                number = std::clamp(number, part->range.low, part->range.high);
            }
    for (std::size_t i = 0; i < count; i += 2)
        for (const sanitize::InputField& field : space.fields)
            sanitize::bring_into_domain(field, points[i].subspan(field.first, field.components));
    return points;
}

/// Looks for inputs that show what is undecided of a stage.
void find_examples(const Family& family, const Composition& composition, const Validated& validated,
                   std::size_t stage, const Proven& proven, const ProveOptions& options,
                   const std::vector<ProvenRule*>& rules, const std::vector<Place>& places) {
    constexpr std::size_t kPortion = 256;
    constexpr int kMostEndless = 4;  // runs with a loop that is given up: each takes 65,536 turns
    int endless = 0;
    const auto permutations = sanitize::permutations_of(composition, stage);
    const Key key = permutations.empty() ? Key{} : composition.permutations[permutations.front()].key;
    const StageKind kind = composition.stages[stage].kind;
    sanitize::OutputBounds bounds(family, key, kind, proven.program, proven.space,
                                  sanitize::depth_promise_of(validated.stages[stage].spirv));
    sanitize::Guide guide(proven.program, proven.space, options.seed);
    for (std::size_t done = 0; done < options.points; done += kPortion) {
        const std::size_t portion = done / kPortion;
        const std::vector<PartLeft>& left = rules[portion % rules.size()]->left;
        // First hard ones, then every other time what the guide makes of those that came near.
        auto points = portion >= 4 && portion % 2 == 1
                          ? guide.next(kPortion)
                          : points_in(proven.space, left, kPortion, options.seed + portion);
        // An input that breaks a constraint shows nothing.
        for (std::size_t i = 0; i < points.count; ++i) sanitize::constrain(proven.space, points[i]);
        const auto invocations = sanitize::invocations_of(proven.space, points);
        const sanitize::Machine other = sanitize::kMachines[1 + portion % (sanitize::kMachines.size() - 1)];
        for (const sanitize::Machine machine : {sanitize::Machine::ieee, other}) {
            const auto found = sanitize::find_traps(proven.program, invocations, machine, {}, &guide);
            if (!found) return;
            guide.learn(points);
            const bool is_endless = std::ranges::any_of(*found, [](const sanitize::Finding& finding) {
                return finding.message == sanitize::kEndless;
            });
            endless += is_endless ? 1 : 0;
            for (const sanitize::Finding& finding : *found)
                for (std::size_t i = 0; i < rules.size(); ++i) {
                    ProvenRule& rule = *rules[i];
                    if (rule.status == Status::possible || finding.message != rule.message ||
                        finding.place.file != places[i].file || finding.place.line != places[i].line)
                        continue;
                    sanitize::Finding example = finding;
                    example.stage = kind;
                    rule.example = sanitize::simplified(proven.program, proven.space, bounds, example);
                    rule.status = Status::possible;
                }
        }
        if (endless >= kMostEndless) return;
        if (std::ranges::all_of(rules,
                                [](const ProvenRule* rule) { return rule->status == Status::possible; }))
            return;
    }
}

void add_outputs(std::map<std::pair<StageKind, std::string>, OutputRange>& all, const Family& family,
                 const Proven& proven, StageKind stage) {
    for (std::size_t i = 0; i < proven.outputs.size(); ++i) {
        if (proven.outputs[i].empty()) continue;  // never written
        const evaluate::Port& port = proven.program.outputs[i];
        const Domain* domain = verify::domain_of(family.domains, port.name);
        const bool has_last = domain != nullptr && !domain->last.empty();
        const std::size_t ranged = port.components - (has_last ? 1 : 0);
        for (std::size_t c = 0; c < proven.outputs[i].size(); ++c) {
            std::string name = without_subscripts(port.name);
            if (c >= ranged) name += fmt::format(".{}", "xyzw"[c % 4]);  // a quantity of its own
            OutputRange& output =
                all.try_emplace({stage, name}, OutputRange{stage, name, kNothing}).first->second;
            output.range = hull(output.range, port.scalar == evaluate::Scalar::uint32
                                                  ? without_sign(proven.outputs[i][c])
                                                  : proven.outputs[i][c]);
            if (domain == nullptr) continue;
            output.is_stated = true;
            if (c >= ranged) {
                output.stated_low = domain->last.at(0);
                output.stated_high = domain->last.at(1);
                continue;
            }
            output.is_of_length = domain->of_length;
            output.stated_low = domain->of_length ? -domain->high : domain->low;
            output.stated_high = domain->high;
            for (const double also : domain->also) {
                output.stated_low = std::min(output.stated_low, also);
                output.stated_high = std::max(output.stated_high, also);
            }
        }
    }
}

}  // namespace

bool SourceOperation::is_proven() const {
    return std::ranges::all_of(rules,
                               [](const ProvenRule& rule) { return rule.status == Status::impossible; });
}

bool SourceOperation::has_own_rule() const {
    return std::ranges::any_of(rules, [](const ProvenRule& rule) { return !rule.is_of_results; });
}

ProveReport prove(const Family& family, const Composition& composition, const Validated& validated,
                  const ProveOptions& options) {
    std::vector<Proven> stages(composition.stages.size());
    Remembered remembered(options.cache);
    parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
        stages[i] = prove_stage(validated.stages[i].spirv, family.domains, options.splits, remembered);
    });
    ProveReport report;
    report.stages = stages.size();
    report.permutations = composition.permutations.size();
    if (options.check > 0 && !stages.empty()) {
        const std::size_t points = (options.check + stages.size() - 1) / stages.size();
        std::vector<Diagnostics> faults(stages.size());
        parallel_for(options.jobs, stages.size(), [&](std::size_t i) {
            if (!stages[i].diagnostics.empty()) return;
            faults[i] = check(stages[i].program, stages[i].space, stages[i].rules, stages[i].results, points,
                              options.seed + i * points);
        });
        for (const Diagnostics& of_stage : faults) append(report.diagnostics, of_stage);
        report.points = points * stages.size();
    }
    std::map<PlaceAndName, SourceOperation> operations;
    std::map<std::pair<StageKind, std::string>, OutputRange> outputs;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        add(operations, stages[i], i);
        add_outputs(outputs, family, stages[i], composition.stages[i].kind);
        const std::vector<std::size_t> permutations = sanitize::permutations_of(composition, i);
        for (Diagnostic error : stages[i].diagnostics) {
            if (!permutations.empty())
                error.subject = key_text(family, composition.permutations[permutations.front()].key);
            report.diagnostics.push_back(std::move(error));
        }
    }
    // What is undecided, by the stage where it is met first.
    std::map<std::size_t, std::pair<std::vector<ProvenRule*>, std::vector<Place>>> open;
    for (auto& [where, operation] : operations)
        for (ProvenRule& rule : operation.rules)
            if (rule.status == Status::undecided) {
                open[rule.stage].first.push_back(&rule);
                open[rule.stage].second.push_back(operation.place);
            }
    std::vector<std::size_t> with_open;
    for (const auto& [stage, rules] : open) with_open.push_back(stage);
    parallel_for(options.jobs, with_open.size(), [&](std::size_t i) {
        const std::size_t stage = with_open[i];
        if (stages[stage].rules.empty()) return;
        find_examples(family, composition, validated, stage, stages[stage], options, open[stage].first,
                      open[stage].second);
    });
    for (auto& [where, operation] : operations) {
        for (ProvenRule& rule : operation.rules) {
            if (rule.status == Status::impossible) continue;
            const std::vector<std::size_t> permutations = sanitize::permutations_of(composition, rule.stage);
            if (!permutations.empty() && !family.features.empty())
                rule.key = key_text(family, composition.permutations[permutations.front()].key);
        }
        report.operations.push_back(std::move(operation));
    }
    for (auto& [where, output] : outputs) report.outputs.push_back(std::move(output));
    return report;
}

}  // namespace gobo::prove
