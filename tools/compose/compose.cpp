#include "compose/compose.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "compose/conditions.hpp"
#include "compose/dialect.hpp"
#include "compose/piece_marks.hpp"
#include "compose/rewrite.hpp"
#include "compose/scan_piece.hpp"
#include "compose/subroutines.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// Includes nested deeper than this are refused: a chain of that length is a mistake.
constexpr std::size_t kDeepestInclude = 100;
/// What a stage may hold: files that include others twice, each below its top, double at every step.
constexpr std::size_t kMostIncludes = 10'000;
constexpr std::size_t kMostBytes = 16'000'000;
/// Of a loop that is unrolled.
constexpr int kMostRounds = 4096;

/// At an include or another directive.
template <class Directive>
tl::unexpected<Diagnostics> fail_at(const Directive& directive, std::string message, std::string help) {
    return fail(directive.place, directive.line, std::move(message), std::move(help));
}

/// How many characters a text's first lines take.
std::size_t size_of_lines(std::string_view text, int lines) {
    std::size_t size = 0;
    for (; lines > 0 && size < text.size(); --lines) size = text.find('\n', size) + 1;
    return size;
}

/// "sub/../a.glsl" -> "a.glsl", of a path that stays inside.
std::string without_dots(const std::string& path) {
    std::vector<std::string> parts;
    for (std::string& part : split(path, '/')) {
        if (part == "..") parts.pop_back();
        if (part != ".." && part != ".") parts.push_back(std::move(part));
    }
    return join(parts, "/");
}

template <class List, class Item>
bool has(const List& list, const Item& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

/// The feature whose macro a `#define` of the shaders defines; null for any other directive.
const Feature* feature_defined_by(const Directive& directive, const Family& family) {
    if (directive.word != "define") return nullptr;
    const auto found = std::ranges::find(family.features, macro_name(directive.rest), &Feature::macro);
    return found == family.features.end() ? nullptr : &*found;
}

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
    std::string guard;
    /// Whatever the macros are: one piece, its extensions under no condition, no macro of a feature defined.
    bool is_fixed = true;
};

/// The pieces of a composition, each read and scanned once, and the resolution of includes to them. Whatever
/// does not depend on the key is computed once.
class PieceLibrary {
  public:
    PieceLibrary(const Family& family, const SearchPath& search, Comments comments, Composition& composition)
        : family_(family), search_(search), comments_(comments), composition_(composition) {
        for (const Feature& feature : family.features) {
            if (!feature.macro.empty()) interest_.push_back(feature.macro);
            if (!feature.substituted.empty()) has_substitutions_ = true;
            if (feature.kind == FeatureKind::choice) chosen_functions_.insert(feature.macro);
        }
        for (const Varying& varying : family.varyings) interest_.push_back(varying.name);
        if (!family.substitutions.empty() || family.compatibility) has_substitutions_ = true;
        if (family.compatibility)
            interest_.insert(interest_.end(), legacy_names().begin(), legacy_names().end());
    }

    /// What the family substitutes is replaced as the key has it, in the files found from now on.
    void substitute_for(const Key& key, StageKind stage) {
        if (!has_substitutions_) return;
        substitutions_ = substitutions_of(family_, key, stage);
        const auto next = static_cast<int>(variants_.size());
        variant_ = variants_.try_emplace(substitutions_, next).first->second;
    }

    /// The file that an include means: of a feature, the one for its value, nothing for a count of 0.
    /// `from` is the file that includes it; null: the family asks for it.
    Result<std::optional<int>> find(const Include& include, const Key& key, StageKind stage,
                                    const Source* from) {
        const std::string name = include.target.substr(0, include.target.find('/'));
        const std::optional<int> index =
            include.in_angles && is_feature_or_part(include.target) ? family_.index_of(name) : std::nullopt;
        const auto at = static_cast<std::size_t>(index.value_or(0));
        const auto choice =
            std::tuple(index ? nullptr : from, include.target, index ? key[at] : -1, stage, variant_);
        if (const auto known = by_choice_.find(choice); known != by_choice_.end()) return known->second;
        GOBO_TRY(const std::optional<int> file,
                 index ? find_value(include, family_.features[at], key[at], stage)
                       : find_file(include, stage, from));
        return by_choice_[choice] = file;
    }

    /// The text that the family puts in front of stages, as a file.
    Result<int> prologue(const PrologueText& part) {
        const std::string name =
            fmt::format("{}[prologue{}{}]", family_.name, part.stage.empty() ? "" : ".", part.stage);
        const std::string lines_before(static_cast<std::size_t>(std::max(part.place.line - 1, 0)), '\n');
        GOBO_TRY(const int file, add_file({name, part.place.file, lines_before + part.text, false}, "", ""));
        const Source& source = sources_[static_cast<std::size_t>(file)];
        if (source.version.empty()) return file;
        return fail(source.version_line.place, source.version_line.line,
                    "a #version in the family's prologue",
                    fmt::format("write version = \"{}\" at the top of the family file", source.version));
    }

