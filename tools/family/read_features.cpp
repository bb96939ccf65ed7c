#include "family/read_features.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// A count above this would make shaders no driver takes; it also bounds what a hostile file can ask for.
constexpr std::int64_t kLargestCount = 4096;

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
    const auto first = feature.values.begin();
    std::rotate(first, first + *index, first + *index + 1);
}

void read_choice(TomlReader& reader, const toml::table& table, Feature& feature, const std::string& what) {
    feature.values = reader.strings(table, "values");
    feature.excluded = reader.strings(table, "excluded");
    const toml::node& values = *table.get("values");
    if (feature.values.empty())
        reader.error(values, what + " has no values", "list at least one; the first is the default");
    std::set<std::string> seen;
    for (const std::string& value : feature.values) {
        if (value.empty() || !std::all_of(value.begin(), value.end(), is_identifier_part))
            reader.error(values, fmt::format("{} cannot have the value '{}'", what, value),
                         "use letters, digits and _: it names a file and a C++ enumerator");
        if (!seen.insert(value).second)
            reader.error(values, fmt::format("{} has the value '{}' twice", what, value), "list it once");
    }
    put_default_first(reader, table, feature, what);
    // Generated headers hold enums and uniform blocks side by side: where a block has a feature's name
    // already, the family names the enum otherwise.
    feature.enum_name = reader.string(table, "enum").value_or("");
    if (table.contains("enum") && !is_identifier(feature.enum_name))
        reader.error(*table.get("enum"), fmt::format("{} has '{}' for an enum", what, feature.enum_name),
                     "name it as C++ names a type, such as FogKind");
    for (const std::string& value : feature.excluded) {
        const auto index = feature.index_of(value);
        if (index.value_or(0) > 0) continue;
        reader.error(*table.get("excluded"), fmt::format("{} cannot exclude '{}'", what, value),
                     index ? "the default cannot be excluded" : feature.help_for(value));
    }
}

void read_count(TomlReader& reader, const toml::table& table, Feature& feature, const std::string& what) {
    feature.kind = FeatureKind::count;
    const toml::node& node = *table.get("count");
    const toml::array* range = node.as_array();
    const auto bound = [&](std::size_t i) {
        const auto* number = range == nullptr || range->size() != 2 ? nullptr : (*range)[i].as_integer();
        return number == nullptr ? -1 : number->get();
    };
    if (bound(0) != 0 || bound(1) < 1 || bound(1) > kLargestCount) {
        reader.error(node, what + " has no valid count",
                     fmt::format("write count = [0, N] with N from 1 to {}", kLargestCount));
        return;
    }
    for (std::int64_t i = 0; i <= bound(1); ++i) feature.values.push_back(std::to_string(i));
    feature.macro = reader.required_string(table, what, "constant");
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
    if (const toml::node* retired = table->get("retired"))
        reader.error(*retired, what + " has retired values", "'retired' is now 'excluded'");
    reader.only(*table, what,
                {"role", "values", "default", "excluded", "enum", "count", "constant", "define"});
    constexpr std::array roles = {Role::effect, Role::quality, Role::pipeline};
    feature.role = roles[reader.one_of(*table, what, "role", {"effect", "quality", "pipeline"}).value_or(0)];
    const bool is_choice = table->contains("values"), is_count = table->contains("count");
    if (table->contains("default") && !is_choice)
        reader.error(*table->get("default"), what + " cannot name its default",
                     "only a choice can: a count's is 0, a define's is off");
    if (table->contains("enum") && !is_choice)
        reader.error(*table->get("enum"), what + " cannot name an enum",
                     "only a choice has one: a count is an int, a define a bool");
    if (is_choice + is_count + table->contains("define") != 1) {
        reader.error(node, what + " must be one of a choice, a count and a define",
                     "give it exactly one of values, count and define");
    } else if (is_choice) {
        read_choice(reader, *table, feature, what);
    } else if (is_count) {
        read_count(reader, *table, feature, what);
    } else {
        feature.kind = FeatureKind::define;
        feature.values = {"off", "on"};
        feature.macro = reader.string(*table, "define").value_or("");
    }
    if (!is_choice && !is_identifier(feature.macro))
        reader.error(node, fmt::format("{} has '{}' for a macro", what, feature.macro),
                     "a macro is an identifier");
    return feature;
}

