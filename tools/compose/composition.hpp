// What composing gives: the distinct pieces, the distinct stages as lists of pieces, and the permutations.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/stage.hpp"
#include "family/family.hpp"

namespace gobo {

/// The GLSL dialect that a permutation is composed for.
enum class Dialect {
    own,       ///< the #version that the family's templates state themselves; 450 where they state none
    glsl450,   ///< desktop OpenGL 4.5
    glsl330,   ///< desktop OpenGL 3.3
    es300,     ///< OpenGL ES 3.0 and WebGL 2
    vulkan,    ///< GLSL 4.50 for Vulkan, shipped as SPIR-V
    gl_spirv,  ///< the same text as glsl450, shipped as SPIR-V for OpenGL 4.6
};

/// Whether headers hold the stages' SPIR-V instead of their texts.
[[nodiscard]] inline bool is_spirv(Dialect dialect) {
    return dialect == Dialect::vulkan || dialect == Dialect::gl_spirv;
}

/// Whether a composition's texts keep the comments of the files. Lines and columns are the same either way.
enum class Comments { remove, keep };

/// One text of a stage. All pieces of a stage, one after the other, are its source.
struct Piece {
    std::string name;  ///< portable: "shader_lib/fog.glsl#linear", or relative to the folder it was found in
    std::string path;  ///< as diagnostics and depfiles show it; for a generated piece, the file it comes from
    std::string text;  ///< what is validated and shipped: the file's lines from `first_line` on
    bool on_disk = false;        ///< read from a file that a depfile must name
    std::string file_text = {};  ///< all that its file holds, for messages that quote a line; of a generated
                                 ///< piece empty
    /// Of a prologue, by line: where an #extension stands, and that line.
    std::map<int, std::pair<Place, std::string>> moved_lines = {};
    bool is_shipped = false;  ///< gobo's own
    int first_line = 1;       ///< where in its file `text` starts: no empty lines lead it there

    /// The file's number of a line of `text`, counted from 1.
    [[nodiscard]] int line_in_file(int line) const { return first_line - 1 + line; }

    friend bool operator==(const Piece&, const Piece&) = default;
};

/// A line as the piece's file has it, by the file's number.
[[nodiscard]] std::string_view line_of(const Piece& piece, int number);

/// Puts a message at a line of a piece's file, which it quotes; at the line that was moved there, if so.
void put_at(Diagnostic& diagnostic, const Piece& piece, int line);

/// A stage is a list of pieces: the prologue first, then each piece once, depth first.
struct Stage {
    StageKind kind = StageKind::vertex;
    std::vector<int> pieces;  ///< indices into Composition::pieces

    friend bool operator==(const Stage&, const Stage&) = default;
};

/// A count that is a specialisation constant of a permutation's stages.
struct SpecializedCount {
    int id = 0;     ///< the constant_id
    int value = 0;  ///< the permutation's

    friend bool operator==(const SpecializedCount&, const SpecializedCount&) = default;
};

/// A canonical key with its stages.
struct Permutation {
    Key key;
    StageNumbers stages = {};  ///< indices into Composition::stages
    std::vector<SpecializedCount> specialized = {};
};

/// The permutations of one family, with every distinct piece and stage once.
struct Composition {
    std::vector<Piece> pieces;
    std::vector<Stage> stages;
    std::vector<Permutation> permutations;  ///< in the order of the keys asked for
    std::set<std::string> files;            ///< every file on disk that was read: for the depfile
    /// Bindings that pieces state by BLOCK(binding, name) and SAMPLER(binding, type) name, by name: some
    /// dialects' text cannot carry them.
    std::map<std::string, int> stated_bindings;
    Diagnostics warnings;  ///< of the pieces, by path and line
    Diagnostics notes;     ///< why keys keep counts as literals that the family wants specialised
    Dialect dialect = Dialect::own;

    [[nodiscard]] const Piece& piece(int number) const { return pieces[static_cast<std::size_t>(number)]; }
    [[nodiscard]] const Stage& stage(int number) const { return stages[static_cast<std::size_t>(number)]; }
};

/// The whole source of a stage: its pieces one after the other.
[[nodiscard]] std::string source_of(const Composition& composition, const Stage& stage);

}  // namespace gobo