    /// The number of a generated text; equal texts have equal numbers.
    int generated(Piece piece) {
        const auto [at, is_new] = by_generated_text_.try_emplace(piece.text, -1);
        if (is_new) at->second = add(std::move(piece), {std::vector<char>(interest_.size(), 0), nullptr});
        return at->second;
    }

    /// The piece with one round of its loop in the loop's place.
    int round(int piece, const LoopHead& head, int index) {
        const auto [at, is_new] = rounds_.try_emplace({piece, index}, -1);
        if (!is_new) return at->second;
        Piece copy = composition_.piece(piece);
        copy.text = round_of_loop(copy.text, head, index);
        return at->second = add(std::move(copy), entry(piece));
    }

    /// What the composition is warned of when all of it is put together.
    void add_warnings() {
        for (const auto& [path, warning] : heads_)
            if (warning) composition_.warnings.push_back(*warning);
    }

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

  private:
    /// What the composer asks of a piece.
    struct Entry {
        std::vector<char> mentions;  ///< per identifier of interest
        const Source* source;
    };

    [[nodiscard]] const Entry& entry(int piece) const { return entries_[static_cast<std::size_t>(piece)]; }

    int add(Piece piece, Entry entry) {
        if (piece.on_disk) composition_.files.insert(piece.path);
        composition_.pieces.push_back(std::move(piece));
        entries_.push_back(std::move(entry));
        return static_cast<int>(entries_.size()) - 1;
    }

    /// "fog" or "guards/unit_vector".
    static bool is_feature_or_part(std::string_view target) {
        const auto slash = target.find('/');
        return is_identifier(target.substr(0, slash)) &&
               (slash == std::string_view::npos || is_identifier(target.substr(slash + 1)));
    }

    /// "surface/normal.glsl" -> "surface/normal.frag.glsl"
    static std::string with_infix(const std::string& path, StageKind stage) {
        const auto dot = path.rfind('.');
        const auto slash = path.rfind('/');
        if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return path;
        return fmt::format("{}.{}{}", path.substr(0, dot), names_of(stage).infix, path.substr(dot));
    }

    Result<std::optional<int>> load(const std::string& path, const std::string& root) {
        const auto [known, is_new] = by_path_.try_emplace({root, path, variant_});
        if (!is_new) return known->second;
        GOBO_TRY(std::optional<Piece> piece, search_.find(path, root));
        if (!piece) return std::nullopt;
        const bool is_of_root = piece->path.ends_with("/" + path);
        const std::string found_in =
            is_of_root ? piece->path.substr(0, piece->path.size() - path.size() - 1) : "";
        GOBO_TRY(known->second, add_file(std::move(*piece), folder_of(path), found_in));
        return known->second;
    }

    /// The number of a file, which is scanned where it is new, as the family rewrites it.
    Result<int> add_file(Piece piece, std::string folder, std::string root) {
        if (piece.file_text.empty()) piece.file_text = piece.text;
        std::string text = substitutions_.empty() || folder == kLegacyFolder
                               ? piece.text
                               : substituted(piece.text, substitutions_);
        if (family_.compatibility && folder != kLegacyFolder) text = without_redeclarations(std::move(text));
        const auto [found, is_unread] = by_file_.try_emplace(
            {piece.path, piece.name, text == piece.text ? "" : text}, static_cast<int>(sources_.size()));
        if (!is_unread) return found->second;
        note_head(piece);
        GOBO_TRY(ScannedPiece scanned,
                 scan_piece(family_.include_rules.empty() ? text : with_includes(text, family_), piece.path,
                            piece.text));
        choose_subroutines(scanned.text, scanned.code, chosen_functions_);
        composition_.stated_bindings.merge(scanned.bindings);
        Diagnostics& warnings = composition_.warnings;
        warnings.insert(warnings.end(), scanned.warnings.begin(), scanned.warnings.end());
        Source& source = sources_.emplace_back();
        source.name = piece.name;
        source.folder = std::move(folder);
        source.root = std::move(root);
        add_pieces(source, piece, scanned);
        source.version = std::move(scanned.version);
        source.version_line = std::move(scanned.version_line);
        source.includes = std::move(scanned.includes);
        source.directives = std::move(scanned.directives);
        source.extensions = std::move(scanned.extensions);
        source.is_once = scanned.is_once;
        source.guard = std::move(scanned.guard);
        return found->second;
    }

