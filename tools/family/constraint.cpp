#include "family/constraint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/numbers.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

struct Form {
    std::string_view name;
    Constraint::Kind kind;
    std::size_t names;
};
constexpr std::array kForms = {
    Form{"unit", Constraint::Kind::unit, 1}, Form{"not_zero", Constraint::Kind::not_zero, 1},
    Form{"distinct", Constraint::Kind::distinct, 2}, Form{"orthonormal", Constraint::Kind::orthonormal, 1},
    Form{"inverse_transpose_of", Constraint::Kind::inverse_transpose, 2}};

std::optional<double> number_in(std::string_view text) {
    const auto number = number_from<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

bool is_name(std::string_view text) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    return !text.empty() && kLetters.find(text.front()) != std::string_view::npos &&
           std::ranges::all_of(text, [&](char sign) {
               return kLetters.find(sign) != std::string_view::npos ||
                      std::string_view("0123456789.[]").find(sign) != std::string_view::npos;
           });
}

std::optional<Constraint> comparison_of(std::string_view text) {
    const auto at = text.find_first_of("<>=!");
    const std::string_view sign = text.substr(at, text.substr(at + 1).starts_with('=') ? 2 : 1);
    std::string_view left = trim(text.substr(0, at));
    std::string_view right = trim(text.substr(at + sign.size()));
    if (sign.starts_with('>')) std::swap(left, right);
    Constraint constraint;
    if (sign == "!=")
        constraint.kind = Constraint::Kind::differ;
    else if (sign == "<=" || sign == ">=")
        constraint.kind = Constraint::Kind::less_equal;
    else if (sign != "<" && sign != ">")
        return std::nullopt;
    if (constraint.kind == Constraint::Kind::differ && number_in(left)) std::swap(left, right);
    for (const std::string_view side : {left, right}) {
        const auto number = number_in(side);
        if (!number && !is_name(side)) return std::nullopt;
        constraint.names.emplace_back(number ? "" : side);
        if (number) constraint.number = *number;
    }
    if (constraint.names[0].empty() && constraint.names[1].empty()) return std::nullopt;
    return constraint;
}

}  // namespace

double Constraint::bound() const {
    if (kind != Kind::less) return number;
    return is_upper() ? float_below(number) : float_above(number);
}

std::optional<ComponentName> component_name(std::string_view name) {
    constexpr std::string_view kLetters = "xyzwrgbastpq";
    if (name.size() < 3 || name[name.size() - 2] != '.') return std::nullopt;
    const auto at = kLetters.find(name.back());
    if (at == std::string_view::npos) return std::nullopt;
    return ComponentName{std::string(name.substr(0, name.size() - 2)), at % 4};
}

const Domain* domain_of_component(const std::vector<Domain>& domains, std::string_view name,
                                  std::size_t component) {
    const auto found = std::ranges::find_if(domains, [&](const Domain& domain) {
        const auto part = component_name(domain.name);
        return part && part->component == component && part->of == name;
    });
    return found == domains.end() ? nullptr : &*found;
}

std::string_view struct_of(std::string_view name) {
    const auto dot = name.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
}

bool is_constraint(std::string_view text) {
    return text.find_first_of("<>=!(") != std::string_view::npos;
}

std::optional<Constraint> constraint_of(std::string_view text) {
    const auto trimmed = [](std::string_view part) { return std::string(trim(part)); };
    if (text.find_first_of("<>=!") != std::string_view::npos) return comparison_of(text);
    const auto open = text.find('(');
    if (open == std::string_view::npos || !text.ends_with(')')) return std::nullopt;
    const std::string name = trimmed(text.substr(0, open));
    const auto form = std::ranges::find(kForms, std::string_view(name), &Form::name);
    if (form == kForms.end()) return std::nullopt;
    Constraint constraint;
    constraint.kind = form->kind;
    for (const std::string& part : split(text.substr(open + 1, text.size() - open - 2), ','))
        constraint.names.push_back(trimmed(part));
    if (constraint.names.size() != form->names || !std::ranges::all_of(constraint.names, is_name))
        return std::nullopt;
    return constraint;
}

