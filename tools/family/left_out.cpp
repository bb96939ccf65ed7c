#include "family/left_out.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "family/read_features.hpp"
#include "family/read_rules.hpp"

namespace gobo {
namespace {

/// "Toon" of "Toon.levels" and "lights" of "lights[]".
std::string_view head_of(std::string_view name) {
    return name.substr(0, name.find_first_of(".["));
}

bool erase_named(toml::table& base, std::string_view table, const std::string& name) {
    toml::table* entries = base[table].as_table();
    if (entries == nullptr) return false;
    std::vector<std::string> found;
    for (const auto& [key, node] : *entries)
        if (head_of(key.str()) == name) found.emplace_back(key.str());
    for (const std::string& key : found) entries->erase(key);
    return !found.empty();
}

/// Whether the document has a feature of that name that is no choice, or is one with that value.
bool has_value(const toml::table& base, const std::string& name, std::string_view value) {
    const auto* values = base["features"][name]["values"].as_array();
    return values == nullptr || std::ranges::any_of(*values, [&](const toml::node& node) {
               return node.value_or(std::string_view()) == value;
           });
}

/// What was renamed to the feature, or to a value of it, is unknown without it.
void erase_old_names(toml::table& base, const std::string& feature) {
    toml::table* renamed = base["renamed"].as_table();
    if (renamed == nullptr) return;
    std::vector<std::string> found;
    for (const auto& [key, node] : *renamed) {
        const std::string now = node.value_or(std::string());
        if (now == feature || now.starts_with(feature + "=")) found.emplace_back(key.str());
    }
    for (const std::string& key : found) renamed->erase(key);
}

/// The conditions of one family read as those of another.
class Folding {
  public:
    /// `fixed`: per feature of `from`, the index of the value that it stands at where it is left out.
    Folding(const std::vector<Feature>& from, const std::vector<std::optional<int>>& fixed,
            const std::vector<Feature>& to)
        : from_(from), fixed_(fixed), to_(to) {
        for (std::size_t i = 0; i < from.size(); ++i)
            index_.push_back(fixed[i] ? std::nullopt : index_of(to, from[i].name));
    }

    [[nodiscard]] std::vector<int> features(const std::vector<int>& indices) const {
        std::vector<int> kept;
        for (const int index : indices)
            if (const auto now = index_[static_cast<std::size_t>(index)]) kept.push_back(*now);
        return kept;
    }

    [[nodiscard]] Expression fold(const Expression& old) const {
        Expression folded = old;
        folded.parts.clear();
        if (old.kind == Expression::Kind::compare) {
            folded.features = features(old.features);
            folded.subtracted = features(old.subtracted);
            const int sum = fixed_sum(old.features) - fixed_sum(old.subtracted);
            if (folded.features.empty() && folded.subtracted.empty())
                return constant(compare(sum, old.comparison, old.value));
            folded.value =
                old.features.size() == 1 && old.subtracted.empty() ? value_of(old) : old.value - sum;
            return folded;
        }
        const bool is_conjunction = old.kind == Expression::Kind::conjunction;
        for (const Expression& part : old.parts) {
            Expression one = fold(part);
            if (!is_constant(one))
                folded.parts.push_back(std::move(one));
            else if ((one.kind == Expression::Kind::conjunction) != is_conjunction)
                return one;  // false in a conjunction, true in a disjunction
        }
        return folded;
    }

    [[nodiscard]] static bool is_never(const Expression& expression) {
        return is_constant(expression) && expression.kind == Expression::Kind::disjunction;
    }

  private:
    static bool is_constant(const Expression& expression) {
        return expression.kind != Expression::Kind::compare && expression.parts.empty();
    }
    static Expression constant(bool holds) {
        return {.kind = holds ? Expression::Kind::conjunction : Expression::Kind::disjunction};
    }

