#include "family/read_family.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_domains.hpp"
#include "family/read_features.hpp"
#include "family/read_relations.hpp"
#include "family/toml_reader.hpp"

namespace gobo {
namespace {

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return path.substr(0, slash);
}

/// Beyond any driver's: OpenGL guarantees 15 vectors between the stages.
constexpr std::int64_t largest_location = 255;
constexpr std::int64_t largest_vector = 4;

void read_location(TomlReader& reader, const toml::table& row, const std::string& what, Varying& varying) {
    const std::int64_t location = reader.integer(row, "location").value_or(-1);
    if (location >= 0 && location <= largest_location) {
        varying.location = static_cast<int>(location);
    } else if (row.contains("location")) {
        reader.error(*row.get("location"), what + " has no valid location",
                     fmt::format("write location = N with N from 0 to {}", largest_location));
    } else {
        reader.error(row, what + " lacks its location", "add location = 0 or more");
    }
}

void read_interpolation(TomlReader& reader, const toml::table& row, const std::string& what,
                        Varying& varying) {
    const std::vector<std::string> known = {"flat", "noperspective", "smooth"};
    varying.interpolation = reader.string(row, "interpolation").value_or("");
    if (varying.interpolation.empty() ||
        std::find(known.begin(), known.end(), varying.interpolation) != known.end())
        return;
    reader.error(*row.get("interpolation"),
                 fmt::format("{} has no interpolation '{}'", what, varying.interpolation),
                 suggestion(varying.interpolation, known));
}

/// `count = "point + spot"`: the counts by whose sum a varying is an array.
void read_counts(TomlReader& reader, const toml::table& row, const std::string& what,
                 const std::vector<Feature>& features, Varying& varying) {
    std::vector<std::string> names;
    for (const Feature& feature : features)
        if (feature.kind == FeatureKind::count) names.push_back(feature.name);
    for (const std::string& part : split(reader.string(row, "count").value_or(""), '+')) {
        const std::string name(trim(part));
        const auto feature = std::find_if(features.begin(), features.end(),
                                          [&](const Feature& one) { return one.name == name; });
        if (feature != features.end() && feature->kind == FeatureKind::count) {
            varying.counts.push_back(static_cast<int>(feature - features.begin()));
            continue;
        }
        reader.error(*row.get("count"), fmt::format("{} is counted by '{}', which is no count", what, name),
                     suggestion(name, names));
    }
}

/// `values_per_element = 4`: a counted varying whose elements are vectors of so many values.
void read_values_per_element(TomlReader& reader, const toml::table& row, const std::string& what,
                             Varying& varying) {
    if (!row.contains("values_per_element")) return;
    const std::int64_t values = reader.integer(row, "values_per_element").value_or(0);
    if (row.contains("count") && values >= 1 && values <= largest_vector)
        varying.values_per_element = static_cast<int>(values);
    else
        reader.error(*row.get("values_per_element"), what + " has no valid values_per_element",
                     fmt::format("write a number from 1 to {} beside a count", largest_vector));
}

/// `varyings` are sorted by location.
void refuse_shared_locations(TomlReader& reader, const std::vector<Varying>& varyings) {
    for (std::size_t i = 1; i < varyings.size(); ++i) {
        if (!varyings[i].counts.empty() || varyings[i].location != varyings[i - 1].location) continue;
        reader.error(varyings[i].place,
                     fmt::format("varying '{}' shares location {} with '{}'", varyings[i].name,
                                 varyings[i].location, varyings[i - 1].name),
                     "give each varying a location of its own");
    }
}

/// Single varyings by location, counted ones behind them by name.
bool lies_before(const Varying& a, const Varying& b) {
    if (a.counts.empty() != b.counts.empty()) return a.counts.empty();
    return a.counts.empty() && a.location < b.location;
}

std::vector<Varying> read_varyings(TomlReader& reader, const toml::table& root,
                                   const std::vector<Feature>& features) {
    std::vector<Varying> varyings;
    const toml::table* table = reader.table(root, "varyings");
    if (table == nullptr) return varyings;
    for (const auto& [key, node] : *table) {
        Varying varying;
        varying.name = key.str();
        varying.place = reader.place_of(node);
        const std::string what = fmt::format("varying '{}'", varying.name);
        const toml::table* row = node.as_table();
        if (row == nullptr || !is_identifier(varying.name)) {
            reader.error(node, what + " must be a GLSL identifier with a table",
                         "write [varyings.NAME] with location, type, piece and value");
            break;
        }
        reader.only(*row, what,
                    {"location", "count", "values_per_element", "type", "interpolation", "piece", "value"});
        if (row->contains("count") && !row->contains("location"))
            read_counts(reader, *row, what, features, varying);
        else
            read_location(reader, *row, what, varying);
        if (row->contains("count") && row->contains("location")) {
            reader.error(*row->get("location"), what + " has a location and a count",
                         "leave the location out: counted varyings lie behind the others");
        }
        read_values_per_element(reader, *row, what, varying);
        varying.type = reader.required_string(*row, what, "type");
        varying.value = reader.required_string(*row, what, "value");
        varying.piece = reader.string(*row, "piece").value_or("");
        read_interpolation(reader, *row, what, varying);
        varyings.push_back(std::move(varying));
    }
    std::stable_sort(varyings.begin(), varyings.end(), lies_before);
    refuse_shared_locations(reader, varyings);
    return varyings;
}

std::vector<RenderValue> read_render(TomlReader& reader, const toml::table& root) {
    std::vector<RenderValue> values;
    const toml::table* table = reader.table(root, "render");
    if (table == nullptr) return values;
    for (const auto& [key, node] : *table) {
        RenderValue value;
        value.name = key.str();
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
        values.push_back(std::move(value));
    }
    return values;
}

/// Errors in the keys, features and condition of a default set are the family's, not those of who uses it.
void check_default_set(TomlReader& reader, const toml::table& table, const DefaultSelection& selection,
                       const Family& family) {
    if (reader.failed()) return;
    for (const std::string& text : selection.keys) {
        const Place place = reader.place_of(*table.get("keys"));
        if (const Result<Key> key = parse_key(family, text, place); !key) reader.take(key.error());
    }
    std::vector<std::string> names;
    for (const Feature& feature : family.features) names.push_back(feature.name);
    for (const std::string& name : selection.over) {
        if (family.index_of(name)) continue;
        reader.error(*table.get("over"), fmt::format("[default_set] names an unknown feature '{}'", name),
                     suggestion(name, names));
    }
    if (!selection.where.empty()) (void)read_condition(reader, table, "where", family.features);
}

std::optional<DefaultSelection> read_default_set(TomlReader& reader, const toml::table& root,
                                                 const Family& family) {
    const toml::table* table = reader.table(root, "default_set");
    if (table == nullptr) return std::nullopt;
    reader.only(*table, "[default_set]", {"keys", "all", "cover", "over", "where"});
    DefaultSelection selection;
    selection.keys = reader.strings(*table, "keys");
    selection.all = reader.boolean(*table, "all").value_or(false);
    selection.cover = static_cast<int>(std::clamp<std::int64_t>(reader.integer(*table, "cover").value_or(0),
                                                                0, std::numeric_limits<int>::max()));
    selection.over = reader.strings(*table, "over");
    selection.where = reader.string(*table, "where").value_or("");
    if (selection.keys.empty() && !selection.all && selection.cover < 1) {
        reader.error(*table, "[default_set] selects nothing", "add keys = [...], all = true or cover = 2");
    }
    check_default_set(reader, *table, selection, family);
    return selection;
}

/// Follows `extends`, once: a family that is extended stands on its own feet.
Result<FamilyText> base_of(const TomlReader& reader, const FindFamily& find_base) {
    const toml::node* extends = reader.root().get("extends");
    if (extends == nullptr || reader.failed()) return FamilyText{};
    Diagnostic diagnostic;
    diagnostic.place = reader.place_of(*extends);
    diagnostic.help = "name a shipped family or a .toml file: extends = \"lit\"";
    if (!extends->is_string() || !find_base) {
        diagnostic.message = "'extends' must name a family";
        return fail(std::move(diagnostic));
    }
    Result<FamilyText> base = find_base(extends->as_string()->get());
    if (base) return base;
    diagnostic.message =
        fmt::format("cannot extend '{}': {}", extends->as_string()->get(), base.error().front().message);
    diagnostic.help = base.error().front().help;
    return fail(std::move(diagnostic));
}

}  // namespace

