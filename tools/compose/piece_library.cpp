#include "compose/piece_library.hpp"

#include <fmt/format.h>

#include "compose/conditions.hpp"
#include "compose/piece_marks.hpp"
#include "compose/specialized_counts.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// How many characters a text's first lines take.
std::size_t size_of_lines(std::string_view text, int lines) {
    std::size_t size = 0;
    for (; lines > 0 && size < text.size(); --lines) size = text.find('\n', size) + 1;
    return size;
}

/// Takes away the empty lines around a text, and says how many led it. Of one without code the last stays.
int cut_outer_empty_lines(std::string& text) {
    const std::size_t end = text.find_last_not_of('\n');
    if (end != std::string::npos) text.resize(std::min(end + 2, text.size()));
    const std::size_t begin =
        std::min(text.find_first_not_of('\n'), std::max<std::size_t>(text.size(), 1) - 1);
    text.erase(0, begin);
    return static_cast<int>(begin);
}

}  // namespace

const Feature* feature_defined_by(const Directive& directive, const Family& family) {
    if (directive.word != "define") return nullptr;
    const auto found = std::ranges::find(family.features, macro_name(directive.rest), &Feature::macro);
    return found == family.features.end() ? nullptr : &*found;
}

PieceLibrary::PieceLibrary(const Family& family, const SearchPath& search, Comments comments,
                           Composition& composition)
    : family_(family),
      search_(search),
      comments_(comments),
      composition_(composition),
      specialized_(specialized_counts(family, composition.dialect)),
      is_vulkan_(composition.dialect == Dialect::vulkan) {
    for (const Feature& feature : family.features) {
        if (!feature.macro.empty()) interest_.push_back(feature.macro);
        if (!feature.substituted.empty()) has_substitutions_ = true;
        if (feature.kind == FeatureKind::choice) chosen_functions_.insert(feature.macro);
    }
    for (const Varying& varying : family.varyings) interest_.push_back(varying.name);
    if (!family.substitutions.empty() || family.compatibility || is_vulkan_) has_substitutions_ = true;
    interest_.insert(interest_.end(), lookups_of_level().begin(), lookups_of_level().end());
    if (family.compatibility) interest_.insert(interest_.end(), legacy_names().begin(), legacy_names().end());
}

void PieceLibrary::substitute_for(const Key& key, StageKind stage) {
    if (!has_substitutions_) return;
    replaced_ = {substitutions_of(family_, key),
                 family_.compatibility ? legacy_substitutions(stage) : Substitutions{},
                 {}};
    if (is_vulkan_ && stage == StageKind::vertex)
        replaced_.by_vulkan = {{"gl_VertexID", "gl_VertexIndex"}, {"gl_InstanceID", "gl_InstanceIndex"}};
    const auto next = static_cast<int>(variants_.size());
    variant_ = variants_.try_emplace(replaced_, next).first->second;
}

Result<int> PieceLibrary::prologue(const PrologueText& part) {
    const std::string name =
        fmt::format("{}[prologue{}{}]", family_.name, part.stage.empty() ? "" : ".", part.stage);
    const std::string lines_before(static_cast<std::size_t>(std::max(part.place.line - 1, 0)), '\n');
    GOBO_TRY(const int file, add_file({name, part.place.file, lines_before + part.text, false}, "", ""));
    const Source& source = sources_[static_cast<std::size_t>(file)];
    if (source.version.empty()) return file;
    return fail(source.version_line.place, source.version_line.line, "a #version in the family's prologue",
                fmt::format("write version = \"{}\" at the top of the family file", source.version));
}

int PieceLibrary::generated(Piece piece) {
    piece.first_line += cut_outer_empty_lines(piece.text);
    const auto [at, is_new] = by_generated_text_.try_emplace(std::pair(piece.text, piece.first_line), -1);
    if (is_new) at->second = add(std::move(piece), {std::vector<char>(interest_.size(), 0), nullptr});
    return at->second;
}

