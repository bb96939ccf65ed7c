#include "gobo/subject.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"

namespace gobo {
namespace {

Result<Subject> subject_of_files(const World& world, const std::vector<std::string>& names,
                                 const CommonOptions& options, Dialect dialect) {
    SearchPath search;
    for (const std::string& folder : options.include_folders) search.add(world.disk, folder, "", true);
    Result<Family> family = family_of_files(names, world.disk, search);
    if (!family) return tl::unexpected(family.error());
    Result<Composition> composition = compose(*family, {Key{}}, search, dialect);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(*family), std::move(*composition), true};
}

Result<Subject> subject_of_key(const World& world, const std::vector<std::string>& names,
                               const CommonOptions& options, Dialect dialect) {
    if (names.size() > 2) {
        return fail(Fault::usage, fmt::format("'{}' is one name too many", names[2]),
                    "name a family and a key, or shader files; quote a key that has blanks");
    }
    Result<LoadedFamily> family = load_family(world, names[0], options);
    if (!family) return tl::unexpected(family.error());
    SelectionOptions selection;
    selection.keys = {names.size() > 1 ? names[1] : "default"};
    Result<Composition> composition = load_composition(world, *family, selection, dialect);
    if (!composition) return tl::unexpected(composition.error());
    return Subject{std::move(family->family), std::move(*composition), false};
}

}  // namespace

Result<Subject> load_subject(const World& world, const std::vector<std::string>& names,
                             const CommonOptions& options, const std::string& dialect_name) {
    const Result<Dialect> dialect = read_dialect(dialect_name);
    if (!dialect) return tl::unexpected(dialect.error());
    const bool are_files = std::any_of(names.begin(), names.end(), is_shader_file);
    return are_files ? subject_of_files(world, names, options, *dialect)
                     : subject_of_key(world, names, options, *dialect);
}

}  // namespace gobo
