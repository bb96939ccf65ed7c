// What the shaders of any key may hold: texts, their files, and the subroutine uniforms that features choose.
#include <algorithm>
#include <optional>
#include <utility>

#include "compose/compose.hpp"
#include "compose/piece_library.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// The files that the stage of any key may hold.
std::set<const Source*> reachable(const Family& family, PieceLibrary& library, StageKind stage) {
    Key key = default_key(family);
    library.substitute_for(key, stage);
    std::vector<std::pair<Include, const Source*>> open;
    const auto ask = [&](const std::string& path) {
        open.push_back({{false, path, {family.path, 0, 0}, ""}, nullptr});
    };
    for (const Templates& templates : family.programs) std::ranges::for_each(templates[stage], ask);
    if (stage == StageKind::vertex)
        for (const Varying& varying : family.varyings)
            if (!varying.piece.empty()) ask(varying.piece);
    std::set<const Source*> found;
    const auto visit = [&](int file) {
        const Source& source = library.source(file);
        if (!found.insert(&source).second) return;
        for (const Include& needed : source.includes) open.emplace_back(needed, &source);
        for (const Directive& directive : source.directives)
            if (directive.word == "include")
                if (const auto below = read_include(directive)) open.emplace_back(*below, &source);
    };
    for (const PrologueText& part : family.prologue)
        if (const auto file = library.prologue(part)) visit(*file);
    while (!open.empty()) {
        const auto [include, from] = open.back();
        open.pop_back();
        const std::optional<int> index =
            include.in_angles ? family.index_of(include.target.substr(0, include.target.find('/')))
                              : std::nullopt;
        const std::size_t values =
            index ? family.features[static_cast<std::size_t>(*index)].values.size() : 1;
        for (std::size_t value = 0; value < values; ++value) {
            if (index) key[static_cast<std::size_t>(*index)] = static_cast<int>(value);
            const auto file = library.find(include, key, stage, from);
            if (file && *file) visit(**file);  // what is missing is told where a key asks for it
        }
        if (index) key[static_cast<std::size_t>(*index)] = 0;
    }
    return found;
}

}  // namespace

std::vector<std::string> texts_of_all_keys(const Family& family, const SearchPath& search, Dialect dialect) {
    Composition composition;
    composition.dialect = dialect;
    PieceLibrary library(family, search, Comments::remove, composition);
    std::vector<std::string> texts;
    const auto add = [&](const std::string& text) { texts.push_back(text); };
    for (const Feature& feature : family.features)
        for (const auto& [value, text] : feature.texts) add(text.value_or(""));
    for (const PrologueText& part : family.prologue) add(part.text);
    for (const Varying& varying : family.varyings) add(varying.name + " " + varying.value);
    for (const StageNames& stage : kStages)
        for (const Source* source : reachable(family, library, stage.kind))
            for (const int piece : source->pieces) add(composition.piece(piece).text);
    return texts;
}

std::map<std::string, std::string> files_of_all_keys(const Family& family, const SearchPath& search,
                                                     Dialect dialect) {
    Composition composition;
    composition.dialect = dialect;
    PieceLibrary library(family, search, Comments::remove, composition);
    for (const StageNames& stage : kStages) (void)reachable(family, library, stage.kind);
    std::map<std::string, std::string> names;
    for (const Piece& piece : composition.pieces) {
        const std::size_t end = piece.file_text.empty() ? std::string::npos : piece.name.rfind('#');
        if (piece.on_disk) names[piece.path] = piece.name.substr(0, end);
    }
    return names;
}

std::set<std::string> subroutines_of_all_keys(const Family& family, const SearchPath& search,
                                              Dialect dialect) {
    const bool may_have_some = std::ranges::any_of(family.features, [](const Feature& feature) {
        return feature.kind == FeatureKind::choice && !feature.macro.empty();
    });
    if (!may_have_some || !search.may_hold("subroutine")) return {};
    Composition composition;
    composition.dialect = dialect;
    PieceLibrary library(family, search, Comments::remove, composition);
    std::set<std::string> names;
    for (const StageNames& stage : kStages)
        for (const Source* source : reachable(family, library, stage.kind))
            for (const SubroutineUniform& uniform : source->subroutines) names.insert(uniform.name);
    return names;
}
}  // namespace gobo
