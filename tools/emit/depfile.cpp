#include "emit/depfile.hpp"

#include <set>
#include <string_view>

namespace gobo {
namespace {

/// As GCC writes names: a blank or '#' takes a backslash, and backslashes just before one are doubled.
std::string escaped(std::string_view path) {
    std::string result;
    std::size_t backslashes = 0;
    for (const char character : path) {
        if (character == ' ' || character == '\t' || character == '#') {
            result.append(backslashes + 1, '\\');
        } else if (character == '$') {
            result += '$';
        }
        backslashes = character == '\\' ? backslashes + 1 : 0;
        result += character;
    }
    return result;
}

}  // namespace

std::string emit_depfile(const std::vector<std::string>& outputs, const std::vector<std::string>& files) {
    std::string text;
    for (const std::string& output : outputs) {
        if (!text.empty()) text += ' ';
        text += escaped(output);
    }
    text += ':';
    std::set<std::string_view> named;
    for (const std::string& file : files) {
        if (named.insert(file).second) text += " \\\n  " + escaped(file);
    }
    return text + '\n';
}

}  // namespace gobo
