#include "compose/compose.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/scan_piece.hpp"
#include "core/text.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// Includes nested deeper than this are refused: a chain of that length is a mistake.
constexpr std::size_t kDeepestInclude = 100;

tl::unexpected<Diagnostics> fail_at(const Include& include, std::string message, std::string help) {
    return fail(include.place, include.line, std::move(message), std::move(help));
}

template <class List, class Item>
bool has(const List& list, const Item& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

/// The pieces of a composition, each read and scanned once, and the resolution of includes to them. Whatever
/// does not depend on the key is computed once.
class PieceLibrary {
  public:
    /// What the composer asks of a piece again and again.
    struct Entry {
        std::string version;
        std::vector<Include> includes;
        std::vector<char> mentions;  ///< per identifier of interest
    };

    PieceLibrary(const Family& family, const SearchPath& search, Comments comments, Composition& composition)
        : family_(family), search_(search), comments_(comments), composition_(composition) {
        for (const Feature& feature : family.features)
            if (!feature.macro.empty()) interest_.push_back(feature.macro);
        for (const Varying& varying : family.varyings) interest_.push_back(varying.name);
    }

    /// The piece that an include means: of a feature, the one for its value, nothing for a count of 0.
    Result<std::optional<int>> find(const Include& include, const Key& key, StageKind stage) {
        const std::string name = include.target.substr(0, include.target.find('/'));
        const std::optional<int> index = include.of_feature ? family_.index_of(name) : std::nullopt;
        if (include.of_feature && !index) {
            std::vector<std::string> names = {"varyings"};
            for (const Feature& feature : family_.features) names.push_back(feature.name);
            return fail_at(include, fmt::format("family '{}' has no feature '{}'", family_.name, name),
                           suggestion(name, names));
        }
        const auto at = static_cast<std::size_t>(index.value_or(0));
        const auto choice = std::tuple(include.target, index ? key[at] : -1, stage);
        if (const auto known = by_choice_.find(choice); known != by_choice_.end()) return known->second;
        GOBO_TRY(
            const std::optional<int> piece,
            index ? find_value(include, family_.features[at], key[at], stage) : find_file(include, stage));
        return by_choice_[choice] = piece;
    }

    /// The number of a generated text; equal texts have equal numbers.
    int generated(Piece piece) {
        const auto [at, is_new] = by_generated_text_.try_emplace(piece.text, -1);
        if (is_new) at->second = add(std::move(piece), {{}, {}, std::vector<char>(interest_.size(), 0)});
        return at->second;
    }

    [[nodiscard]] const Entry& entry(int piece) const { return entries_[static_cast<std::size_t>(piece)]; }

    /// Whether one of the pieces mentions an identifier that the dialects' prologues or the family ask for.
    [[nodiscard]] bool mentions(const std::vector<int>& pieces, std::string_view identifier) const {
        const auto index =
            static_cast<std::size_t>(std::ranges::find(interest_, identifier) - interest_.begin());
        return index < interest_.size() &&
               std::ranges::any_of(pieces, [&](int piece) { return entry(piece).mentions[index] != 0; });
    }

  private:
    int add(Piece piece, Entry entry) {
        if (piece.on_disk) composition_.files.insert(piece.path);
        composition_.pieces.push_back(std::move(piece));
        entries_.push_back(std::move(entry));
        return static_cast<int>(entries_.size()) - 1;
    }

    /// "surface/normal.glsl" -> "surface/normal.frag.glsl"
    static std::string with_infix(const std::string& path, StageKind stage) {
        const auto dot = path.rfind('.');
        const auto slash = path.rfind('/');
        if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return path;
        return fmt::format("{}.{}{}", path.substr(0, dot), stage == StageKind::vertex ? "vert" : "frag",
                           path.substr(dot));
    }

    Result<std::optional<int>> load(const std::string& path) {
        if (const auto known = by_path_.find(path); known != by_path_.end()) return known->second;
        GOBO_TRY(std::optional<Piece> piece, search_.find(path));
        if (!piece) return by_path_[path] = std::nullopt;
        if (piece->file_text.empty()) piece->file_text = piece->text;
        GOBO_TRY(ScannedPiece scanned, scan_piece(std::move(piece->text), piece->path));
        piece->text = std::move(comments_ == Comments::keep ? scanned.text : scanned.code);
        Entry entry{std::move(scanned.version), std::move(scanned.includes), {}};
        for (const std::string& identifier : interest_)
            entry.mentions.push_back(scanned.identifiers.contains(identifier) ? 1 : 0);
        composition_.stated_bindings.merge(scanned.bindings);
        Diagnostics& warnings = composition_.warnings;
        warnings.insert(warnings.end(), scanned.warnings.begin(), scanned.warnings.end());
        return by_path_[path] = add(std::move(*piece), std::move(entry));
    }

    /// A template or a fixed piece: PATH.STAGE.EXTENSION where there is one, else PATH.
    Result<std::optional<int>> find_file(const Include& include, StageKind stage) {
        const std::string& path = include.target;
        if (!stays_inside(path))
            return fail_at(
                include, fmt::format("the path '{}' leaves the folders searched", path),
                "write a path relative to one of them, without '..' in front; name further folders with -I");
        const bool is_template = include.place.line == 0;  // no line of a file includes it
        return first_of({with_infix(path, stage), path}, path, include,
                        fmt::format("no {} '{}'", is_template ? "template" : "piece", path));
    }

    Result<std::optional<int>> find_value(const Include& include, const Feature& feature, int value,
                                          StageKind stage) {
        const bool is_count = feature.kind == FeatureKind::count;
        if (is_count && value == 0) return std::nullopt;
        const std::string& value_name =
            is_count ? feature.name : feature.values[static_cast<std::size_t>(value)];
        const std::string path = fmt::format("{}/{}.glsl", include.target, value_name);
        std::vector<std::string> candidates = {with_infix(path, stage), path};
        // `#include <feature/part>`: values without a file of their own share FEATURE/PART.glsl.
        if (include.target.find('/') != std::string::npos) candidates.push_back(include.target + ".glsl");
        return first_of(candidates, path, include,
                        is_count ? fmt::format("count '{}' has no piece '{}'", feature.name, path)
                                 : fmt::format("value '{}' of feature '{}' has no piece '{}'", value_name,
                                               feature.name, path));
    }

    /// The first of the files that there is; otherwise an error that names the nearest to `wanted`.
    Result<std::optional<int>> first_of(const std::vector<std::string>& paths, const std::string& wanted,
                                        const Include& include, std::string message) {
        for (const std::string& path : paths) {
            GOBO_TRY(const std::optional<int> piece, load(path));
            if (piece) return piece;
        }
        std::string help = fmt::format("searched {}", join(search_.folders(), ", "));
        if (const auto near = nearest(wanted, search_.all_include_paths()))
            help += fmt::format("; nearest: '{}'", *near);
        return fail_at(include, std::move(message), std::move(help));
    }

    const Family& family_;
    const SearchPath& search_;
    Comments comments_;
    Composition& composition_;
    /// What mentions() is asked for.
    std::vector<std::string> interest_ = {"BLOCK",   "VARYING", "ATTRIBUTE",           "OUTPUT",
                                          "SAMPLER", "DEPTH",   "early_fragment_tests"};
    std::deque<Entry> entries_;  ///< not a vector: who holds an entry may load more of them
    std::map<std::string, std::optional<int>, std::less<>> by_path_;  ///< also what is known to be absent
    std::map<std::string, int, std::less<>> by_generated_text_;
    /// Target of the include, value (-1 where it names a file), stage.
    std::map<std::tuple<std::string, int, StageKind>, std::optional<int>, std::less<>> by_choice_;
};

/// A stage being put together: the pieces placed so far and the includes that lead to the one being placed.
struct Placement {
    const Key& key;
    StageKind stage;
    const std::vector<int>* varyings;  ///< to write, in the vertex stage
    std::vector<int> placed = {};
    std::vector<int> open = {};   ///< pieces whose includes are being followed
    bool wants_varyings = false;  ///< an `#include <varyings>` was met
};

class Composer {
  public:
    Composer(const Family& family, const SearchPath& search, Dialect dialect, Comments comments)
        : family_(family), library_(family, search, comments, composition_) {
        composition_.dialect = dialect;
    }

    Result<void> add(const Key& key) {
        Placement fragment{key, StageKind::fragment, nullptr};
        GOBO_TRY_DO(follow_template(fragment, family_.fragment));
        const std::vector<int> read = varyings_read(fragment.placed);
        Placement vertex{key, StageKind::vertex, &read};
        GOBO_TRY_DO(follow_template(vertex, family_.vertex));
        const int vertex_stage = finish(vertex, read);
        composition_.permutations.push_back({key, vertex_stage, finish(fragment, read)});
        return {};
    }

    Composition result() && { return std::move(composition_); }

  private:
    Result<void> follow_template(Placement& placement, const std::string& path) {
        return path.empty() ? Result<void>() : follow(placement, {false, path, {family_.path, 0, 0}, ""});
    }

    /// Places a piece after everything it includes, once.
    Result<void> place(Placement& placement, int piece, const Include& from) {
        if (has(placement.placed, piece)) return {};
        if (has(placement.open, piece)) return cycle(placement, piece, from);
        if (placement.open.size() > kDeepestInclude)
            return fail_at(from, fmt::format("includes are nested more than {} deep", kDeepestInclude),
                           "include the piece from the template");
        placement.open.push_back(piece);
        for (const Include& include : library_.entry(piece).includes) GOBO_TRY_DO(follow(placement, include));
        placement.open.pop_back();
        placement.placed.push_back(piece);
        return {};
    }

    Result<void> follow(Placement& placement, const Include& include) {
        if (include.of_feature && include.target == "varyings" && !family_.index_of("varyings"))
            return follow_varyings(placement);
        GOBO_TRY(const std::optional<int> piece, library_.find(include, placement.key, placement.stage));
        return piece ? place(placement, *piece, include) : Result<void>{};
    }

    /// `#include <varyings>` in the vertex stage: the pieces that the written varyings need, then their
    /// declarations.
    Result<void> follow_varyings(Placement& placement) {
        if (placement.varyings == nullptr) return {};  // the fragment stage's stand behind its prologue
        placement.wants_varyings = true;
        for (const int index : *placement.varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            if (!varying.piece.empty())  // the family file asks for it
                GOBO_TRY_DO(follow(placement, {false, varying.piece, varying.place, ""}));
        }
        placement.placed.push_back(
            library_.generated(varyings_piece(*placement.varyings, placement.key, StageKind::vertex)));
        return {};
    }

    tl::unexpected<Diagnostics> cycle(const Placement& placement, int piece, const Include& from) const {
        std::string path;
        for (auto at = std::ranges::find(placement.open, piece); at != placement.open.end(); ++at)
            path += composition_.piece(*at).name + " -> ";
        return fail_at(from, "include cycle: " + path + composition_.piece(piece).name,
                       "move what both need into a piece of its own");
    }

    /// Indices of the varyings that some piece of the fragment stage mentions.
    [[nodiscard]] std::vector<int> varyings_read(const std::vector<int>& fragment) const {
        std::vector<int> read;
        for (std::size_t i = 0; i < family_.varyings.size(); ++i)
            if (library_.mentions(fragment, family_.varyings[i].name)) read.push_back(static_cast<int>(i));
        return read;
    }

    /// The declarations of varyings, each on the line of the family file where it stands, so that a
    /// diagnostic and the module's debug lines name that place; in the vertex stage also the functions that
    /// write them.
    [[nodiscard]] Piece varyings_piece(const std::vector<int>& varyings, const Key& key,
                                       StageKind stage) const {
        std::map<int, std::string> lines;
        std::string calls;
        std::string path = family_.path;
        int behind = 0;  // the first location that is still free
        for (const int index : varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            if (index == varyings.front()) path = varying.place.file;
            const bool is_counted = !varying.counts.empty();
            int values = 0;
            for (const int feature : varying.counts) values += key[static_cast<std::size_t>(feature)];
            const int elements = (values + varying.values_per_element - 1) / varying.values_per_element;
            const int location = is_counted ? behind : varying.location;
            behind = location + std::max(elements, 1);
            std::string& line = lines[varying.place.line];
            line += fmt::format("{}{}VARYING({}) {} {}{};", varying.interpolation,
                                varying.interpolation.empty() ? "" : " ", location, varying.type,
                                varying.name, is_counted ? fmt::format("[{}]", elements) : "");
            if (stage == StageKind::fragment) continue;
            std::string writer = "writeVarying" + varying.name;
            char& initial = writer[writer.size() - varying.name.size()];
            if (initial >= 'a' && initial <= 'z') initial = static_cast<char>(initial - 'a' + 'A');
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
        return {fmt::format("{}[varyings]", family_.name), std::move(path), std::move(text), false};
    }

    [[nodiscard]] Piece prologue(const Placement& placement, bool has_varyings) const {
        const std::string& version = library_.entry(placement.placed.back()).version;
        std::string text =
            dialect_prologue(composition_.dialect, placement.stage, version, [&](std::string_view name) {
                return (has_varyings && name == "VARYING") || library_.mentions(placement.placed, name);
            });
        for (std::size_t i = 0; i < family_.features.size(); ++i) {
            const Feature& feature = family_.features[i];
            const int value = placement.key[i];
            const bool is_defined =
                feature.kind == FeatureKind::count || (feature.kind == FeatureKind::define && value != 0);
            if (is_defined && library_.mentions(placement.placed, feature.macro))
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
        if (is_fragment && declares)
            stage.pieces.push_back(
                library_.generated(varyings_piece(read, placement.key, StageKind::fragment)));
        stage.pieces.insert(stage.pieces.end(), placement.placed.begin(), placement.placed.end());
        const auto [at, is_new] =
            numbers_.try_emplace(stage.pieces, static_cast<int>(composition_.stages.size()));
        if (is_new) composition_.stages.push_back(std::move(stage));
        return at->second;
    }

    const Family& family_;
    Composition composition_;
    PieceLibrary library_;
    std::map<std::vector<int>, int> numbers_;
};

}  // namespace

std::string_view name_of(StageKind kind) {
    return kind == StageKind::vertex ? "vertex" : "fragment";
}

std::string_view line_of(const Piece& piece, int number) {
    return line_of(piece.file_text.empty() ? piece.text : piece.file_text, number);
}

std::string source_of(const Composition& composition, const Stage& stage) {
    std::string source;
    for (const int piece : stage.pieces) source += composition.piece(piece).text;
    return source;
}

Result<Composition> compose(const Family& family, const std::vector<Key>& keys, const SearchPath& search,
                            Dialect dialect, Comments comments) {
    Composer composer(family, search, dialect, comments);
    for (const Key& key : keys) GOBO_TRY_DO(composer.add(key));
    return std::move(composer).result();
}

Diagnostics same_stages(const Family& family, const Composition& composition) {
    std::map<std::pair<int, int>, const Permutation*> first_of;
    std::string example;
    int more = -1;
    for (const Permutation& permutation : composition.permutations) {
        const auto [at, is_new] =
            first_of.try_emplace({permutation.vertex, permutation.fragment}, &permutation);
        if (is_new || ++more > 0) continue;
        example = fmt::format("the keys '{}' and '{}' compose to the same stages",
                              key_text(family, at->second->key), key_text(family, permutation.key));
    }
    if (example.empty()) return {};
    Diagnostics warnings =
        fail({family.path, 0, 0}, "", more == 0 ? example : fmt::format("{}; so do {} more", example, more),
             "add a rule: when = \"...\" with default = [...] for the feature that cannot matter there")
            .value();
    warnings.front().severity = Severity::warning;
    return warnings;
}

}  // namespace gobo
