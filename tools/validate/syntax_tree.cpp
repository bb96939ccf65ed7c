#include "validate/syntax_tree.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/declaration.hpp"

namespace gobo {
namespace {

/// The names of functions that a stage declares by `float f(float x);`.
std::set<std::string_view> declared_functions(const std::vector<const Piece*>& pieces) {
    std::set<std::string_view> names;
    int braces = 0;
    for (const Piece* const piece : pieces) {
        const std::vector<std::string_view> tokens = tokens_of(piece->text);
        std::string_view name;  // before the last `(` outside of functions
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (tokens[i] == "{") ++braces;
            if (tokens[i] == "}") --braces;
            if (braces == 0 && tokens[i] == "(" && i > 1 && is_identifier(tokens[i - 2]))
                name = is_identifier(tokens[i - 1]) ? tokens[i - 1] : "";
            if (braces == 0 && tokens[i] == ")" && i + 1 < tokens.size() && tokens[i + 1] == ";" &&
                !name.empty())
                names.insert(name);
        }
    }
    return names;
}

/// Of a type as glslang prints it, "uniform structure{ global lowp sampler2D map,  global bool on}".
void add_precisions(const std::string& path, std::string_view type, Precisions& precisions) {
    constexpr std::string_view kStructure = "structure{";
    const std::size_t open = type.find(kStructure);
    if (open == std::string_view::npos) {
        for (const std::string& word : split(type, ' '))
            if (word == "lowp" || word == "mediump" || word == "highp") precisions[path] = word;
        return;
    }
    int depth = 1;
    std::size_t begin = open + kStructure.size();
    for (std::size_t i = begin; i < type.size() && depth > 0; ++i) {
        depth += type[i] == '{' ? 1 : type[i] == '}' ? -1 : 0;
        if (depth != 0 && (depth != 1 || type[i] != ',')) continue;
        const std::string_view member = trim(type.substr(begin, i - begin));
        const std::size_t blank = std::min(member.rfind(' '), member.size());
        add_precisions(fmt::format("{}.{}", path, trim(member.substr(blank))), member.substr(0, blank),
                       precisions);
        begin = i + 1;
    }
}

void set_precision(const std::string& path, Usage& usage, const Precisions& precisions) {
    if (const auto found = precisions.find(path); found != precisions.end()) usage.precision = found->second;
}

void set_precisions(const std::string& path, std::vector<Member>& members, const Precisions& precisions) {
    for (Member& member : members) {
        const std::string own = path + "." + member.name;
        set_precision(own, member.usage, precisions);
        set_precisions(own, member.members, precisions);
    }
}

}  // namespace

bool asks_for_tree(const std::vector<const Piece*>& pieces, ReadPieces& read) {
    const auto has_plain_uniform = [](const Piece* piece) {
        const std::string& text = piece->text;
        for (std::size_t at = text.find("uniform"); at != std::string::npos;
             at = text.find("uniform", at + 1)) {
            const std::size_t end = text.find_first_of(";{", at);
            const bool is_block = end != std::string::npos && text[end] == '{' &&
                                  text.substr(at, end - at).find("struct") == std::string::npos;
            if (!is_block) return true;
        }
        return false;
    };
    const auto may_declare = [&](const Piece* piece) {
        return piece != pieces.front() && read.of(*piece).may_declare_functions;
    };
    return (version_of(pieces.front()->text).es && std::ranges::any_of(pieces, has_plain_uniform)) ||
           (std::ranges::any_of(pieces, may_declare) && !declared_functions(pieces).empty());
}

Precisions precisions_of(std::string_view tree) {
    Precisions precisions;
    tree = tree.substr(std::min(tree.find("Linker Objects"), tree.size()));
    for (const std::string& line : split(tree, '\n')) {
        const std::size_t name = line.find('\'');
        const std::size_t end = line.find("' (", name + 1);
        if (name == std::string::npos || end == std::string::npos) continue;
        const std::string_view type = std::string_view(line).substr(end + 3);
        const std::string_view head = type.substr(0, type.find('{'));
        if (head.find("uniform ") == std::string_view::npos || head.ends_with("block")) continue;
        add_precisions(line.substr(name + 1, end - name - 1), type.substr(0, type.rfind(')')), precisions);
    }
    return precisions;
}

void set_precisions(Interface& interface, const Precisions& precisions) {
    for (Uniform& uniform : interface.uniforms) {
        const std::string path = without_indices(uniform.name);
        set_precision(path, uniform.usage, precisions);
        set_precisions(path, uniform.members, precisions);
    }
    for (Sampler& sampler : interface.samplers)
        set_precision(without_indices(sampler.name), sampler.usage, precisions);
}

Diagnostics check_calls(std::string_view tree, const std::vector<const Piece*>& pieces) {
    Diagnostics found;
    const std::set<std::string_view> declared = declared_functions(pieces);
    if (declared.empty()) return found;
    std::set<std::string> written;  // as glslang names them, with the types of the parameters: "f(f1;"
    std::set<std::string> called;
    const std::vector<std::string> lines = split(tree, '\n');
    for (const auto& [mark, names] :
         {std::pair("Function Definition: ", &written), std::pair("Function Call: ", &called)})
        for (const std::string& line : lines) {
            const std::size_t at = line.find(mark);
            if (at == std::string::npos) continue;
            const std::string name = line.substr(at + std::string_view(mark).size());
            names->insert(name.substr(0, name.find(' ')));
        }
    for (const std::string& mangled : called) {
        const std::string_view name = std::string_view(mangled).substr(0, mangled.find('('));
        if (written.contains(mangled) || !declared.contains(name)) continue;
        found.push_back(diagnostic_at(use_of(name, pieces), Severity::error,
                                      fmt::format("the function '{}' has no body", name),
                                      "write it, or include the piece that holds it"));
    }
    return found;
}

}  // namespace gobo
