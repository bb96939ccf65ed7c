#include "family/read_rules.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/read_features.hpp"

namespace gobo {
namespace {

/// Where a program names its features, the others make no difference to it.
std::vector<Rule> rules_of_programs(const TomlTable& root, const std::vector<Feature>& features) {
    std::vector<Rule> rules;
    const auto programs = root.table("programs");
    if (!programs || root.reader.failed()) return rules;
    for (const auto& [key, node] : programs->entries) {
        const TomlTable table(root.reader, *node.as_table(), fmt::format("program '{}'", key.str()));
        if (!table.has("features")) continue;
        std::set<int> used = {*index_of(features, kProgramFeature)};
        for (const std::string& name : table.strings("features"))
            used.insert(read_feature_name(table, "features", name, features));
        Rule rule;
        rule.place = table.place_of("features");
        rule.when = parse_expression(fmt::format("{} == {}", kProgramFeature, key.str()), features,
                                     rule.place, Fault::input)
                        .value();
        for (int feature = 0; feature < static_cast<int>(features.size()); ++feature)
            if (!used.contains(feature)) rule.defaults.push_back(feature);
        if (!rule.defaults.empty()) rules.push_back(std::move(rule));
    }
    return rules;
}

Rule read_rule(const TomlTable& table, const std::vector<Feature>& features) {
    Rule rule;
    rule.place = table.place_of();
    table.only({"when", "default", "forbid", "reason", "dialects"});
    const bool defaults = table.has("when") && table.has("default") && !table.has("forbid");
    const bool forbids = table.has("forbid") && !table.has("when") && !table.has("default");
    if (defaults == forbids) {
        table.error({}, "must be one of default and forbid",
                    "write when = \"CONDITION\" with default = [FEATURES], or forbid = \"CONDITION\" with "
                    "reason = \"...\"");
        return rule;
    }
    rule.kind = forbids ? Rule::Kind::forbid : Rule::Kind::defaults;
    rule.when = read_condition(table, forbids ? "forbid" : "when", features);
    if (forbids) rule.reason = table.called("a forbid rule").required_string("reason");
    for (const std::string& name : table.strings("default"))
        rule.defaults.push_back(read_feature_name(table.called("the rule"), "default", name, features));
    rule.dialects = table.strings("dialects");
    const std::vector<std::string> known = {"450", "330", "es300", "vulkan", "gl_spirv"};
    for (const std::string& dialect : rule.dialects)
        if (std::ranges::count(known, dialect) == 0)
            table.reader.error(table.place_of("dialects"), fmt::format("unknown dialect '{}'", dialect),
                               suggestion(dialect, known));
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
const RelationForm* form_of(const TomlTable& table) {
    std::vector<const RelationForm*> found;
    for (const RelationForm& form : kRelationForms)
        if (table.has(form.name)) found.push_back(&form);
    if (found.empty())
        table.reader.error(table.place_of(), "a relation must say what holds",
                           "write any_order = \"ARRAY\", adds = \"ARRAY[].MEMBER\", turn = [NAMES], off = "
                           "\"FEATURE\" with at = { NAME = VALUE }, or finer = \"FEATURE\"");
    if (found.size() > 1)
        table.reader.error(
            table.place_of(),
            fmt::format("a relation is either '{}' or '{}', not both", found[0]->name, found[1]->name),
            "write each relation under its own [[relations]]");
    return found.size() == 1 ? found.front() : nullptr;
}

/// The array of any_order = "ARRAY" and adds = "ARRAY[].MEMBER" is no element of another one.
void check_array_name(const RelationForm& form, const TomlTable& table, const std::string& name) {
    const std::size_t bracket = name.find_first_of("[]");
    const std::string array = name.substr(0, bracket);
    if (form.kind == Relation::Kind::any_order && (name.empty() || bracket != std::string::npos))
        table.reader.error(table.place_of(form.name), fmt::format("'{}' is not the name of an array", name),
                           fmt::format("write any_order = \"{}\"", array.empty() ? "ARRAY" : array));
    if (form.kind != Relation::Kind::adds) return;
    const bool is_member = bracket != std::string::npos && !array.empty() && name.substr(bracket, 2) == "[]";
    if (!is_member)
        table.reader.error(table.place_of(form.name),
                           fmt::format("'{}' is not a member of an array's elements", name),
                           "write adds = \"ARRAY[].MEMBER\"");
    else if (const std::size_t more = name.find("[]", bracket + 2); more != std::string::npos)
        table.reader.error(table.place_of(form.name),
                           fmt::format("'{}' is more than one number or vector of an element", name),
                           fmt::format("write a relation for each: adds = \"{}[0]{}\"", name.substr(0, more),
                                       name.substr(more + 2)));
}

/// The uniforms and inputs that turn an effect off: numbers.
std::vector<RenderValue> read_at(const TomlTable& table) {
    std::vector<RenderValue> values;
    if (const auto at = table.table("at"))
        for (const auto& [key, node] : at->entries)
            values.push_back({.name = std::string(key.str()),
                              .numbers = table.reader.numbers_of(node, key.str()),
                              .place = table.reader.place_of(node)});
    else
        table.error({}, "does not say where the effect is off",
                    "add at = { NAME = VALUE } with the reflected names and their values");
    return values;
}

Relation read_relation(const TomlTable& table, const std::vector<Feature>& features) {
    Relation relation;
    relation.place = table.place_of();
    const RelationForm* form = form_of(table);
    if (form == nullptr) return relation;
    relation.kind = form->kind;
    relation.text = form->name;
    std::vector<std::string> known = {std::string(form->name), "when"};
    if (!form->beside.empty()) known.emplace_back(form->beside);
    table.only(known);
    if (form->kind == Relation::Kind::turn) {
        relation.names = table.strings("turn");
        relation.turned_back = table.strings("turn_back");
        if (relation.names.empty() && relation.turned_back.empty())
            table.reader.error(table.place_of("turn"), "the relation turns nothing",
                               "name the vectors and matrices that turn together");
    } else {
        const std::string name = table.required_string(form->name);
        relation.text += fmt::format(" = \"{}\"", name);
        if (form->kind == Relation::Kind::any_order || form->kind == Relation::Kind::adds)
            relation.names = {name};
        else if (!table.reader.failed())
            relation.feature = read_feature_name(table, form->name, name, features);
        check_array_name(*form, table, name);
    }
    if (form->kind == Relation::Kind::off) relation.at = read_at(table);
    if (table.has("when")) relation.when = read_condition(table, "when", features);
    return relation;
}

}  // namespace

Expression read_condition(const TomlTable& table, std::string_view entry,
                          const std::vector<Feature>& features) {
    const std::string text = table.string(entry).value_or("");
    const Place place =
        table.has(entry) ? table.reader.place_of_text(*table.entries.get(entry)) : table.place_of();
    Result<Expression> condition = parse_expression(text, features, place, Fault::input);
    if (condition) return std::move(*condition);
    table.reader.take(condition.error());
    return {};
}

std::vector<Rule> read_rules(const TomlTable& root, const std::vector<Feature>& features) {
    std::vector<Rule> rules = rules_of_programs(root, features);
    for (const TomlTable& rule : root.tables("rules", "a rule")) rules.push_back(read_rule(rule, features));
    return rules;
}

std::vector<Relation> read_relations(const TomlTable& root, const std::vector<Feature>& features) {
    std::vector<Relation> relations;
    for (const TomlTable& relation : root.tables("relations", "the relation"))
        relations.push_back(read_relation(relation, features));
    return relations;
}

}  // namespace gobo