    [[nodiscard]] int fixed_sum(const std::vector<int>& indices) const {
        int sum = 0;
        for (const int index : indices) sum += fixed_[static_cast<std::size_t>(index)].value_or(0);
        return sum;
    }

    /// Another default than that of the extended family gives values other indices.
    [[nodiscard]] int value_of(const Expression& old) const {
        const Feature& before = from_[static_cast<std::size_t>(old.features[0])];
        if (before.kind == FeatureKind::count) return old.value;
        const Feature& now =
            to_[static_cast<std::size_t>(*index_[static_cast<std::size_t>(old.features[0])])];
        return now.index_of(before.values[static_cast<std::size_t>(old.value)]).value_or(old.value);
    }

    const std::vector<Feature>& from_;
    const std::vector<std::optional<int>>& fixed_;
    const std::vector<Feature>& to_;
    std::vector<std::optional<int>> index_;
};

}  // namespace

std::vector<std::string> leave_out(toml::table& base, const std::vector<std::string>& names) {
    std::vector<std::string> unknown;
    for (const std::string& text : names) {
        const std::size_t equals = std::min(text.find('='), text.size());
        const std::string name = text.substr(0, equals);
        if (equals < text.size() && !has_value(base, name, text.substr(equals + 1))) {
            unknown.push_back(text);
            continue;
        }
        bool is_known = false;
        for (const char* table : {"features", "varyings", "domain", "render"})
            is_known = erase_named(base, table, name) || is_known;
        erase_old_names(base, name);
        if (!is_known) unknown.push_back(text);
    }
    if (names.empty()) return unknown;
    base.erase("rules");
    base.erase("relations");
    base.erase("default_set");  // its condition may name any feature
    return unknown;
}

Inherited inherited_without(const TomlTable& base, const std::vector<std::string>& names,
                            const std::vector<Feature>& features) {
    Inherited inherited;
    const std::vector<Feature> from = read_features(base);
    std::vector<std::optional<int>> fixed(from.size());
    for (const std::string& text : names) {
        const std::size_t equals = std::min(text.find('='), text.size());
        const auto index = index_of(from, text.substr(0, equals));
        if (!index) continue;  // a varying, a block
        const Feature& feature = from[static_cast<std::size_t>(*index)];
        const std::string value = equals == text.size() ? feature.values.front() : text.substr(equals + 1);
        fixed[static_cast<std::size_t>(*index)] = feature.index_of(value).value_or(0);
    }
    const std::vector<Rule> rules = read_rules(base, from);
    const std::vector<Relation> relations = read_relations(base, from);
    if (base.reader.failed()) return inherited;
    const Folding folding(from, fixed, features);
    for (const Rule& rule : rules) {
        Rule kept = rule;
        kept.when = folding.fold(rule.when);
        kept.defaults = folding.features(rule.defaults);
        const bool is_idle = rule.kind == Rule::Kind::defaults && kept.defaults.empty();
        if (!is_idle && !Folding::is_never(kept.when)) inherited.rules.push_back(std::move(kept));
    }
    const auto is_left_out = [&](const std::string& name) {
        return std::ranges::count(names, head_of(name)) > 0;
    };
    for (const Relation& relation : relations) {
        Relation kept = relation;
        std::erase_if(kept.names, is_left_out);
        std::erase_if(kept.turned_back, is_left_out);
        std::erase_if(kept.at, [&](const RenderValue& value) { return is_left_out(value.name); });
        if (relation.when) kept.when = folding.fold(*relation.when);
        if (relation.feature >= 0) {
            const std::vector<int> now = folding.features({relation.feature});
            if (now.empty()) continue;
            kept.feature = now.front();
        }
        const bool says_nothing = (kept.names.empty() && !relation.names.empty()) ||
                                  (kept.at.empty() && !relation.at.empty()) ||
                                  (kept.when && Folding::is_never(*kept.when));
        if (!says_nothing) inherited.relations.push_back(std::move(kept));
    }
    return inherited;
}

}  // namespace gobo