    /// Notes what stands before the first mark of a file that is split into pieces.
    void note_head(const Piece& piece) {
        const bool is_head = piece.name.find('#') == std::string::npos;
        if (is_head) heads_[piece.path] = std::nullopt;
        const int line = is_head || !piece.on_disk ? 0 : line_before_pieces(piece.file_text);
        if (line == 0) return;
        Diagnostic warning = fail({piece.path, line, 0}, line_of(piece, line),
                                  "nothing includes this text: it stands before the first #piece",
                                  "move it into the piece that needs it")
                                 .value()
                                 .front();
        warning.severity = Severity::warning;
        heads_.try_emplace(piece.path, std::move(warning));
    }

    /// Parts a file at the includes below its top. Each part begins with as many empty lines as stand before
    /// it, so that lines have the file's numbers.
    void add_pieces(Source& source, const Piece& file, const ScannedPiece& scanned) {
        std::string_view text = comments_ == Comments::keep ? scanned.text : scanned.code;
        std::string_view code = scanned.code;
        int line = 1;  // the first of what is left
        const auto add_up_to = [&](int last) {
            Piece piece = file;
            piece.text.assign(static_cast<std::size_t>(line - 1), '\n');
            const std::size_t size = size_of_lines(text, last - line + 1);
            const std::size_t code_size = size_of_lines(code, last - line + 1);
            piece.text += text.substr(0, size);
            const auto identifiers = identifiers_of(code.substr(0, code_size));
            Entry entry{{}, &source};
            for (const std::string& identifier : interest_)
                entry.mentions.push_back(identifiers.contains(identifier) ? 1 : 0);
            source.pieces.push_back(add(std::move(piece), std::move(entry)));
            text.remove_prefix(size);
            code.remove_prefix(code_size);
            line = last + 1;
        };
        for (const Directive& directive : scanned.directives) {
            const bool parts =
                directive.word == "include" || (directive.word == "pragma" && family_.unrolls_loops);
            if (parts) add_up_to(directive.place.line);
            if (parts || directive.word == "extension" || feature_defined_by(directive, family_) != nullptr)
                source.is_fixed = false;
        }
        add_up_to(static_cast<int>(std::ranges::count(scanned.code, '\n')));
    }

    /// A template or a file: PATH.STAGE.EXTENSION where there is one, else PATH; beside the file that
    /// includes it first, then from the folders searched.
    Result<std::optional<int>> find_file(const Include& include, StageKind stage, const Source* from) {
        std::vector<std::string> candidates;
        for (const std::string& folder : {from == nullptr ? "" : from->folder, std::string()}) {
            const std::string& target = include.target;
            const std::string wanted = folder.empty() ? target : folder + "/" + target;
            if (target.starts_with('/') || !stays_inside(wanted)) continue;
            const std::string path = without_dots(wanted);
            candidates.insert(candidates.end(), {with_infix(path, stage), path});
            if (include.in_angles && target.find('.') == std::string::npos)
                candidates.insert(candidates.end(), {with_infix(path + ".glsl", stage), path + ".glsl"});
        }
        if (candidates.empty() && include.target.find('\\') != std::string::npos)
            return fail_at(include, fmt::format("the path '{}' holds a '\\'", include.target),
                           "write / between folder and file");
        if (candidates.empty())
            return fail_at(
                include, fmt::format("the path '{}' leaves the folders searched", include.target),
                "write a path relative to one of them, without '..' in front; name further folders with -I");
        const std::string name = include.target.substr(0, include.target.find('/'));
        if (include.in_angles && is_feature_or_part(include.target)) {
            GOBO_TRY(const std::optional<int> file, first_of(candidates, from));
            if (file) return file;
            std::vector<std::string> names = {"varyings"};
            for (const Feature& feature : family_.features) names.push_back(feature.name);
            return fail_at(include, fmt::format("family '{}' has no feature '{}'", family_.name, name),
                           suggestion(name, names));
        }
        const bool is_template = include.place.line == 0;  // no line of a file includes it
        return first_of(candidates, include.target, include, from,
                        fmt::format("no {} '{}'", is_template ? "template" : "piece", include.target));
    }

    Result<std::optional<int>> find_value(const Include& include, const Feature& feature, int value,
                                          StageKind stage) {
        const bool is_count = feature.kind == FeatureKind::count;
        if (is_count && feature.lowest + value == 0) return std::nullopt;
        const std::string& value_name =
            is_count ? feature.name : feature.values[static_cast<std::size_t>(value)];
        const std::string path = fmt::format("{}/{}.glsl", include.target, value_name);
        std::vector<std::string> candidates = {with_infix(path, stage), path};
        // `#include <feature/part>`: values without a file of their own share FEATURE/PART.glsl.
        if (include.target.find('/') != std::string::npos) candidates.push_back(include.target + ".glsl");
        return first_of(candidates, path, include, nullptr,
                        is_count ? fmt::format("count '{}' has no piece '{}'", feature.name, path)
                                 : fmt::format("value '{}' of feature '{}' has no piece '{}'", value_name,
                                               feature.name, path));
    }

