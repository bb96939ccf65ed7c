// A stage being put together: the files that its templates include, each at its place.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "compose/conditions.hpp"
#include "compose/piece_library.hpp"

namespace gobo {

/// A subroutine uniform that a feature chooses the function of.
struct ChosenSubroutine {
    SubroutineUniform uniform;
    SubroutineType type;
    Directive declared;
};

/// A stage being put together: the pieces placed so far and the includes that lead to the one being placed.
struct Placement {
    const Key& key;
    StageKind stage;
    const std::vector<int>* varyings;  ///< to write, in the vertex stage
    std::vector<int> placed = {};
    std::vector<int> files = {};  ///< whose text is placed
    std::vector<int> open = {};   ///< files whose includes are being followed
    std::size_t bytes = 0;
    std::size_t behind_prologue = 0;  ///< how many of `placed` are the family's prologue
    bool wants_varyings = false;      ///< an `#include <varyings>` was met
    Extensions extensions = {};
    std::string version = {};  ///< the family's, else the template's, else the first that a file states
    std::string version_beside = {};  ///< that of another stage of the program, for one that states none
    std::vector<ChosenSubroutine> subroutines = {};
    std::optional<Conditions> conditions = {};
    std::size_t walked = 0;  ///< the pieces whose directives `conditions` has taken in
};

/// Follows the includes of the family's templates, for one key and stage at a time.
class Placer {
  public:
    Placer(const Family& family, PieceLibrary& library, const Composition& composition)
        : family_(family), library_(library), composition_(composition) {}

    /// Places the family's prologue, the stage's templates and all that they include; nothing where the key
    /// has no such stage. Errors as compose() has them.
    [[nodiscard]] Result<void> follow_templates(Placement& placement);

  private:
    /// The version that the first file of another stage of the program states.
    std::string version_beside(const Placement& placement);
    /// Puts the declarations of what OpenGL had built in, and the stage mentions, behind the prologue.
    Result<void> place_legacy(Placement& placement);
    /// Refuses a file whose version is not the one that the family states, or that the stage begins with.
    Result<void> check_version(const Placement& placement, const Source& source) const;
    /// Refuses a `#define` that gives the macro of a feature another text.
    Result<void> check_macro(const Placement& placement, const Directive& directive) const;
    /// Places a file: what it includes at its top, then its text.
    Result<void> place(Placement& placement, int file, const Include& include);
    void place_piece(Placement& placement, int piece);
    /// A part of a file, unless it is but an empty line.
    void place_part(Placement& placement, int piece);
    /// Warns of those that end what another file asks for, which they do not.
    void take_extensions(Placement& placement, const Extensions& stated, int first_line = 0,
                         int last_line = std::numeric_limits<int>::max());
    /// Places a file's pieces, with what it includes below its top between them.
    Result<void> place_text(Placement& placement, const Source& source);
    /// Declares the function that a subroutine uniform becomes.
    Result<void> place_subroutine(Placement& placement, const Source& source, const Directive& declared);
    /// Behind all else, what those functions call.
    void place_called_functions(Placement& placement);
    /// Places a piece that is a loop as many times as that goes round.
    Result<void> place_rounds(Placement& placement, int piece, const Directive& start);
    /// Lets the conditions take in the directives of all that is placed.
    Result<void> catch_up(Placement& placement);
    Result<void> follow(Placement& placement, const Include& include, const Source* from);
    /// `#include <varyings>` in the vertex stage: the pieces that the written varyings need, then their
    /// declarations.
    Result<void> follow_varyings(Placement& placement);
    tl::unexpected<Diagnostics> cycle(const Placement& placement, int file, const Include& from) const;

    const Family& family_;
    PieceLibrary& library_;
    const Composition& composition_;
};

}  // namespace gobo
