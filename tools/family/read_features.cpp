#include "family/read_features.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/render_sources.hpp"

namespace gobo {
namespace {

/// A count above this would make shaders no driver takes; it also bounds what a hostile file can ask for.
constexpr std::int64_t kLargestCount = 4096;

constexpr const char* kMainProgram = "main";

/// Keys hold indices, and everywhere index 0 is the default: where the family names another than the first
/// value, that one moves to the front.
void put_default_first(const TomlTable& table, Feature& feature) {
    const std::optional<std::string> name = table.string("default");
    if (!name) return;
    const std::optional<int> index = feature.index_of(*name);
    if (!index)
        return table.error("default", fmt::format("has no value '{}' to default to", *name),
                           suggestion(*name, feature.values));
    feature.default_place = *index;
    const auto first = feature.values.begin();
    std::rotate(first, first + *index, first + *index + 1);
}

void read_choice(const TomlTable& table, Feature& feature) {
    feature.values = table.strings("values");
    feature.excluded = table.strings("excluded");
    if (feature.values.empty())
        table.error("values", "has no values", "list at least one; the first is the default");
    std::set<std::string> seen;
    for (const std::string& value : feature.values) {
        if (value.empty() || !std::ranges::all_of(value, is_identifier_part))
            table.error("values", fmt::format("cannot have the value '{}'", value),
                        "use letters, digits and _: it names a file and a C++ enumerator");
        if (!seen.insert(value).second)
            table.error("values", fmt::format("has the value '{}' twice", value), "list it once");
    }
    put_default_first(table, feature);
    // Generated headers hold enums and uniform blocks side by side: where a block has a feature's name
    // already, the family names the enum otherwise.
    feature.enum_name = table.string("enum").value_or("");
    if (table.has("enum") && !is_identifier(feature.enum_name))
        table.error("enum", fmt::format("has '{}' for an enum", feature.enum_name),
                    "name it as C++ names a type, such as FogKind");
    for (const std::string& value : feature.excluded) {
        const auto index = feature.index_of(value);
        if (index.value_or(0) > 0) continue;
        table.error("excluded", fmt::format("cannot exclude '{}'", value),
                    index ? "the default cannot be excluded" : feature.help_for(value));
    }
}

void read_count(const TomlTable& table, Feature& feature) {
    feature.kind = FeatureKind::count;
    const toml::array* range = table.entries["count"].as_array();
    const auto bound = [&](std::size_t i) {
        const auto* number = range == nullptr || range->size() != 2 ? nullptr : (*range)[i].as_integer();
        return number == nullptr ? -1 : number->get();
    };
    if (bound(0) < 0 || bound(1) < bound(0) || bound(1) > kLargestCount)
        return table.error(
            "count", "has no valid count",
            fmt::format("write count = [LEAST, MOST], whole numbers from 0 to {}, MOST not below LEAST",
                        kLargestCount));
    feature.lowest = static_cast<int>(bound(0));
    for (std::int64_t i = bound(0); i <= bound(1); ++i) feature.values.push_back(std::to_string(i));
}

/// `text = "0.5"` of a define that is on; `text = { hard = "0.5", off = false }` by value, where `false`
/// leaves the macro undefined.
void read_texts(const TomlTable& table, Feature& feature) {
    const auto add = [&](const std::string& value, const toml::node& node) {
        if (!feature.index_of(value))
            return table.error("text", fmt::format("has no value '{}'", value), feature.help_for(value));
        const auto* text = node.as_string();
        const auto* flag = node.as_boolean();
        if (text == nullptr && (flag == nullptr || flag->get()))
            return table.reader.error(node, fmt::format("the text of '{}' must be a string or false", value),
                                      "write the text of the macro, or false to leave it undefined");
        if (text != nullptr && !is_macro_text(text->get()))
            return table.reader.error(node, fmt::format("the text of '{}' is no macro's", value),
                                      "write it on one line, without comments and backslashes");
        feature.texts[value] = text == nullptr ? std::nullopt : std::optional(std::string(trim(text->get())));
    };
    const toml::node* node = table.entries.get("text");
    if (node == nullptr || table.reader.failed()) return;
    if (node->is_table())
        for (const auto& [value, text] : *node->as_table()) add(std::string(value.str()), text);
    else if (feature.kind == FeatureKind::define)
        add("on", *node);
    else
        table.error("text", "has one text for all values", "write text = { VALUE = \"TEXT\" }");
}

/// The macro of a feature, and its texts, or what stands for it in the shaders.
void read_macro(const TomlTable& table, Feature& feature) {
    const std::string_view entry = feature.kind == FeatureKind::count ? "constant" : "define";
    const bool is_macro = feature.kind == FeatureKind::count && !table.has("substitute");
    feature.macro = is_macro ? table.required_string(entry) : table.string(entry).value_or("");
    feature.substituted = table.string("substitute").value_or("");
    if ((table.has(entry) || is_macro) && !is_identifier(feature.macro))
        table.error({}, fmt::format("has '{}' for a macro", feature.macro), "a macro is an identifier");
    constexpr std::array<std::string_view, 4> own = {"defined", "__LINE__", "__FILE__", "__VERSION__"};
    if (std::ranges::count(own, feature.macro) > 0 || feature.macro.starts_with("gl_"))
        table.error(entry, fmt::format("has '{}' for a macro, which GLSL keeps for itself", feature.macro),
                    feature.macro.starts_with("gl_") ? "no #define can replace it: use [substitute]"
                                                     : "choose another name");
    if (table.has("substitute") && !is_substituted(feature.substituted))
        table.error("substitute", fmt::format("cannot replace '{}'", feature.substituted),
                    "write a name, best with a sign that GLSL has no use for: \"@name@\" or \"$name\"");
    feature.stages = table.strings("stages");
    std::vector<std::string> known;
    for (const StageNames& stage : kStages) known.emplace_back(stage.name);
    for (const std::string& stage : feature.stages)
        if (std::ranges::count(known, stage) == 0)
            table.error("stages", fmt::format("names an unknown stage '{}'", stage),
                        suggestion(stage, known));
    if (!feature.macro.empty() || !feature.substituted.empty()) return read_texts(table, feature);
    for (const char* name : {"text", "stages"})
        if (table.has(name))
            table.error(name, fmt::format("has {}, but no macro", name), "add define = \"MACRO\"");
}

Feature read_feature(TomlReader& reader, std::string name, const toml::node& node) {
    Feature feature;
    feature.name = std::move(name);
    feature.place = reader.place_of(node);
    const std::string what = fmt::format("feature '{}'", feature.name);
    if (!node.is_table() || !is_identifier(feature.name)) {
        reader.error(node, what + " must be an identifier with a table",
                     "write [features.NAME] with values, count or define");
        return feature;
    }
    const TomlTable table(reader, *node.as_table(), what);
    if (table.has("retired")) table.error("retired", "has retired values", "'retired' is now 'excluded'");
    table.only({"role", "values", "default", "excluded", "enum", "count", "constant", "define", "text",
                "substitute", "stages", "specialize"});
    constexpr std::array roles = {Role::effect, Role::quality, Role::pipeline};
    feature.role = roles[table.one_of("role", {"effect", "quality", "pipeline"}).value_or(0)];
    const bool is_choice = table.has("values"), is_count = table.has("count");
    const bool is_define = !is_choice && (table.has("define") || (table.has("substitute") && !is_count));
    if (table.has("default") && !is_choice)
        table.error("default", "cannot name its default",
                    "only a choice can: a count's is its least, a define's is off");
    if (table.has("enum") && !is_choice)
        table.error("enum", "cannot name an enum",
                    "only a choice has one: a count is an int, a define a bool");
    if (is_choice + is_count + is_define != 1) {
        table.error({}, "must be one of a choice, a count and a define",
                    "give it exactly one of values, count and define");
    } else if (is_choice) {
        read_choice(table, feature);
    } else if (is_count) {
        read_count(table, feature);
    } else {
        feature.kind = FeatureKind::define;
        feature.values = {"off", "on"};
    }
    read_macro(table, feature);
    feature.is_specialized = table.boolean("specialize").value_or(false);
    if (feature.is_specialized && (!is_count || feature.macro.empty() || table.has("text")))
        table.error("specialize", "cannot be specialised",
                    "only a count with a constant can: the constant becomes Vulkan's");
    return feature;
}

/// `old = "new"` for a feature, `"feature=old" = "feature=new"` for a value. Features stand before their
/// values in the table, as it is sorted.
void read_renamed(const TomlTable& root, std::vector<Feature>& features) {
    const auto table = root.table("renamed");
    if (!table || root.reader.failed()) return;
    const auto halves = [](std::string_view text) {
        const auto equals = std::min(text.find('='), text.size());
        return std::pair(text.substr(0, equals), text.substr(equals));
    };
    for (const auto& [key, node] : table->entries) {
        const std::string was(key.str()), now = table->string(was).value_or("");
        const auto [old_name, old_value] = halves(was);
        const auto [new_name, new_value] = halves(now);
        const auto index = index_of(features, new_name);
        Feature* feature = index ? &features[*index] : nullptr;
        if (feature != nullptr && old_value.empty() && new_value.empty() && !index_of(features, old_name)) {
            feature->old_names.emplace_back(old_name);
        } else if (feature != nullptr && old_value.size() > 1 && new_value.size() > 1 &&
                   (old_name == feature->name || std::ranges::count(feature->old_names, old_name) > 0) &&
                   feature->index_of(new_value.substr(1)) && !feature->index_of(old_value.substr(1))) {
            feature->old_values.emplace(old_value.substr(1), new_value.substr(1));
        } else {
            root.reader.error(node, fmt::format("'{}' cannot have been renamed to '{}'", was, now),
                              "write OLD = \"FEATURE\" or \"FEATURE=OLD\" = \"FEATURE=VALUE\", of which "
                              "only the new one exists");
        }
    }
}

/// The choice between the templates at the top of the file, called `main`, and those of [programs].
void add_program_feature(const TomlTable& programs, std::vector<Feature>& features) {
    Feature feature;
    feature.name = kProgramFeature;
    feature.role = Role::pipeline;
    feature.place = programs.place_of();
    feature.values = {kMainProgram};
    for (const auto& [key, node] : programs.entries) feature.values.emplace_back(key.str());
    const auto before = std::ranges::lower_bound(features, feature.name, {}, &Feature::name);
    if (before != features.end() && before->name == feature.name)
        return programs.reader.error(before->place, "the feature 'program' chooses between [programs]",
                                     "give this feature another name");
    features.insert(before, std::move(feature));
}

}  // namespace

bool is_substituted(std::string_view text) {
    return std::ranges::all_of(text, [](char c) { return c > ' ' && c != '\x7f'; }) &&
           text.find_first_of("#\"\\/") == std::string_view::npos &&
           std::ranges::any_of(text, is_identifier_part);
}

bool is_macro_text(std::string_view text) {
    constexpr std::string_view ends = {"\n\r\\\0", 4};
    return text.find_first_of(ends) == std::string_view::npos && text.find("//") == std::string_view::npos &&
           text.find("/*") == std::string_view::npos;
}

int read_feature_name(const TomlTable& table, std::string_view entry, const std::string& name,
                      const std::vector<Feature>& features) {
    if (const auto index = index_of(features, name)) return *index;
    table.error(entry, fmt::format("names an unknown feature '{}'", name), help_for(features, name));
    return 0;
}

std::vector<RenderValue> read_render_values(const TomlTable& table, std::string_view entry) {
    std::vector<RenderValue> values;
    const auto named = table.table(entry);
    if (!named) return values;
    for (const auto& [key, node] : named->entries) {
        RenderValue value;
        value.name = key.str();
        value.place = table.reader.place_of(node);
        if (const auto* source = node.as_string()) {
            value.source = source->get();
        } else if (node.is_table()) {
            const TomlTable row(table.reader, *node.as_table(),
                                fmt::format("the render value of '{}'", value.name));
            row.only({"source", "numbers"});
            value.source = row.required_string("source");
            value.numbers = row.numbers("numbers");
        } else {
            value.numbers = table.reader.numbers_of(node, value.name);
        }
        if (!value.source.empty() && !is_render_source(value.source))
            table.reader.error(node, fmt::format("unknown source '{}' for '{}'", value.source, value.name),
                               suggestion(value.source, {kRenderSources.begin(), kRenderSources.end()}));
        values.push_back(std::move(value));
    }
    return values;
}

std::vector<Feature> read_features(const TomlTable& root) {
    std::vector<Feature> features;  // TOML tables come sorted by name
    if (const auto table = root.table("features"))
        for (const auto& [key, node] : table->entries)
            features.push_back(read_feature(root.reader, std::string(key.str()), node));
    if (const auto programs = root.table("programs")) add_program_feature(*programs, features);
    std::set<std::string> macros;
    for (const Feature& feature : features)
        for (const std::string& macro : {feature.macro, feature.substituted})
            if (!macro.empty() && !macros.insert(macro).second)
                root.reader.error(feature.place,
                                  fmt::format("feature '{}' shares the macro '{}' with another feature",
                                              feature.name, macro),
                                  "give each count and define a macro of its own");
    read_renamed(root, features);
    return features;
}

}  // namespace gobo