std::vector<Constraint> constraints_of(const std::vector<Domain>& domains) {
    std::vector<Constraint> constraints;
    for (const Domain& domain : domains)
        if (is_constraint(domain.name))
            if (auto constraint = constraint_of(domain.name)) {
                constraint->text = domain.name;
                constraint->place = domain.place;
                constraints.push_back(std::move(*constraint));
            }
    return constraints;
}

const Constraint* contradiction_in(const std::vector<Constraint>& constraints,
                                   std::map<std::string, NumberRange> ranges, double (*step)(double, bool)) {
    // The least values follow from one another: where they still grow after as many rounds as there are
    // names, comparisons form a circle.
    for (std::size_t round = 0; round <= ranges.size() + 1; ++round)
        for (const Constraint& constraint : constraints) {
            const bool is_strict = constraint.kind == Constraint::Kind::less;
            if (constraint.has_number()) {
                const bool is_upper = constraint.is_upper();
                const auto of = ranges.find(constraint.names[is_upper ? 0 : 1]);
                if (of == ranges.end()) continue;
                auto& [low, high, is_float] = of->second;
                const double bound = constraint.bound();
                if (constraint.kind == Constraint::Kind::differ) {
                    if (low == high && low == constraint.number) return &constraint;
                    continue;
                }
                (is_upper ? high : low) = is_upper ? std::min(high, bound) : std::max(low, bound);
                if (low > high) return &constraint;
                continue;
            }
            const bool is_of_one = constraint.names.size() == 2 && constraint.names[0] == constraint.names[1];
            if (is_of_one && (is_strict || constraint.kind == Constraint::Kind::differ ||
                              constraint.kind == Constraint::Kind::distinct))
                return &constraint;
            if (!constraint.is_comparison() || constraint.kind == Constraint::Kind::differ) continue;
            const auto less = ranges.find(constraint.names[0]);
            const auto more = ranges.find(constraint.names[1]);
            if (less == ranges.end() || more == ranges.end()) continue;
            const double low = less->second.low;
            const double least =
                is_strict ? low + step(low, less->second.is_float && more->second.is_float) : low;
            if (least <= more->second.low) continue;
            more->second.low = least;
            if (least > more->second.high || round > ranges.size()) return &constraint;
        }
    return nullptr;
}

Diagnostic contradiction_error(const Constraint& constraint) {
    return {.place = constraint.place,
            .message = fmt::format("no input keeps '{}' along with its range and the other constraints",
                                   constraint.text),
            .help = "remove one of those that contradict one another, or widen the range in [domain]"};
}

Result<void> refuse_contradictions(const std::vector<Domain>& domains) {
    std::map<std::string, NumberRange> ranges;
    for (const Domain& domain : domains) {
        if (is_constraint(domain.name)) continue;
        double least = domain.of_length ? -domain.high : domain.low;
        double most = domain.high;
        for (const double also : domain.also) {
            least = std::min(least, also);
            most = std::max(most, also);
        }
        ranges.emplace(domain.name, NumberRange{least, most});
    }
    std::vector<Constraint> constraints = constraints_of(domains);
    std::ranges::stable_sort(constraints, {},
                             [](const Constraint& one) { return std::pair(one.place.file, one.place.line); });
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (const Constraint& constraint : constraints)
        for (const std::string& name : constraint.names) {
            const auto part = component_name(name);
            const auto whole = part ? ranges.find(part->of) : ranges.end();
            if (!name.empty())
                ranges.emplace(name,
                               whole == ranges.end() ? NumberRange{-kLargest, kLargest} : whole->second);
        }
    const auto step = [](double number, bool) { return float_above(number) - number; };
    if (const Constraint* const found = contradiction_in(constraints, std::move(ranges), step))
        return fail(contradiction_error(*found));
    return {};
}

}  // namespace gobo
