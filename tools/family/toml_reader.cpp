#include "family/toml_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {

namespace {

/// Moves everything of `over` into `base`. Nodes are moved, not copied: a copy forgets its place in the
/// document.
void merge_into(toml::table& base, toml::table& over, const std::vector<std::string>& appended) {
    for (auto&& [key, node] : over) {
        toml::node* present = base.get(key);
        const bool grows = std::find(appended.begin(), appended.end(), key.str()) != appended.end();
        if (present != nullptr && present->is_table() && node.is_table()) {
            merge_into(*present->as_table(), *node.as_table(), appended);
        } else if (present != nullptr && grows && present->is_array() && node.is_array()) {
            for (toml::node& element : *node.as_array()) {
                element.visit([&](auto& value) { present->as_array()->push_back(std::move(value)); });
            }
        } else {
            node.visit([&](auto& value) { base.insert_or_assign(key, std::move(value)); });
        }
    }
}

}  // namespace

TomlReader::TomlReader(std::string_view text, std::string path) : path_(std::move(path)) {
    root_ = parse(text, path_);
}

toml::table TomlReader::parse(std::string_view text, const std::string& path) {
    texts_[path] = text;
    try {  // the packaged library reports by exceptions only; they end here
        return toml::parse(text, path);
    } catch (const toml::parse_error& failure) {
        const toml::source_position at = failure.source().begin;
        error(Place{path, static_cast<int>(at.line), static_cast<int>(at.column)},
              fmt::format("not valid TOML: {}", failure.description()), "see https://toml.io for the syntax");
        return {};
    }
}

void TomlReader::extend(std::string_view base_text, std::string base_path,
                        const std::vector<std::string>& appended) {
    toml::table base = parse(base_text, base_path);
    merge_into(base, root_, appended);
    root_ = std::move(base);
}

Place TomlReader::place_of(const toml::source_region& region) const {
    return {region.path ? *region.path : path_, static_cast<int>(region.begin.line),
            static_cast<int>(region.begin.column)};
}

void TomlReader::error(const Place& place, std::string message, std::string help) {
    if (failed()) return;
    Diagnostic diagnostic;
    diagnostic.place = place;
    diagnostic.message = std::move(message);
    const auto text = texts_.find(place.file);
    if (text != texts_.end()) diagnostic.quoted_line = line_of(text->second, place.line);
    diagnostic.help = std::move(help);
    errors_.push_back(std::move(diagnostic));
}

void TomlReader::take(Diagnostics errors) {
    for (Diagnostic& diagnostic : errors)
        error(diagnostic.place, std::move(diagnostic.message), std::move(diagnostic.help));
}

void TomlReader::only(const toml::table& table, std::string_view what,
                      const std::vector<std::string>& known) {
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        error(place_of(key.source()), fmt::format("unknown name '{}' in {}", name, what),
              suggestion(name, known));
    }
}

void TomlReader::wrong_type(const toml::node& node, std::string_view name, std::string_view wanted) {
    error(node, fmt::format("'{}' must be {}", name, wanted), fmt::format("write {} = ...", name));
}

template <class T>
std::optional<T> TomlReader::value(const toml::table& table, std::string_view name, std::string_view wanted) {
    const toml::node* node = table.get(name);
    if (node == nullptr) return std::nullopt;
    if (const auto* found = node->as<T>()) return found->get();
    wrong_type(*node, name, wanted);
    return std::nullopt;
}

std::optional<std::string> TomlReader::string(const toml::table& table, std::string_view name) {
    return value<std::string>(table, name, "a string");
}

std::optional<std::int64_t> TomlReader::integer(const toml::table& table, std::string_view name) {
    return value<std::int64_t>(table, name, "a whole number");
}

std::optional<bool> TomlReader::boolean(const toml::table& table, std::string_view name) {
    return value<bool>(table, name, "true or false");
}

std::optional<std::size_t> TomlReader::one_of(const toml::table& table, std::string_view what,
                                              std::string_view name, const std::vector<std::string>& known) {
    const std::optional<std::string> text = string(table, name);
    if (!text) return std::nullopt;
    const auto found = std::find(known.begin(), known.end(), *text);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    error(*table.get(name), fmt::format("{} has no {} '{}'", what, name, *text), suggestion(*text, known));
    return std::nullopt;
}

std::vector<std::string> TomlReader::strings(const toml::table& table, std::string_view name) {
    const toml::node* node = table.get(name);
    if (node == nullptr) return {};
    std::vector<std::string> values;
    const auto add = [&](const toml::node& element) {
        const auto* text = element.as_string();
        if (text == nullptr) return wrong_type(element, name, "an array of strings");
        values.push_back(text->get());
    };
    if (const toml::array* array = node->as_array())
        for (const toml::node& element : *array) add(element);
    else
        wrong_type(*node, name, "an array of strings");
    return values;
}

std::vector<double> TomlReader::numbers(const toml::table& table, std::string_view name) {
    const toml::node* node = table.get(name);
    return node == nullptr ? std::vector<double>{} : numbers_of(*node, name);
}

std::vector<double> TomlReader::numbers_of(const toml::node& node, std::string_view name) {
    std::vector<double> values;
    const auto add = [&](const toml::node& element) {
        const std::optional<double> value = element.value<double>();
        if (!element.is_number() || !value || !std::isfinite(*value))
            return wrong_type(element, name, "finite numbers");
        values.push_back(*value);
    };
    if (const toml::array* array = node.as_array())
        for (const toml::node& element : *array) add(element);
    else
        add(node);
    return values;
}

const toml::table* TomlReader::table(const toml::table& parent, std::string_view name) {
    const toml::node* node = parent.get(name);
    if (node != nullptr && !node->is_table()) wrong_type(*node, name, "a table");
    return node == nullptr ? nullptr : node->as_table();
}

std::vector<const toml::table*> TomlReader::tables(const toml::table& parent, std::string_view name,
                                                   std::string_view one) {
    std::vector<const toml::table*> found;
    const toml::node* node = parent.get(name);
    if (node == nullptr || failed()) return found;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
        error(*node, fmt::format("'{}' must be an array of tables", name),
              fmt::format("write each {} under [[{}]]", one, name));
        return found;
    }
    for (const toml::node& element : *array) found.push_back(element.as_table());
    return found;
}

std::string TomlReader::required_string(const toml::table& table, std::string_view what,
                                        std::string_view name) {
    if (!table.contains(name))
        error(table, fmt::format("{} lacks '{}'", what, name), fmt::format("add {} = \"...\"", name));
    return string(table, name).value_or("");
}

}  // namespace gobo
