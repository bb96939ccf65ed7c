#include "compose/search_path.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {

bool stays_inside(std::string_view include_path) {
    if (include_path.empty() || include_path.front() == '/' ||
        include_path.find('\\') != std::string_view::npos)
        return false;
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
    const auto slash = path.rfind('/');
    const bool here = slash == std::string::npos;
    const std::string folder = here ? "" : path.substr(0, std::max<std::size_t>(slash, 1));
    roots_.insert(roots_.begin() + static_cast<std::ptrdiff_t>(named_files_++),
                  {&files, folder, "", true, here ? path : path.substr(slash + 1)});
}

Result<std::optional<Piece>> SearchPath::find(const std::string& include_path) const {
    for (const Root& root : roots_) {
        if (!root.only.empty() && root.only != include_path) continue;
        const bool here = root.folder.empty() || root.folder == ".";
        const std::string path = here ? include_path : root.folder + "/" + include_path;
        if (!root.files->is_file(path)) continue;
        const std::string real_root = root.files->real_path(here ? "." : root.folder);
        const std::string real = root.files->real_path(path);
        if (root.on_disk && root.only.empty() &&
            !real.starts_with(real_root == "/" ? real_root : real_root + "/")) {
            Diagnostic diagnostic;
            diagnostic.place.file = path;
            diagnostic.message = fmt::format("is a link that leads out of '{}'", root.folder);
            diagnostic.help = "put the piece itself into the folder, or name its folder with -I";
            return fail(std::move(diagnostic));
        }
        Result<std::string> text = root.files->read(path);
        if (!text) return tl::unexpected(text.error());
        return Piece{root.name_prefix + include_path, path, std::move(*text), root.on_disk};
    }
    return std::nullopt;
}

std::vector<std::string> SearchPath::folders() const {
    std::vector<std::string> folders;
    for (const Root& root : roots_) {
        if (root.only.empty()) folders.push_back(root.folder.empty() ? "." : root.folder);
    }
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

}  // namespace gobo
