#include "family/read_family.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_features.hpp"
#include "family/toml_reader.hpp"

namespace gobo {
namespace {

/// Beyond any driver's: OpenGL guarantees 15 vectors between the stages.
constexpr std::int64_t kLargestLocation = 255;
constexpr std::int64_t kLargestVector = 4;

/// `location = 3`, or `count = "point + spot"`: the counts by whose sum a varying is an array.
void read_location(TomlReader& reader, const toml::table& row, const std::string& what,
                   const std::vector<Feature>& features, Varying& varying) {
    const toml::node* location = row.get("location");
    const toml::node* count = row.get("count");
    if (location == nullptr && count == nullptr)
        reader.error(row, what + " lacks its location", "add location = 0 or more");
    if (location != nullptr) {
        const std::int64_t number = reader.integer(row, "location").value_or(-1);
        varying.location = static_cast<int>(number);
        if (number < 0 || number > kLargestLocation)
            reader.error(*location, what + " has no valid location",
                         fmt::format("write location = N with N from 0 to {}", kLargestLocation));
        if (count != nullptr)
            reader.error(*location, what + " has a location and a count",
                         "leave the location out: counted varyings lie behind the others");
    }
    if (count != nullptr) {
        std::vector<std::string> known;
        for (const Feature& feature : features)
            if (feature.kind == FeatureKind::count) known.push_back(feature.name);
        for (const std::string& name : split(reader.string(row, "count").value_or(""), '+')) {
            if (std::find(known.begin(), known.end(), name) == known.end())
                reader.error(*count, fmt::format("{} is counted by '{}', which is not a count", what, name),
                             suggestion(name, known));
            else
                varying.counts.push_back(*index_of(features, name));
        }
    }
    if (const toml::node* values = row.get("values_per_element")) {
        const std::int64_t number = reader.integer(row, "values_per_element").value_or(0);
        varying.values_per_element = static_cast<int>(number);
        if (count == nullptr || number < 1 || number > kLargestVector)
            reader.error(*values, what + " has no valid values_per_element",
                         fmt::format("write a number from 1 to {} beside a count", kLargestVector));
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
        read_location(reader, *row, what, features, varying);
        varying.type = reader.required_string(*row, what, "type");
        varying.value = reader.required_string(*row, what, "value");
        varying.piece = reader.string(*row, "piece").value_or("");
        if (reader.one_of(*row, what, "interpolation", {"flat", "noperspective", "smooth"}))
            varying.interpolation = *reader.string(*row, "interpolation");
        varyings.push_back(std::move(varying));
    }
    std::stable_sort(varyings.begin(), varyings.end(), lies_before);
    for (std::size_t i = 1; i < varyings.size(); ++i)
        if (varyings[i].counts.empty() && varyings[i].location == varyings[i - 1].location)
            reader.error(varyings[i].place,
                         fmt::format("varying '{}' shares location {} with '{}'", varyings[i].name,
                                     varyings[i].location, varyings[i - 1].name),
                         "give each varying a location of its own");
    return varyings;
}

Domain read_domain(TomlReader& reader, std::string name, const toml::node& node) {
    Domain domain;
    domain.name = std::move(name);
    domain.place = reader.place_of(node);
    const std::string what = fmt::format("the domain of '{}'", domain.name);
    std::vector<double> range;
    if (const toml::table* table = node.as_table()) {
        reader.only(*table, what, {"range", "length", "last", "also"});
        domain.of_length = table->contains("length");
        range = reader.numbers(*table, domain.of_length ? "length" : "range");
        domain.also = reader.numbers(*table, "also");
        domain.last = reader.numbers(*table, "last");
        if (!domain.last.empty() && (domain.last.size() != 2 || domain.last[0] > domain.last[1]))
            reader.error(*table->get("last"), what + " is not a range", "write last = [low, high]");
    } else {
        range = reader.numbers_of(node, domain.name);
    }
    if (range.size() != 2 || range[0] > range[1]) {
        reader.error(node, what + " is not a range", "write [low, high]");
        return domain;
    }
    domain.low = range[0];
    domain.high = range[1];
    return domain;
}

/// Sorted by name, as TOML tables are.
std::vector<Domain> read_domains(TomlReader& reader, const toml::table& root) {
    std::vector<Domain> domains;
    if (const toml::table* table = reader.table(root, "domain"))
        for (const auto& [key, node] : *table)
            domains.push_back(read_domain(reader, std::string(key.str()), node));
    return domains;
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
    if (selection.keys.empty() && !selection.all && selection.cover < 1)
        reader.error(*table, "[default_set] selects nothing", "add keys = [...], all = true or cover = 2");
    if (reader.failed()) return selection;
    // Errors in its keys, features and condition are the family's, not those of who uses it.
    for (const std::string& text : selection.keys)
        if (const Result<Key> key = parse_key(family, text, reader.place_of(*table->get("keys"))); !key)
            reader.take(key.error());
    for (const std::string& name : selection.over)
        read_feature_name(reader, *table->get("over"), "[default_set]", name, family.features);
    if (!selection.where.empty()) read_condition(reader, *table, "where", family.features);
    return selection;
}

/// Follows `extends`, once: a family that is extended stands on its own feet.
Result<FamilyText> base_of(const TomlReader& reader, const FindFamily& find_base) {
    const toml::node* extends = reader.root().get("extends");
    if (extends == nullptr || reader.failed()) return FamilyText{};
    Diagnostic diagnostic;
    diagnostic.place = reader.place_of(*extends);
    diagnostic.help = "name a shipped family or a .toml file: extends = \"lit\"";
    diagnostic.message = "'extends' must name a family";
    if (!extends->is_string() || !find_base) return fail(std::move(diagnostic));
    const std::string& name = extends->as_string()->get();
    Result<FamilyText> base = find_base(name);
    if (base) return base;
    diagnostic.message = fmt::format("cannot extend '{}': {}", name, base.error().front().message);
    diagnostic.help = base.error().front().help;
    return fail(std::move(diagnostic));
}

}  // namespace

Result<Family> read_family(std::string_view text, const std::string& path, const FindFamily& find_base) {
    TomlReader reader(text, path);
    GOBO_TRY(const FamilyText base, base_of(reader, find_base));
    if (!base.path.empty()) reader.extend(base.text, base.path, {"values", "excluded", "rules", "relations"});
    Family family;
    family.path = path;
    const toml::table& root = reader.root();
    reader.only(root, "the family",
                {"name", "extends", "vertex", "fragment", "features", "rules", "varyings", "domain", "render",
                 "relations", "default_set", "renamed"});
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
    family.render = read_render_values(reader, root, "render");
    family.relations = read_relations(reader, root, family.features);
    family.default_selection = read_default_set(reader, root, family);
    if (reader.failed()) return tl::unexpected(reader.errors());
    return family;
}

Result<std::vector<Domain>> read_domain_file(std::string_view text, const std::string& path) {
    TomlReader reader(text, path);
    reader.only(reader.root(), "the file", {"domain"});
    std::vector<Domain> domains = read_domains(reader, reader.root());
    if (reader.failed()) return tl::unexpected(reader.errors());
    return domains;
}

}  // namespace gobo
