// The lighting models that the project promises, and where each is to be found: docs/models.toml.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::models {

/// One model of the classic texts.
struct Model {
    std::string id;      ///< "S3"
    std::string title;   ///< "Blinn's highlight"
    std::string family;  ///< "lit"
    std::string key;     ///< an example
    std::string where;   ///< the permutations that have the model: a condition over the family's features
    std::vector<std::string> pieces;  ///< files whose pieces say it: "fog.glsl" of shader_lib, or "tests/..."
};

/// The models in the order of the file. Errors: a syntax error, an unknown or missing name, at its line.
[[nodiscard]] Result<std::vector<Model>> read_catalogue(std::string_view toml, const std::string& path);

}  // namespace gobo::models
