#include "scene/document.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::scene {
namespace {

using nlohmann::json;

/// "an object", "a number"; "null".
std::string kind_of(const json& value) {
    if (value.is_null()) return "null";
    return fmt::format("{} {}", value.is_structured() ? "an" : "a", value.type_name());
}

/// Line and column of a byte, both from 1.
Place place_of_byte(std::string_view text, std::size_t byte, const std::string& path) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    return {path, line, static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1};
}

/// What nlohmann::json says, without its own numbers and positions.
std::string reason_of(const std::string& what) {
    const auto parse = what.find("syntax error");
    if (parse != std::string::npos) return what.substr(parse);
    const auto bracket = what.find("] ");
    return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

}  // namespace

Document::Document(std::string_view text, std::string path) : path_(std::move(path)) {
    Diagnostic diagnostic;
    diagnostic.place.file = path_;
    try {
        root_ = json::parse(text);
        if (root_.is_object()) return;
        diagnostic.message = fmt::format("this is no glTF: its root is {}, not an object", kind_of(root_));
    } catch (const json::exception& error) {
        if (const auto* parse =
                dynamic_cast<const json::parse_error*>(&error)) {  // else a number beyond double's range
            diagnostic.place = place_of_byte(text, parse->byte == 0 ? 0 : parse->byte - 1, path_);
            const std::string_view line = line_of(text, diagnostic.place.line);
            if (line.size() <= 200) diagnostic.quoted_line = line;
        }
        diagnostic.message = fmt::format("this is no JSON: {}", reason_of(error.what()));
    }
    root_ = json::object();
    errors_.push_back(std::move(diagnostic));
}

void Document::take(Diagnostics errors) {
    if (!failed()) errors_ = std::move(errors);
}

/// Whether the value is there and of the type; an error where it is of another.
bool Value::is(bool (json::*type)() const noexcept, std::string_view wanted) const {
    if (json == nullptr) return false;
    const bool is_right = (json->*type)();
    if (!is_right) fail("must be {}, not {}", wanted, kind_of(*json));
    return is_right;
}

Value Value::operator[](std::string_view name) const {
    Value value{document, nullptr, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name)};
    if (document->failed() || !is(&json::is_object, "an object")) return value;
    if (const auto found = json->find(name); found != json->end()) value.json = &*found;
    return value;
}

Value Value::required() const {
    if (json == nullptr) fail("is missing");
    return *this;
}

void Value::keep(const std::string& message, std::string_view help) const {
    Diagnostic diagnostic;
    diagnostic.place.file = document->path();
    diagnostic.message = fmt::format("{} {}", path, message);
    diagnostic.help = help;
    document->take({std::move(diagnostic)});
}

Value Value::object() const {
    return is(&json::is_object, "an object") ? *this : Value{document, nullptr, path};
}

Value Value::gobo_extras() const {
    const Value extras = (*this)["extras"];
    return extras && extras.json->is_object() ? extras["gobo"].object() : Value{document, nullptr, path};
}

std::vector<Value> Value::elements() const {
    std::vector<Value> values;
    if (!is(&json::is_array, "an array")) return values;
    values.reserve(json->size());
    for (const auto& element : *json)
        values.push_back({document, &element, fmt::format("{}[{}]", path, values.size())});
    return values;
}

std::vector<Value> Value::objects() const {
    std::vector<Value> values = elements();
    const auto is_object = [](const Value& value) { return value.is(&json::is_object, "an object"); };
    return std::ranges::all_of(values, is_object) ? values : std::vector<Value>();
}

bool Value::read(bool& to) const {
    const bool is_read = is(&json::is_boolean, "true or false");
    if (is_read) to = json->get<bool>();
    return is_read;
}

bool Value::read(std::string& to) const {
    const bool is_read = is(&json::is_string, "a string");
    if (is_read) to = json->get<std::string>();
    return is_read;
}

bool Value::read(double& to, const Range& range) const {
    if (!is(&json::is_number, "a number")) return false;
    to = json->get<double>();
    if (to >= range.low && to <= range.high) return true;
    const std::string wanted = std::isinf(range.high)
                                   ? fmt::format("at least {:g}", range.low)
                                   : fmt::format("between {:g} and {:g}", range.low, range.high);
    fail("is {:g}, but must be {}", to, wanted);
    return false;
}

bool Value::read_numbers(double* to, std::size_t count) const {
    if (json == nullptr) return false;
    const std::vector<Value> values = elements();
    if (values.size() != count)
        fail("must hold {} numbers, not {}", count, values.size());
    else
        for (const Value& value : values) value.read(*to++);
    return !document->failed();
}

bool Value::read_color(glm::dvec3& to) const {
    const bool is_read = read(to);
    if (is_read && (to.r < 0 || to.g < 0 || to.b < 0)) fail("holds a negative number");
    return is_read;
}

std::optional<std::int64_t> Value::integer() const {
    constexpr double most = 9007199254740992.0;  // 2^53: beyond it a double holds not every whole number
    if (!is(&json::is_number, "a whole number")) return std::nullopt;
    const auto number = json->get<double>();
    if (number == std::floor(number) && std::abs(number) <= most) return static_cast<std::int64_t>(number);
    fail("must be a whole number, not {}", json->dump());
    return std::nullopt;
}

std::size_t Value::count() const {
    const std::int64_t number = required().integer().value_or(0);
    if (number < 1) fail("is {}, but must be at least 1", number);
    return static_cast<std::size_t>(number);
}

std::size_t Value::choice(const std::vector<std::string>& known, std::optional<std::size_t> otherwise) const {
    if (!otherwise) static_cast<void>(required());
    std::string text;
    if (!read(text)) return otherwise.value_or(0);
    const auto found = std::ranges::find(known, text);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    fail_with(suggestion(text, known), "is '{}', which is unknown", text);
    return 0;
}

std::optional<std::size_t> Value::index(std::size_t size, std::string_view things) const {
    const auto number = integer();
    if (!number) return std::nullopt;
    if (*number >= 0 && static_cast<std::size_t>(*number) < size) return static_cast<std::size_t>(*number);
    fail_with(size == 0 ? std::string() : fmt::format("indices run from 0 to {}", size - 1),
              "is {}, but the file has {} {}", *number, size, things);
    return std::nullopt;
}

std::vector<std::size_t> Value::indices(std::size_t size, std::string_view things) const {
    std::vector<std::size_t> result;
    for (const Value& value : elements()) {
        const auto index = value.index(size, things);
        if (!index) return {};
        result.push_back(*index);
    }
    return result;
}

void Value::only(const std::vector<std::string>& known) const {
    if (json == nullptr) return;
    for (const auto& [name, value] : json->items())
        if (std::ranges::find(known, name) == known.end())
            return (*this)[name].fail_with(suggestion(name, known), "is unknown");
}

}  // namespace gobo::scene
