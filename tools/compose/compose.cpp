#include "compose/compose.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/piece_library.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// Includes nested deeper than this are refused: a chain of that length is a mistake.
constexpr std::size_t deepest_include = 100;

/// A stage being put together: the pieces placed so far and the includes that lead to the one being placed.
struct Placement {
    const Key& key;
    StageKind stage;
    std::vector<int> placed;
    std::map<int, std::vector<Renaming>> names;  ///< of the pieces placed under other names
    std::vector<int> open;                       ///< pieces whose includes are being followed
    bool wants_varyings = false;                 ///< an `#include <varyings>` was met
    const std::vector<int>* varyings = nullptr;  ///< to write, in the vertex stage
};

std::vector<std::string> identifiers_of_interest(const Family& family) {
    std::vector<std::string> names = {"BLOCK",   "VARYING", "ATTRIBUTE",           "OUTPUT",
                                      "SAMPLER", "DEPTH",   "early_fragment_tests"};
    for (const Feature& feature : family.features) {
        if (!feature.macro.empty()) names.push_back(feature.macro);
    }
    for (const Varying& varying : family.varyings) names.push_back(varying.name);
    return names;
}

class Composer {
  public:
    Composer(const Family& family, const SearchPath& search, Dialect dialect, Comments comments)
        : family_(family),
          dialect_(dialect),
          library_(family, search, identifiers_of_interest(family), comments) {}

    Diagnostics add(const Key& key) {
        Permutation permutation;
        permutation.key = key;
        Result<Placement> fragment = place_template(key, StageKind::fragment, family_.fragment, nullptr);
        if (!fragment) return fragment.error();
        const std::vector<int> read = varyings_read(fragment->placed);
        Result<Placement> vertex = place_template(key, StageKind::vertex, family_.vertex, &read);
        if (!vertex) return vertex.error();
        permutation.vertex = finish(*vertex, read);
        permutation.fragment = finish(*fragment, read);
        permutations_.push_back(std::move(permutation));
        return {};
    }

    Composition result() && {
        Composition composition;
        composition.pieces = library_.pieces();
        composition.stages = std::move(stages_);
        composition.permutations = std::move(permutations_);
        composition.files = library_.files();
        composition.stated_bindings = library_.stated_bindings();
        composition.warnings = library_.warnings();
        composition.dialect = dialect_;
        return composition;
    }

  private:
    Result<Placement> place_template(const Key& key, StageKind stage, const std::string& path,
                                     const std::vector<int>* varyings) {
        Placement placement{key, stage, {}, {}, {}, false, varyings};
        if (path.empty()) return placement;
        const Result<int> piece = library_.fixed(path, stage, nullptr);
        if (!piece) return tl::unexpected(piece.error());
        Diagnostics errors = place(placement, *piece, nullptr);
        if (!errors.empty()) return tl::unexpected(std::move(errors));
        return placement;
    }

    /// Places a piece after everything it includes, once.
    Diagnostics place(Placement& placement, int piece, const Include* from) {
        const std::vector<Renaming> renamings = from != nullptr ? from->renamings : std::vector<Renaming>{};
        if (std::find(placement.placed.begin(), placement.placed.end(), piece) != placement.placed.end())
            return renamings.empty() || placement.names[piece] == renamings ? Diagnostics{}
                                                                            : two_names(piece, *from);
        if (std::find(placement.open.begin(), placement.open.end(), piece) != placement.open.end()) {
            return cycle(placement, piece, *from);
        }
        if (placement.open.size() > deepest_include) return too_deep(*from);
        placement.open.push_back(piece);
        for (const Include& include : library_.entry(piece).includes) {
            Diagnostics errors = follow(placement, include);
            if (!errors.empty()) return errors;
        }
        placement.open.pop_back();
        put(placement, piece, renamings);
        return {};
    }

    /// The piece itself, its names changed by the preprocessor for as long as it lasts.
    void put(Placement& placement, int piece, const std::vector<Renaming>& renamings) {
        std::string before;
        std::string after;
        for (const Renaming& renaming : renamings) {
            before += fmt::format("#define {} {}\n", renaming.from, renaming.to);
            after += fmt::format("#undef {}\n", renaming.from);
        }
        const std::string& path = library_.entry(piece).piece.path;
        if (!before.empty()) placement.placed.push_back(library_.generated({"[renaming]", path, before}));
        placement.placed.push_back(piece);
        if (!after.empty()) placement.placed.push_back(library_.generated({"[renamed]", path, after}));
        placement.names[piece] = renamings;
    }