    /// The first of the files that there is.
    Result<std::optional<int>> first_of(const std::vector<std::string>& paths, const Source* from) {
        for (const std::string& path : paths) {
            GOBO_TRY(const std::optional<int> file, load(path, from == nullptr ? "" : from->root));
            if (file) return file;
        }
        return std::nullopt;
    }

    /// The same; where there is none, an error that names the nearest to `wanted`.
    Result<std::optional<int>> first_of(const std::vector<std::string>& paths, const std::string& wanted,
                                        const Include& include, const Source* from, std::string message) {
        GOBO_TRY(const std::optional<int> file, first_of(paths, from));
        if (file) return file;
        std::string help = fmt::format("searched {}", join(search_.folders(), ", "));
        const std::vector<std::string> all = search_.all_include_paths();
        const auto near = nearest(wanted, all);
        if (near == wanted) {  // there, but all of it stands behind marks
            const std::string folder = wanted.substr(0, wanted.rfind('.')) + "/";
            const auto piece =
                std::ranges::find_if(all, [&](const auto& path) { return path.starts_with(folder); });
            if (piece != all.end())
                help = fmt::format("'{}' is split into pieces: write which one, as \"{}\"", wanted, *piece);
        } else if (near) {
            help += fmt::format("; nearest: '{}'", *near);
        }
        return fail_at(include, std::move(message), std::move(help));
    }

    const Family& family_;
    const SearchPath& search_;
    Comments comments_;
    std::map<std::string, std::optional<Diagnostic>> heads_;  ///< by path; nothing where it is included
    Composition& composition_;
    /// What mentions() is asked for.
    std::vector<std::string> interest_ = {"BLOCK",   "VARYING", "ATTRIBUTE",           "OUTPUT",
                                          "SAMPLER", "DEPTH",   "early_fragment_tests"};
    std::deque<Entry> entries_;   ///< of the pieces
    std::deque<Source> sources_;  ///< not a vector: who holds one may load more of them
    /// What features replace, and the number of that in `variants_`; 0 where none does.
    Substitutions substitutions_;
    std::map<Substitutions, int> variants_;
    int variant_ = 0;
    bool has_substitutions_ = false;
    std::set<std::string> chosen_functions_;  ///< macros of choices: where a file has them as subroutines
    /// Root, path and variant; also what is known to be absent.
    std::map<std::tuple<std::string, std::string, int>, std::optional<int>> by_path_;
    /// Path, name and, where something is replaced in it, text: two paths may lead to one file.
    std::map<std::tuple<std::string, std::string, std::string>, int> by_file_;
    std::map<std::string, int, std::less<>> by_generated_text_;
    std::map<std::pair<int, int>, int> rounds_;  ///< by piece and index
    /// Of a file the one that includes it; target of the include, value (-1 of a file), stage, variant.
    std::map<std::tuple<const Source*, std::string, int, StageKind, int>, std::optional<int>> by_choice_;
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
    std::optional<Conditions> conditions = {};
    std::size_t walked = 0;  ///< the pieces whose directives `conditions` has taken in
};

class Composer {
  public:
    Composer(const Family& family, const SearchPath& search, Dialect dialect, Comments comments)
        : family_(family), library_(family, search, comments, composition_) {
        composition_.dialect = dialect;
    }

    Result<void> add(const Key& key) {
        // The fragment stage comes first: the vertex stage writes what it reads.
        Placement fragment{key, StageKind::fragment, nullptr};
        GOBO_TRY_DO(follow_templates(fragment));
        const std::vector<int> read = varyings_read(fragment.placed);
        Permutation permutation{key};
        for (const StageNames& stage : kStages) {
            Placement placement{key, stage.kind, stage.kind == StageKind::vertex ? &read : nullptr};
            const bool is_fragment = stage.kind == StageKind::fragment;
            if (!is_fragment) GOBO_TRY_DO(follow_templates(placement));
            permutation.stages[stage.kind] = finish(is_fragment ? fragment : placement, read);
        }
        composition_.permutations.push_back(std::move(permutation));
        return {};
    }

    /// Every identifier that the stages of any key may hold: of all that templates include, whichever value
    /// chooses it and whatever conditions say.
    std::set<std::string, std::less<>> all_identifiers() {
        std::set<std::string, std::less<>> identifiers;
        const auto add = [&](std::string_view text) {
            for (const std::string_view name : identifiers_of(text)) identifiers.emplace(name);
        };
        for (const Feature& feature : family_.features)
            for (const auto& [value, text] : feature.texts) add(text.value_or(""));
        for (const PrologueText& part : family_.prologue) add(part.text);
        for (const Varying& varying : family_.varyings) add(varying.name + " " + varying.value);
        for (const StageNames& stage : kStages)
            for (const Source* source : reachable(stage.kind))
                for (const int piece : source->pieces) add(composition_.piece(piece).text);
        return identifiers;
    }

