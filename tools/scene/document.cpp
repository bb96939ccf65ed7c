#include "scene/document.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::scene {
namespace {

using nlohmann::json;

std::string_view kind_of(const json& value) {
    switch (value.type()) {
        case json::value_t::null:
            return "null";
        case json::value_t::object:
            return "an object";
        case json::value_t::array:
            return "an array";
        case json::value_t::string:
            return "a string";
        case json::value_t::boolean:
            return "a boolean";
        default:
            return "a number";
    }
}

/// Line and column of a byte, both from 1.
Place place_of_byte(std::string_view text, std::size_t byte, const std::string& path) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const auto start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return {path, line, static_cast<int>(before.size() - start) + 1};
}

/// What nlohmann::json says, without its own numbers and positions.
std::string reason_of(const std::string& what) {
    const auto parse = what.find("syntax error");
    if (parse != std::string::npos) return what.substr(parse);
    const auto bracket = what.find("] ");
    return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

}  // namespace

std::string path_to(const Value& parent, std::string_view name) {
    return parent.path.empty() ? std::string(name) : fmt::format("{}.{}", parent.path, name);
}

Document::Document(std::string_view text, std::string path) : path_(std::move(path)) {
    Diagnostic diagnostic;
    diagnostic.place.file = path_;
    try {
        root_ = json::parse(text);
        if (root_.is_object()) return;
        diagnostic.message = fmt::format("this is no glTF: its root is {}, not an object", kind_of(root_));
    } catch (const json::parse_error& error) {
        diagnostic.place = place_of_byte(text, error.byte == 0 ? 0 : error.byte - 1, path_);
        const std::string_view line = line_of(text, diagnostic.place.line);
        if (line.size() <= 200) diagnostic.quoted_line = line;
        diagnostic.message = fmt::format("this is no JSON: {}", reason_of(error.what()));
    } catch (const json::exception& error) {  // a number beyond double's range
        diagnostic.message = fmt::format("this is no JSON: {}", reason_of(error.what()));
    }
    root_ = json::object();
    errors_.push_back(std::move(diagnostic));
}

void Document::error(std::string_view place, std::string_view message, std::string help) {
    if (failed()) return;
    Diagnostic diagnostic;
    diagnostic.place.file = path_;
    diagnostic.message = place.empty() ? std::string(message) : fmt::format("{} {}", place, message);
    diagnostic.help = std::move(help);
    errors_.push_back(std::move(diagnostic));
}

void Document::take(Diagnostics errors) {
    if (!failed()) errors_ = std::move(errors);
}

void Document::wrong_type(const Value& value, std::string_view wanted) {
    error(value.path, fmt::format("must be {}, not {}", wanted, kind_of(*value.json)));
}

std::optional<Value> Document::member(const Value& parent, std::string_view name) const {
    if (failed() || !parent.json->is_object()) return std::nullopt;
    const auto found = parent.json->find(std::string(name));
    if (found == parent.json->end()) return std::nullopt;
    return Value{&*found, path_to(parent, name)};
}

std::optional<Value> Document::object(const Value& parent, std::string_view name) {
    std::optional<Value> value = member(parent, name);
    if (value && !value->json->is_object()) {
        wrong_type(*value, "an object");
        return std::nullopt;
    }
    return value;
}

std::optional<double> Document::number_of(const Value& value) {
    if (value.json->is_number()) return value.json->get<double>();
    wrong_type(value, "a number");
    return std::nullopt;
}

std::optional<std::int64_t> Document::integer_of(const Value& value) {
    constexpr double most = 9007199254740992.0;  // 2^53: beyond it a double holds not every whole number
    if (!value.json->is_number()) {
        wrong_type(value, "a whole number");
        return std::nullopt;
    }
    const auto number = value.json->get<double>();
    if (number == std::floor(number) && std::abs(number) <= most) return static_cast<std::int64_t>(number);
    error(value.path, fmt::format("must be a whole number, not {}", value.json->dump()));
    return std::nullopt;
}

std::optional<double> Document::number(const Value& parent, std::string_view name) {
    const auto value = member(parent, name);
    return value ? number_of(*value) : std::nullopt;
}

std::optional<std::int64_t> Document::integer(const Value& parent, std::string_view name) {
    const auto value = member(parent, name);
    return value ? integer_of(*value) : std::nullopt;
}

std::optional<bool> Document::boolean(const Value& parent, std::string_view name) {
    const auto value = member(parent, name);
    if (!value) return std::nullopt;
    if (value->json->is_boolean()) return value->json->get<bool>();
    wrong_type(*value, "true or false");
    return std::nullopt;
}

