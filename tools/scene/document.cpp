#include "scene/document.hpp"

#include <algorithm>
#include <cmath>

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
Place place_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + static_cast<int>(std::ranges::count(before, '\n'));
    return {"", line, static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1};
}

/// What nlohmann::json says, without its own numbers and positions.
std::string reason_of(const std::string& what) {
    const auto parse = what.find("syntax error");
    if (parse != std::string::npos) return what.substr(parse);
    const auto bracket = what.find("] ");
    return bracket == std::string::npos ? what : what.substr(bracket + 2);
}

}  // namespace

json parse_document(std::string_view text) {
    Diagnostic diagnostic;
    try {
        json root = json::parse(text);
        if (root.is_object()) return root;
        diagnostic.message = fmt::format("this is not glTF: its root is {}, not an object", kind_of(root));
    } catch (const json::exception& error) {
        if (const auto* parse =
                dynamic_cast<const json::parse_error*>(&error)) {  // else a number beyond double's range
            diagnostic.place = place_of_byte(text, parse->byte == 0 ? 0 : parse->byte - 1);
            const std::string_view line = line_of(text, diagnostic.place.line);
            if (line.size() <= 200) diagnostic.quoted_line = line;
        }
        // Of no text at all its versions speak in different words.
        const std::string reason = trim(text).empty() ? "it is empty" : reason_of(error.what());
        diagnostic.message = "this is not JSON: " + reason;
    }
    throw Diagnostics{diagnostic};
}

/// Whether the value is there; an error where it is of another type.
bool Value::is(bool (json::*type)() const noexcept, std::string_view wanted) const {
    if (json == nullptr) return false;
    if (!(json->*type)()) fail("must be {}, not {}", wanted, kind_of(*json));
    return true;
}

Value Value::operator[](std::string_view name) const {
    Value value{nullptr, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name)};
    if (!is(&json::is_object, "an object")) return value;
    if (const auto found = json->find(name); found != json->end()) value.json = &*found;
    return value;
}

Value Value::required() const {
    if (json == nullptr) fail("is missing");
    return *this;
}

void Value::throw_error(const std::string& message, std::string_view help) const {
    throw gobo::fail(Fault::input, fmt::format("{} {}", path, message), std::string(help)).value();
}

Diagnostic Value::warning(const std::string& message, std::string_view help) const {
    return {.severity = Severity::warning,
            .message = fmt::format("{} {}", path, message),
            .help = std::string(help)};
}

Value Value::object() const {
    static_cast<void>(is(&json::is_object, "an object"));
    return *this;
}

Value Value::gobo_extras() const {
    const Value extras = (*this)["extras"];
    return extras && extras.json->is_object() ? extras["gobo"].object() : Value{nullptr, path};
}

std::vector<Value> Value::elements() const {
    std::vector<Value> values;
    if (!is(&json::is_array, "an array")) return values;
    values.reserve(json->size());
    for (const auto& element : *json)
        values.push_back({&element, fmt::format("{}[{}]", path, values.size())});
    return values;
}

std::vector<Value> Value::objects() const {
    std::vector<Value> values = elements();
    for (const Value& value : values) static_cast<void>(value.object());
    return values;
}

bool Value::read(bool& to) const {
    const bool is_there = is(&json::is_boolean, "true or false");
    if (is_there) to = json->get<bool>();
    return is_there;
}

bool Value::read(std::string& to) const {
    const bool is_there = is(&json::is_string, "a string");
    if (is_there) to = json->get<std::string>();
    return is_there;
}

bool Value::read(double& to, const Range& range) const {
    if (!is(&json::is_number, "a number")) return false;
    to = json->get<double>();
    if (to >= range.low && to <= range.high) return true;
    if (std::isinf(range.high)) fail("is {:g}, but must be at least {:g}", to, range.low);
    fail("is {:g}, but must be between {:g} and {:g}", to, range.low, range.high);
}

bool Value::read_numbers(double* to, std::size_t count) const {
    const std::vector<Value> values = elements();
    if (json != nullptr && values.size() != count) fail("must hold {} numbers, not {}", count, values.size());
    for (const Value& value : values) value.read(*to++);
    return json != nullptr;
}

bool Value::read_color(glm::dvec3& to) const {
    const bool is_there = read(to);
    if (is_there && (to.r < 0 || to.g < 0 || to.b < 0)) fail("holds a negative number");
    if (is_there && std::max({to.r, to.g, to.b}) > kBrightness.high)
        fail("holds a number above {:g}", kBrightness.high);
    return is_there;
}

std::optional<std::int64_t> Value::integer() const {
    constexpr double most = 9007199254740992.0;  // 2^53: beyond it a double holds not every whole number
    if (!is(&json::is_number, "a whole number")) return std::nullopt;
    const auto number = json->get<double>();
    if (number == std::floor(number) && std::abs(number) <= most) return static_cast<std::int64_t>(number);
    fail("must be a whole number, not {}", json->dump());
}

std::size_t Value::count() const {
    const std::int64_t number = *required().integer();
    if (number < 1) fail("is {}, but must be at least 1", number);
    return static_cast<std::size_t>(number);
}

std::size_t Value::choice(const std::vector<std::string>& known, std::optional<std::size_t> otherwise) const {
    std::string text;
    if (otherwise && json == nullptr) return *otherwise;
    static_cast<void>(required().read(text));
    const auto found = std::ranges::find(known, text);
    if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
    fail_with(suggestion(text, known), "is '{}', which is unknown", text);
}

std::optional<std::size_t> Value::index(std::size_t size, std::string_view things) const {
    const auto number = integer();
    if (!number) return std::nullopt;
    if (*number >= 0 && static_cast<std::size_t>(*number) < size) return static_cast<std::size_t>(*number);
    fail_with(size == 0 ? std::string() : fmt::format("indices run from 0 to {}", size - 1),
              "is {}, but the file has {} {}", *number, size, things);
}

std::vector<std::size_t> Value::indices(std::size_t size, std::string_view things) const {
    std::vector<std::size_t> result;
    for (const Value& value : elements()) result.push_back(*value.index(size, things));
    return result;
}

void Value::only(const std::vector<std::string>& known) const {
    if (json == nullptr) return;
    for (const auto& [name, value] : json->items())
        if (std::ranges::find(known, name) == known.end())
            (*this)[name].fail_with(suggestion(name, known), "is unknown");
}

}  // namespace gobo::scene
