// A JSON document read strictly: each value must have the type asked for, each index must lie in its array.
// The first thing wrong ends the reading: it is thrown as Diagnostics, whose message begins with the path
// that leads to it, and read_scene() alone catches it and names the file.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/diagnostic.hpp"

namespace gobo::scene {

/// What a number must lie within.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};
inline constexpr Range kNotNegative{0};
inline constexpr Range kUpToOne{0, 1};
/// Of a light or a colour: the product of two of them is far from the largest float.
inline constexpr Range kBrightness{0, 1e12};

/// Parses a document. A syntax error, or a root that is no object, is thrown as everything else is.
[[nodiscard]] nlohmann::json parse_document(std::string_view text);

/// A value of a document and the path that leads to it: `nodes[3].mesh`. It may be absent: that is no error
/// unless it is required, and nothing is read of it. A value of another type, or out of range, is an error.
struct Value {
    const nlohmann::json* json = nullptr;  ///< null: absent
    std::string path;

    explicit operator bool() const { return json != nullptr; }
    /// A member of an object.
    [[nodiscard]] Value operator[](std::string_view name) const;
    /// The value itself; an error where it is absent.
    [[nodiscard]] Value required() const;
    /// Throws the error, and how to fix it.
    template <class... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> message, Args&&... args) const {
        throw_error(fmt::format(message, std::forward<Args>(args)...), "");
    }
    template <class... Args>
    [[noreturn]] void fail_with(std::string_view help, fmt::format_string<Args...> message,
                                Args&&... args) const {
        throw_error(fmt::format(message, std::forward<Args>(args)...), help);
    }

    /// A warning of what is read all the same, without the file's name.
    [[nodiscard]] Diagnostic warning(const std::string& message, std::string_view help) const;

    /// The value itself, if it is an object, and its `extras.gobo`. Other programs' extras may be of any
    /// type.
    [[nodiscard]] Value object() const;
    [[nodiscard]] Value gobo_extras() const;
    /// The elements of an array, and of an array of objects.
    [[nodiscard]] std::vector<Value> elements() const;
    [[nodiscard]] std::vector<Value> objects() const;

    // Each leaves `to` as it is where the value is absent. Whether it was read.
    bool read(bool& to) const;
    bool read(std::string& to) const;
    bool read(double& to, const Range& range = {}) const;
    bool read(glm::dvec3& to) const { return read_numbers(&to.x, 3); }
    template <class T, class... More>
    bool read(std::optional<T>& to, const More&... more) const {
        T value{};
        const bool is_read = read(value, more...);
        if (is_read) to = value;
        return is_read;
    }
    /// Exactly `count` numbers.
    bool read_numbers(double* to, std::size_t count) const;
    /// A colour whose parts are not negative.
    bool read_color(glm::dvec3& to) const;

    [[nodiscard]] std::optional<std::int64_t> integer() const;
    /// A required whole number above 0.
    [[nodiscard]] std::size_t count() const;
    /// The place of the value among the names listed; without a default it is required.
    [[nodiscard]] std::size_t choice(const std::vector<std::string>& known,
                                     std::optional<std::size_t> otherwise = {}) const;
    /// The index of one of `size` things; `things` is what messages call them ("meshes").
    [[nodiscard]] std::optional<std::size_t> index(std::size_t size, std::string_view things) const;
    [[nodiscard]] std::vector<std::size_t> indices(std::size_t size, std::string_view things) const;
    /// Refuses an object's members that are not in `known`, suggesting the nearest.
    void only(const std::vector<std::string>& known) const;

  private:
    [[noreturn]] void throw_error(const std::string& message, std::string_view help) const;
    [[nodiscard]] bool is(bool (nlohmann::json::*type)() const noexcept, std::string_view wanted) const;
};

}  // namespace gobo::scene
