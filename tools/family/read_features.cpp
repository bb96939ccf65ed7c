#include "family/read_features.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// A count above this would make shaders no driver takes; it also bounds what a hostile file can ask for.
constexpr std::int64_t largest_count = 4096;

Role read_role(TomlReader& reader, const toml::table& table, const std::string& what) {
    const std::string name = reader.string(table, "role").value_or("effect");
    if (name == "effect") return Role::effect;
    if (name == "quality") return Role::quality;
    if (name == "pipeline") return Role::pipeline;
    reader.error(*table.get("role"), fmt::format("{} has no role '{}'", what, name),
                 suggestion(name, {"effect", "quality", "pipeline"}));
    return Role::effect;
}

bool is_value_name(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), is_identifier_part);
}

/// Keys hold indices, and everywhere index 0 is the default: where the family names another than the first
/// value, that one moves to the front.
void put_default_first(TomlReader& reader, const toml::table& table, Feature& feature,
                       const std::string& what) {
    const std::optional<std::string> name = reader.string(table, "default");
    if (!name) return;
    const std::optional<int> index = feature.index_of(*name);
    if (!index) {
        reader.error(*table.get("default"), fmt::format("{} has no value '{}' to default to", what, *name),
                     suggestion(*name, feature.values));
        return;
    }
    feature.default_place = *index;
    std::rotate(feature.values.begin(), feature.values.begin() + *index, feature.values.begin() + *index + 1);
}

/// Generated headers hold enums and uniform blocks side by side: where a block has a feature's name already,
/// the family names the enum otherwise.
void read_enum_name(TomlReader& reader, const toml::table& table, Feature& feature, const std::string& what) {
    const std::optional<std::string> name = reader.string(table, "enum");
    if (!name) return;
    feature.enum_name = *name;
    if (is_identifier(*name)) return;
    reader.error(*table.get("enum"), fmt::format("{} has '{}' for an enum", what, *name),
                 "name it as C++ names a type, such as FogKind");
}

void read_choice(TomlReader& reader, const toml::table& table, Feature& feature, const std::string& what) {
    feature.kind = FeatureKind::choice;
    feature.values = reader.strings(table, "values");
    feature.retired = reader.strings(table, "retired");
    if (feature.values.empty()) {
        reader.error(*table.get("values"), what + " has no values",
                     "list at least one; the first is the default");
    }
    std::set<std::string> seen;
    for (const std::string& value : feature.values) {
        if (!is_value_name(value)) {
            reader.error(*table.get("values"), fmt::format("{} cannot have the value '{}'", what, value),
                         "use letters, digits and _: it names a file and a C++ enumerator");
        }
        if (!seen.insert(value).second) {
            reader.error(*table.get("values"), fmt::format("{} has the value '{}' twice", what, value),
                         "list it once");
        }
    }
    put_default_first(reader, table, feature, what);
    read_enum_name(reader, table, feature, what);
    for (const std::string& value : feature.retired) {
        const auto index = feature.index_of(value);
        if (!index || *index == 0) {
            reader.error(*table.get("retired"), fmt::format("{} cannot retire '{}'", what, value),
                         index ? "the default cannot be retired" : suggestion(value, feature.values));
        }
    }
}

void read_count(TomlReader& reader, const toml::table& table, Feature& feature, const std::string& what) {
    feature.kind = FeatureKind::count;
    const toml::array* range = table.get("count")->as_array();
    const auto bound = [&](std::size_t i) { return (*range)[i].value<std::int64_t>().value_or(-1); };
    const bool is_range =
        range != nullptr && range->size() == 2 && (*range)[0].is_integer() && (*range)[1].is_integer();
    if (!is_range || bound(0) != 0 || bound(1) < 1 || bound(1) > largest_count) {
        reader.error(*table.get("count"), what + " has no valid count",
                     fmt::format("write count = [0, N] with N from 1 to {}", largest_count));
        return;
    }
    for (std::int64_t i = 0; i <= bound(1); ++i) feature.values.push_back(std::to_string(i));
    feature.macro = reader.required_string(table, what, "constant");
}

void read_define(TomlReader& reader, const toml::table& table, Feature& feature) {
    feature.kind = FeatureKind::define;
    feature.values = {"off", "on"};
    feature.macro = reader.string(table, "define").value_or("");
}