    Composition result() && {
        library_.add_warnings();
        return std::move(composition_);
    }

  private:
    /// The files that the stage of any key may hold.
    std::set<const Source*> reachable(StageKind stage) {
        Key key = default_key(family_);
        library_.substitute_for(key, stage);
        std::vector<std::pair<Include, const Source*>> open;
        const auto ask = [&](const std::string& path) {
            open.push_back({{false, path, {family_.path, 0, 0}, ""}, nullptr});
        };
        for (const Templates& templates : family_.programs) std::ranges::for_each(templates[stage], ask);
        if (stage == StageKind::vertex)
            for (const Varying& varying : family_.varyings)
                if (!varying.piece.empty()) ask(varying.piece);
        std::set<const Source*> found;
        const auto visit = [&](int file) {
            const Source& source = library_.source(file);
            if (!found.insert(&source).second) return;
            for (const Include& needed : source.includes) open.emplace_back(needed, &source);
            for (const Directive& directive : source.directives)
                if (directive.word == "include")
                    if (const auto below = read_include(directive)) open.emplace_back(*below, &source);
        };
        for (const PrologueText& part : family_.prologue)
            if (const auto file = library_.prologue(part)) visit(*file);
        while (!open.empty()) {
            const auto [include, from] = open.back();
            open.pop_back();
            const std::optional<int> index =
                include.in_angles ? family_.index_of(include.target.substr(0, include.target.find('/')))
                                  : std::nullopt;
            const std::size_t values =
                index ? family_.features[static_cast<std::size_t>(*index)].values.size() : 1;
            for (std::size_t value = 0; value < values; ++value) {
                if (index) key[static_cast<std::size_t>(*index)] = static_cast<int>(value);
                const auto file = library_.find(include, key, stage, from);
                if (file && *file) visit(**file);  // what is missing is told where a key asks for it
            }
            if (index) key[static_cast<std::size_t>(*index)] = 0;
        }
        return found;
    }

    Result<void> follow_templates(Placement& placement) {
        const std::vector<std::string>& paths = family_.templates_of(placement.key)[placement.stage];
        if (paths.empty()) return {};
        library_.substitute_for(placement.key, placement.stage);
        const auto asked = [&](const std::string& path) {
            return Include{false, path, {family_.path, 0, 0}, ""};
        };
        const Include first = asked(paths.front());
        GOBO_TRY(const std::optional<int> file,
                 library_.find(first, placement.key, placement.stage, nullptr));
        placement.version = family_.version;
        if (file && placement.version.empty()) placement.version = library_.source(*file).version;
        for (const PrologueText& part : family_.prologue) {
            if (!part.stage.empty() && part.stage != name_of(placement.stage)) continue;
            GOBO_TRY(const int prologue, library_.prologue(part));
            GOBO_TRY_DO(place(placement, prologue, first));
        }
        placement.behind_prologue = placement.placed.size();
        for (const std::string& path : paths) GOBO_TRY_DO(follow(placement, asked(path), nullptr));
        return family_.compatibility ? place_legacy(placement) : Result<void>();
    }

    /// Puts the declarations of what OpenGL had built in, and the stage mentions, behind the prologue.
    Result<void> place_legacy(Placement& placement) {
        const std::vector<int> mentioning = placement.placed;
        for (const std::string& name : legacy_names())
            if (library_.mentions(mentioning, name))
                GOBO_TRY_DO(
                    follow(placement, {false, legacy_piece(name), {family_.path, 0, 0}, ""}, nullptr));
        const auto begin = placement.placed.begin();
        const auto prologue = static_cast<std::ptrdiff_t>(placement.behind_prologue);
        const auto added = static_cast<std::ptrdiff_t>(mentioning.size());
        std::rotate(begin + prologue, begin + added, placement.placed.end());
        placement.behind_prologue += placement.placed.size() - mentioning.size();
        return {};
    }

    /// Refuses a file whose version is not the one that the family states.
    Result<void> check_version(const Source& source) const {
        const auto plain = [](std::string_view version) {
            std::string text;  // with one blank where there are several
            for (const char character : version)
                if (character != ' ' || !text.ends_with(' ')) text += character;
            return text.substr(0, text.find(" core"));
        };
        const bool is_free =
            source.version.empty() || family_.version.empty() || composition_.dialect != Dialect::own;
        if (is_free || plain(source.version) == plain(family_.version)) return {};
        return fail_at(source.version_line,
                       fmt::format("#version {} where the family states {}", source.version, family_.version),
                       fmt::format("leave one of them out: the family's is at {}:{}",
                                   family_.version_place.file, family_.version_place.line));
    }

