// Reading a TOML document strictly: every table says which names it knows, every value what it must be, and
// each error names its place. Shared by whatever gobo reads from TOML.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
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
    /// `prepare` may change the other document before.
    void extend(std::string_view base_text, std::string base_path, const std::vector<std::string>& appended,
                const std::function<void(toml::table& base)>& prepare);

    [[nodiscard]] const toml::table& root() const { return root_; }
    [[nodiscard]] bool failed() const { return !errors_.empty(); }
    [[nodiscard]] const Diagnostics& errors() const { return errors_; }
    [[nodiscard]] Place place_of(const toml::node& node) const { return place_of(node.source()); }
    [[nodiscard]] Place place_of(const toml::source_region& region) const;

    /// Where the text of a string begins: behind the quotation marks and the line end that TOML leaves out.
    /// Its line alone where the string has a backslash.
    [[nodiscard]] Place place_of_text(const toml::node& node) const;

    void error(const Place& place, std::string message, std::string help);
    void error(const toml::node& node, std::string message, std::string help) {
        error(place_of(node), std::move(message), std::move(help));
    }
    /// Takes over errors found elsewhere in the document, quoting its lines.
    void take(const Diagnostics& errors);

    /// Finite numbers of an array node; a single number is an array of one.
    [[nodiscard]] std::vector<double> numbers_of(const toml::node& node, std::string_view name);
    void wrong_type(const toml::node& node, std::string_view name, std::string_view wanted);

  private:
    [[nodiscard]] toml::table parse(std::string_view text, const std::string& path);

    [[nodiscard]] Place in_bytes(Place place) const;

    std::set<std::string> beyond_ascii_;             ///< documents with characters of several bytes, by path
    std::map<std::string, std::string_view> texts_;  ///< of the documents, by path
    std::string path_;
    toml::table root_;
    Diagnostics errors_;
};

/// A table of a document that is being read.
class TomlTable {
  public:
    /// `what` names the table in messages: "feature 'fog'".
    TomlTable(TomlReader& document, const toml::table& table, std::string what)
        : reader(document), entries(table), what_(std::move(what)) {}

    TomlReader& reader;
    const toml::table& entries;

    /// The same table, called something else in messages.
    [[nodiscard]] TomlTable called(std::string what) const { return {reader, entries, std::move(what)}; }

    [[nodiscard]] bool has(std::string_view name) const { return entries.contains(name); }
    /// The place of an entry, or of the table where it has none of that name.
    [[nodiscard]] Place place_of(std::string_view name = {}) const {
        return reader.place_of(has(name) ? *entries.get(name) : entries);
    }
    /// An error at place_of(name) whose message goes on after what the table is: "has no values".
    void error(std::string_view name, std::string_view message, std::string help) const;

    /// Refuses names that are not in `known`, suggesting the nearest.
    void only(const std::vector<std::string>& known) const;

    // Each is nothing where the name is absent, and an error where the value has another type.
    [[nodiscard]] std::optional<std::string> string(std::string_view name) const;
    [[nodiscard]] std::optional<std::int64_t> integer(std::string_view name) const;
    [[nodiscard]] std::optional<bool> boolean(std::string_view name) const;
    [[nodiscard]] std::vector<std::string> strings(std::string_view name) const;
    [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
    [[nodiscard]] std::optional<TomlTable> table(std::string_view name) const;

    /// The index in `known` of the string that the table has; an error where it is none of them.
    [[nodiscard]] std::optional<std::size_t> one_of(std::string_view name,
                                                    const std::vector<std::string>& known) const;
    /// The tables of `[[name]]`; `what` each is: "a rule".
    [[nodiscard]] std::vector<TomlTable> tables(std::string_view name, const std::string& what) const;
    /// As string(), and an error where it is absent.
    [[nodiscard]] std::string required_string(std::string_view name) const;

  private:
    template <class T>
    [[nodiscard]] std::optional<T> value(std::string_view name, std::string_view wanted) const;

    std::string what_;
};

}  // namespace gobo
