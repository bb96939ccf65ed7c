#include "family/read_family.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/glsl_version.hpp"
#include "core/text.hpp"
#include "family/constraint.hpp"
#include "family/cover.hpp"
#include "family/key.hpp"
#include "family/left_out.hpp"
#include "family/read_features.hpp"
#include "family/read_rules.hpp"
#include "family/toml_reader.hpp"

namespace gobo {
namespace {

/// Beyond any driver's: OpenGL guarantees 15 vectors between the stages.
constexpr std::int64_t kLargestLocation = 255;
constexpr std::int64_t kLargestVector = 4;

/// `location = 3`, or `count = "point + spot"`: the counts by whose sum a varying is an array.
void read_location(const TomlTable& table, const std::vector<Feature>& features, Varying& varying) {
    const bool is_counted = table.has("count");
    if (!table.has("location") && !is_counted)
        table.error({}, "lacks its location", "add location = 0 or more");
    if (table.has("location")) {
        const std::int64_t number = table.integer("location").value_or(-1);
        varying.location = static_cast<int>(number);
        if (number < 0 || number > kLargestLocation)
            table.error("location", "has no valid location",
                        fmt::format("write location = N with N from 0 to {}", kLargestLocation));
        if (is_counted)
            table.error("location", "has a location and a count",
                        "leave the location out: counted varyings lie behind the others");
    }
    std::vector<std::string> known;
    for (const Feature& feature : features)
        if (feature.kind == FeatureKind::count) known.push_back(feature.name);
    for (const std::string& name : split(table.string("count").value_or(""), '+'))
        if (std::ranges::count(known, name) > 0)
            varying.counts.push_back(*index_of(features, name));
        else
            table.error("count", fmt::format("is counted by '{}', which is not a count", name),
                        suggestion(name, known));
    const std::int64_t number = table.integer("values_per_element").value_or(1);
    varying.values_per_element = static_cast<int>(number);
    if (table.has("values_per_element") && (!is_counted || number < 1 || number > kLargestVector))
        table.error("values_per_element", "has no valid values_per_element",
                    fmt::format("write a number from 1 to {} beside a count", kLargestVector));
}

/// Single varyings by location, counted ones behind them by name.
bool lies_before(const Varying& a, const Varying& b) {
    if (a.counts.empty() != b.counts.empty()) return a.counts.empty();
    return a.counts.empty() && a.location < b.location;
}

std::vector<Varying> read_varyings(const TomlTable& root, const std::vector<Feature>& features) {
    std::vector<Varying> varyings;
    const auto named = root.table("varyings");
    if (!named) return varyings;
    for (const auto& [key, node] : named->entries) {
        Varying varying;
        varying.name = key.str();
        varying.place = root.reader.place_of(node);
        const std::string what = fmt::format("varying '{}'", varying.name);
        if (!node.is_table() || !is_identifier(varying.name)) {
            root.reader.error(node, what + " must be a GLSL identifier with a table",
                              "write [varyings.NAME] with location, type, piece and value");
            break;
        }
        const TomlTable table(root.reader, *node.as_table(), what);
        table.only({"location", "count", "values_per_element", "type", "interpolation", "piece", "value"});
        read_location(table, features, varying);
        varying.type = table.required_string("type");
        varying.value = table.required_string("value");
        varying.piece = table.string("piece").value_or("");
        if (table.one_of("interpolation", {"flat", "noperspective", "smooth"}))
            varying.interpolation = *table.string("interpolation");
        varyings.push_back(std::move(varying));
    }
    std::ranges::stable_sort(varyings, lies_before);
    for (std::size_t i = 1; i < varyings.size(); ++i)
        if (varyings[i].counts.empty() && varyings[i].location == varyings[i - 1].location)
            root.reader.error(varyings[i].place,
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
    if (is_constraint(domain.name)) {  // between inputs: "near < far" = true
        if (!constraint_of(domain.name))
            reader.error(node, fmt::format("'{}' is no constraint", domain.name),
                         std::string(kConstraintHelp));
        else if (!node.is_boolean() || !node.as_boolean()->get())
            reader.error(node, fmt::format("the constraint '{}' is not true", domain.name),
                         fmt::format("write \"{}\" = true", domain.name));
        return domain;
    }
    if (node.is_boolean()) {
        reader.error(node, what + " is not a range",
                     "write [low, high]; true states a constraint: \"near < far\" = true");
        return domain;
    }
    if (node.is_table()) {
        const TomlTable table(reader, *node.as_table(), what);
        table.only({"range", "length", "last", "also"});
        domain.of_length = table.has("length");
        range = table.numbers(domain.of_length ? "length" : "range");
        domain.also = table.numbers("also");
        domain.last = table.numbers("last");
        if (!domain.last.empty() && (domain.last.size() != 2 || domain.last[0] > domain.last[1]))
            table.error("last", "is not a range", "write last = [low, high]");
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

/// A component's range is a part of that of the whole, where one is stated.
void check_components(TomlReader& reader, const std::vector<Domain>& domains) {
    for (const Domain& domain : domains) {
        const auto part = component_name(domain.name);
        const auto whole = part ? std::ranges::find(domains, part->of, &Domain::name) : domains.end();
        const Domain* const first = part ? domain_of_component(domains, part->of, part->component) : nullptr;
        if (first != nullptr && first != &domain)
            reader.error(domain.place,
                         fmt::format("'{}' is the same component as '{}'", domain.name, first->name),
                         "state one range of it");
        if (whole == domains.end()) continue;
        if (whole->of_length)
            reader.error(domain.place, fmt::format("the range of '{}' is one of its length", part->of),
                         "state the length's range alone, or that of each component");
        else if (!is_within(domain, *whole))
            reader.error(domain.place,
                         fmt::format("'{}' may hold more here than '{}'", domain.name, part->of),
                         "a component's range is a part of that of the whole");
    }
}

/// Sorted by name, as TOML tables are.
std::vector<Domain> read_domains(const TomlTable& root) {
    std::vector<Domain> domains;
    if (const auto table = root.table("domain"))
        for (const auto& [key, node] : table->entries)
            domains.push_back(read_domain(root.reader, std::string(key.str()), node));
    check_components(root.reader, domains);
    if (const auto kept = refuse_contradictions(domains); !kept)
        for (const Diagnostic& error : kept.error())
            root.reader.error(error.place, error.message, error.help);
    return domains;
}

/// The text as TOML writes it, on one line.
std::string shown(std::string_view text) {
    std::string line;
    for (const char character : text)
        line += character == '\n' ? "\\n" : character == '\r' ? "\\r" : std::string(1, character);
    return line;
}

/// "330 core", where the family states it.
std::string read_version(const TomlTable& root) {
    const std::optional<std::string> version = root.string("version");
    if (version && !is_glsl_version(*version))
        root.reader.error(root.place_of("version"), fmt::format("GLSL has no version '{}'", shown(*version)),
                          "write a number that GLSL has and the profile: 330 core, 450, 300 es");
    return version.value_or("");
}

/// `text` for all stages, then those of single ones.
std::vector<PrologueText> read_prologue(const TomlTable& root) {
    std::vector<PrologueText> prologue;
    const auto table = root.table("prologue");
    if (!table) return prologue;
    std::vector<std::string> known = {"text"};
    for (const StageNames& stage : kStages) known.emplace_back(stage.name);
    table->only(known);
    for (const std::string& name : known)
        if (const std::optional<std::string> text = table->string(name))
            prologue.push_back(
                {name == "text" ? "" : name, *text, root.reader.place_of_text(*table->entries.get(name))});
    return prologue;
}

/// `"#pragma import \"*\"" = "lib/*.glsl"`.
std::vector<IncludeRule> read_include_rules(const TomlTable& root) {
    std::vector<IncludeRule> rules;
    const auto table = root.table("includes");
    if (!table) return rules;
    for (const auto& [key, node] : table->entries) {
        IncludeRule rule{std::string(trim(key.str())), table->string(key.str()).value_or(""),
                         root.reader.place_of(node)};
        const auto stars = std::ranges::count(rule.line, '*');  // without one, the line means one file
        for (const std::string& text : {rule.line, rule.path})
            if (stars > 1 || std::ranges::count(text, '*') != stars || text.find('\n') != std::string::npos ||
                rule.line == "*" || text.empty())
                root.reader.error(rule.place,
                                  fmt::format("'{}' does not say where the name stands", shown(text)),
                                  "write one * in the line and one in the path: '#pragma import \"*\"' = "
                                  "'lib/*.glsl'; or none in both");
        rules.push_back(std::move(rule));
    }
    std::ranges::stable_sort(rules, std::ranges::greater(),
                             [](const IncludeRule& rule) { return rule.line.size(); });
    return rules;
}

/// `'gl_FragColor' = 'color'`.
std::map<std::string, std::string> read_substitutions(const TomlTable& root) {
    std::map<std::string, std::string> substitutions;
    const auto table = root.table("substitute");
    if (!table) return substitutions;
    for (const auto& [key, node] : table->entries) {
        const std::string text = table->string(key.str()).value_or("");
        if (!is_substituted(key.str()) || !is_macro_text(text))
            root.reader.error(node, fmt::format("cannot replace '{}' by '{}'", shown(key.str()), shown(text)),
                              "write a name, perhaps between signs, and one line without comments");
        substitutions.emplace(key.str(), text);
    }
    return substitutions;
}

/// `[[descriptor_sets]]`.
std::vector<DescriptorSet> read_descriptor_sets(const TomlTable& root) {
    std::vector<DescriptorSet> sets;
    std::map<std::string, std::string> set_of;  // by resource
    for (const TomlTable& table : root.tables("descriptor_sets", "a descriptor set")) {
        table.only({"name", "holds"});
        DescriptorSet set{table.required_string("name"), table.strings("holds"), table.place_of(),
                          table.place_of("holds")};
        if (!root.reader.failed() && !is_identifier(set.name))
            table.error("name", fmt::format("has the name '{}'", set.name),
                        "use letters, digits and _: it names a C++ constant");
        for (const DescriptorSet& other : sets)
            if (other.name == set.name)
                table.error("name", fmt::format("has the name '{}', as another has", set.name),
                            "give each descriptor set a name of its own");
        for (const std::string& resource : set.holds)
            if (const auto [other, is_new] = set_of.try_emplace(resource, set.name); !is_new)
                table.error(
                    "holds",
                    fmt::format("holds '{}', which {}", resource,
                                other->second == set.name ? "it lists twice"
                                                          : fmt::format("'{}' holds already", other->second)),
                    "list each block and sampler once");
        sets.push_back(std::move(set));
    }
    return sets;
}

std::optional<Selection> read_default_set(const TomlTable& root, const Family& family) {
    const auto table = root.table("default_set");
    if (!table) return std::nullopt;
    table->only({"keys", "all", "cover", "over", "where"});
    Selection selection;
    for (const std::string& text : table->strings("keys")) selection.keys.push_back({text});
    selection.all = table->boolean("all").value_or(false);
    const std::optional<std::int64_t> cover = table->integer("cover");
    if (cover && (*cover < 0 || *cover > kLargestCover))
        table->error("cover", "has no valid cover",
                     fmt::format("write cover = T, a whole number from 0, for none, to {}", kLargestCover));
    selection.cover = static_cast<int>(std::clamp<std::int64_t>(cover.value_or(0), 0, kLargestCover));
    selection.over = table->strings("over");
    selection.where = table->string("where").value_or("");
    if (!selection.where.empty()) read_condition(*table, "where", family.features);
    if (selection.names_nothing() && cover.value_or(0) == 0)
        table->error({}, "selects nothing", "add keys = [...], all = true or cover = 2");
    if (root.reader.failed()) return selection;
    // Errors in its keys, features and condition are the family's, not those of who uses it.
    for (const NamedKey& named : selection.keys)
        if (const auto key = parse_key(family, named.text, table->place_of("keys")); !key)
            root.reader.take(key.error());
    for (const std::string& name : selection.over) read_feature_name(*table, "over", name, family.features);
    return selection;
}

/// `vertex = "a.vert"` or `fragment = ["a.frag", "b.frag"]`, for each stage. Only the program of a pass that
/// draws no colours may lack the fragment stage.
Templates read_templates(const TomlTable& table, bool needs_fragment) {
    Templates templates;
    for (const StageNames& stage : kStages) {
        if (!table.has(stage.name)) continue;
        std::vector<std::string>& files = templates[stage.kind];
        const bool are_several = table.entries.get(stage.name)->is_array();
        files = are_several ? table.strings(stage.name) : std::vector{table.string(stage.name).value_or("")};
        if (files.empty() || std::ranges::count(files, "") > 0)
            table.error(stage.name, fmt::format("has no file for '{}'", stage.name),
                        fmt::format("name the template that holds main(): {} = \"...\"", stage.name));
    }
    const auto has = [&](StageKind stage) { return !templates[stage].empty(); };
    if (has(StageKind::compute)) {
        if (std::ranges::count_if(templates.values, [](const auto& files) { return !files.empty(); }) > 1)
            table.error("compute", "has a compute stage beside others",
                        "a compute stage is a program of its own: write it under [programs.NAME]");
        return templates;
    }
    if (!has(StageKind::vertex)) static_cast<void>(table.required_string("vertex"));
    if (!has(StageKind::fragment) && needs_fragment) static_cast<void>(table.required_string("fragment"));
    if (has(StageKind::tess_control) && !has(StageKind::tess_evaluation))
        table.error("tess_control", "has a tess_control stage without a tess_evaluation stage",
                    "add tess_evaluation = \"NAME.tese\"");
    return templates;
}

/// The templates at the top of the file, then those of each of [programs].
std::vector<Templates> read_programs(const TomlTable& root) {
    std::vector<Templates> programs = {read_templates(root, true)};
    const auto tables = root.table("programs");
    if (!tables) return programs;
    for (const auto& [key, node] : tables->entries) {
        const std::string what = fmt::format("program '{}'", key.str());
        const bool is_value = !key.str().empty() && std::ranges::all_of(key.str(), is_identifier_part);
        if (!node.is_table() || !is_value || key.str() == "main") {
            root.reader.error(
                node, what + " must be a table, called by letters, digits and _ and not 'main'",
                "write [programs.NAME] with its stages; those at the top of the file are 'main'");
            break;
        }
        const TomlTable table(root.reader, *node.as_table(), what);
        std::vector<std::string> known = {"features"};
        for (const StageNames& stage : kStages) known.emplace_back(stage.name);
        table.only(known);
        programs.push_back(read_templates(table, false));
    }
    return programs;
}

/// A stage that lies between would have to hand them on.
void refuse_varyings_across_stages(const TomlTable& root, const Family& family) {
    for (const Templates& program : family.programs)
        for (const StageNames& stage : kStages)
            if (lies_between(stage.kind) && !program[stage.kind].empty() && !family.varyings.empty())
                root.reader.error(family.varyings.front().place,
                                  fmt::format("[varyings] lead from the vertex to the fragment stage, but "
                                              "the family has a {} stage between",
                                              stage.name),
                                  "declare them as in and out variables in each stage");
}

/// Follows `extends`, once: a family that is extended stands on its own feet.
Result<FamilyText> base_of(const TomlReader& reader, const FindFamily& find_base) {
    const toml::node* extends = reader.root().get("extends");
    if (extends == nullptr || reader.failed()) return FamilyText{};
    const auto refuse = [&](std::string message, std::string help) {
        return fail(reader.place_of(*extends), {}, std::move(message), std::move(help));
    };
    if (!extends->is_string() || !find_base)
        return refuse("'extends' must name a family",
                      "name a shipped family or a .toml file: extends = \"lit\"");
    const std::string& name = extends->as_string()->get();
    Result<FamilyText> base = find_base(name);
    if (base) return base;
    const Diagnostic& error = base.error().front();
    return refuse(fmt::format("cannot extend '{}': {}", name, error.message), error.help);
}

}  // namespace

Result<Family> read_family(std::string_view text, const std::string& path, const FindFamily& find_base) {
    TomlReader reader(text, path);
    GOBO_TRY(const FamilyText base, base_of(reader, find_base));
    const TomlTable own(reader, reader.root(), "the family");
    const std::vector<std::string> without = own.strings("without");
    if (!without.empty() && base.path.empty() && !reader.failed())
        own.error("without", "leaves something out of no family", "name the family with extends = \"NAME\"");
    std::vector<std::string> unknown;
    if (!base.path.empty())
        reader.extend(base.text, base.path, {"values", "excluded", "rules", "relations"},
                      [&](toml::table& table) { unknown = leave_out(table, without); });
    Family family;
    family.path = path;
    family.extends = !base.path.empty();
    const TomlTable root(reader, reader.root(), "the family");
    std::vector<std::string> known = {
        "name",       "extends",      "without",       "programs", "version",        "prologue", "includes",
        "substitute", "unroll_loops", "compatibility", "features", "rules",          "varyings", "domain",
        "render",     "relations",    "default_set",   "renamed",  "descriptor_sets"};
    for (const StageNames& stage : kStages) known.emplace_back(stage.name);
    root.only(known);
    for (const std::string& name : unknown)
        root.error("without", fmt::format("leaves out '{}', which '{}' does not have", name, base.path),
                   "name features, varyings, uniform blocks or inputs of the extended family");
    family.name = root.required_string("name");
    if (!reader.failed() && !is_identifier(family.name))
        reader.error(root.place_of("name"), fmt::format("'{}' cannot name a family", family.name),
                     "use letters, digits and _, not starting with a digit: it names a C++ namespace");
    family.programs = read_programs(root);
    family.version = read_version(root);
    family.version_place = root.place_of("version");
    family.prologue = read_prologue(root);
    family.include_rules = read_include_rules(root);
    family.substitutions = read_substitutions(root);
    family.unrolls_loops = root.boolean("unroll_loops").value_or(false);
    family.compatibility = root.boolean("compatibility").value_or(false);
    family.features = read_features(root);
    Inherited inherited;
    if (!without.empty() && !reader.failed()) {
        TomlReader base_reader(base.text, base.path);
        inherited = inherited_without(TomlTable(base_reader, base_reader.root(), "the family"), without,
                                      family.features);
        if (base_reader.failed()) reader.take(base_reader.errors());
    }
    family.rules = std::move(inherited.rules);
    for (Rule& rule : read_rules(root, family.features)) family.rules.push_back(std::move(rule));
    family.varyings = read_varyings(root, family.features);
    refuse_varyings_across_stages(root, family);
    family.domains = read_domains(root);
    family.descriptor_sets = read_descriptor_sets(root);
    family.render = read_render_values(root, "render");
    family.relations = std::move(inherited.relations);
    for (Relation& relation : read_relations(root, family.features))
        family.relations.push_back(std::move(relation));
    family.default_selection = read_default_set(root, family);
    if (reader.failed()) return tl::unexpected(reader.errors());
    return family;
}

Result<std::vector<Domain>> read_domain_file(std::string_view text, const std::string& path) {
    TomlReader reader(text, path);
    const TomlTable root(reader, reader.root(), "the file");
    root.only({"domain"});
    std::vector<Domain> domains = read_domains(root);
    if (reader.failed()) return tl::unexpected(reader.errors());
    return domains;
}

}  // namespace gobo
