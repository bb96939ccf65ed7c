#include "compose/compose.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "compose/placing.hpp"
#include "compose/specialized_counts.hpp"
#include "compose/stage_prologue.hpp"
#include "compose/varyings.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

class Composer {
  public:
    Composer(const Family& family, const SearchPath& search, Dialect dialect, Comments comments,
             const LiteralCounts& literal)
        : family_(family),
          literal_(literal),
          composition_(composition_for(dialect)),
          library_(family, search, comments, composition_),
          placer_(family, library_, composition_),
          specializer_(family, dialect) {
        library_.are_subroutines(subroutines_of_all_keys(family, search, dialect));
    }

    Result<void> add(const Key& key) {
        // The fragment stage comes first: the vertex stage writes what it reads.
        Placement fragment{key, StageKind::fragment, nullptr};
        GOBO_TRY_DO(placer_.follow_templates(fragment));
        const std::vector<int> read = varyings_read(family_, library_, fragment.placed);
        Permutation permutation{key};
        std::vector<Placement> placements;
        for (const StageNames& stage : kStages) {
            if (stage.kind == StageKind::fragment) {
                placements.push_back(std::move(fragment));
                continue;
            }
            const std::vector<int>* const written = stage.kind == StageKind::vertex ? &read : nullptr;
            placements.push_back(Placement{key, stage.kind, written});
            GOBO_TRY_DO(placer_.follow_templates(placements.back()));
        }
        GOBO_TRY(auto specialized, specializer_.in_stages(key, placements, read, library_));
        if (const auto literal = literal_.find(key); literal != literal_.end())
            for (const int feature : literal->second) specialized.erase(feature);
        for (const auto& [feature, id] : specialized)
            permutation.specialized.push_back({id, family_.features[feature].lowest + key[feature]});
        for (const Placement& placement : placements)
            permutation.stages[placement.stage] = finish(placement, read, specialized);
        composition_.permutations.push_back(std::move(permutation));
        return {};
    }

    Composition result() && {
        library_.add_warnings();
        composition_.notes = specializer_.notes();
        return std::move(composition_);
    }

  private:
    static Composition composition_for(Dialect dialect) {
        Composition composition;
        composition.dialect = dialect;
        return composition;
    }

    /// Puts the prologue in front and gives the stage its number; equal lists are the same stage.
    int finish(const Placement& placement, const std::vector<int>& read,
               const std::map<int, int>& specialized) {
        if (placement.placed.empty()) return -1;
        const bool is_fragment = placement.stage == StageKind::fragment;
        const bool declares = !read.empty() && (is_fragment || placement.wants_varyings);
        // What the shaders define themselves means what they say, though gobo's pieces use the same word.
        const auto defines = [&](std::string_view name) {
            return std::ranges::any_of(placement.placed, [&](int piece) {
                const Source* source = library_.source_of(piece);
                return source != nullptr &&
                       std::ranges::any_of(source->directives, [&](const Directive& found) {
                           return found.word == "define" && macro_name(found.rest) == name;
                       });
            });
        };
        constexpr std::array<std::string_view, 6> own = {"BLOCK",  "VARYING", "ATTRIBUTE",
                                                         "OUTPUT", "SAMPLER", "DEPTH"};
        const auto mentions = [&](std::string_view name) {
            if (declares && name == "VARYING") return true;
            return library_.mentions(placement.placed, name) &&
                   (std::ranges::find(own, name) == own.end() || !defines(name));
        };
        Piece prologue{
            "prologue", "prologue",
            stage_prologue(family_, composition_.dialect, placement, mentions, library_, specialized), false};
        int line = 0;
        for (std::string_view rest = prologue.text; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
            ++line;
            constexpr std::string_view word = "#extension ";
            if (!rest.starts_with(word)) continue;
            const std::string name(rest.substr(word.size(), rest.find(' ', word.size()) - word.size()));
            if (const auto stated = placement.extensions.find(name); stated != placement.extensions.end())
                prologue.moved_lines[line] = {stated->second.place, stated->second.line};
        }
        for (const Feature& feature : family_.features) {  // as macros of features, at those
            auto at = prologue.text.find(fmt::format("#define {} ", feature.macro));
            if (at == std::string::npos) at = prologue.text.find(fmt::format("#define {}\n", feature.macro));
            if (at == std::string::npos || feature.macro.empty()) continue;
            const auto lines = std::count(prologue.text.begin(),
                                          prologue.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
            prologue.moved_lines[static_cast<int>(1 + lines)] = {
                feature.place, prologue.text.substr(at, prologue.text.find('\n', at) - at)};
        }
        Stage stage{placement.stage, {library_.generated(std::move(prologue))}};
        const auto behind_prologue =
            placement.placed.begin() + static_cast<std::ptrdiff_t>(placement.behind_prologue);
        stage.pieces.insert(stage.pieces.end(), placement.placed.begin(), behind_prologue);
        if (is_fragment && declares)
            stage.pieces.push_back(
                library_.generated(varyings_piece(family_, read, placement.key, StageKind::fragment)));
        stage.pieces.insert(stage.pieces.end(), behind_prologue, placement.placed.end());
        const auto [at, is_new] =
            numbers_.try_emplace({stage.kind, stage.pieces}, static_cast<int>(composition_.stages.size()));
        if (is_new) composition_.stages.push_back(std::move(stage));
        return at->second;
    }

    const Family& family_;
    const LiteralCounts& literal_;
    Composition composition_;
    PieceLibrary library_;
    Placer placer_;
    CountSpecializer specializer_;
    std::map<std::pair<StageKind, std::vector<int>>, int> numbers_;  ///< one file may be both templates
};

}  // namespace

Result<Composition> compose(const Family& family, const std::vector<Key>& keys, const SearchPath& search,
                            Dialect dialect, Comments comments, const LiteralCounts& literal) {
    Composer composer(family, search, dialect, comments, literal);
    for (const Key& key : keys) {
        Result<void> added = composer.add(key);
        if (added) continue;
        for (Diagnostic& error : added.error())  // an include may mean another piece for another key
            if (error.place.line > 0) error.subject = key_text(family, key);
        return tl::unexpected(std::move(added.error()));
    }
    return std::move(composer).result();
}
}  // namespace gobo
