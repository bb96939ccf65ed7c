#include "family/read_relations.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/read_features.hpp"

namespace gobo {
namespace {

/// What a relation is named after, and what else may stand beside it.
struct Form {
    Relation::Kind kind;
    std::string name;
    std::string beside;  ///< another entry, or empty
};

const std::vector<Form>& forms() {
    static const std::vector<Form> table = {{Relation::Kind::any_order, "any_order", ""},
                                            {Relation::Kind::adds, "adds", ""},
                                            {Relation::Kind::turn, "turn", "turn_back"},
                                            {Relation::Kind::off, "off", "at"},
                                            {Relation::Kind::finer, "finer", ""}};
    return table;
}

constexpr std::string_view help =
    "write any_order = \"ARRAY\", adds = \"ARRAY[].MEMBER\", turn = [NAMES], off = \"FEATURE\" with at = "
    "{ NAME = VALUE }, or finer = \"FEATURE\"";

/// The form whose name the table holds.
const Form* form_of(TomlReader& reader, const toml::table& row) {
    const Form* found = nullptr;
    for (const Form& form : forms()) {
        if (!row.contains(form.name)) continue;
        if (found != nullptr) {
            reader.error(row,
                         fmt::format("a relation is either '{}' or '{}', not both", found->name, form.name),
                         "write each relation under its own [[relations]]");
            return nullptr;
        }
        found = &form;
    }
    if (found == nullptr) reader.error(row, "a relation must say what holds", std::string(help));
    return found;
}

std::optional<int> read_feature(TomlReader& reader, const toml::table& row, const std::string& entry,
                                const std::vector<Feature>& features) {
    const std::string name = reader.required_string(row, "the relation", entry);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < features.size(); ++i) {
        if (features[i].name == name) return static_cast<int>(i);
        names.push_back(features[i].name);
    }
    if (!reader.failed())
        reader.error(*row.get(entry), fmt::format("the relation names an unknown feature '{}'", name),
                     suggestion(name, names));
    return std::nullopt;
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
    for (const auto& [key, node] : *table) {
        RenderValue value;
        value.name = key.str();
        value.numbers = reader.numbers_of(node, value.name);
        value.place = reader.place_of(node);
        values.push_back(std::move(value));
    }
    return values;
}

/// A member of an array's elements: "uLights[].color".
void check_member(TomlReader& reader, const toml::table& row, const std::string& name) {
    const auto brackets = name.find("[]");
    if (reader.failed() || (brackets != std::string::npos && brackets > 0)) return;
    reader.error(*row.get("adds"), fmt::format("'{}' is no member of an array's elements", name),
                 "write adds = \"ARRAY[].MEMBER\"");
}

Relation read_relation(TomlReader& reader, const toml::table& row, const std::vector<Feature>& features) {
    Relation relation;
    relation.place = reader.place_of(row);
    const Form* form = form_of(reader, row);
    if (form == nullptr) return relation;
    relation.kind = form->kind;
    std::vector<std::string> known = {form->name, "when"};
    if (!form->beside.empty()) known.push_back(form->beside);
    reader.only(row, "the relation", known);
    switch (form->kind) {
        case Relation::Kind::any_order:
        case Relation::Kind::adds:
            relation.names = {reader.required_string(row, "the relation", form->name)};
            if (form->kind == Relation::Kind::adds) check_member(reader, row, relation.names.front());
            break;
        case Relation::Kind::turn:
            relation.names = reader.strings(row, "turn");
            relation.turned_back = reader.strings(row, "turn_back");
            break;
        case Relation::Kind::off:
            relation.feature = read_feature(reader, row, "off", features).value_or(-1);
            relation.at = read_at(reader, row);
            break;
        case Relation::Kind::finer:
            relation.feature = read_feature(reader, row, "finer", features).value_or(-1);
            break;
    }
    if (row.contains("when")) relation.when = read_condition(reader, row, "when", features);
    return relation;
}

}  // namespace

std::vector<Relation> read_relations(TomlReader& reader, const toml::table& root,
                                     const std::vector<Feature>& features) {
    std::vector<Relation> relations;
    const toml::node* node = root.get("relations");
    if (node == nullptr || reader.failed()) return relations;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
        reader.error(*node, "'relations' must be an array of tables",
                     "write each relation under [[relations]]");
        return relations;
    }
    for (const toml::node& relation : *array)
        relations.push_back(read_relation(reader, *relation.as_table(), features));
    return relations;
}

std::string to_text(const Relation& relation, const std::vector<Feature>& features) {
    const auto feature = [&] {
        return relation.feature < 0 ? std::string()
                                    : features[static_cast<std::size_t>(relation.feature)].name;
    };
    switch (relation.kind) {
        case Relation::Kind::any_order:
            return fmt::format("any_order = \"{}\"", relation.names.front());
        case Relation::Kind::adds:
            return fmt::format("adds = \"{}\"", relation.names.front());
        case Relation::Kind::turn:
            return "turn";
        case Relation::Kind::off:
            return fmt::format("off = \"{}\"", feature());
        case Relation::Kind::finer:
            break;
    }
    return fmt::format("finer = \"{}\"", feature());
}

}  // namespace gobo