    Diagnostics two_names(int piece, const Include& from) const {
        Diagnostic diagnostic;
        diagnostic.place = from.place;
        diagnostic.quoted_line = from.line;
        diagnostic.message =
            fmt::format("'{}' is in this stage already, under other names", library_.entry(piece).piece.name);
        diagnostic.help = "include it with the same renaming everywhere; a stage holds each piece once";
        return {diagnostic};
    }

    Diagnostics follow(Placement& placement, const Include& include) {
        if (include.of_feature && include.target == "varyings" && !family_.index_of("varyings")) {
            return follow_varyings(placement);
        }
        if (!include.of_feature) {
            const Result<int> piece = library_.fixed(include.target, placement.stage, &include);
            return piece ? place(placement, *piece, &include) : piece.error();
        }
        const Result<std::optional<int>> piece = library_.chosen(include, placement.key, placement.stage);
        if (!piece) return piece.error();
        return *piece ? place(placement, **piece, &include) : Diagnostics{};
    }

    /// `#include <varyings>` in the vertex stage: the pieces that the written varyings need, then their
    /// declarations.
    Diagnostics follow_varyings(Placement& placement) {
        if (placement.varyings == nullptr) return {};  // the fragment stage's stand behind its prologue
        placement.wants_varyings = true;
        for (const int index : *placement.varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            if (varying.piece.empty()) continue;
            const Include needed{false, varying.piece, varying.place, ""};  // the family file asks for it
            const Result<int> piece = library_.fixed(varying.piece, placement.stage, &needed);
            Diagnostics errors = piece ? place(placement, *piece, &needed) : piece.error();
            if (!errors.empty()) return errors;
        }
        placement.placed.push_back(
            library_.generated(varyings_piece(*placement.varyings, placement.key, StageKind::vertex)));
        return {};
    }

    Diagnostics cycle(const Placement& placement, int piece, const Include& from) const {
        std::string path;
        const auto first = std::find(placement.open.begin(), placement.open.end(), piece);
        for (auto at = first; at != placement.open.end(); ++at)
            path += library_.entry(*at).piece.name + " -> ";
        path += library_.entry(piece).piece.name;
        Diagnostic diagnostic;
        diagnostic.place = from.place;
        diagnostic.quoted_line = from.line;
        diagnostic.message = "include cycle: " + path;
        diagnostic.help = "move what both need into a piece of its own";
        return {diagnostic};
    }

    static Diagnostics too_deep(const Include& from) {
        Diagnostic diagnostic;
        diagnostic.place = from.place;
        diagnostic.quoted_line = from.line;
        diagnostic.message = fmt::format("includes are nested more than {} deep", deepest_include);
        diagnostic.help = "include the piece from the template";
        return {diagnostic};
    }

