#include "compose/loose_files.hpp"

#include <fmt/format.h>

namespace gobo {

std::optional<StageKind> stage_of_file(const std::string& path) {
    const std::string_view name =
        path.ends_with(".glsl") ? std::string_view(path).substr(0, path.size() - 5) : std::string_view(path);
    if (name.ends_with(".vert")) return StageKind::vertex;
    if (name.ends_with(".frag")) return StageKind::fragment;
    return std::nullopt;
}

bool is_shader_file(const std::string& path) {
    constexpr std::string_view extensions[] = {".vert", ".frag", ".glsl", ".geom", ".comp",
                                               ".tesc", ".tese", ".vs",   ".fs"};
    for (const std::string_view extension : extensions) {
        if (path.ends_with(extension)) return true;
    }
    return false;
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
        const auto slash = path.rfind('/');
        slot = path.substr(slash == std::string::npos ? 0 : slash + 1);
        const std::string folder =
            slash == std::string::npos ? "" : path.substr(0, std::max<std::size_t>(slash, 1));
        search.add_file(files, path);
        search.add(files, folder, "", true);
        if (family.path.empty()) family.path = path;
    }
    return family;
}

}  // namespace gobo
