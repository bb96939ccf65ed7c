#include "validate/switch_rules.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// `0:12      case:  with expression`: string 0, line 12, six blanks deep.
struct Node {
    std::size_t string = 0;
    int line = 0;
    std::size_t depth = 0;
    std::string_view text;
};

/// Nothing for a line that stands for no node, or for one without a place (`0:?`).
std::optional<Node> read_node(std::string_view line) {
    Node node;
    const std::size_t colon = line.find(':');
    const std::size_t blank = line.find(' ');
    if (colon == std::string_view::npos || blank == std::string_view::npos) return std::nullopt;
    const char* const begin = line.data();
    if (std::from_chars(begin, begin + colon, node.string).ec != std::errc() ||
        std::from_chars(begin + colon + 1, begin + blank, node.line).ec != std::errc())
        return std::nullopt;
    node.text = trim(line.substr(blank));
    node.depth = static_cast<std::size_t>(node.text.data() - begin) - blank;
    return node;
}

/// Of a node that ends with its type, `'x' ( in int)`: "int" or "uint"; "" of any other.
std::string_view type_of(std::string_view text) {
    for (const std::string_view type : {"uint", "int"})
        if (text.ends_with(fmt::format("{})", type)) &&
            !is_identifier_part(text[text.size() - type.size() - 2]))
            return type;
    return "";
}

struct Switch {
    std::size_t depth = 0;
    std::string_view type;
};

}  // namespace

bool has_strict_switches(const std::vector<const Piece*>& pieces) {
    const GlslVersion version = version_of(pieces.front()->text);
    return (version.es || version.number < 400) && std::ranges::any_of(pieces, [](const Piece* piece) {
               return piece->text.find("switch") != std::string::npos;
           });
}

Diagnostics check_switches(std::string_view tree, const std::vector<const Piece*>& pieces) {
    Diagnostics found;
    std::vector<Switch> open;   // the innermost last
    std::optional<Node> label;  // whose value is awaited
    std::string_view before;
    while (!tree.empty()) {
        const std::size_t end = std::min(tree.find('\n'), tree.size());
        const std::optional<Node> node = read_node(tree.substr(0, end));
        tree.remove_prefix(std::min(end + 1, tree.size()));
        if (!node) continue;
        while (!open.empty() &&
               (node->depth < open.back().depth ||
                (node->depth == open.back().depth && node->text != "condition" && node->text != "body")))
            open.pop_back();
        if (before == "condition" && !open.empty()) open.back().type = type_of(node->text);
        if (node->text == "switch") open.push_back({node->depth, ""});
        const std::string_view type = type_of(node->text);
        if (label && !open.empty() && !type.empty()) {
            if (type != open.back().type && !open.back().type.empty()) {
                Diagnostic& diagnostic = found.emplace_back();
                diagnostic.message = fmt::format("a case of {} in a switch of {}", type, open.back().type);
                diagnostic.help = type == "uint" ? "write it without the u" : "write a u behind the number";
                const Piece& piece = *pieces[std::min(label->string, pieces.size() - 1)];
                put_at(diagnostic, piece, piece.line_in_file(label->line));
            }
            label.reset();
        }
        if (node->text.starts_with("case:")) label = node;
        before = node->text;
    }
    return found;
}

}  // namespace gobo