int PieceLibrary::round(int piece, const LoopHead& head, int index) {
    const auto [at, is_new] = rounds_.try_emplace({piece, index}, -1);
    if (!is_new) return at->second;
    Piece copy = composition_.piece(piece);
    copy.text = round_of_loop(copy.text, head, index);
    return at->second = add(std::move(copy), entry(piece));
}

void PieceLibrary::warn_once(Diagnostic warning) {
    Diagnostics& known = composition_.warnings;
    if (std::ranges::none_of(known, [&](const Diagnostic& one) {
            return one.place == warning.place && one.message == warning.message;
        }))
        known.push_back(std::move(warning));
}

void PieceLibrary::add_warnings() {
    for (const auto& [path, warning] : heads_)
        if (warning) composition_.warnings.push_back(*warning);
}

std::vector<StatedBinding> PieceLibrary::bindings(const std::vector<int>& pieces) const {
    std::map<std::string, StatedBinding> by_name;
    for (const int piece : pieces)
        for (const StatedBinding& stated : entry(piece).bindings) by_name.try_emplace(stated.name, stated);
    std::vector<StatedBinding> sorted;
    for (auto& [name, stated] : by_name) sorted.push_back(std::move(stated));
    return sorted;
}

int PieceLibrary::add(Piece piece, Entry entry) {
    if (piece.on_disk) composition_.files.insert(piece.path);
    composition_.pieces.push_back(std::move(piece));
    entries_.push_back(std::move(entry));
    return static_cast<int>(entries_.size()) - 1;
}

Result<std::optional<int>> PieceLibrary::load(const std::string& path, const std::string& root, Whose whose) {
    const std::tuple at(root, path, whose, variant_);
    if (const auto known = by_path_.find(at); known != by_path_.end()) return known->second;
    GOBO_TRY(std::optional<Piece> piece, search_.find(path, root, whose));
    if (!piece) return by_path_[at] = std::nullopt;
    const bool is_of_root = piece->path.ends_with("/" + path);
    const std::string found_in =
        is_of_root ? piece->path.substr(0, piece->path.size() - path.size() - 1) : "";
    GOBO_TRY(const int file, add_file(std::move(*piece), folder_of(path), found_in));
    return by_path_[at] = file;
}

std::string PieceLibrary::rewritten(const Piece& piece, bool is_legacy) const {
    std::string text = piece.text;
    const auto replace = [&](const Substitutions& substitutions) {
        if (!substitutions.empty()) text = substituted(text, substitutions);
    };
    // A family that extends one of ours may change what that has; else our pieces stay as they are.
    const bool is_kept = piece.is_shipped && (is_legacy || !family_.extends);
    if (!is_kept) replace(replaced_.by_family);
    if (!piece.is_shipped) {
        replace(replaced_.by_legacy);
        if (family_.compatibility) text = without_redeclarations(std::move(text));
    }
    replace(replaced_.by_vulkan);
    return family_.include_rules.empty() || is_kept ? text : with_includes(text, family_);
}

