// The depfile, in what make and ninja both read.
#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "emit/depfile_names.hpp"
#include "emit/emit.hpp"

namespace gobo {
namespace {

bool has_any(std::string_view name, std::string_view characters) {
    return name.find_first_of(characters) != std::string_view::npos;
}

/// Ninja knows few characters, reads a backslash before '#', ':' and '$' in its own way, and takes a colon at
/// the end for that of the rule.
bool ninja_reads(std::string_view name) {
    const auto is_known = [](char character) {
        return is_identifier_part(character) || static_cast<unsigned char>(character) >= 0x80 ||
               std::string_view(" #$\\,/:.~(){}%=@[]!+-").find(character) != std::string_view::npos;
    };
    for (std::size_t at = name.find('\\'); at != std::string_view::npos; at = name.find('\\', at + 1))
        if (has_any(name.substr(at + 1, 1), "#:$")) return false;
    return std::ranges::all_of(name, is_known) && !name.ends_with(':');
}

/// As GCC writes names: a blank, '#' or ':' takes a backslash, and backslashes just before one are doubled.
std::string escaped(std::string_view name) {
    std::string result;
    std::size_t backslashes = 0;
    for (char character : name) {
        if (character == '\n' || character == '\r') character = '_';
        if (has_any({&character, 1}, " \t#:")) result.append(backslashes + 1, '\\');
        if (character == '$') result += '$';
        backslashes = character == '\\' ? backslashes + 1 : 0;
        result += character;
    }
    return result;
}

/// One warning for all names: at the first of them.
void warn(const std::vector<std::string>& names, const std::string& what, Diagnostics& warnings) {
    if (names.empty()) return;
    const std::string more = names.size() > 1 ? fmt::format(" (and of {} more)", names.size() - 1) : "";
    Diagnostic& warning = warnings.emplace_back();
    warning.severity = Severity::warning;
    warning.place.file = names.front();
    warning.message = fmt::format("a depfile cannot hold this name{}: {}", more, what);
    warning.help = "rename the file or its folder: letters, digits, blanks and . _ - + , @ are safe";
}

}  // namespace

bool make_reads(const std::string& name) {
    const bool is_member = name.ends_with(')') && has_any(name, "(");  // of an archive
    return !name.empty() && !is_member && !has_any(name, "\n\r;|") &&
           !has_any(name.substr(name.size() - 1), " \t\\");
}

Diagnostics check_depfile_names(const std::string& output, const std::set<std::string>& files) {
    std::vector<std::string> left_out;
    std::vector<std::string> misread;
    for (const std::string& file : files)
        if (!make_reads(file))
            left_out.push_back(file);
        else if (!ninja_reads(file))
            misread.push_back(file);
    Diagnostics warnings;
    if (std::ranges::all_of(files, [](const std::string& file) { return has_any(file, "="); }))
        warn({files.begin(), files.end()}, "make takes it for a variable, and will not see the file change",
             warnings);
    warn(left_out, "build tools will not see the file change", warnings);
    warn(misread, "make reads it, but ninja builds every time", warnings);
    if (!make_reads(output) || !ninja_reads(output) || has_any(output, "=%"))
        warn({output}, "build tools will not know what it is for", warnings);
    return warnings;
}

std::string emit_depfile(const std::vector<std::string>& outputs, const std::vector<std::string>& files) {
    std::vector<std::string> targets;
    std::ranges::transform(outputs, std::back_inserter(targets), escaped);
    std::string text = fmt::format("{}:", fmt::join(targets, " "));
    // To make a '=' in the first name means a variable.
    const auto first = std::ranges::find_if(
        files, [](const std::string& file) { return make_reads(file) && !has_any(file, "="); });
    std::set<std::string_view> named;
    const auto add = [&](const std::string& file) {
        if (make_reads(file) && named.insert(file).second) text += " \\\n  " + escaped(file);
    };
    if (first != files.end()) add(*first);
    std::ranges::for_each(files, add);
    return text + '\n';
}

}  // namespace gobo
