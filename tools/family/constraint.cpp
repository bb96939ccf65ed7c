#include "family/constraint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace gobo
