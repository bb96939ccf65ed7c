#include "compose/piece_library.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

std::string_view infix_of(StageKind stage) {
    return stage == StageKind::vertex ? "vert" : "frag";
}

/// "surface/normal.glsl" -> "surface/normal.frag.glsl"
std::string with_infix(const std::string& path, StageKind stage) {
    const auto dot = path.rfind('.');
    const auto slash = path.rfind('/');
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return path;
    return fmt::format("{}.{}{}", path.substr(0, dot), infix_of(stage), path.substr(dot));
}

/// `#include <feature/part>`: values without a file of their own share FEATURE/PART.glsl.
bool is_part(const Include& include) {
    return include.target.find('/') != std::string::npos;
}

}  // namespace

PieceLibrary::PieceLibrary(const Family& family, const SearchPath& search, std::vector<std::string> interest,
                           Comments comments)
    : family_(family), search_(search), interest_(std::move(interest)), comments_(comments) {}

Result<std::optional<int>> PieceLibrary::load(const std::string& path) {
    if (const auto known = by_path_.find(path); known != by_path_.end()) return known->second;
    Result<std::optional<Piece>> found = search_.find(path);
    if (!found) return tl::unexpected(found.error());
    if (!*found) return by_path_[path] = std::nullopt;
    Piece piece = std::move(**found);
    Result<ScannedPiece> scanned = scan_piece(std::move(piece.text), piece.path);
    if (!scanned) return tl::unexpected(scanned.error());
    piece.text = std::move(scanned->text);
    if (comments_ == Comments::remove) {
        piece.file_text = std::move(piece.text);
        piece.text = std::move(scanned->code);
    }
    Entry entry{std::move(piece), std::move(scanned->version), std::move(scanned->includes), {}};
    for (const std::string& identifier : interest_) {
        entry.mentions.push_back(scanned->identifiers.contains(identifier) ? 1 : 0);
    }
    entries_.push_back(std::move(entry));
    stated_bindings_.merge(scanned->bindings);
    warnings_.insert(warnings_.end(), scanned->warnings.begin(), scanned->warnings.end());
    return by_path_[path] = static_cast<int>(entries_.size()) - 1;
}

tl::unexpected<Diagnostics> PieceLibrary::missing(const std::string& wanted, const Include* from,
                                                  std::string reason) const {
    Diagnostic diagnostic;
    diagnostic.place.file = family_.path;
    if (from != nullptr) {
        diagnostic.place = from->place;
        diagnostic.quoted_line = from->line;
    }
    diagnostic.message = std::move(reason);
    diagnostic.help = fmt::format("searched {}", join(search_.folders(), ", "));
    if (const auto near = nearest(wanted, search_.all_include_paths()))
        diagnostic.help += fmt::format("; nearest: '{}'", *near);
    return fail(std::move(diagnostic));
}

Result<int> PieceLibrary::fixed(const std::string& path, StageKind stage, const Include* from) {
    if (!stays_inside(path)) {
        Diagnostic diagnostic;
        diagnostic.place = from != nullptr ? from->place : Place{family_.path, 0, 0};
        diagnostic.quoted_line = from != nullptr ? from->line : "";
        diagnostic.message = fmt::format("the path '{}' leaves the folders searched", path);
        diagnostic.help =
            "write a path relative to one of them, without '..' in front; name further folders with -I";
        return fail(std::move(diagnostic));
    }
    for (const std::string& candidate : {with_infix(path, stage), path}) {
        const Result<std::optional<int>> piece = load(candidate);
        if (!piece) return tl::unexpected(piece.error());
        if (*piece) return **piece;
    }
    return missing(path, from, fmt::format("no {} '{}'", from != nullptr ? "piece" : "template", path));
}

Result<std::optional<int>> PieceLibrary::find_value(const Include& include, const Feature& feature, int value,
                                                    StageKind stage) {
    const bool is_count = feature.kind == FeatureKind::count;
    if (is_count && value == 0) return std::nullopt;
    const std::string& value_name = is_count ? feature.name : feature.values[static_cast<std::size_t>(value)];
    const std::string path = fmt::format("{}/{}.glsl", include.target, value_name);
    std::vector<std::string> candidates = {with_infix(path, stage), path};
    if (is_part(include)) candidates.push_back(include.target + ".glsl");
    for (const std::string& candidate : candidates) {
        Result<std::optional<int>> piece = load(candidate);
        if (!piece || *piece) return piece;
    }
    return missing(path, &include,
                   is_count ? fmt::format("count '{}' has no piece '{}'", feature.name, path)
                            : fmt::format("value '{}' of feature '{}' has no piece '{}'", value_name,
                                          feature.name, path));
}

Result<std::optional<int>> PieceLibrary::chosen(const Include& include, const Key& key, StageKind stage) {
    const std::string wanted = include.target.substr(0, include.target.find('/'));
    const auto index = family_.index_of(wanted);
    if (!index) {
        std::vector<std::string> names = {"varyings"};
        for (const Feature& feature : family_.features) names.push_back(feature.name);
        Diagnostic diagnostic;
        diagnostic.place = include.place;
        diagnostic.quoted_line = include.line;
        diagnostic.message = fmt::format("family '{}' has no feature '{}'", family_.name, wanted);
        diagnostic.help = suggestion(wanted, names);
        return fail(std::move(diagnostic));
    }
    const int value = key[static_cast<std::size_t>(*index)];
    const auto choice = std::tuple(include.target, value, stage);
    if (const auto known = by_choice_.find(choice); known != by_choice_.end()) return known->second;
    Result<std::optional<int>> piece =
        find_value(include, family_.features[static_cast<std::size_t>(*index)], value, stage);
    if (piece) by_choice_[choice] = *piece;
    return piece;
}

int PieceLibrary::generated(Piece piece) {
    const auto [at, is_new] = by_generated_text_.try_emplace(piece.text, static_cast<int>(entries_.size()));
    if (is_new) entries_.push_back({std::move(piece), {}, {}, std::vector<char>(interest_.size(), 0)});
    return at->second;
}

std::vector<Piece> PieceLibrary::pieces() const {
    std::vector<Piece> pieces;
    for (const Entry& entry : entries_) pieces.push_back(entry.piece);
    return pieces;
}

std::vector<std::string> PieceLibrary::files() const {
    std::vector<std::string> files;
    for (const Entry& entry : entries_) {
        if (entry.piece.on_disk) files.push_back(entry.piece.path);
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

}  // namespace gobo
