#include "family/toml_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/text.hpp"
#include "core/toml_depth.hpp"
#include "core/toml_repeats.hpp"

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
            node.visit([&, at = key](auto& value) { base.insert_or_assign(at, std::move(value)); });
        }
    }
}

}  // namespace

TomlReader::TomlReader(std::string_view text, std::string path) : path_(std::move(path)) {
    root_ = parse(text, path_);
}

toml::table TomlReader::parse(std::string_view text, const std::string& path) {
    texts_[path] = text;
    if (std::ranges::any_of(text, [](char byte) { return static_cast<unsigned char>(byte) >= 0x80; }))
        beyond_ascii_.insert(path);
    if (const int line = line_of_overlong_key(text); line > 0) {
        error(Place{path, line, 0}, fmt::format("a key has more than {} parts", kMostKeyParts),
              "nest fewer tables");
        return {};
    }
    try {  // the packaged library reports by exceptions only; they end here
        return toml::parse(text, path);
    } catch (const toml::parse_error& failure) {
        const toml::source_position at = failure.source().begin;
        const Place place = in_bytes({path, static_cast<int>(at.line), static_cast<int>(at.column)});
        if (const auto repeated = repeated_key(failure.description(), text, at.line, place.column))
            error(place, *repeated, "keep one of them");
        else
            error(place, fmt::format("not valid TOML: {}", failure.description()),
                  "see https://toml.io for the syntax");
        return {};
    }
}

void TomlReader::extend(std::string_view base_text, std::string base_path,
                        const std::vector<std::string>& appended,
                        const std::function<void(toml::table& base)>& prepare) {
    toml::table base = parse(base_text, base_path);
    if (const toml::node* extends = root_.get("extends"); extends != nullptr && base.contains("extends")) {
        const bool is_itself = base_path == path_;
        return error(*extends,
                     is_itself ? "a family cannot extend itself"
                               : fmt::format("cannot extend '{}': it extends a family itself", base_path),
                     is_itself ? "name another, or leave 'extends' out"
                               : "extend the family that it extends, and state here what it adds");
    }
    prepare(base);
    merge_into(base, root_, appended);
    root_ = std::move(base);
}

Place TomlReader::place_of(const toml::source_region& region) const {
    return in_bytes({region.path ? *region.path : path_, static_cast<int>(region.begin.line),
                     static_cast<int>(region.begin.column)});
}

/// The library counts columns in characters.
Place TomlReader::in_bytes(Place place) const {
    if (!beyond_ascii_.contains(place.file)) return place;
    const std::string_view line = line_of(texts_.at(place.file), place.line);
    int left = place.column;
    std::size_t bytes = 0;
    for (; left > 1 && bytes < line.size(); --left)
        for (++bytes; bytes < line.size() && (static_cast<unsigned char>(line[bytes]) & 0xC0) == 0x80;)
            ++bytes;
    place.column = static_cast<int>(bytes) + left;
    return place;
}