Feature read_feature(TomlReader& reader, std::string name, const toml::node& node) {
    Feature feature;
    feature.name = std::move(name);
    feature.place = reader.place_of(node);
    const std::string what = fmt::format("feature '{}'", feature.name);
    const toml::table* table = node.as_table();
    if (table == nullptr || !is_identifier(feature.name)) {
        reader.error(node, what + " must be an identifier with a table",
                     "write [features.NAME] with values, count or define");
        return feature;
    }
    reader.only(*table, what,
                {"role", "values", "default", "retired", "enum", "count", "constant", "define"});
    feature.role = read_role(reader, *table, what);
    const int kinds = (table->contains("values") ? 1 : 0) + (table->contains("count") ? 1 : 0) +
                      (table->contains("define") ? 1 : 0);
    if (table->contains("default") && !table->contains("values")) {
        reader.error(*table->get("default"), what + " cannot name its default",
                     "only a choice can: a count's is 0, a define's is off");
    }
    if (table->contains("enum") && !table->contains("values")) {
        reader.error(*table->get("enum"), what + " cannot name an enum",
                     "only a choice has one: a count is an int, a define a bool");
    }
    if (kinds != 1) {
        reader.error(node, what + " must be one of a choice, a count and a define",
                     "give it exactly one of values, count and define");
    } else if (table->contains("values")) {
        read_choice(reader, *table, feature, what);
    } else if (table->contains("count")) {
        read_count(reader, *table, feature, what);
    } else {
        read_define(reader, *table, feature);
    }
    const bool has_macro = feature.kind != FeatureKind::choice && !reader.failed();
    if (has_macro && !is_identifier(feature.macro)) {
        reader.error(node, fmt::format("{} has '{}' for a macro", what, feature.macro),
                     "a macro is an identifier");
    }
    return feature;
}

void refuse_shared_macros(TomlReader& reader, const std::vector<Feature>& features) {
    std::set<std::string> macros;
    for (const Feature& feature : features) {
        if (feature.macro.empty() || macros.insert(feature.macro).second) continue;
        reader.error(feature.place,
                     fmt::format("feature '{}' shares the macro '{}' with another feature", feature.name,
                                 feature.macro),
                     "give each count and define a macro of its own");
    }
}

int feature_index(TomlReader& reader, const toml::node& node, const std::string& name,
                  const std::vector<Feature>& features) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < features.size(); ++i) {
        if (features[i].name == name) return static_cast<int>(i);
        names.push_back(features[i].name);
    }
    reader.error(node, fmt::format("the rule names an unknown feature '{}'", name), suggestion(name, names));
    return 0;
}

Rule read_rule(TomlReader& reader, const toml::table& table, const std::vector<Feature>& features) {
    Rule rule;
    rule.place = reader.place_of(table);
    reader.only(table, "a rule", {"when", "default", "forbid", "reason", "dialects"});
    const bool defaults = table.contains("when") && table.contains("default") && !table.contains("forbid");
    const bool forbids = table.contains("forbid") && !table.contains("when") && !table.contains("default");
    if (defaults == forbids) {
        reader.error(table, "a rule must be one of default and forbid",
                     "write when = \"CONDITION\" with default = [FEATURES], or forbid = \"CONDITION\" with "
                     "reason = \"...\"");
        return rule;
    }
    rule.kind = forbids ? Rule::Kind::forbid : Rule::Kind::defaults;
    rule.when = read_condition(reader, table, forbids ? "forbid" : "when", features);
    if (forbids) rule.reason = reader.required_string(table, "a forbid rule", "reason");
    for (const std::string& name : reader.strings(table, "default")) {
        rule.defaults.push_back(feature_index(reader, *table.get("default"), name, features));
    }
    rule.dialects = reader.strings(table, "dialects");
    for (const std::string& dialect : rule.dialects) {
        if (dialect == "450" || dialect == "330" || dialect == "es300") continue;
        reader.error(*table.get("dialects"), fmt::format("unknown dialect '{}'", dialect),
                     suggestion(dialect, {"450", "330", "es300"}));
    }
    return rule;
}

}  // namespace

Expression read_condition(TomlReader& reader, const toml::table& table, std::string_view name,
                          const std::vector<Feature>& features) {
    const std::string text = reader.string(table, name).value_or("");
    Place place = reader.place_of(*table.get(name));
    if (place.column > 0) ++place.column;  // behind the quotation mark
    Result<Expression> condition = parse_expression(text, features, place, Fault::input);
    if (condition) return std::move(*condition);
    reader.take(condition.error());
    return {};
}

std::vector<Feature> read_features(TomlReader& reader, const toml::table& root) {
    std::vector<Feature> features;  // TOML tables come sorted by name
    const toml::table* table = reader.table(root, "features");
    if (table == nullptr) return features;
    for (const auto& [key, node] : *table)
        features.push_back(read_feature(reader, std::string(key.str()), node));
    refuse_shared_macros(reader, features);
    return features;
}

std::vector<Rule> read_rules(TomlReader& reader, const toml::table& root,
                             const std::vector<Feature>& features) {
    std::vector<Rule> rules;
    const toml::node* node = root.get("rules");
    if (node == nullptr || reader.failed()) return rules;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
        reader.error(*node, "'rules' must be an array of tables", "write each rule under [[rules]]");
        return rules;
    }
    for (const toml::node& rule : *array) rules.push_back(read_rule(reader, *rule.as_table(), features));
    return rules;
}

}  // namespace gobo
