// Shader files that belong to no family, taken as a family without features.
#pragma once

#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "compose/search_path.hpp"

namespace gobo {

/// The stage that a file's name tells: .vert or .frag, also with .glsl behind; nothing for any other name.
[[nodiscard]] std::optional<StageKind> stage_of_file(const std::string& path);

/// Whether a name looks like a shader file's rather than a family's.
[[nodiscard]] bool is_shader_file(const std::string& path);

/// A family of one key whose templates are the files, and whose folders are added to `search`. At most one
/// file of each stage; Fault::usage otherwise.
[[nodiscard]] Result<Family> family_of_files(const std::vector<std::string>& paths, const FileSystem& files,
                                             SearchPath& search);

}  // namespace gobo
