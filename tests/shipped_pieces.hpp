// The pieces of shader_lib as they stand in the source tree, by include path: "fog/linear.glsl".
#pragma once

#include <string>
#include <vector>

#include "compose/search_path.hpp"
#include "core/file_system.hpp"

namespace gobo {

inline const SearchPath& shipped_pieces() {
    static const DiskFileSystem disk;
    static const SearchPath search = [] {
        SearchPath shader_lib;
        shader_lib.add(disk, GOBO_SOURCE_DIR "/shader_lib", "shader_lib/", false);
        return shader_lib;
    }();
    return search;
}

inline std::string piece_text(const std::string& include_path) {
    return shipped_pieces().find(include_path).value().value().text;
}

/// The include paths of all pieces, or of those in a folder: "light_sum/".
inline std::vector<std::string> piece_paths(const std::string& folder = "") {
    std::vector<std::string> paths = shipped_pieces().all_include_paths();
    std::erase_if(paths, [&](const std::string& path) {
        return !path.starts_with(folder) || !shipped_pieces().find(path).value();
    });
    return paths;
}

}  // namespace gobo