/// `old = "new"` for a feature, `"feature=old" = "feature=new"` for a value. Features stand before their
/// values in the table, as it is sorted.
void read_renamed(TomlReader& reader, const toml::table& root, std::vector<Feature>& features) {
    const toml::table* table = reader.table(root, "renamed");
    if (table == nullptr || reader.failed()) return;
    const auto halves = [](std::string_view text) {
        const auto equals = std::min(text.find('='), text.size());
        return std::pair(text.substr(0, equals), text.substr(equals));
    };
    for (const auto& [key, node] : *table) {
        const std::string was(key.str()), now = reader.string(*table, was).value_or("");
        const auto [old_name, old_value] = halves(was);
        const auto [new_name, new_value] = halves(now);
        const auto index = index_of(features, new_name);
        Feature* feature = index ? &features[*index] : nullptr;
        const auto is_its_name = [&](std::string_view name) {
            const auto& old_names = feature->old_names;
            return name == feature->name || std::count(old_names.begin(), old_names.end(), name) > 0;
        };
        if (feature != nullptr && old_value.empty() && new_value.empty() && !index_of(features, old_name)) {
            feature->old_names.emplace_back(old_name);
        } else if (feature != nullptr && old_value.size() > 1 && new_value.size() > 1 &&
                   is_its_name(old_name) && feature->index_of(new_value.substr(1)) &&
                   !feature->index_of(old_value.substr(1))) {
            feature->old_values.emplace(old_value.substr(1), new_value.substr(1));
        } else {
            reader.error(node, fmt::format("'{}' cannot have been renamed to '{}'", was, now),
                         "write OLD = \"FEATURE\" or \"FEATURE=OLD\" = \"FEATURE=VALUE\", of which only the "
                         "new one exists");
        }
    }
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
    for (const std::string& name : reader.strings(table, "default"))
        rule.defaults.push_back(read_feature_name(reader, *table.get("default"), "the rule", name, features));
    rule.dialects = reader.strings(table, "dialects");
    for (const std::string& dialect : rule.dialects) {
        const std::vector<std::string> known = {"450", "330", "es300"};
        if (std::find(known.begin(), known.end(), dialect) == known.end())
            reader.error(*table.get("dialects"), fmt::format("unknown dialect '{}'", dialect),
                         suggestion(dialect, known));
    }
    return rule;
}

/// What a relation is named after, and what else may stand beside it.
struct RelationForm {
    Relation::Kind kind;
    std::string_view name;
    std::string_view beside;  ///< another entry, or empty
};

constexpr RelationForm kRelationForms[] = {{Relation::Kind::any_order, "any_order", ""},
                                           {Relation::Kind::adds, "adds", ""},
                                           {Relation::Kind::turn, "turn", "turn_back"},
                                           {Relation::Kind::off, "off", "at"},
                                           {Relation::Kind::finer, "finer", ""}};

/// The form whose name the table holds.
const RelationForm* form_of(TomlReader& reader, const toml::table& row) {
    const RelationForm* found = nullptr;
    for (const RelationForm& form : kRelationForms) {
        if (!row.contains(form.name)) continue;
        if (found != nullptr) {
            reader.error(row,
                         fmt::format("a relation is either '{}' or '{}', not both", found->name, form.name),
                         "write each relation under its own [[relations]]");
            return nullptr;
        }
        found = &form;
    }
    if (found == nullptr)
        reader.error(row, "a relation must say what holds",
                     "write any_order = \"ARRAY\", adds = \"ARRAY[].MEMBER\", turn = [NAMES], off = "
                     "\"FEATURE\" with at = { NAME = VALUE }, or finer = \"FEATURE\"");
    return found;
}

/// The uniforms and inputs that turn an effect off.
std::vector<RenderValue> read_at(TomlReader& reader, const toml::table& row) {
    std::vector<RenderValue> values;
    const toml::table* table = reader.table(row, "at");
    if (table == nullptr) {
        reader.error(row, "the relation does not say where the effect is off",
                     "add at = { NAME = VALUE } with the reflected names and their values");
        return values;
    }
    for (const auto& [key, node] : *table)
        values.push_back(
            {std::string(key.str()), "", reader.numbers_of(node, key.str()), reader.place_of(node)});
    return values;
}

