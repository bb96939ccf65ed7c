#include "validate/declaration.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/rewrite.hpp"
#include "core/text.hpp"
#include "reflect/interface.hpp"

namespace gobo {
namespace {

/// What stands before a name where a stage's interface is declared, also by the macros of the dialects.
constexpr std::array<std::string_view, 13> kStorage = {
    "in",    "out",     "uniform",   "buffer", "varying", "attribute", "inout",
    "BLOCK", "VARYING", "ATTRIBUTE", "OUTPUT", "SAMPLER", "DEPTH"};

/// Where the line holds the word, not as a part of a longer one; npos where it does not.
std::size_t place_of(std::string_view line, std::string_view word) {
    if (word.empty()) return std::string_view::npos;
    for (auto at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
        const bool begins = at == 0 || !is_identifier_part(line[at - 1]);
        const std::size_t end = at + word.size();
        if (begins && (end == line.size() || !is_identifier_part(line[end]))) return at;
    }
    return std::string_view::npos;
}

bool mentions(std::string_view line, std::string_view word) {
    return place_of(line, word) != std::string_view::npos;
}

/// Whether a storage qualifier stands before the name in the same statement.
bool declares(std::string_view line, std::string_view name) {
    std::string_view head = line.substr(0, place_of(line, name));
    head = head.substr(head.find_last_of(";{}") + 1);
    return std::ranges::any_of(kStorage, [&](std::string_view word) { return mentions(head, word); });
}

/// Calls `visit(piece, line number, line without its comment)` for each line that mentions the name.
template <class Visit>
void for_each_mention(std::string_view name, const std::vector<const Piece*>& pieces, const Visit& visit) {
    for (const Piece* const piece : pieces) {
        if (piece->text.find(name) == std::string::npos) continue;
        std::string_view rest = piece->text;
        for (int number = piece->first_line; !rest.empty(); ++number) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            const std::string_view code = line.substr(0, line.find("//"));
            if (mentions(code, name)) visit(*piece, number, code);
            rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        }
    }
}

Declaration declaration_at(const Piece& piece, int number) {
    return {{piece.path, number, 0}, std::string(line_of(piece, number)), false};
}

}  // namespace

std::string Declaration::text() const {
    return place.line == 0 ? place.file : fmt::format("{}:{}", place.file, place.line);
}

Declaration declaration_of(std::string_view name, std::string_view hint,
                           const std::vector<const Piece*>& pieces) {
    Declaration best{{pieces.back()->path, 0, 0}, "", false};
    int best_rank = 0;
    const std::string_view root = root_of(name);
    const bool is_legacy = name_in_files(root) != root;  // users find it where their files name it
    for_each_mention(root, pieces, [&](const Piece& piece, int number, std::string_view line) {
        if (is_legacy && piece.is_shipped) return;
        const bool has_hint = mentions(line, hint);
        const int rank = 1 + (declares(line, root) ? 2 : 0) + (has_hint ? 1 : 0);
        if (rank <= best_rank) return;
        best_rank = rank;
        best = declaration_at(piece, number);
        best.mentions_hint = has_hint;
    });
    return best;
}

Declaration declaration_of_member(std::string_view block, std::string_view member,
                                  const std::vector<const Piece*>& pieces) {
    const Declaration start = declaration_of(block, "", pieces);
    Declaration found = start;
    bool is_found = false;
    for_each_mention(member, pieces, [&](const Piece& piece, int number, std::string_view) {
        if (is_found || piece.path != start.place.file || number < start.place.line) return;
        found = declaration_at(piece, number);
        is_found = true;
    });
    return found;
}

Declaration use_of(std::string_view name, const std::vector<const Piece*>& pieces) {
    Declaration first{{pieces.back()->path, 0, 0}, "", false};
    const std::string legacy = legacy_name(name);
    for_each_mention(name, pieces, [&](const Piece& piece, int number, std::string_view line) {
        const bool is_ours = piece.is_shipped && mentions(line, legacy);
        if (first.place.line == 0 && !declares(line, name) && !is_ours) first = declaration_at(piece, number);
    });
    return first.place.line > 0 || legacy.empty() ? first : declaration_of(legacy, "", pieces);
}

Diagnostic diagnostic_at(const Declaration& declaration, Severity severity, std::string message,
                         std::string help) {
    return {.severity = severity,
            .place = declaration.place,
            .message = std::move(message),
            .quoted_line = declaration.quoted_line,
            .help = std::move(help)};
}

}  // namespace gobo