    /// Refuses a `#define` that gives the macro of a feature another text.
    Result<void> check_macro(const Placement& placement, const Directive& directive) const {
        const Feature* feature = feature_defined_by(directive, family_);
        if (feature == nullptr || !placement.conditions->would_redefine(directive)) return {};
        return fail_at(
            directive,
            fmt::format("this gives '{}' another text than feature '{}' does", feature->macro, feature->name),
            fmt::format("put it between #ifndef {} and #endif, as what holds where the key leaves it "
                        "undefined; the feature is at {}:{}",
                        feature->macro, feature->place.file, feature->place.line));
    }

    /// Places a file: what it includes at its top, then its text.
    Result<void> place(Placement& placement, int file, const Include& include) {
        const Source& source = library_.source(file);
        if ((include.at_top || source.is_once) && has(placement.files, file)) return {};
        if (!include.at_top && !source.guard.empty()) {
            GOBO_TRY_DO(catch_up(placement));
            if (placement.conditions->is_defined(source.guard).value_or(0) != 0) return {};
        }
        if (has(placement.open, file)) {
            if (source.is_once) return {};
            return cycle(placement, file, include);
        }
        if (placement.open.size() > kDeepestInclude)
            return fail_at(include, fmt::format("includes are nested more than {} deep", kDeepestInclude),
                           "include the piece from the template");
        if (placement.files.size() > kMostIncludes || placement.bytes > kMostBytes)
            return fail_at(
                include,
                fmt::format("the stage takes more than {} includes or {} bytes", kMostIncludes, kMostBytes),
                "include files at the top, where each comes once, or put #pragma once into them");
        GOBO_TRY_DO(check_version(source));
        if (placement.version.empty()) placement.version = source.version;
        placement.open.push_back(file);
        for (const Include& needed : source.includes) GOBO_TRY_DO(follow(placement, needed, &source));
        GOBO_TRY_DO(place_text(placement, source));
        placement.open.pop_back();
        placement.files.push_back(file);
        return {};
    }

    void place_piece(Placement& placement, int piece) {
        placement.placed.push_back(piece);
        placement.bytes += composition_.piece(piece).text.size();
    }

    /// Places a file's pieces, with what it includes below its top between them.
    Result<void> place_text(Placement& placement, const Source& source) {
        for (const auto& [name, extension] : source.extensions)
            add_extension(placement.extensions, name, extension);
        if (source.is_fixed) {
            place_piece(placement, source.pieces.front());
            return {};
        }
        auto piece = source.pieces.begin();
        const Directive* loop = nullptr;  // the pragma before it
        for (const Directive& directive : source.directives) {
            GOBO_TRY_DO(catch_up(placement));
            Conditions& conditions = *placement.conditions;
            if (directive.word == "pragma" && family_.unrolls_loops) {
                const bool is_end = directive.rest == kUnrollEnd && loop != nullptr && conditions.is_active();
                if (is_end) {
                    GOBO_TRY_DO(place_rounds(placement, *piece++, *loop));
                } else {
                    place_piece(placement, *piece++);
                }
                loop = directive.rest == kUnrollStart ? &directive : nullptr;
                placement.walked = placement.placed.size();
            } else if (directive.word == "include") {
                if (loop != nullptr)
                    return fail_at(directive, "an #include within a loop that is to be unrolled",
                                   "write the loop into one file");
                place_piece(placement, *piece++);
                placement.walked = placement.placed.size();
                if (!conditions.is_active()) continue;
                GOBO_TRY(Include include, read_include(directive));
                include.at_top = false;
                GOBO_TRY_DO(follow(placement, include, &source));
            } else if (directive.word == "extension") {
                if (conditions.is_active())
                    add_extension(placement.extensions, directive, conditions.is_certain());
            } else {
                GOBO_TRY_DO(check_macro(placement, directive));
                GOBO_TRY_DO(conditions.apply(directive));
            }
        }
        GOBO_TRY_DO(catch_up(placement));
        place_piece(placement, *piece);
        placement.walked = placement.placed.size();
        return {};
    }

    /// Places a piece that is a loop as many times as that goes round.
    Result<void> place_rounds(Placement& placement, int piece, const Directive& start) {
        const std::optional<LoopHead> head = loop_head(composition_.piece(piece).text);
        if (!head)
            return fail_at(start, "the loop behind this has another form than can be unrolled",
                           "write for (int i = 0; i < COUNT; i++) { ... }, without an #include, between the "
                           "two pragmas");
        const Directive end{"if", head->end, start.place, start.line};
        GOBO_TRY(const Known count, placement.conditions->value_of(end));
        if (!count || *count > kMostRounds)
            return fail_at(start,
                           fmt::format("the loop behind this ends at '{}', which is no number below {}",
                                       head->end, kMostRounds),
                           "define it by a count of the family or a macro");
        for (int i = head->first; i < *count; ++i) place_piece(placement, library_.round(piece, *head, i));
        return {};
    }

