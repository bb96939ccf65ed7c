// From a family and keys to the distinct pieces, the stages as lists of them, and the permutations.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "compose/search_path.hpp"

namespace gobo {

/// By key the counts, by feature, that stay numbers though the family wants them specialised.
using LiteralCounts = std::map<Key, std::set<int>>;

/// Composes every key (canonical ones, as select() gives them). Each file is read and scanned once.
/// Errors name the include's file and line: a missing piece (with the folders searched and the nearest file),
/// an unknown feature, an include cycle (printed whole), a path that leaves the folders searched.
[[nodiscard]] Result<Composition> compose(const Family& family, const std::vector<Key>& keys,
                                          const SearchPath& search, Dialect dialect,
                                          Comments comments = Comments::remove,
                                          const LiteralCounts& literal = {});

/// The texts that the shaders of any key may hold, of all dialects' conditions.
[[nodiscard]] std::vector<std::string> texts_of_all_keys(const Family& family, const SearchPath& search,
                                                         Dialect dialect);

/// The files on disk that hold the pieces and templates of any key, and their portable names, by path.
[[nodiscard]] std::map<std::string, std::string> files_of_all_keys(const Family& family,
                                                                   const SearchPath& search, Dialect dialect);

/// The subroutine uniforms that stages of any key may hold and that choices of the family name. Their macros
/// are none: other stages may use the name otherwise.
[[nodiscard]] std::set<std::string> subroutines_of_all_keys(const Family& family, const SearchPath& search,
                                                            Dialect dialect);

}  // namespace gobo
