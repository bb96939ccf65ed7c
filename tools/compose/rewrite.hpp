// Changes to the text of a file before it is scanned; lines stay lines.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compose/composition.hpp"
#include "family/family.hpp"

namespace gobo {

/// What is replaced, and by what.
using Substitutions = std::vector<std::pair<std::string, std::string>>;

/// What the family and its features replace for a key.
[[nodiscard]] Substitutions substitutions_of(const Family& family, const Key& key);
/// What `compatibility = true` replaces in the files of a stage, behind that: `gl_Vertex` by `legacy_Vertex`.
[[nodiscard]] Substitutions legacy_substitutions(StageKind stage);

/// What a stage of a family with `compatibility = true` may mention, each declared by the piece
/// NAME of `templates/compatibility.glsl`: `legacy_Vertex`, which is what the files call `gl_Vertex`, and
/// `texture2D`.
[[nodiscard]] const std::vector<std::string>& legacy_names();
/// What the files call one of them: "gl_Vertex" for "legacy_Vertex"; any other name as it is.
[[nodiscard]] std::string name_in_files(std::string_view name);
/// The other way round; empty for what is not built in.
[[nodiscard]] std::string legacy_name(std::string_view name_in_files);
/// The lookups that a vertex stage alone has in GLSL 1.10 and 1.20: `texture2DLod`.
[[nodiscard]] std::span<const std::string_view> lookups_of_level();
/// The folder of the include paths of those pieces.
inline constexpr std::string_view kLegacyFolder = "compatibility";
/// The include path of the piece that declares one of them.
[[nodiscard]] std::string legacy_piece(const std::string& name);

/// The text with each of them replaced, the longest that fits first; one that begins or ends as a name does
/// is not found within a longer name.
[[nodiscard]] std::string substituted(std::string_view text, const Substitutions& substitutions);

/// The text without `varying vec4 legacy_TexCoord[2];`, by which old shaders size what they had built in:
/// blanks stand there.
[[nodiscard]] std::string without_redeclarations(std::string text);

/// The head of a loop: `for (int i = 0; i < COUNT; i++) {`.
struct LoopHead {
    std::size_t begin;  ///< in the text
    std::size_t size;
    std::string index;  ///< the name that counts
    int first;
    std::string end;  ///< what it stays below
};

/// That of the first loop of a text; nothing where it has another form.
[[nodiscard]] std::optional<LoopHead> loop_head(const std::string& text);

/// Whether nothing but the loop stands in code without comments, beside the #pragma at its end.
[[nodiscard]] bool is_loop_alone(std::string_view code, const LoopHead& head);

/// A `break` or `continue`.
struct Jump {
    std::string word;
    int line;  ///< of the text, from 1
};

/// The first in code without comments that is the loop's own, not one of a loop or switch within it.
[[nodiscard]] std::optional<Jump> jump_of_loop(std::string_view code, const LoopHead& head);

/// The text with one round of its loop in the loop's place: the index is a constant, and
/// UNROLLED_LOOP_INDEX its number.
[[nodiscard]] std::string round_of_loop(const std::string& text, const LoopHead& head, int index);

/// The text with each line that a rule of the family fits written as `#include "path"`. Choices of pieces
/// and `varyings` keep their `#include <name>`.
[[nodiscard]] std::string with_includes(std::string_view text, const Family& family);

}  // namespace gobo