    /// Lets the conditions take in the directives of all that is placed.
    Result<void> catch_up(Placement& placement) {
        if (!placement.conditions)
            placement.conditions.emplace(prologue_text(placement, [](std::string_view) { return true; }));
        for (; placement.walked < placement.placed.size(); ++placement.walked) {
            const Source* source = library_.source_of(placement.placed[placement.walked]);
            if (source == nullptr) continue;
            for (const Directive& directive : source->directives)
                GOBO_TRY_DO(placement.conditions->apply(directive));
        }
        return {};
    }

    Result<void> follow(Placement& placement, const Include& include, const Source* from) {
        if (include.in_angles && include.target == "varyings" && !family_.index_of("varyings"))
            return follow_varyings(placement);
        GOBO_TRY(const std::optional<int> file, library_.find(include, placement.key, placement.stage, from));
        return file ? place(placement, *file, include) : Result<void>{};
    }

    /// `#include <varyings>` in the vertex stage: the pieces that the written varyings need, then their
    /// declarations.
    Result<void> follow_varyings(Placement& placement) {
        if (placement.varyings == nullptr) return {};  // the fragment stage's stand behind its prologue
        placement.wants_varyings = true;
        for (const int index : *placement.varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            if (!varying.piece.empty())  // the family file asks for it
                GOBO_TRY_DO(follow(placement, {false, varying.piece, varying.place, ""}, nullptr));
        }
        placement.placed.push_back(
            library_.generated(varyings_piece(*placement.varyings, placement.key, StageKind::vertex)));
        return {};
    }

    tl::unexpected<Diagnostics> cycle(const Placement& placement, int file, const Include& from) const {
        std::string path;
        for (auto at = std::ranges::find(placement.open, file); at != placement.open.end(); ++at)
            path += library_.source(*at).name + " -> ";
        return fail_at(from, "include cycle: " + path + library_.source(file).name,
                       "move what both need into a piece of its own");
    }

    /// Indices of the varyings that some piece of the fragment stage mentions.
    [[nodiscard]] std::vector<int> varyings_read(const std::vector<int>& fragment) const {
        std::vector<int> read;
        for (std::size_t i = 0; i < family_.varyings.size(); ++i)
            if (library_.mentions(fragment, family_.varyings[i].name)) read.push_back(static_cast<int>(i));
        return read;
    }

    struct VaryingPlace {
        int location;
        int elements;  ///< of an array; 0 for a single one
    };

