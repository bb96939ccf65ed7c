// The pieces of a composition, each read and scanned once, and the files that includes mean.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "compose/composition.hpp"
#include "compose/rewrite.hpp"
#include "compose/scan_piece.hpp"
#include "compose/search_path.hpp"
#include "compose/subroutines.hpp"
#include "family/family.hpp"

namespace gobo {

/// An error at an include or another directive.
template <class Directive>
tl::unexpected<Diagnostics> fail_at(const Directive& directive, std::string message, std::string help) {
    return fail(directive.place, directive.line, std::move(message), std::move(help));
}

/// The feature whose macro a `#define` of the shaders defines; null for any other directive.
[[nodiscard]] const Feature* feature_defined_by(const Directive& directive, const Family& family);

/// A file with what the composer asks of it again and again. Includes below its top part it into several
/// pieces.
struct Source {
    std::string name;
    std::string folder;  ///< of its include path
    std::string root;    ///< of the folders searched the one that it was found in
    std::vector<int> pieces;
    std::string version;
    Directive version_line;
    std::vector<Include> includes;
    std::vector<Directive> directives;
    Extensions extensions;
    bool is_once = false;
    bool is_legacy = false;  ///< of templates/compatibility.glsl
    std::string guard;
    std::vector<SubroutineUniform> subroutines;  ///< those that become functions
    std::vector<SubroutineType> subroutine_types;
    /// Directives, by number, that mention a count which is to be specialised, by feature.
    std::vector<std::pair<int, std::size_t>> asks_for_counts;
    /// Whatever the macros are: one piece, its extensions under no condition, no macro of a feature defined.
    bool is_fixed = true;
};

/// The pieces of a composition, each read and scanned once, and the resolution of includes to them. Whatever
/// does not depend on the key is computed once.
class PieceLibrary {
  public:
    PieceLibrary(const Family& family, const SearchPath& search, Comments comments, Composition& composition);

    /// What the family substitutes is replaced as the key has it, in the files found from now on.
    void substitute_for(const Key& key, StageKind stage);

    /// The file that an include means: of a feature, the one for its value, nothing for a count of 0.
    /// `from` is the file that includes it; null: the family asks for it.
    [[nodiscard]] Result<std::optional<int>> find(const Include& include, const Key& key, StageKind stage,
                                                  const Source* from);
    /// gobo's own file that declares one of legacy_names(), whatever the user's files are called.
    [[nodiscard]] Result<int> legacy(const std::string& name, StageKind stage);

    /// The text that the family puts in front of stages, as a file.
    [[nodiscard]] Result<int> prologue(const PrologueText& part);

    /// The number of a generated text; equal texts have equal numbers.
    int generated(Piece piece);

    /// The piece with one round of its loop in the loop's place.
    int round(int piece, const LoopHead& head, int index);

    /// Features whose macros are subroutine uniforms of some stage: none of them is a macro.
    void are_subroutines(std::set<std::string> macros) { subroutines_ = std::move(macros); }
    [[nodiscard]] bool is_subroutine(const std::string& macro) const { return subroutines_.contains(macro); }

    /// Of a place that many keys come to.
    void warn_once(Diagnostic warning);
    /// What the composition is warned of when all of it is put together.
    void add_warnings();

    [[nodiscard]] const Source& source(int file) const { return sources_[static_cast<std::size_t>(file)]; }
    /// The file that a piece is of; null for a generated one.
    [[nodiscard]] const Source* source_of(int piece) const { return entry(piece).source; }

    /// Whether one of the pieces mentions an identifier that the dialects' prologues or the family ask for.
    [[nodiscard]] bool mentions(const std::vector<int>& pieces, std::string_view identifier) const {
        const auto index =
            static_cast<std::size_t>(std::ranges::find(interest_, identifier) - interest_.begin());
        return index < interest_.size() &&
               std::ranges::any_of(pieces, [&](int piece) { return entry(piece).mentions[index] != 0; });
    }