    [[nodiscard]] bool mentions(const std::vector<int>& placed, std::string_view identifier) const {
        const auto& names = library_.interest();
        const auto index =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), identifier) - names.begin());
        return index < names.size() && std::any_of(placed.begin(), placed.end(), [&](int piece) {
                   return library_.entry(piece).mentions[index] != 0;
               });
    }

    /// Indices of the varyings that some piece of the fragment stage mentions.
    [[nodiscard]] std::vector<int> varyings_read(const std::vector<int>& fragment) const {
        std::vector<int> read;
        for (std::size_t i = 0; i < family_.varyings.size(); ++i) {
            if (mentions(fragment, family_.varyings[i].name)) read.push_back(static_cast<int>(i));
        }
        return read;
    }

    /// The declarations of varyings, each on the line of the family file where it stands, so that a
    /// diagnostic and the module's debug lines name that place; in the vertex stage also the functions that
    /// write them.
    [[nodiscard]] Piece varyings_piece(const std::vector<int>& varyings, const Key& key,
                                       StageKind stage) const {
        std::map<int, std::string> lines;
        std::string calls;
        int behind = 0;  // the first location that is still free
        for (const int index : varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            const std::string qualifier = varying.interpolation.empty() ? "" : varying.interpolation + " ";
            std::string& line = lines[varying.place.line];
            const int size = size_of(varying, key);
            const int location = varying.counts.empty() ? varying.location : behind;
            behind = location + std::max(size, 1);
            line += fmt::format("{}VARYING({}) {} {}{};", qualifier, location, varying.type, varying.name,
                                varying.counts.empty() ? "" : fmt::format("[{}]", size));
            if (stage == StageKind::fragment) continue;
            const std::string writer = writer_of(varying);
            line += fmt::format(" void {}() {{ {} = {}; }}", writer, varying.name, varying.value);
            calls += fmt::format("    {}();\n", writer);
        }
        std::string text;
        int at = 1;
        for (const auto& [line, declaration] : lines) {
            text.append(static_cast<std::size_t>(std::max(line - at, 0)), '\n');
            text += declaration + "\n";
            at = line + 1;
        }
        if (stage == StageKind::vertex) text += fmt::format("void writeVaryings() {{\n{}}}\n", calls);
        const std::string& path =
            varyings.empty() ? family_.path
                             : family_.varyings[static_cast<std::size_t>(varyings.front())].place.file;
        return {fmt::format("{}[varyings]", family_.name), path, std::move(text), false};
    }

    /// How many elements a counted varying has.
    static int size_of(const Varying& varying, const Key& key) {
        int values = 0;
        for (const int feature : varying.counts) values += key[static_cast<std::size_t>(feature)];
        return (values + varying.values_per_element - 1) / varying.values_per_element;
    }

    /// eyePosition -> writeVaryingEyePosition
    static std::string writer_of(const Varying& varying) {
        std::string name = varying.name;
        if (name.front() >= 'a' && name.front() <= 'z')
            name.front() = static_cast<char>(name.front() - 'a' + 'A');
        return "writeVarying" + name;
    }

    [[nodiscard]] Piece prologue(const Placement& placement, bool has_varyings) const {
        const std::string& version = library_.entry(placement.placed.back()).version;
        const Mentions asks = [&](std::string_view name) {
            return (has_varyings && name == "VARYING") || mentions(placement.placed, name);
        };
        std::string text = dialect_prologue(dialect_, placement.stage, version, asks);
        for (std::size_t i = 0; i < family_.features.size(); ++i) {
            const Feature& feature = family_.features[i];
            const int value = placement.key[i];
            const bool is_defined =
                feature.kind == FeatureKind::count || (feature.kind == FeatureKind::define && value != 0);
            if (is_defined && mentions(placement.placed, feature.macro))
                text += fmt::format("#define {} {}\n", feature.macro, value);
        }
        return {"prologue", "prologue", std::move(text), false};
    }

    /// Puts the prologue in front and gives the stage its number; equal lists are the same stage.
    int finish(const Placement& placement, const std::vector<int>& read) {
        if (placement.placed.empty()) return -1;
        const bool is_fragment = placement.stage == StageKind::fragment;
        const bool declares = !read.empty() && (is_fragment || placement.wants_varyings);
        Stage stage{placement.stage, {library_.generated(prologue(placement, declares))}};
        if (is_fragment && declares) {
            stage.pieces.push_back(
                library_.generated(varyings_piece(read, placement.key, StageKind::fragment)));
        }
        stage.pieces.insert(stage.pieces.end(), placement.placed.begin(), placement.placed.end());
        const auto [at, is_new] = numbers_.try_emplace(stage.pieces, static_cast<int>(stages_.size()));
        if (is_new) stages_.push_back(std::move(stage));
        return at->second;
    }

    const Family& family_;
    Dialect dialect_;
    PieceLibrary library_;
    std::vector<Stage> stages_;
    std::vector<Permutation> permutations_;
    std::map<std::vector<int>, int> numbers_;
};

}  // namespace

Result<Composition> compose(const Family& family, const std::vector<Key>& keys, const SearchPath& search,
                            Dialect dialect, Comments comments) {
    Composer composer(family, search, dialect, comments);
    for (const Key& key : keys) {
        Diagnostics errors = composer.add(key);
        if (!errors.empty()) return tl::unexpected(std::move(errors));
    }
    return std::move(composer).result();
}

}  // namespace gobo
