
#include "lab/study/plan.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "budget/qualities.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "family/toml_reader.hpp"

namespace gobo::study {
namespace {

/// One value of a table such as a family's [render]: a source's name, a table with source and numbers, or
/// numbers.
RenderValue read_render_value(TomlReader& reader, std::string name, const toml::node& node) {
    RenderValue value;
    value.name = std::move(name);
    value.place = reader.place_of(node);
    if (const auto* source = node.as_string()) {
        value.source = source->get();
    } else if (const toml::table* row = node.as_table()) {
        reader.only(*row, fmt::format("the render value of '{}'", value.name), {"source", "numbers"});
        value.source =
            reader.required_string(*row, fmt::format("the render value of '{}'", value.name), "source");
        value.numbers = reader.numbers(*row, "numbers");
    } else {
        value.numbers = reader.numbers_of(node, value.name);
    }
    return value;
}

std::vector<RenderValue> read_values(TomlReader& reader, const toml::table& row, std::string_view name) {
    std::vector<RenderValue> values;
    if (const toml::table* table = reader.table(row, name))
        for (const auto& [key, node] : *table)
            values.push_back(read_render_value(reader, std::string(key.str()), node));
    return values;
}

/// A point in the world, or `point` as it is.
void read_point(TomlReader& reader, const toml::table& row, std::string_view name,
                std::array<double, 3>& point) {
    if (!row.contains(name)) return;
    const std::vector<double> numbers = reader.numbers(row, name);
    if (numbers.size() == 3)
        std::copy(numbers.begin(), numbers.end(), point.begin());
    else
        reader.error(*row.get(name), fmt::format("'{}' is not a point", name), "write [x, y, z]");
}

void read_extent(TomlReader& reader, const toml::table& row, std::string_view name, int least, int& extent) {
    constexpr int kMost = 1024;
    const std::int64_t number = reader.integer(row, name).value_or(extent);
    if (number >= least && number <= kMost)
        extent = static_cast<int>(number);
    else
        reader.error(*row.get(name), fmt::format("'{}' is {}", name, number),
                     fmt::format("choose from {} to {}", least, kMost));
}

StudyScene read_scene(TomlReader& reader, const toml::table& row) {
    const std::vector<std::string> meshes = {"plane", "sphere", "teapot", "torus"};
    StudyScene scene;
    scene.name = reader.required_string(row, "a study scene", "name");
    reader.only(row, fmt::format("the study scene '{}'", scene.name),
                {"name", "mesh", "detail", "floor_cells", "camera", "target", "values"});
    scene.mesh = reader.string(row, "mesh").value_or(scene.mesh);
    if (std::find(meshes.begin(), meshes.end(), scene.mesh) == meshes.end())
        reader.error(*row.get("mesh"), fmt::format("there is no mesh '{}'", scene.mesh),
                     suggestion(scene.mesh, meshes));
    read_extent(reader, row, "detail", 3, scene.detail);
    read_extent(reader, row, "floor_cells", 0, scene.floor_cells);
    read_point(reader, row, "camera", scene.camera);
    read_point(reader, row, "target", scene.target);
    scene.values = read_values(reader, row, "values");
    return scene;
}

void check_keys(TomlReader& reader, const toml::node& node, const std::vector<std::string>& texts,
                const Family& family) {
    if (reader.failed()) return;
    for (const std::string& text : texts)
        if (const Result<Key> key = parse_key(family, text, reader.place_of(node)); !key)
            reader.take(key.error());
}

void check_quality(TomlReader& reader, const toml::node& node, const std::string& name,
                   const Family& family) {
    std::vector<std::string> known;
    for (const Feature& feature : family.features)
        if (feature.role == Role::quality) known.push_back(feature.name);
    if (std::find(known.begin(), known.end(), name) == known.end())
        reader.error(node, fmt::format("the family has no quality feature '{}'", name),
                     suggestion(name, known));
}

StudyCurve read_curve(TomlReader& reader, const toml::table& row, const Family& family) {
    reader.only(row, "a study curve", {"feature", "over", "numbers", "effects"});
    StudyCurve curve;
    curve.feature = reader.required_string(row, "a study curve", "feature");
    curve.over = reader.required_string(row, "a study curve", "over");
    curve.numbers = reader.numbers(row, "numbers");
    curve.effects = reader.required_string(row, "a study curve", "effects");
    if (reader.failed()) return curve;
    check_quality(reader, *row.get("feature"), curve.feature, family);
    check_keys(reader, *row.get("effects"), {curve.effects}, family);
    return curve;
}

StudyChange read_change(TomlReader& reader, const toml::table& row, const Family& family) {
    reader.only(row, "a study change", {"from", "to", "from_values", "to_values"});
    StudyChange change;
    change.from = reader.required_string(row, "a study change", "from");
    change.to = reader.required_string(row, "a study change", "to");
    change.from_values = read_values(reader, row, "from_values");
    change.to_values = read_values(reader, row, "to_values");
    if (!reader.failed()) check_keys(reader, row, {change.from, change.to}, family);
    return change;
}

/// The tables of an array of tables.
std::vector<const toml::table*> rows_of(TomlReader& reader, const toml::table& table, std::string_view name) {
    std::vector<const toml::table*> rows;
    const toml::node* node = table.get(name);
    if (node == nullptr) return rows;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_homogeneous<toml::table>()) {
        reader.error(*node, fmt::format("'{}' must be tables", name), fmt::format("write [[{}]]", name));
        return rows;
    }
    for (const toml::node& row : *array) rows.push_back(row.as_table());
    return rows;
}

/// Of a family that names none: as many combinations of effects as a reader can take in.
std::vector<std::string> effects_by_default(const Family& family) {
    constexpr std::size_t kMostEffects = 8;
    std::vector<std::string> effects;
    const Result<std::vector<Key>> keys = select(family, Selection{}, "450");
    if (!keys) return {key_text(family, default_key(family))};
    for (const Key& key : *keys) {
        const std::string text = key_text(family, effects_of(family, key));
        if (std::find(effects.begin(), effects.end(), text) == effects.end()) effects.push_back(text);
        if (effects.size() == kMostEffects) break;
    }
    return effects;
}

StudyPlan completed(StudyPlan plan, const Family& family) {
    if (plan.effects.empty()) plan.effects = effects_by_default(family);
    if (plan.quick.empty()) plan.quick = {plan.effects.front()};
    if (plan.scenes.empty())
        plan.scenes = {{.name = "teapot"},
                       {.name = "coarse sphere", .mesh = "sphere", .detail = 12, .floor_cells = 4}};
    return plan;
}

}  // namespace