std::optional<std::string> Document::string(const Value& parent, std::string_view name) {
    const auto value = member(parent, name);
    if (!value) return std::nullopt;
    if (value->json->is_string()) return value->json->get<std::string>();
    wrong_type(*value, "a string");
    return std::nullopt;
}

std::vector<Value> Document::elements(const Value& parent, std::string_view name) {
    const auto array = member(parent, name);
    return array ? elements_of(*array) : std::vector<Value>();
}

std::vector<Value> Document::elements_of(const Value& array) {
    if (!array.json->is_array()) {
        wrong_type(array, "an array");
        return {};
    }
    std::vector<Value> values;
    values.reserve(array.json->size());
    for (const json& element : *array.json)
        values.push_back({&element, fmt::format("{}[{}]", array.path, values.size())});
    return values;
}

std::vector<Value> Document::objects(const Value& parent, std::string_view name) {
    std::vector<Value> values = elements(parent, name);
    for (const Value& value : values) {
        if (value.json->is_object()) continue;
        wrong_type(value, "an object");
        return {};
    }
    return values;
}

std::optional<std::vector<double>> Document::numbers(const Value& parent, std::string_view name,
                                                     std::size_t size) {
    const auto array = member(parent, name);
    return array ? numbers_of(*array, size) : std::nullopt;
}

std::optional<std::vector<double>> Document::numbers_of(const Value& array, std::size_t size) {
    const std::vector<Value> values = elements_of(array);
    if (failed()) return std::nullopt;
    if (values.size() != size) {
        error(array.path, fmt::format("must hold {} numbers, not {}", size, values.size()));
        return std::nullopt;
    }
    std::vector<double> result;
    for (const Value& value : values) result.push_back(number_of(value).value_or(0));
    if (failed()) return std::nullopt;
    return result;
}

std::optional<int> Document::index_of(const Value& value, std::size_t size, std::string_view things) {
    const auto number = integer_of(value);
    if (!number) return std::nullopt;
    if (*number >= 0 && static_cast<std::uint64_t>(*number) < size) return static_cast<int>(*number);
    error(value.path, fmt::format("is {}, but the file has {} {}", *number, size, things),
          size == 0 ? std::string() : fmt::format("indices run from 0 to {}", size - 1));
    return std::nullopt;
}

std::optional<int> Document::index(const Value& parent, std::string_view name, std::size_t size,
                                   std::string_view things) {
    const auto value = member(parent, name);
    return value ? index_of(*value, size, things) : std::nullopt;
}

std::vector<int> Document::indices(const Value& parent, std::string_view name, std::size_t size,
                                   std::string_view things) {
    std::vector<int> result;
    for (const Value& value : elements(parent, name)) {
        const auto index = index_of(value, size, things);
        if (!index) return {};
        result.push_back(*index);
    }
    return result;
}

std::int64_t Document::required_integer(const Value& parent, std::string_view name) {
    if (!member(parent, name)) error(path_to(parent, name), "is missing");
    return integer(parent, name).value_or(0);
}

double Document::required_number(const Value& parent, std::string_view name) {
    if (!member(parent, name)) error(path_to(parent, name), "is missing");
    return number(parent, name).value_or(0);
}

int Document::required_index(const Value& parent, std::string_view name, std::size_t size,
                             std::string_view things) {
    if (!member(parent, name)) error(path_to(parent, name), "is missing");
    return index(parent, name, size, things).value_or(0);
}

std::optional<double> Document::number_within(const Value& parent, std::string_view name, double low,
                                              double high) {
    const auto value = number(parent, name);
    if (!value || (*value >= low && *value <= high)) return value;
    const std::string wanted = std::isinf(high) ? fmt::format("at least {:g}", low)
                                                : fmt::format("between {:g} and {:g}", low, high);
    error(path_to(parent, name), fmt::format("is {:g}, but must be {}", *value, wanted));
    return std::nullopt;
}

std::optional<std::string> Document::choice(const Value& parent, std::string_view name,
                                            const std::vector<std::string>& known) {
    auto value = string(parent, name);
    if (!value || std::find(known.begin(), known.end(), *value) != known.end()) return value;
    error(path_to(parent, name), fmt::format("is '{}', which is unknown", *value), suggestion(*value, known));
    return std::nullopt;
}

void Document::only(const Value& object, const std::vector<std::string>& known) {
    for (const auto& [name, value] : object.json->items()) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        error(path_to(object, name), "is unknown", suggestion(name, known));
    }
}

}  // namespace gobo::scene
