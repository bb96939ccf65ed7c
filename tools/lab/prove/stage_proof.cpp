#include "lab/prove/stage_proof.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "lab/prove/unroll.hpp"

namespace gobo::prove {
namespace {

constexpr std::size_t kDeepestSplit = 24;

/// The parts of a range: by sign and 0 first, then in halves; of positive ones by their powers of two.
std::vector<Range> parts_of(const Range& range) {
    const auto part = [&](double low, double high, bool zero) {
        Range one = range;
        one.low = low;
        one.high = high;
        one.zero = zero;
        one.nan = false;
        return tidy(one);
    };
    std::vector<Range> parts;
    if (range.low < 0 && range.high > 0) {
        parts.push_back(part(range.low, -kSmallestFloat, false));
        if (range.zero) parts.push_back(exactly(0));
        parts.push_back(part(kSmallestFloat, range.high, false));
    } else if (range.zero && range.least > 0 && range.size() > 0) {
        parts.push_back(exactly(0));
        parts.push_back(part(range.low, range.high, false));
    } else {
        const double small = std::max(range.smallest(), range.size() * 1e-6);
        double middle =
            range.size() > 4 * small ? std::sqrt(small * range.size()) : (small + range.size()) / 2;
        middle = nearest_float(range.high <= 0 && range.low < 0 ? -middle : middle);
        // Integers lie between large floats.
        if (range.grid >= 0) middle = std::floor(middle);
        if (middle <= range.low || middle >= range.high) return {};
        parts.push_back(part(range.low, middle, range.zero));
        parts.push_back(part(range.grid >= 0 ? middle + 1 : float_above(middle), range.high, range.zero));
    }
    std::erase_if(parts, [](const Range& one) { return one.is_empty(); });
    return parts;
}

}  // namespace

StageProof::StageProof(const evaluate::Program& program, const sanitize::InputSpace& space)
    : program_(program), space_(space) {
    const auto all = rules_of(program);
    for (std::uint32_t at = 0; at < all.size(); ++at)
        for (const Rule& rule : all[at]) {
            RuleAtOperation one;
            one.operation = at;
            one.rule = rule;
            rules_.push_back(std::move(one));
        }
}

Result<void> StageProof::run(std::size_t splits, bool has_tiny_inputs, const std::vector<bool>& is_settled) {
    auto unrolled = unroll(program_, space_, has_tiny_inputs);
    if (!unrolled) {
        for (RuleAtOperation& one : rules_) one.is_proven = one.is_constant = false;
        return tl::unexpected(unrolled.error());
    }
    expressions_ = std::move(*unrolled);
    std::vector<std::size_t> first_rule(program_.operations.size() + 1, rules_.size());
    for (std::size_t i = rules_.size(); i-- > 0;) first_rule[rules_[i].operation] = i;

    struct Open {
        std::uint32_t site;
        std::size_t rule;
    };
    std::vector<Open> open;
    results_.assign(program_.operations.size(), {});
    Ranges ranges(expressions_, space_);
    ranges.begin({}, nullptr);
    for (const Event& event : expressions_.events) {
        if (event.kind == Event::Kind::expression) ranges.compute(event.index);
        if (event.kind == Event::Kind::context) ranges.enter(event.index);
        if (event.kind != Event::Kind::site) continue;
        const Site& site = expressions_.sites[event.index];
        View view{ranges, program_, expressions_, site};
        std::vector<Range>& results = results_[site.operation];
        if (results.size() < site.results) results.resize(site.results, kNothing);
        for (std::uint32_t i = 0; i < site.results && ranges.is_reached(); ++i)
            results[i] = hull(results[i], ranges.range(expressions_.site_operands[site.first_result + i]));
        for (std::size_t i = first_rule[site.operation];
             i < rules_.size() && rules_[i].operation == site.operation; ++i) {
            RuleAtOperation& one = rules_[i];
            std::size_t at = site.first_operand;
            for (std::size_t operand = 0; operand < view.info().operands.size(); ++operand)
                for (std::uint32_t c = 0; c < view.info().operands[operand].count; ++c, ++at)
                    if ((one.rule.deciding >> std::min<std::size_t>(operand, 31) & 1U) != 0 &&
                        expressions_.all[expressions_.origin(expressions_.site_operands[at])].code !=
                            kConstant)
                        one.is_constant = false;
            if (one.rule.is_impossible != nullptr && (!ranges.is_reached() || one.rule.is_impossible(view)))
                continue;
            open.push_back({event.index, i});
        }
    }
    ranges.enter(0);
    outputs_.clear();
    for (const OutputValues& output : expressions_.outputs) {
        std::vector<Range>& all = outputs_.emplace_back();
        const auto is_unknown = [&](std::uint32_t expression) {
            return expressions_.all[expression].code == kUnknown;
        };
        if (std::ranges::all_of(output.expressions, is_unknown)) continue;
        for (const std::uint32_t expression : output.expressions) all.push_back(ranges.range(expression));
    }
    for (const Open& one : open) {
        RuleAtOperation& rule = rules_[one.rule];
        if (!rule.is_proven) continue;
        const Site& site = expressions_.sites[one.site];
        std::vector<Cut> cuts;
        rule.is_proven = false;
        const bool is_done = one.rule < is_settled.size() && is_settled[one.rule];
        if (rule.rule.is_impossible == nullptr || splits == 0 || is_done) continue;
        const Slice slice = slice_for(site);
        std::size_t budget = splits;
        rule.is_proven = split(ranges, slice, site, rule.rule, cuts, budget, 0, rule.left);
    }
    return {};
}

StageProof::Slice StageProof::slice_for(const Site& site) const {
    Slice slice;
    slice.is_wanted.assign(expressions_.all.size(), false);
    std::vector<bool> is_needed(expressions_.contexts.size(), false);
    std::vector<std::uint32_t> waiting;
    const auto want = [&](std::uint32_t expression) {
        if (slice.is_wanted[expression]) return;
        slice.is_wanted[expression] = true;
        waiting.push_back(expression);
    };
    const auto need = [&](std::uint32_t context) {
        for (; !is_needed[context]; context = expressions_.contexts[context].parent) {
            is_needed[context] = true;
            if (context == 0) return;
            want(expressions_.contexts[context].condition);
        }
    };
    need(0);
    need(site.context);
    for (std::uint32_t at = site.first_operand; at < site.first_result + site.results; ++at)
        want(expressions_.site_operands[at]);
    while (!waiting.empty()) {
        const std::uint32_t expression = waiting.back();
        waiting.pop_back();
        const Expression& one = expressions_.all[expression];
        need(one.context);
        for (std::uint32_t i = 0; i < one.count; ++i) want(expressions_.operand(expression, i));
        if (one.code == kJoined)
            for (const std::uint32_t context : expressions_.lists[one.field]) need(context);
    }
    for (const Event& event : expressions_.events) {
        if (event.kind == Event::Kind::context && is_needed[event.index]) slice.events.push_back(event);
        if (event.kind == Event::Kind::expression && slice.is_wanted[event.index]) {
            slice.events.push_back(event);
            const Expression& one = expressions_.all[event.index];
            if (one.code == kInput || one.code == kTexel) slice.candidates.push_back(event.index);
        }
        if (event.kind == Event::Kind::site && &expressions_.sites[event.index] == &site) {
            slice.events.push_back(event);
            break;
        }
    }
    // Conditions decide more than inputs do.
    for (std::uint32_t context = 1; context < expressions_.contexts.size(); ++context)
        if (is_needed[context] && expressions_.contexts[context].is_true)
            slice.candidates.insert(slice.candidates.begin(), expressions_.contexts[context].condition);
    std::vector<std::uint32_t> distinct;
    for (const std::uint32_t one : slice.candidates)
        if (std::ranges::find(distinct, one) == distinct.end()) distinct.push_back(one);
    slice.candidates = std::move(distinct);
    return slice;
}

bool StageProof::holds(Ranges& ranges, const Slice& slice, const Site& site, const Rule& rule,
                       const std::vector<Cut>& cuts) const {
    ranges.begin(cuts, &slice.is_wanted);
    for (const Event& event : slice.events) {
        if (event.kind == Event::Kind::expression) ranges.compute(event.index);
        if (event.kind == Event::Kind::context) ranges.enter(event.index);
        if (event.kind != Event::Kind::site) continue;
        View view{ranges, program_, expressions_, site};
        return !ranges.is_reached() || rule.is_impossible(view);
    }
    return true;
}

bool StageProof::split(Ranges& ranges, const Slice& slice, const Site& site, const Rule& rule,
                       std::vector<Cut>& cuts, std::size_t& budget, std::size_t depth,
                       std::vector<Cut>& left) const {
    if (budget == 0 || depth > kDeepestSplit) {
        left = cuts;
        return false;
    }
    // The expression whose parts are proven most often; among equals the one that is widest.
    std::uint32_t best = 0;
    std::vector<Range> best_parts;
    double best_score = -1;
    std::vector<bool> best_holds;
    for (const std::uint32_t candidate : slice.candidates) {
        if (budget == 0) break;
        const auto cut = std::ranges::find(cuts, candidate, &Cut::expression);
        Range range = cut != cuts.end() ? cut->range : kNothing;
        if (cut == cuts.end()) {
            const Expression& one = expressions_.all[candidate];
            range = one.scalar == Scalar::boolean ? kTruth : expressions_.known[candidate];
        }
        const std::vector<Range> parts = range.is_one() ? std::vector<Range>{} : parts_of(range);
        if (parts.size() < 2) continue;
        std::vector<bool> are_proven;
        double score = 0;
        for (const Range& part : parts) {
            std::vector<Cut> narrower = cuts;
            narrower.push_back({candidate, part});
            if (budget > 0) --budget;
            are_proven.push_back(holds(ranges, slice, site, rule, narrower));
            if (are_proven.back()) score += 1.0 / static_cast<double>(parts.size());
        }
        if (score >= 1) return true;
        const double width =
            range.least > 0 ? std::log2(range.size() / std::max(range.smallest(), 1e-30)) : 64;
        score += std::min(width, 100.0) * 1e-4;
        if (score > best_score) {
            best = candidate;
            best_parts = parts;
            best_score = score;
            best_holds = are_proven;
        }
    }
    if (best_parts.empty()) {
        left = cuts;
        return false;
    }
    for (std::size_t i = 0; i < best_parts.size(); ++i) {
        if (best_holds[i]) continue;
        const std::vector<Cut> before = cuts;
        const auto known = std::ranges::find(cuts, best, &Cut::expression);
        if (known != cuts.end())
            known->range = best_parts[i];
        else
            cuts.push_back({best, best_parts[i]});
        const bool is_proven = split(ranges, slice, site, rule, cuts, budget, depth + 1, left);
        cuts = before;
        if (!is_proven) return false;
    }
    return true;
}

std::vector<PartLeft> StageProof::inputs_of(const std::vector<Cut>& cuts) const {
    std::vector<PartLeft> parts;
    for (const Cut& cut : cuts) {
        const Expression& one = expressions_.all[cut.expression];
        if (one.code != kInput) continue;
        const sanitize::InputField& field = space_.fields[one.field];
        parts.push_back({field.components == 1 ? field.name : fmt::format("{}[{}]", field.name, one.part),
                         field.scalar == Scalar::uint32 ? without_sign(cut.range) : cut.range});
    }
    return parts;
}

}  // namespace gobo::prove
