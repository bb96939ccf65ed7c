// Domains narrower than a family's, as --domain states them.
#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/constraint.hpp"
#include "family/read_family.hpp"

namespace gobo {
namespace {

/// The domain that holds for the name: its own, or of a component that of the whole.
const Domain* domain_of(const std::vector<Domain>& domains, const std::string& name) {
    const auto own = std::ranges::find(domains, name, &Domain::name);
    if (own != domains.end()) return &*own;
    const auto component = component_name(name);
    if (!component) return nullptr;
    const auto whole = std::ranges::find(domains, component->of, &Domain::name);
    return whole == domains.end() ? nullptr : &*whole;
}

Result<Domain> refused(const Domain& stated, const std::string& reason, std::string help) {
    return fail(stated.place, "", fmt::format("'{}' narrows no domain: {}", stated.name, reason),
                std::move(help));
}

/// The range that a comparison with a number leaves.
Result<Domain> range_left_by(const Domain& stated, const Constraint& constraint, Domain range) {
    if (range.of_length) {
        const std::string whole = component_name(range.name).value_or(ComponentName{range.name}).of;
        return refused(stated, fmt::format("the range of '{}' is one of its length", whole),
                       fmt::format("state \"{}\" = {{ length = [low, high] }}", whole));
    }
    if (constraint.kind == Constraint::Kind::differ)
        return refused(stated, "a range has no hole", "state the side that the numbers are on: < or >");
    const bool is_upper = constraint.is_upper();
    const double bound = constraint.bound();
    (is_upper ? range.high : range.low) = is_upper ? std::min(range.high, bound) : std::max(range.low, bound);
    std::erase_if(range.also, [&](double also) { return is_upper ? also > bound : also < bound; });
    if (range.low > range.high)
        return refused(stated, fmt::format("the family's '{}' has no such numbers", range.name),
                       "state numbers that it has");
    return range;
}

/// Of what the search for the largest error keeps, a range or the order of two numbers; else an error that
/// says why not.
Result<Domain> checkable(const std::vector<Domain>& domains, const Domain& stated) {
    const Constraint constraint = constraint_of(stated.name).value();
    std::vector<std::string> names = constraint.names;
    std::erase(names, "");
    for (const std::string& name : names)
        if (domain_of(domains, name) == nullptr)
            return fail(stated.place, "", fmt::format("the family declares no domain for '{}'", name),
                        "name inputs and uniforms that its [domain] has");
    Domain range = *domain_of(domains, names[0]);
    range.name = names[0];
    if (component_name(range.name)) range.last.clear();
    range.place = stated.place;
    switch (constraint.kind) {
        case Constraint::Kind::less:
        case Constraint::Kind::less_equal:
        case Constraint::Kind::differ:
            if (constraint.has_number()) return range_left_by(stated, constraint, range);
            if (component_name(names[0]) || component_name(names[1]) ||
                struct_of(names[0]) != struct_of(names[1]) || struct_of(names[0]).empty())
                return refused(
                    stated,
                    "the search for the largest error orders members of one struct, and these are not",
                    "state it in the family's [domain], or ranges that keep them apart");
            return stated;
        case Constraint::Kind::unit:
            if (!range.of_length)
                return refused(stated, fmt::format("the range of '{}' is one of its numbers", range.name),
                               "state it in the family's [domain] as { length = [low, high] }");
            range.also.clear();
            range.low = std::max(range.low, 0.999999);
            range.high = std::min(range.high, 1.000001);
            return range;
        case Constraint::Kind::not_zero:
            if (!range.of_length || range.low <= 0)
                return refused(stated, fmt::format("the family's '{}' has no least length", range.name),
                               "state it in the family's [domain] as { length = [low, high], also = [0] }");
            std::erase(range.also, 0);
            return range;
        case Constraint::Kind::distinct:
            return refused(stated, "where vectors are not equal, they may still be as near as floats are",
                           "state it in the family's [domain]: gobo sanitize and prove keep it");
        case Constraint::Kind::orthonormal:
        case Constraint::Kind::inverse_transpose:
            return refused(stated, "the search for the largest error keeps ranges and orders",
                           "state it in the family's [domain]: gobo sanitize and prove keep it");
    }
    return stated;
}

}  // namespace

bool is_within(const Domain& narrower, const Domain& domain) {
    const auto holds = [&](double number) {
        return (domain.low <= number && number <= domain.high) ||
               std::ranges::find(domain.also, number) != domain.also.end();
    };
    const bool is_range_within = (domain.low <= narrower.low && narrower.high <= domain.high) ||
                                 (narrower.low == narrower.high && holds(narrower.low));
    return narrower.of_length == domain.of_length && is_range_within &&
           std::ranges::all_of(narrower.also, holds) &&
           (narrower.last.empty() || (!domain.last.empty() && domain.last[0] <= narrower.last[0] &&
                                      narrower.last[1] <= domain.last[1]));
}

Result<std::vector<Domain>> narrow_domains(Family& family, const std::vector<Domain>& narrower) {
    Diagnostics errors;
    std::vector<std::string> names;
    for (const Domain& known : family.domains) names.push_back(known.name);
    std::vector<Domain> all = narrower;
    std::stable_partition(all.begin(), all.end(),
                          [](const Domain& stated) { return !is_constraint(stated.name); });
    std::vector<Domain> narrowed;
    for (const Domain& stated : all) {
        const bool is_stated_by_both =
            std::ranges::find(family.domains, stated.name, &Domain::name) != family.domains.end();
        auto checked = is_constraint(stated.name) && !is_stated_by_both ? checkable(family.domains, stated)
                                                                        : Result<Domain>(stated);
        if (!checked) {
            errors.insert(errors.end(), checked.error().begin(), checked.error().end());
            continue;
        }
        const Domain domain = *checked;
        std::erase_if(narrowed, [&](const Domain& before) { return before.name == domain.name; });
        narrowed.push_back(domain);
        auto own = std::ranges::find(family.domains, domain.name, &Domain::name);
        const auto component = component_name(domain.name);
        const bool is_part = component && own == family.domains.end();  // of the whole's range
        if (is_part) own = std::ranges::find(family.domains, component->of, &Domain::name);
        if (own == family.domains.end() && is_constraint(domain.name)) {
            family.domains.push_back(domain);
        } else if (own == family.domains.end()) {
            errors.push_back({.place = domain.place,
                              .message = fmt::format("the family '{}' declares no domain for '{}'",
                                                     family.name, domain.name),
                              .help = suggestion(domain.name, names)});
        } else if (is_part && own->of_length) {
            errors.push_back({.place = domain.place,
                              .message = fmt::format("the range of '{}' is one of its length", own->name),
                              .help = "narrow the length's range"});
        } else if (!is_within(domain, *own)) {
            errors.push_back(
                {.place = domain.place,
                 .message = fmt::format("'{}' may hold more here than the family allows", domain.name),
                 .help = "what the shaders are made for stands in the family's [domain]: narrow it"});
        } else if (is_part) {
            family.domains.push_back(domain);
        } else {
            const std::vector<double> last = domain.last.empty() ? own->last : domain.last;
            *own = domain;
            own->last = last;
        }
    }
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    GOBO_TRY_DO(refuse_contradictions(family.domains));
    return narrowed;
}

}  // namespace gobo
