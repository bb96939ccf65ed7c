// The tables of a family file that say what can be chosen: [features], [renamed].
#pragma once

#include <string_view>
#include <vector>

#include "family/family.hpp"
#include "family/toml_reader.hpp"

namespace gobo {

/// Whether shaders may hold the text where another is put: a name, perhaps between signs, without blanks.
[[nodiscard]] bool is_substituted(std::string_view text);
/// Whether a macro may be defined as the text: one line that ends nowhere else, without comments.
[[nodiscard]] bool is_macro_text(std::string_view text);

/// The choice between the templates of [programs].
inline constexpr const char* kProgramFeature = "program";

// Errors go to the reader.

/// Sorted by name, with the names of [renamed]; with [programs] also the choice `program` between them.
[[nodiscard]] std::vector<Feature> read_features(const TomlTable& root);

/// The index of a feature that an entry of a table names; 0 and an error where there is none.
int read_feature_name(const TomlTable& table, std::string_view entry, const std::string& name,
                      const std::vector<Feature>& features);

/// Values of uniforms and inputs by name, as in [render]: each a source's name, a table with a source and
/// numbers, or numbers.
[[nodiscard]] std::vector<RenderValue> read_render_values(const TomlTable& table, std::string_view entry);

}  // namespace gobo
