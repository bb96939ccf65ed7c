#include "compose/placing.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compose/clean_text.hpp"
#include "compose/stage_prologue.hpp"
#include "compose/varyings.hpp"

namespace gobo {
namespace {

/// Includes nested deeper than this are refused: a chain of that length is a mistake.
constexpr std::size_t kDeepestInclude = 100;
/// What a stage may hold: files that include others twice, each below its top, double at every step.
constexpr std::size_t kMostIncludes = 10'000;
constexpr std::size_t kMostBytes = 16'000'000;
/// Of a loop that is unrolled.
constexpr int kMostRounds = 4096;

/// Of those at its top.
int line_of_first_include(const Source& source) {
    return source.includes.empty() ? 0 : source.includes.front().place.line;
}

template <class List, class Item>
bool has(const List& list, const Item& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

Result<void> Placer::follow_templates(Placement& placement) {
    const std::vector<std::string>& paths = family_.templates_of(placement.key)[placement.stage];
    if (paths.empty()) return {};
    placement.version_beside = version_beside(placement);
    library_.substitute_for(placement.key, placement.stage);
    const auto asked = [&](const std::string& path) {
        return Include{false, path, {family_.path, 0, 0}, ""};
    };
    const Include first = asked(paths.front());
    GOBO_TRY(const std::optional<int> file, library_.find(first, placement.key, placement.stage, nullptr));
    placement.version = family_.version;
    if (file && placement.version.empty()) placement.version = library_.source(*file).version;
    for (const PrologueText& part : family_.prologue) {
        if (!part.stage.empty() && part.stage != name_of(placement.stage)) continue;
        GOBO_TRY(const int prologue, library_.prologue(part));
        GOBO_TRY_DO(place(placement, prologue, first));
    }
    placement.behind_prologue = placement.placed.size();
    for (const std::string& path : paths) GOBO_TRY_DO(follow(placement, asked(path), nullptr));
    place_called_functions(placement);
    return family_.compatibility ? place_legacy(placement) : Result<void>();
}

std::string Placer::version_beside(const Placement& placement) {
    if (composition_.dialect != Dialect::own || !family_.version.empty()) return {};
    for (const StageNames& stage : kStages) {
        const std::vector<std::string>& paths = family_.templates_of(placement.key)[stage.kind];
        if (stage.kind == placement.stage || paths.empty()) continue;
        library_.substitute_for(placement.key, stage.kind);
        const auto file = library_.find({false, paths.front(), {family_.path, 0, 0}, ""}, placement.key,
                                        stage.kind, nullptr);  // what is missing is told at its own stage
        if (file && *file && !library_.source(**file).version.empty()) return library_.source(**file).version;
    }
    return {};
}

Result<void> Placer::place_legacy(Placement& placement) {
    const std::vector<int> mentioning = placement.placed;
    for (const std::string& name : legacy_names())
        if (library_.mentions(mentioning, name)) {
            GOBO_TRY(const int file, library_.legacy(name, placement.stage));
            GOBO_TRY_DO(place(placement, file, {false, legacy_piece(name), {family_.path, 0, 0}, ""}));
        }
    const auto begin = placement.placed.begin();
    const auto prologue = static_cast<std::ptrdiff_t>(placement.behind_prologue);
    const auto added = static_cast<std::ptrdiff_t>(mentioning.size());
    std::rotate(begin + prologue, begin + added, placement.placed.end());
    placement.behind_prologue += placement.placed.size() - mentioning.size();
    return {};
}

Result<void> Placer::check_version(const Placement& placement, const Source& source) const {
    const auto plain = [](std::string_view version) {
        std::string text;  // with one blank where there are several
        for (const char character : version)
            if (character != ' ' || !text.ends_with(' ')) text += character;
        return text.substr(0, text.find(" core"));
    };
    if (source.version.empty() || composition_.dialect != Dialect::own) return {};
    if (family_.version.empty()) {
        const bool is_template = placement.open.empty();
        if (!is_template || placement.version.empty() || plain(source.version) == plain(placement.version))
            return {};
        return fail_at(source.version_line,
                       fmt::format("#version {} where the {} stage begins with {}", source.version,
                                   name_of(placement.stage), placement.version),
                       "a stage has one version: state the same in all of its files, or in the first alone");
    }
    if (plain(source.version) == plain(family_.version)) return {};
    return fail_at(source.version_line,
                   fmt::format("#version {} where the family states {}", source.version, family_.version),
                   fmt::format("leave one of them out: the family's is at {}:{}", family_.version_place.file,
                               family_.version_place.line));
}

Result<void> Placer::check_macro(const Placement& placement, const Directive& directive) const {
    const Feature* feature = feature_defined_by(directive, family_);
    if (feature == nullptr || !placement.conditions->would_redefine(directive)) return {};
    return fail_at(
        directive,
        fmt::format("this gives '{}' another text than feature '{}' does", feature->macro, feature->name),
        fmt::format("put it between #ifndef {} and #endif, as what holds where the key leaves it "
                    "undefined; the feature is at {}:{}",
                    feature->macro, feature->place.file, feature->place.line));
}

Result<void> Placer::place(Placement& placement, int file, const Include& include) {
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
    const char* const fewer =
        "include files at the top, where each comes once, or put #pragma once into them";
    if (placement.files.size() > kMostIncludes)
        return fail_at(include, fmt::format("the stage takes more than {} includes", kMostIncludes), fewer);
    if (placement.bytes > kMostBytes)
        return fail_at(include, fmt::format("the stage's text is longer than {} bytes", kMostBytes), fewer);
    GOBO_TRY_DO(check_version(placement, source));
    if (placement.version.empty()) placement.version = source.version;
    placement.open.push_back(file);
    take_extensions(placement, source.extensions, 0, line_of_first_include(source) - 1);
    for (const Include& needed : source.includes) GOBO_TRY_DO(follow(placement, needed, &source));
    GOBO_TRY_DO(place_text(placement, source));
    placement.open.pop_back();
    placement.files.push_back(file);
    return {};
}

void Placer::place_part(Placement& placement, int piece) {
    if (composition_.piece(piece).text != "\n") place_piece(placement, piece);
}

void Placer::place_piece(Placement& placement, int piece) {
    placement.placed.push_back(piece);
    placement.bytes += composition_.piece(piece).text.size();
}

void Placer::take_extensions(Placement& placement, const Extensions& stated, int first_line, int last_line) {
    for (const auto& [name, extension] : stated) {
        if (extension.place.line < first_line || extension.place.line > last_line) continue;
        const auto held = placement.extensions.find(name);
        if (held != placement.extensions.end() && extension.behavior == "disable" &&
            held->second.behavior != "disable")
            library_.warn_once(ended_extension(name, held->second, extension));
        add_extension(placement.extensions, name, extension);
    }
}

Result<void> Placer::place_text(Placement& placement, const Source& source) {
    take_extensions(placement, source.extensions, line_of_first_include(source));
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
            if (directive.rest == kUnrollStart && loop != nullptr)
                return fail_at(directive,
                               fmt::format("a loop to be unrolled within that behind line {}, which is to be "
                                           "unrolled, too",
                                           loop->place.line),
                               "take the two pragmas of one of them away");
            if (is_end) {
                GOBO_TRY_DO(place_rounds(placement, *piece++, *loop));
            } else {
                place_part(placement, *piece++);
            }
            loop = directive.rest == kUnrollStart && conditions.is_active() ? &directive : nullptr;
            placement.walked = placement.placed.size();
        } else if (directive.word == "include") {
            if (loop != nullptr)
                return fail_at(directive, "an #include within a loop that is to be unrolled",
                               "write the loop into one file");
            place_part(placement, *piece++);
            placement.walked = placement.placed.size();
            if (!conditions.is_active()) continue;
            GOBO_TRY(Include include, read_include(directive));
            include.at_top = false;
            GOBO_TRY_DO(follow(placement, include, &source));
        } else if (directive.word == "subroutine") {
            place_part(placement, *piece++);
            if (conditions.is_active()) GOBO_TRY_DO(place_subroutine(placement, source, directive));
            placement.walked = placement.placed.size();
        } else if (directive.word == "extension") {
            Extensions stated;
            if (conditions.is_active() && add_extension(stated, directive, conditions.is_certain()))
                take_extensions(placement, stated);
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

Result<void> Placer::place_subroutine(Placement& placement, const Source& source, const Directive& declared) {
    const SubroutineUniform& uniform =
        *std::ranges::find(source.subroutines, declared.rest, &SubroutineUniform::name);
    std::vector<int> files = placement.files;  // that of the type is among them, or being placed
    files.insert(files.end(), placement.open.begin(), placement.open.end());
    for (auto file = files.rbegin(); file != files.rend(); ++file) {
        const std::vector<SubroutineType>& types = library_.source(*file).subroutine_types;
        const auto type = std::ranges::find(types, uniform.type, &SubroutineType::name);
        if (type == types.end()) continue;
        placement.subroutines.push_back({uniform, *type, declared});
        Piece piece{"subroutines", "subroutines", prototype_of(uniform, *type) + ";\n"};
        piece.moved_lines[1] = {declared.place, declared.line};
        place_piece(placement, library_.generated(std::move(piece)));
        return {};
    }
    return fail_at(declared, fmt::format("no subroutine type '{}' is declared before this", uniform.type),
                   fmt::format("write subroutine RESULT {}(PARAMETERS); before it, or include the file that "
                               "does",
                               uniform.type));
}

void Placer::place_called_functions(Placement& placement) {
    Piece piece{"subroutines", "subroutines", ""};
    int line = 0;
    for (const ChosenSubroutine& chosen : placement.subroutines) {
        const auto feature = std::ranges::find(family_.features, chosen.uniform.name, &Feature::macro);
        const auto index = static_cast<std::size_t>(feature - family_.features.begin());
        const std::optional<std::string> function = feature->text_of(placement.key[index]);
        if (!function) continue;
        piece.text += call_of(chosen.uniform, chosen.type, *function) + "\n";
        piece.moved_lines[++line] = {chosen.declared.place, chosen.declared.line};
    }
    if (!piece.text.empty()) place_piece(placement, library_.generated(std::move(piece)));
}

Result<void> Placer::place_rounds(Placement& placement, int piece, const Directive& start) {
    const std::optional<LoopHead> head = loop_head(composition_.piece(piece).text);
    if (!head)
        return fail_at(start, "the loop behind this has another form than can be unrolled",
                       "write for (int i = 0; i < COUNT; i++) { ... }, with < and not <=, without an "
                       "#include, between the two pragmas");
    const Piece& whole = composition_.piece(piece);
    GOBO_TRY(const CleanText clean, clean_text(whole.text, whole.path));
    if (!is_loop_alone(clean.code, *head))
        return fail_at(start, "something other than the loop stands between the two pragmas",
                       "put the pragmas around the loop alone, and close it outside of conditions");
    if (const auto jump = jump_of_loop(clean.code, *head)) {
        const int line = whole.line_in_file(jump->line);
        return fail(Place{whole.path, line}, line_of(whole, line),
                    fmt::format("'{}' of a loop that is unrolled, which leaves no loop behind", jump->word),
                    "write the loop without it, or take the pragmas away");
    }
    const Directive end{"if", head->end, start.place, start.line};
    GOBO_TRY(const Known count, placement.conditions->value_of(end, true));
    if (!count || *count > kMostRounds)
        return fail_at(start,
                       fmt::format("the loop behind this ends at '{}', which is no number below {}",
                                   head->end, kMostRounds),
                       "define it by a count of the family or a macro");
    for (int i = head->first; i < *count; ++i) place_piece(placement, library_.round(piece, *head, i));
    return {};
}

Result<void> Placer::catch_up(Placement& placement) {
    if (!placement.conditions)
        placement.conditions.emplace(
            stage_prologue(
                family_, composition_.dialect, placement, [](std::string_view) { return true; }, library_),
            !is_spirv(composition_.dialect));
    for (; placement.walked < placement.placed.size(); ++placement.walked) {
        const Source* source = library_.source_of(placement.placed[placement.walked]);
        if (source == nullptr) continue;
        for (const Directive& directive : source->directives)
            GOBO_TRY_DO(placement.conditions->apply(directive));
    }
    return {};
}

Result<void> Placer::follow(Placement& placement, const Include& include, const Source* from) {
    if (include.in_angles && include.target == "varyings" && !family_.index_of("varyings"))
        return follow_varyings(placement);
    GOBO_TRY(const std::optional<int> file, library_.find(include, placement.key, placement.stage, from));
    return file ? place(placement, *file, include) : Result<void>{};
}

Result<void> Placer::follow_varyings(Placement& placement) {
    if (placement.varyings == nullptr) return {};  // the fragment stage's stand behind its prologue
    placement.wants_varyings = true;
    for (const int index : *placement.varyings) {
        const Varying& varying = family_.varyings[static_cast<std::size_t>(index)];
        if (!varying.piece.empty())  // the family file asks for it
            GOBO_TRY_DO(follow(placement, {false, varying.piece, varying.place, ""}, nullptr));
    }
    placement.placed.push_back(
        library_.generated(varyings_piece(family_, *placement.varyings, placement.key, StageKind::vertex)));
    return {};
}

tl::unexpected<Diagnostics> Placer::cycle(const Placement& placement, int file, const Include& from) const {
    std::string path;
    for (auto at = std::ranges::find(placement.open, file); at != placement.open.end(); ++at)
        path += library_.source(*at).name + " -> ";
    return fail_at(from, "include cycle: " + path + library_.source(file).name,
                   "move what both need into a piece of its own");
}
}  // namespace gobo
