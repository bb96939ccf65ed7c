// A JSON document read strictly: each value must have the type asked for, each index must lie in its array,
// and the first thing wrong is said with the path that leads to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/diagnostic.hpp"

namespace gobo::scene {

/// A value of a document and the path that leads to it: `nodes[3].mesh`.
struct Value {
    const nlohmann::json* json = nullptr;
    std::string path;
};

/// A document being read. The first error is kept; reads after it return nothing, so that callers need not
/// test each.
class Document {
  public:
    /// Parses `text`; a syntax error, or a root that is no object, is already an error of the document.
    /// `path` stands in diagnostics.
    Document(std::string_view text, std::string path);
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    [[nodiscard]] Value root() const { return {&root_, {}}; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] bool failed() const { return !errors_.empty(); }
    [[nodiscard]] const Diagnostics& errors() const { return errors_; }

    // Each is nothing where the name is absent, and an error where the value has another type.
    [[nodiscard]] std::optional<Value> object(const Value& parent, std::string_view name);
    [[nodiscard]] std::optional<double> number(const Value& parent, std::string_view name);
    [[nodiscard]] std::optional<std::int64_t> integer(const Value& parent, std::string_view name);
    [[nodiscard]] std::optional<bool> boolean(const Value& parent, std::string_view name);
    [[nodiscard]] std::optional<std::string> string(const Value& parent, std::string_view name);
    /// Exactly `size` numbers.
    [[nodiscard]] std::optional<std::vector<double>> numbers(const Value& parent, std::string_view name,
                                                             std::size_t size);
    [[nodiscard]] std::optional<std::vector<double>> numbers_of(const Value& array, std::size_t size);
    /// The elements of an array of objects; empty where it is absent.
    [[nodiscard]] std::vector<Value> objects(const Value& parent, std::string_view name);
    [[nodiscard]] std::vector<Value> elements(const Value& parent, std::string_view name);
    /// The index of one of `size` things; `things` is what messages call them ("meshes").
    [[nodiscard]] std::optional<int> index(const Value& parent, std::string_view name, std::size_t size,
                                           std::string_view things);
    [[nodiscard]] std::vector<int> indices(const Value& parent, std::string_view name, std::size_t size,
                                           std::string_view things);

    /// As above, and an error where the name is absent.
    [[nodiscard]] std::int64_t required_integer(const Value& parent, std::string_view name);
    [[nodiscard]] double required_number(const Value& parent, std::string_view name);
    [[nodiscard]] int required_index(const Value& parent, std::string_view name, std::size_t size,
                                     std::string_view things);
    /// A number within [low, high].
    [[nodiscard]] std::optional<double> number_within(const Value& parent, std::string_view name, double low,
                                                      double high);
    /// One of the names listed.
    [[nodiscard]] std::optional<std::string> choice(const Value& parent, std::string_view name,
                                                    const std::vector<std::string>& known);
    /// Refuses members that are not in `known`, suggesting the nearest.
    void only(const Value& object, const std::vector<std::string>& known);

    /// Keeps the error unless there is one already. `place` is the path of what is wrong, and begins the
    /// message.
    void error(std::string_view place, std::string_view message, std::string help = {});
    void take(Diagnostics errors);

  private:
    [[nodiscard]] std::optional<Value> member(const Value& parent, std::string_view name) const;
    void wrong_type(const Value& value, std::string_view wanted);
    [[nodiscard]] std::vector<Value> elements_of(const Value& array);
    [[nodiscard]] std::optional<double> number_of(const Value& value);
    [[nodiscard]] std::optional<std::int64_t> integer_of(const Value& value);
    [[nodiscard]] std::optional<int> index_of(const Value& value, std::size_t size, std::string_view things);

    std::string path_;
    nlohmann::json root_;
    Diagnostics errors_;
};

/// `parent.name`, or `name` at the root.
[[nodiscard]] std::string path_to(const Value& parent, std::string_view name);

}  // namespace gobo::scene