Result<int> PieceLibrary::add_file(Piece piece, std::string folder, std::string root) {
    if (piece.file_text.empty()) piece.file_text = piece.text;
    const bool is_legacy = piece.is_shipped && folder == kLegacyFolder;
    const std::string text = rewritten(piece, is_legacy);
    const std::tuple at(piece.path, piece.name, text == piece.text ? "" : text);
    if (const auto known = by_file_.find(at); known != by_file_.end()) return known->second;
    note_head(piece);
    GOBO_TRY(ScannedPiece scanned, scan_piece(text, piece.path, piece.text));
    if (const int line = line_of_subroutine_array(scanned.code, chosen_functions_); line > 0)
        return fail({piece.path, line, 0}, line_of(piece, line),
                    "an array of subroutine uniforms cannot be a feature: each of its elements chooses anew",
                    "declare a uniform, and a feature, for each element");
    std::vector<SubroutineUniform> subroutines = subroutine_uniforms(scanned.code);
    std::vector<SubroutineType> types = subroutine_types(scanned.code);
    if (!choose_subroutines(scanned.text, scanned.code, chosen_functions_)) subroutines.clear();
    for (const SubroutineUniform& uniform : subroutines) {
        const auto behind = std::ranges::find_if(
            scanned.directives, [&](const auto& next) { return next.place.line > uniform.line; });
        scanned.directives.insert(behind, {"subroutine",
                                           uniform.name,
                                           {piece.path, uniform.line, 0},
                                           std::string(line_of(piece, uniform.line))});
    }
    composition_.stated_bindings.merge(scanned.bindings);
    append(composition_.warnings, scanned.warnings);
    const int number = by_file_[at] = static_cast<int>(sources_.size());
    Source& source = sources_.emplace_back();
    source.name = piece.name;
    source.folder = std::move(folder);
    source.root = std::move(root);
    source.subroutines = std::move(subroutines);
    source.subroutine_types = std::move(types);
    add_pieces(source, piece, scanned);
    source.version = std::move(scanned.version);
    source.version_line = std::move(scanned.version_line);
    source.includes = std::move(scanned.includes);
    source.directives = std::move(scanned.directives);
    for (std::size_t i = 0; i < source.directives.size(); ++i)
        for (const auto& [feature, id] : specialized_)
            if (identifiers_of(source.directives[i].rest).contains(family_.features[feature].macro))
                source.asks_for_counts.emplace_back(feature, i);
    source.extensions = std::move(scanned.extensions);
    source.is_once = scanned.is_once;
    source.is_legacy = is_legacy;
    source.guard = std::move(scanned.guard);
    return number;
}

void PieceLibrary::note_head(const Piece& piece) {
    const bool is_head = piece.name.find('#') == std::string::npos;
    if (is_head) heads_[piece.path] = std::nullopt;
    const int line = is_head ? 0 : line_before_pieces(piece.file_text);
    if (line == 0) return;
    Diagnostic warning = fail({piece.path, line, 0}, line_of(piece, line),
                              "nothing includes this text: it stands before the first #piece",
                              "move it into the piece that needs it")
                             .value()
                             .front();
    warning.severity = Severity::warning;
    heads_.try_emplace(piece.path, std::move(warning));
}

void PieceLibrary::add_pieces(Source& source, const Piece& file, const ScannedPiece& scanned) {
    const std::string asking =
        with_largest_counts(comments_ == Comments::keep ? scanned.text : scanned.code, family_, specialized_);
    std::string_view text = asking;
    std::string_view code = scanned.code;
    int line = 1;  // the first of what is left
    const auto add_up_to = [&](int last) {
        Piece piece = file;
        const std::size_t size = size_of_lines(text, last - line + 1);
        const std::size_t code_size = size_of_lines(code, last - line + 1);
        piece.text = text.substr(0, size);
        piece.first_line = line + cut_outer_empty_lines(piece.text);
        const auto identifiers = identifiers_of(code.substr(0, code_size));
        Entry entry{{}, &source};
        for (const std::string& identifier : interest_)
            entry.mentions.push_back(identifiers.contains(identifier) ? 1 : 0);
        if (is_vulkan_) entry.bindings = stated_bindings(code.substr(0, code_size));
        source.pieces.push_back(add(std::move(piece), std::move(entry)));
        text.remove_prefix(size);
        code.remove_prefix(code_size);
        line = last + 1;
    };
    for (const Directive& directive : scanned.directives) {
        const bool parts = directive.word == "include" || directive.word == "subroutine" ||
                           (directive.word == "pragma" && family_.unrolls_loops);
        if (parts) add_up_to(directive.place.line);
        if (parts || directive.word == "extension" || feature_defined_by(directive, family_) != nullptr)
            source.is_fixed = false;
    }
    add_up_to(static_cast<int>(std::ranges::count(scanned.code, '\n')));
}
}  // namespace gobo
