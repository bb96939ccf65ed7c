// Changes to whole modules: what is shipped, and what a pipeline makes of one.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <spirv-tools/libspirv.hpp>

#include "core/diagnostic.hpp"

namespace gobo::spirv {

using Words = std::vector<std::uint32_t>;

/// The module with arrays whose size hangs on these specialisation constants alone, by constant_id, as large
/// as values from 1 to their defaults make them: their size is fixed then, whatever a pipeline chooses.
[[nodiscard]] Result<Words> with_largest_arrays(std::span<const std::uint32_t> words,
                                                const std::set<std::uint32_t>& counts);

/// The module with its specialisation constants at the given values, by constant_id, and no longer to be
/// chosen; others stand at their defaults.
[[nodiscard]] Result<Words> specialized(const Words& words, const std::map<int, std::uint32_t>& values);

/// The module made faster by SPIRV-Tools' optimizer; specialisation constants stay.
[[nodiscard]] Result<Words> optimized(const Words& words, spv_target_env environment);

/// One of the texts that a module was made of, in its file.
struct TextOfFile {
    std::string path;
    int first_line = 1;
};

/// The module whose lines are said to be of the texts "0", "1" and so on, with those of the files.
[[nodiscard]] Words with_lines_of_files(const Words& words, const std::vector<TextOfFile>& texts);

/// The module without names, lines and source.
[[nodiscard]] Result<Words> without_names(const Words& words);

}  // namespace gobo::spirv
