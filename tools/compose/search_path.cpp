#include "compose/search_path.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// "a/b.frag" -> "a" and "b.frag"; of a file in the root "/".
std::pair<std::string, std::string> folder_and_name(const std::string& path) {
    const auto slash = path.rfind('/');
    if (slash == std::string::npos) return {"", path};
    return {path.substr(0, std::max<std::size_t>(slash, 1)), path.substr(slash + 1)};
}

/// The stage that a file's name tells: .vert or .frag, also with .glsl behind; nothing for any other name.
std::optional<StageKind> stage_of_file(const std::string& path) {
    std::string_view name = path;
    if (name.ends_with(".glsl")) name.remove_suffix(5);
    if (name.ends_with(".vert")) return StageKind::vertex;
    if (name.ends_with(".frag")) return StageKind::fragment;
    return std::nullopt;
}

}  // namespace

bool stays_inside(std::string_view include_path) {
    if (include_path.starts_with('/') || include_path.find('\\') != std::string_view::npos) return false;
    int depth = 0;
    for (const std::string& part : split(include_path, '/')) {
        if (part == "..") --depth;
        if (part != ".." && part != ".") ++depth;
        if (depth < 0) return false;
    }
    return depth > 0;
}

void SearchPath::add(const FileSystem& files, std::string folder, std::string name_prefix, bool on_disk) {
    roots_.push_back({&files, std::move(folder), std::move(name_prefix), on_disk, {}});
}

void SearchPath::add_file(const FileSystem& files, const std::string& path) {
    auto [folder, name] = folder_and_name(path);
    roots_.insert(roots_.begin() + static_cast<std::ptrdiff_t>(named_files_++),
                  {&files, std::move(folder), "", true, std::move(name)});
}

Result<std::optional<Piece>> SearchPath::find(const std::string& include_path) const {
    for (const Root& root : roots_) {
        if (!root.only.empty() && root.only != include_path) continue;
        const bool here = root.folder.empty() || root.folder == ".";
        const std::string path = here ? include_path : root.folder + "/" + include_path;
        if (!root.files->is_file(path)) continue;
        const std::string real_root = root.files->real_path(here ? "." : root.folder);
        if (root.on_disk && root.only.empty() &&
            !root.files->real_path(path).starts_with(real_root == "/" ? real_root : real_root + "/")) {
            return fail({path, 0, 0}, "", fmt::format("is a link that leads out of '{}'", root.folder),
                        "put the piece itself into the folder, or name its folder with -I");
        }
        GOBO_TRY(std::string text, root.files->read(path));
        return Piece{root.name_prefix + include_path, path, std::move(text), root.on_disk};
    }
    return std::nullopt;
}

std::vector<std::string> SearchPath::folders() const {
    std::vector<std::string> folders;
    for (const Root& root : roots_)
        if (root.only.empty()) folders.push_back(root.folder.empty() ? "." : root.folder);
    return folders;
}

std::vector<std::string> SearchPath::all_include_paths() const {
    std::vector<std::string> paths;
    for (const Root& root : roots_) {
        if (!root.only.empty()) continue;
        const std::string folder = root.on_disk && root.folder.empty() ? "." : root.folder;
        const std::vector<std::string> below = root.files->files_below(folder);
        paths.insert(paths.end(), below.begin(), below.end());
    }
    std::sort(paths.begin(), paths.end());
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    return paths;
}

bool is_shader_file(const std::string& path) {
    constexpr std::string_view extensions[] = {".vert", ".frag", ".glsl", ".geom", ".comp",
                                               ".tesc", ".tese", ".vs",   ".fs"};
    return std::any_of(std::begin(extensions), std::end(extensions),
                       [&](std::string_view extension) { return path.ends_with(extension); });
}

Result<Family> family_of_files(const std::vector<std::string>& paths, const FileSystem& files,
                               SearchPath& search) {
    Family family;
    family.name = "files";
    for (const std::string& path : paths) {
        const auto stage = stage_of_file(path);
        if (!stage) {
            return fail(Fault::usage, fmt::format("'{}' does not tell its stage", path),
                        "name vertex stages *.vert or *.vert.glsl, fragment stages *.frag or *.frag.glsl");
        }
        if (!files.is_file(path)) return tl::unexpected(files.read(path).error());
        std::string& slot = *stage == StageKind::vertex ? family.vertex : family.fragment;
        if (!slot.empty()) {
            return fail(Fault::usage, fmt::format("'{}' is a second {} stage", path, name_of(*stage)),
                        "name at most one file of each stage");
        }
        const auto [folder, name] = folder_and_name(path);
        slot = name;
        search.add_file(files, path);
        search.add(files, folder, "", true);
        if (family.path.empty()) family.path = path;
    }
    return family;
}

}  // namespace gobo
