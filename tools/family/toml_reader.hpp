// Reading a TOML document strictly: every table says which names it knows, every value what it must be, and
// each error names its place. Shared by whatever gobo reads from TOML.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "core/diagnostic.hpp"

namespace gobo {

/// A document being read. The first error is kept; reads after it return defaults, so that callers need not
/// test each.
class TomlReader {
  public:
    /// Parses `text`; a syntax error is already an error of the reader.
    TomlReader(std::string_view text, std::string path);

    /// Lays this document over another one: tables merge, the arrays in `appended` grow by this document's
    /// elements, any other value of this document takes the place of the other's. Errors keep naming the
    /// document they are in.
    void extend(std::string_view base_text, std::string base_path, const std::vector<std::string>& appended);

    [[nodiscard]] const toml::table& root() const { return root_; }
    [[nodiscard]] bool failed() const { return !errors_.empty(); }
    [[nodiscard]] const Diagnostics& errors() const { return errors_; }
    [[nodiscard]] Place place_of(const toml::node& node) const { return place_of(node.source()); }

    /// Refuses names that are not in `known`, suggesting the nearest. `what` names the table in messages.
    void only(const toml::table& table, std::string_view what, const std::vector<std::string>& known);

    // Each is nothing where the name is absent, and an error where the value has another type.
    [[nodiscard]] std::optional<std::string> string(const toml::table& table, std::string_view name);
    [[nodiscard]] std::optional<std::int64_t> integer(const toml::table& table, std::string_view name);
    [[nodiscard]] std::optional<bool> boolean(const toml::table& table, std::string_view name);
    [[nodiscard]] std::vector<std::string> strings(const toml::table& table, std::string_view name);
    [[nodiscard]] std::vector<double> numbers(const toml::table& table, std::string_view name);
    [[nodiscard]] const toml::table* table(const toml::table& parent, std::string_view name);

    /// The index in `known` of the string that the table has; an error where it is none of them.
    [[nodiscard]] std::optional<std::size_t> one_of(const toml::table& table, std::string_view what,
                                                    std::string_view name,
                                                    const std::vector<std::string>& known);
    /// The tables of `[[name]]`, each being `one`.
    [[nodiscard]] std::vector<const toml::table*> tables(const toml::table& parent, std::string_view name,
                                                         std::string_view one);

    /// As string(), and an error where it is absent.
    [[nodiscard]] std::string required_string(const toml::table& table, std::string_view what,
                                              std::string_view name);
    /// Finite numbers of an array node; a single number is an array of one.
    [[nodiscard]] std::vector<double> numbers_of(const toml::node& node, std::string_view name);

    void error(const Place& place, std::string message, std::string help);
    void error(const toml::node& node, std::string message, std::string help) {
        error(place_of(node), std::move(message), std::move(help));
    }
    /// Takes over errors found elsewhere in the document, quoting its lines.
    void take(Diagnostics errors);

  private:
    [[nodiscard]] toml::table parse(std::string_view text, const std::string& path);
    [[nodiscard]] Place place_of(const toml::source_region& region) const;
    template <class T>
    [[nodiscard]] std::optional<T> value(const toml::table& table, std::string_view name,
                                         std::string_view wanted);
    void wrong_type(const toml::node& node, std::string_view name, std::string_view wanted);

    std::map<std::string, std::string_view> texts_;  ///< of the documents, by path
    std::string path_;
    toml::table root_;
    Diagnostics errors_;
};

}  // namespace gobo
