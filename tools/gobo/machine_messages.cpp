#include "gobo/machine_messages.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

struct Kind {
    const char* name;
    const char* meaning;
};
/// By Fault.
constexpr std::array<Kind, 5> kFaults = {{{"input", "The input has errors, or a check failed"},
                                          {"usage", "An unknown command, option, family, feature or value"},
                                          {"file", "A file could not be read or written"},
                                          {"needs_lab", "Only gobo-lab can go on, and it is not installed"},
                                          {"internal", "A bug in gobo"}}};
/// By Severity.
constexpr std::array kSeverities = {"error", "warning", "note"};

template <class Enum>
std::size_t index_of(Enum value) {
    return static_cast<std::size_t>(value);
}

/// Of the byte at `place.column`, the character of the quoted line, counted from 1; the byte where the line
/// is unknown, 0 where the column is.
int column_in_characters(const Diagnostic& diagnostic) {
    const int column = diagnostic.place.column;
    const auto before = static_cast<std::size_t>(std::max(column - 1, 0));
    if (column <= 0 || before > diagnostic.quoted_line.size()) return std::max(column, 0);
    return 1 + static_cast<int>(std::count_if(
                   diagnostic.quoted_line.begin(),
                   diagnostic.quoted_line.begin() + static_cast<std::ptrdiff_t>(before),
                   [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }));
}

/// A path as a reference of a URI: what is no letter, digit or one of "-._~/" is escaped.
std::string uri_of(std::string_view path) {
    constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    std::string uri = path.starts_with('/') ? "file://" : "";
    for (const char byte : path)
        uri += kPlain.find(byte) != std::string_view::npos
                   ? std::string(1, byte)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(byte));
    return uri;
}

/// Bytes that are no UTF-8 are replaced.
std::string text_of(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json location_of(const Diagnostic& diagnostic) {
    Json physical = {{"artifactLocation", {{"uri", uri_of(diagnostic.place.file)}}}};
    if (diagnostic.place.line > 0) {
        Json& region = physical["region"];
        region["startLine"] = diagnostic.place.line;
        if (const int column = column_in_characters(diagnostic); column > 0) region["startColumn"] = column;
        if (!diagnostic.quoted_line.empty()) region["snippet"] = {{"text", diagnostic.quoted_line}};
    }
    return {{"physicalLocation", std::move(physical)}};
}

Json result_of(const Diagnostic& diagnostic) {
    std::string text = diagnostic.message;
    if (!diagnostic.subject.empty()) text += fmt::format(" [{}]", subject_text(diagnostic));
    if (!diagnostic.help.empty()) text += fmt::format("\nhelp: {}", diagnostic.help);
    Json result = {{"ruleId", kFaults[index_of(diagnostic.fault)].name},
                   {"ruleIndex", index_of(diagnostic.fault)},
                   {"level", kSeverities[index_of(diagnostic.severity)]},
                   {"message", {{"text", std::move(text)}}}};
    if (!diagnostic.place.file.empty()) result["locations"] = Json::array({location_of(diagnostic)});
    if (!diagnostic.subject.empty()) result["properties"]["key"] = diagnostic.subject;
    if (diagnostic.more_keys > 0) result["properties"]["more_keys"] = diagnostic.more_keys;
    if (!diagnostic.help.empty()) result["properties"]["help"] = diagnostic.help;
    return result;
}

}  // namespace

std::string json_of(const Diagnostics& diagnostics, int status) {
    Json list = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        Json entry = {{"severity", kSeverities[index_of(diagnostic.severity)]},
                      {"fault", kFaults[index_of(diagnostic.fault)].name}};
        const auto add = [&](const char* name, const auto& value, bool is_known) {
            if (is_known) entry[name] = value;
        };
        const int column = column_in_characters(diagnostic);
        add("file", diagnostic.place.file, !diagnostic.place.file.empty());
        add("line", diagnostic.place.line, diagnostic.place.line > 0);
        add("column", column, column > 0);
        add("message", diagnostic.message, true);
        add("quoted_line", diagnostic.quoted_line, !diagnostic.quoted_line.empty());
        add("help", diagnostic.help, !diagnostic.help.empty());
        add("key", diagnostic.subject, !diagnostic.subject.empty());
        add("more_keys", diagnostic.more_keys, diagnostic.more_keys > 0);
        list.push_back(std::move(entry));
    }
    return text_of({{"diagnostics", std::move(list)}, {"exit_status", status}});
}

std::string sarif_of(const Diagnostics& diagnostics, int status, const std::string& program) {
    Json rules = Json::array();
    for (const Kind& fault : kFaults)
        rules.push_back({{"id", fault.name}, {"shortDescription", {{"text", fault.meaning}}}});
    Json results = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) results.push_back(result_of(diagnostic));
    const Json driver = {{"name", program}, {"version", GOBO_VERSION}, {"rules", std::move(rules)}};
    const Json run = {
        {"tool", {{"driver", driver}}},
        {"columnKind", "unicodeCodePoints"},
        {"invocations", Json::array({{{"executionSuccessful", status == 0}, {"exitCode", status}}})},
        {"results", std::move(results)}};
    return text_of({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                    {"version", "2.1.0"},
                    {"runs", Json::array({run})}});
}

}  // namespace gobo