Result<Family> read_family(std::string_view text, const std::string& path, const FindFamily& find_base) {
    TomlReader reader(text, path);
    const Result<FamilyText> base = base_of(reader, find_base);
    if (!base) return tl::unexpected(base.error());
    if (!base->path.empty())
        reader.extend(base->text, base->path, {"values", "retired", "rules", "relations"});
    Family family;
    family.path = path;
    family.folder = folder_of(path);
    const toml::table& root = reader.root();
    reader.only(root, "the family",
                {"name", "extends", "vertex", "fragment", "features", "rules", "varyings", "domain", "render",
                 "relations", "default_set"});
    family.name = reader.required_string(root, "the family", "name");
    if (!reader.failed() && !is_identifier(family.name)) {
        reader.error(*root.get("name"), fmt::format("'{}' cannot name a family", family.name),
                     "use letters, digits and _, not starting with a digit: it names a C++ namespace");
    }
    family.vertex = reader.required_string(root, "the family", "vertex");
    family.fragment = reader.required_string(root, "the family", "fragment");
    family.features = read_features(reader, root);
    family.rules = read_rules(reader, root, family.features);
    family.varyings = read_varyings(reader, root, family.features);
    family.domains = read_domains(reader, root);
    family.render = read_render(reader, root);
    family.relations = read_relations(reader, root, family.features);
    family.default_selection = read_default_set(reader, root, family);
    if (reader.failed()) return tl::unexpected(reader.errors());
    return family;
}

}  // namespace gobo
