// The shipped library and families, embedded in the executable.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace gobo {

/// Text by path: "shader_lib/fog/linear.glsl", "templates/lit.toml", "data/meshes/teapot.obj".
[[nodiscard]] std::map<std::string, std::string, std::less<>> shipped_files();

}  // namespace gobo