Result<StudyPlan> read_plan(std::string_view text, const std::string& path, const Family& family) {
    TomlReader reader(text, path);
    const toml::table& root = reader.root();
    reader.only(root, "the plan", {"effects", "quick", "rate", "scenes", "curves", "changes"});
    StudyPlan plan;
    plan.effects = reader.strings(root, "effects");
    plan.quick = reader.strings(root, "quick");
    plan.rate = reader.strings(root, "rate");
    for (const auto& [name, keys] : {std::pair{"effects", &plan.effects}, std::pair{"quick", &plan.quick}})
        if (const toml::node* node = root.get(name)) check_keys(reader, *node, *keys, family);
    for (const std::string& name : plan.rate) check_quality(reader, *root.get("rate"), name, family);
    for (const toml::table* row : rows_of(reader, root, "scenes"))
        plan.scenes.push_back(read_scene(reader, *row));
    for (const toml::table* row : rows_of(reader, root, "curves"))
        plan.curves.push_back(read_curve(reader, *row, family));
    for (const toml::table* row : rows_of(reader, root, "changes"))
        plan.changes.push_back(read_change(reader, *row, family));
    if (reader.failed()) return tl::unexpected(reader.errors());
    return completed(std::move(plan), family);
}

StudyPlan default_plan(const Family& family) {
    return completed({}, family);
}

}  // namespace gobo::study