    /// What the pieces declare by BLOCK and SAMPLER, sorted by name; for Vulkan alone.
    [[nodiscard]] std::vector<StatedBinding> bindings(const std::vector<int>& pieces) const;

  private:
    /// What the composer asks of a piece.
    struct Entry {
        std::vector<char> mentions;  ///< per identifier of interest
        const Source* source;
        std::vector<StatedBinding> bindings = {};  ///< for Vulkan alone
    };

    [[nodiscard]] const Entry& entry(int piece) const { return entries_[static_cast<std::size_t>(piece)]; }

    int add(Piece piece, Entry entry);
    Result<std::optional<int>> load(const std::string& path, const std::string& root,
                                    Whose whose = Whose::anyone);
    /// The text of a file as the family rewrites it.
    [[nodiscard]] std::string rewritten(const Piece& piece, bool is_legacy) const;
    /// The number of a file, which is scanned where it is new, as the family rewrites it.
    Result<int> add_file(Piece piece, std::string folder, std::string root);
    /// Notes what stands before the first mark of a file that is split into pieces.
    void note_head(const Piece& piece);
    /// Parts a file at the includes below its top.
    void add_pieces(Source& source, const Piece& file, const ScannedPiece& scanned);

    /// A template or a file: PATH.STAGE.EXTENSION where there is one, else PATH; beside the file that
    /// includes it first, then from the folders searched.
    Result<std::optional<int>> find_file(const Include& include, StageKind stage, const Source* from);
    Result<std::optional<int>> find_value(const Include& include, const Feature& feature, int value,
                                          StageKind stage);
    /// The first of the files that there is.
    Result<std::optional<int>> first_of(const std::vector<std::string>& paths, const Source* from);
    /// The same; where there is none, an error that names the nearest to `wanted`.
    Result<std::optional<int>> first_of(const std::vector<std::string>& paths, const std::string& wanted,
                                        const Include& include, const Source* from, std::string message);

    const Family& family_;
    const SearchPath& search_;
    Comments comments_;
    std::map<std::string, std::optional<Diagnostic>> heads_;  ///< by path; nothing where it is included
    Composition& composition_;
    std::map<int, int> specialized_;  ///< counts, by feature
    bool is_vulkan_;
    /// What mentions() is asked for.
    std::vector<std::string> interest_ = {"BLOCK",   "VARYING", "ATTRIBUTE",           "OUTPUT",
                                          "SAMPLER", "DEPTH",   "early_fragment_tests"};
    std::deque<Entry> entries_;   ///< of the pieces
    std::deque<Source> sources_;  ///< not a vector: who holds one may load more of them
    /// What is replaced one after the other, and the number of that in `variants_`; 0 where nothing is.
    struct Replaced {
        Substitutions by_family;
        Substitutions by_legacy;  ///< `gl_Vertex` of compatibility = true
        Substitutions by_vulkan;  ///< in gobo's own files, too

        friend auto operator<=>(const Replaced&, const Replaced&) = default;
    };
    Replaced replaced_;
    std::map<Replaced, int> variants_;
    int variant_ = 0;
    bool has_substitutions_ = false;
    std::set<std::string> subroutines_;
    std::set<std::string> chosen_functions_;  ///< macros of choices: where a file has them as subroutines
    /// Root, path, whose and variant; also what is known to be absent.
    std::map<std::tuple<std::string, std::string, Whose, int>, std::optional<int>> by_path_;
    /// Path, name and, where something is replaced in it, text: two paths may lead to one file.
    std::map<std::tuple<std::string, std::string, std::string>, int> by_file_;
    std::map<std::pair<std::string, int>, int> by_generated_text_;  ///< and first line
    std::map<std::pair<int, int>, int> rounds_;                     ///< by piece and index
    /// Of a file the one that includes it; target of the include, value (-1 of a file), stage, variant.
    std::map<std::tuple<const Source*, std::string, int, StageKind, int>, std::optional<int>> by_choice_;
};

}  // namespace gobo