Relation read_relation(TomlReader& reader, const toml::table& row, const std::vector<Feature>& features) {
    Relation relation;
    relation.place = reader.place_of(row);
    const RelationForm* form = form_of(reader, row);
    if (form == nullptr) return relation;
    relation.kind = form->kind;
    std::vector<std::string> known = {std::string(form->name), "when"};
    if (!form->beside.empty()) known.emplace_back(form->beside);
    reader.only(row, "the relation", known);
    if (form->kind == Relation::Kind::turn) {
        relation.names = reader.strings(row, "turn");
        relation.turned_back = reader.strings(row, "turn_back");
    } else {
        const std::string name = reader.required_string(row, "the relation", form->name);
        if (form->kind == Relation::Kind::any_order || form->kind == Relation::Kind::adds) {
            relation.names = {name};
            const auto brackets = name.find("[]");
            if (form->kind == Relation::Kind::adds && (brackets == 0 || brackets == std::string::npos))
                reader.error(*row.get("adds"),
                             fmt::format("'{}' is not a member of an array's elements", name),
                             "write adds = \"ARRAY[].MEMBER\"");
        } else if (!reader.failed()) {
            relation.feature =
                read_feature_name(reader, *row.get(form->name), "the relation", name, features);
        }
    }
    if (form->kind == Relation::Kind::off) relation.at = read_at(reader, row);
    if (row.contains("when")) relation.when = read_condition(reader, row, "when", features);
    return relation;
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

int read_feature_name(TomlReader& reader, const toml::node& node, std::string_view what,
                      const std::string& name, const std::vector<Feature>& features) {
    if (const auto index = index_of(features, name)) return *index;
    reader.error(node, fmt::format("{} names an unknown feature '{}'", what, name), help_for(features, name));
    return 0;
}

std::vector<Feature> read_features(TomlReader& reader, const toml::table& root) {
    std::vector<Feature> features;  // TOML tables come sorted by name
    const toml::table* table = reader.table(root, "features");
    if (table == nullptr) return features;
    for (const auto& [key, node] : *table)
        features.push_back(read_feature(reader, std::string(key.str()), node));
    std::set<std::string> macros;
    for (const Feature& feature : features) {
        if (feature.macro.empty() || macros.insert(feature.macro).second) continue;
        reader.error(feature.place,
                     fmt::format("feature '{}' shares the macro '{}' with another feature", feature.name,
                                 feature.macro),
                     "give each count and define a macro of its own");
    }
    read_renamed(reader, root, features);
    return features;
}

std::vector<Rule> read_rules(TomlReader& reader, const toml::table& root,
                             const std::vector<Feature>& features) {
    std::vector<Rule> rules;
    for (const toml::table* rule : reader.tables(root, "rules", "rule"))
        rules.push_back(read_rule(reader, *rule, features));
    return rules;
}

std::vector<Relation> read_relations(TomlReader& reader, const toml::table& root,
                                     const std::vector<Feature>& features) {
    std::vector<Relation> relations;
    for (const toml::table* relation : reader.tables(root, "relations", "relation"))
        relations.push_back(read_relation(reader, *relation, features));
    return relations;
}

std::string to_text(const Relation& relation, const std::vector<Feature>& features) {
    if (relation.kind == Relation::Kind::turn) return "turn";
    const auto form = std::find_if(std::begin(kRelationForms), std::end(kRelationForms),
                                   [&](const RelationForm& row) { return row.kind == relation.kind; });
    const bool names_feature = relation.kind == Relation::Kind::off || relation.kind == Relation::Kind::finer;
    return fmt::format("{} = \"{}\"", form->name,
                       names_feature ? features[relation.feature].name : relation.names.front());
}

std::vector<RenderValue> read_render_values(TomlReader& reader, const toml::table& parent,
                                            std::string_view name) {
    std::vector<RenderValue> values;
    const toml::table* table = reader.table(parent, name);
    if (table == nullptr) return values;
    for (const auto& [key, node] : *table) {
        RenderValue value;
        value.name = key.str();
        value.place = reader.place_of(node);
        const std::string what = fmt::format("the render value of '{}'", value.name);
        if (const auto* source = node.as_string()) {
            value.source = source->get();
        } else if (const toml::table* row = node.as_table()) {
            reader.only(*row, what, {"source", "numbers"});
            value.source = reader.required_string(*row, what, "source");
            value.numbers = reader.numbers(*row, "numbers");
        } else {
            value.numbers = reader.numbers_of(node, value.name);
        }
        values.push_back(std::move(value));
    }
    return values;
}

}  // namespace gobo
