// How an include resolves to a file.
#include <algorithm>

#include <fmt/format.h>

#include "compose/piece_library.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// No system opens a file of a longer path.
constexpr std::size_t kLongestPath = 4096;

/// "sub/../a.glsl" -> "a.glsl", of a path that stays inside.
std::string without_dots(const std::string& path) {
    std::vector<std::string> parts;
    for (std::string& part : split(path, '/')) {
        if (part == "..") parts.pop_back();
        if (part != ".." && part != ".") parts.push_back(std::move(part));
    }
    return join(parts, "/");
}

/// "fog" or "guards/unit_vector".
bool is_feature_or_part(std::string_view target) {
    const auto slash = target.find('/');
    return is_identifier(target.substr(0, slash)) &&
           (slash == std::string_view::npos || is_identifier(target.substr(slash + 1)));
}

/// "surface/normal.glsl" -> "surface/normal.frag.glsl"
std::string with_infix(const std::string& path, StageKind stage) {
    const auto dot = path.rfind('.');
    const auto slash = path.rfind('/');
    if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return path;
    return fmt::format("{}.{}{}", path.substr(0, dot), names_of(stage).infix, path.substr(dot));
}

}  // namespace

Result<std::optional<int>> PieceLibrary::find(const Include& include, const Key& key, StageKind stage,
                                              const Source* from) {
    const std::string name = include.target.substr(0, include.target.find('/'));
    const std::optional<int> index =
        include.in_angles && is_feature_or_part(include.target) ? family_.index_of(name) : std::nullopt;
    const auto at = static_cast<std::size_t>(index.value_or(0));
    const auto choice =
        std::tuple(index ? nullptr : from, include.target, index ? key[at] : -1, stage, variant_);
    if (const auto known = by_choice_.find(choice); known != by_choice_.end()) return known->second;
    GOBO_TRY(const std::optional<int> file, index ? find_value(include, family_.features[at], key[at], stage)
                                                  : find_file(include, stage, from));
    return by_choice_[choice] = file;
}

Result<int> PieceLibrary::legacy(const std::string& name, StageKind stage) {
    const std::string path = legacy_piece(name);
    for (const std::string& candidate : {with_infix(path, stage), path}) {
        GOBO_TRY(const std::optional<int> file, load(candidate, "", Whose::shipped));
        if (file) return *file;
    }
    return fail(Fault::internal, fmt::format("templates/compatibility.glsl declares no '{}'", name));
}

Result<std::optional<int>> PieceLibrary::find_file(const Include& include, StageKind stage,
                                                   const Source* from) {
    const bool is_template = include.place.line == 0;  // no line of a file includes it
    const auto missing = [&] {
        return fmt::format("no {} '{}'", is_template ? "template" : "piece", include.target);
    };
    if (include.target.size() > kLongestPath) return first_of({}, include.target, include, from, missing());
    std::vector<std::string> candidates;
    for (const std::string& folder : {from == nullptr ? "" : from->folder, std::string()}) {
        const std::string& target = include.target;
        const std::string wanted = folder.empty() ? target : folder + "/" + target;
        if (target.starts_with('/') || !stays_inside(wanted)) continue;
        const std::string path = without_dots(wanted);
        candidates.insert(candidates.end(), {with_infix(path, stage), path});
        if (include.in_angles && target.find('.') == std::string::npos)
            candidates.insert(candidates.end(), {with_infix(path + ".glsl", stage), path + ".glsl"});
    }
    if (candidates.empty() && include.target.find('\\') != std::string::npos)
        return fail_at(include, fmt::format("the path '{}' holds a '\\'", include.target),
                       "write / between folder and file");
    if (candidates.empty())
        return fail_at(
            include, fmt::format("the path '{}' leaves the folders searched", include.target),
            "write a path relative to one of them, without '..' in front; name further folders with -I");
    const std::string name = include.target.substr(0, include.target.find('/'));
    if (include.in_angles && is_feature_or_part(include.target)) {
        GOBO_TRY(const std::optional<int> file, first_of(candidates, from));
        if (file) return file;
        std::vector<std::string> names = {"varyings"};
        for (const Feature& feature : family_.features) names.push_back(feature.name);
        return fail_at(include, fmt::format("family '{}' has no feature '{}'", family_.name, name),
                       suggestion(name, names));
    }
    return first_of(candidates, include.target, include, from, missing());
}

Result<std::optional<int>> PieceLibrary::find_value(const Include& include, const Feature& feature, int value,
                                                    StageKind stage) {
    const bool is_count = feature.kind == FeatureKind::count;
    if (is_count && feature.lowest + value == 0) return std::nullopt;
    const std::string& value_name = is_count ? feature.name : feature.values[static_cast<std::size_t>(value)];
    const std::string path = fmt::format("{}/{}.glsl", include.target, value_name);
    std::vector<std::string> candidates = {with_infix(path, stage), path};
    // `#include <feature/part>`: values without a file of their own share FEATURE/PART.glsl.
    if (include.target.find('/') != std::string::npos) candidates.push_back(include.target + ".glsl");
    return first_of(candidates, path, include, nullptr,
                    is_count ? fmt::format("count '{}' has no piece '{}'", feature.name, path)
                             : fmt::format("value '{}' of feature '{}' has no piece '{}'", value_name,
                                           feature.name, path));
}

Result<std::optional<int>> PieceLibrary::first_of(const std::vector<std::string>& paths, const Source* from) {
    for (const std::string& path : paths) {
        GOBO_TRY(const std::optional<int> file,
                 load(path, from == nullptr ? "" : from->root,
                      from != nullptr && from->is_legacy ? Whose::shipped : Whose::anyone));
        if (file) return file;
    }
    return std::nullopt;
}

Result<std::optional<int>> PieceLibrary::first_of(const std::vector<std::string>& paths,
                                                  const std::string& wanted, const Include& include,
                                                  const Source* from, std::string message) {
    GOBO_TRY(const std::optional<int> file, first_of(paths, from));
    if (file) return file;
    std::string help = fmt::format("searched {}", join(search_.folders(), ", "));
    const std::vector<std::string> all = search_.all_include_paths();
    const auto near = nearest(wanted, all);
    if (near == wanted) {  // there, but all of it stands behind marks
        const std::string folder = wanted.substr(0, wanted.rfind('.')) + "/";
        const auto piece =
            std::ranges::find_if(all, [&](const auto& path) { return path.starts_with(folder); });
        if (piece != all.end())
            help = fmt::format("'{}' is split into pieces: write which one, as \"{}\"", wanted, *piece);
    } else if (near) {
        help += fmt::format("; nearest: '{}'", *near);
    }
    return fail_at(include, std::move(message), std::move(help));
}
}  // namespace gobo