    /// Where the varyings stand: at the locations that the family states, arrays behind them. Where the gaps
    /// between them lead past the locations that every implementation has, they stand without gaps.
    [[nodiscard]] std::vector<VaryingPlace> places_of(const std::vector<int>& varyings,
                                                      const Key& key) const {
        constexpr int kGuaranteedLocations = 15;  // MAX_VARYING_COMPONENTS / 4
        std::vector<VaryingPlace> places;
        std::vector<VaryingPlace> packed;
        int behind = 0;  // the first location that is still free
        int packed_behind = 0;
        for (const int index : varyings) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
            int values = 0;
            for (const int feature : varying.counts) {
                const auto at = static_cast<std::size_t>(feature);
                values += family_.features[at].lowest + key[at];
            }
            const int elements = (values + varying.values_per_element - 1) / varying.values_per_element;
            const int locations = location_count(varying.type, {std::max(elements, 1)});
            places.push_back({varying.counts.empty() ? varying.location : behind, elements});
            packed.push_back({packed_behind, elements});
            behind = std::max(behind, places.back().location + locations);
            packed_behind += locations;
        }
        return behind > kGuaranteedLocations ? packed : places;
    }

    /// The declarations of varyings, each on the line of the family file where it stands, so that a
    /// diagnostic and the module's debug lines name that place; in the vertex stage also the functions that
    /// write them.
    [[nodiscard]] Piece varyings_piece(const std::vector<int>& varyings, const Key& key,
                                       StageKind stage) const {
        std::map<int, std::string> lines;
        std::string calls;
        std::string path = family_.path;
        const std::vector<VaryingPlace> places = places_of(varyings, key);
        for (std::size_t i = 0; i < varyings.size(); ++i) {
            const Varying& varying = family_.varyings[static_cast<std::size_t>(varyings[i])];
            if (i == 0) path = varying.place.file;
            std::string& line = lines[varying.place.line];
            line += fmt::format("{}{}VARYING({}) {} {}{};", varying.interpolation,
                                varying.interpolation.empty() ? "" : " ", places[i].location, varying.type,
                                varying.name,
                                varying.counts.empty() ? "" : fmt::format("[{}]", places[i].elements));
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

    [[nodiscard]] std::string prologue_text(const Placement& placement, const Mentions& mentions) const {
        std::string text = dialect_prologue(composition_.dialect, placement.stage, placement.version,
                                            placement.extensions, mentions);
        for (const std::string& definition : macros_of(placement, mentions)) text += definition;
        return text;
    }

    /// The macros of the features that the stage mentions, or that the text of another one does.
    [[nodiscard]] std::vector<std::string> macros_of(const Placement& placement,
                                                     const Mentions& mentions) const {
        std::vector<std::string> definitions(family_.features.size());
        std::set<std::string, std::less<>> mentioned;  // by texts
        for (bool goes_on = true; std::exchange(goes_on, false);) {
            for (std::size_t i = 0; i < definitions.size(); ++i) {
                const Feature& feature = family_.features[i];
                const bool is_in_stage =
                    feature.stages.empty() || has(feature.stages, name_of(placement.stage));
                if (feature.macro.empty() || !definitions[i].empty() || !is_in_stage) continue;
                if (!mentions(feature.macro) && !mentioned.contains(feature.macro)) continue;
                const std::optional<std::string> text = feature.text_of(placement.key[i]);
                if (!text) continue;
                definitions[i] =
                    fmt::format("#define {}{}{}\n", feature.macro, text->empty() ? "" : " ", *text);
                for (const std::string_view name : identifiers_of(*text))
                    goes_on = mentioned.emplace(name).second || goes_on;
            }
        }
        return definitions;
    }

    /// Puts the prologue in front and gives the stage its number; equal lists are the same stage.
    int finish(const Placement& placement, const std::vector<int>& read) {
        if (placement.placed.empty()) return -1;
        const bool is_fragment = placement.stage == StageKind::fragment;
        const bool declares = !read.empty() && (is_fragment || placement.wants_varyings);
        const auto mentions = [&](std::string_view name) {
            return (declares && name == "VARYING") || library_.mentions(placement.placed, name);
        };
        Piece prologue{"prologue", "prologue", prologue_text(placement, mentions), false};
        for (const auto& [name, extension] : placement.extensions) {
            const auto at =
                prologue.text.begin() +
                static_cast<std::ptrdiff_t>(prologue.text.find(fmt::format("#extension {} ", name)));
            const auto line = static_cast<int>(1 + std::count(prologue.text.begin(), at, '\n'));
            prologue.moved_lines[line] = {extension.place, extension.line};
        }
        Stage stage{placement.stage, {library_.generated(std::move(prologue))}};
        const auto behind_prologue =
            placement.placed.begin() + static_cast<std::ptrdiff_t>(placement.behind_prologue);
        stage.pieces.insert(stage.pieces.end(), placement.placed.begin(), behind_prologue);
        if (is_fragment && declares)
            stage.pieces.push_back(
                library_.generated(varyings_piece(read, placement.key, StageKind::fragment)));
        stage.pieces.insert(stage.pieces.end(), behind_prologue, placement.placed.end());
        const auto [at, is_new] =
            numbers_.try_emplace({stage.kind, stage.pieces}, static_cast<int>(composition_.stages.size()));
        if (is_new) composition_.stages.push_back(std::move(stage));
        return at->second;
    }

    const Family& family_;
    Composition composition_;
    PieceLibrary library_;
    std::map<std::pair<StageKind, std::vector<int>>, int> numbers_;  ///< one file may be both templates
};

}  // namespace

std::string_view line_of(const Piece& piece, int number) {
    return line_of(piece.file_text.empty() ? piece.text : piece.file_text, number);
}

void put_at(Diagnostic& diagnostic, const Piece& piece, int line) {
    const auto moved = piece.moved_lines.find(line);
    const bool is_moved = moved != piece.moved_lines.end();
    diagnostic.place = is_moved ? moved->second.first : Place{piece.path, line, 0};
    diagnostic.quoted_line = is_moved ? moved->second.second : line_of(piece, line);
}

std::string source_of(const Composition& composition, const Stage& stage) {
    std::string source;
    for (const int piece : stage.pieces) source += composition.piece(piece).text;
    return source;
}

Result<Composition> compose(const Family& family, const std::vector<Key>& keys, const SearchPath& search,
                            Dialect dialect, Comments comments) {
    Composer composer(family, search, dialect, comments);
    for (const Key& key : keys) {
        Result<void> added = composer.add(key);
        if (added) continue;
        for (Diagnostic& error : added.error())  // an include may mean another piece for another key
            if (error.place.line > 0) error.subject = key_text(family, key);
        return tl::unexpected(std::move(added.error()));
    }
    return std::move(composer).result();
}

std::set<std::string, std::less<>> identifiers_of_all_keys(const Family& family, const SearchPath& search,
                                                           Dialect dialect) {
    return Composer(family, search, dialect, Comments::remove).all_identifiers();
}

}  // namespace gobo