Place TomlReader::place_of_text(const toml::node& node) const {
    Place place = place_of(node);
    const auto text = texts_.find(place.file);
    if (text == texts_.end() || place.column < 1) return place;
    std::string_view line = line_of(text->second, place.line);
    line.remove_prefix(std::min(line.size(), static_cast<std::size_t>(place.column - 1)));
    const bool is_block = line.starts_with(R"(""")") || line.starts_with("'''");
    const auto has_escapes = [&] {
        const auto last = static_cast<int>(node.source().end.line);
        for (int number = place.line; number <= last; ++number)
            if (line_of(text->second, number).find('\\') != std::string_view::npos) return true;
        return false;
    };
    if (line.starts_with('"') && has_escapes()) return {place.file, place.line, 0};
    if (is_block && line.size() == 3) return {place.file, place.line + 1, 1};
    place.column += is_block ? 3 : 1;
    return place;
}

void TomlReader::error(const Place& place, std::string message, std::string help) {
    if (failed()) return;
    const auto text = texts_.find(place.file);
    const std::string_view line = text == texts_.end() ? "" : line_of(text->second, place.line);
    errors_ = fail(place, line, std::move(message), std::move(help)).value();
}

void TomlReader::take(const Diagnostics& errors) {
    error(errors.front().place, errors.front().message, errors.front().help);
}

void TomlReader::wrong_type(const toml::node& node, std::string_view name, std::string_view wanted) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> examples = {
        {{"a string", "\"...\""},
         {"an array of strings", "[\"...\", \"...\"]"},
         {"a whole number", "2"},
         {"finite numbers", "0.5, or [0, 1]"}}};
    const auto example =
        std::ranges::find(examples, wanted, &std::pair<std::string_view, std::string_view>::first);
    error(node, fmt::format("'{}' must be {}", name, wanted),
          wanted == "a table"         ? fmt::format("write [{}], and what belongs to it below", name)
          : example == examples.end() ? fmt::format("write {} = {}", name, wanted)
                                      : fmt::format("write {} = {}", name, example->second));
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

void TomlTable::error(std::string_view name, std::string_view message, std::string help) const {
    reader.error(place_of(name), fmt::format("{} {}", what_, message), std::move(help));
}

void TomlTable::only(const std::vector<std::string>& known) const {
    for (const auto& [key, node] : entries)
        if (std::ranges::count(known, key.str()) == 0)
            reader.error(reader.place_of(key.source()),
                         fmt::format("unknown name '{}' in {}", key.str(), what_),
                         suggestion(key.str(), known));
}

template <class T>
std::optional<T> TomlTable::value(std::string_view name, std::string_view wanted) const {
    const toml::node* node = entries.get(name);
    if (node == nullptr) return std::nullopt;
    if (const auto* found = node->as<T>()) return found->get();
    reader.wrong_type(*node, name, wanted);
    return std::nullopt;
}

std::optional<std::string> TomlTable::string(std::string_view name) const {
    return value<std::string>(name, "a string");
}

std::optional<std::int64_t> TomlTable::integer(std::string_view name) const {
    return value<std::int64_t>(name, "a whole number");
}

std::optional<bool> TomlTable::boolean(std::string_view name) const {
    return value<bool>(name, "true or false");
}

std::optional<std::size_t> TomlTable::one_of(std::string_view name,
                                             const std::vector<std::string>& known) const {
    const std::optional<std::string> text = string(name);
    if (!text) return std::nullopt;
    const auto found = std::ranges::find(known, *text);
    if (found != known.end()) return found - known.begin();
    error(name, fmt::format("has no {} '{}'", name, *text), suggestion(*text, known));
    return std::nullopt;
}

std::vector<std::string> TomlTable::strings(std::string_view name) const {
    std::vector<std::string> values;
    const toml::node* node = entries.get(name);
    if (node == nullptr) return values;
    constexpr const char* wanted = "an array of strings";
    if (!node->is_array()) {
        reader.wrong_type(*node, name, wanted);
        return values;
    }
    for (const toml::node& element : *node->as_array()) {
        if (!element.is_string()) reader.wrong_type(element, name, wanted);
        values.push_back(element.value_or(""));
    }
    return values;
}

std::vector<double> TomlTable::numbers(std::string_view name) const {
    return has(name) ? reader.numbers_of(*entries.get(name), name) : std::vector<double>();
}

std::optional<TomlTable> TomlTable::table(std::string_view name) const {
    const toml::node* node = entries.get(name);
    if (node == nullptr) return std::nullopt;
    if (const toml::table* found = node->as_table())
        return TomlTable(reader, *found, fmt::format("[{}]", name));
    reader.wrong_type(*node, name, "a table");
    return std::nullopt;
}

std::vector<TomlTable> TomlTable::tables(std::string_view name, const std::string& what) const {
    std::vector<TomlTable> found;
    const toml::node* node = entries.get(name);
    if (node == nullptr || reader.failed()) return found;
    const toml::array* array = node->as_array();
    if (array != nullptr && array->is_homogeneous(toml::node_type::table))
        for (const toml::node& element : *array) found.emplace_back(reader, *element.as_table(), what);
    else
        reader.error(*node, fmt::format("'{}' must be an array of tables", name),
                     fmt::format("write each {} under [[{}]]", what.substr(what.find(' ') + 1), name));
    return found;
}

std::string TomlTable::required_string(std::string_view name) const {
    if (!has(name)) error({}, fmt::format("lacks '{}'", name), fmt::format("add {} = \"...\"", name));
    return string(name).value_or("");
}

}  // namespace gobo
