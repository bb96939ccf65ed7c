// Files on disk that are put in place as a whole: readers, builds at the same time and a death at any moment
// meet the old text or the new one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

struct NewFile {
    std::string path;
    std::string_view content;
};

/// Writes each file under a temporary name beside its own, making its folder, and renames them when all are
/// written, in the order given: what others are looked up by goes last. A file that already holds its text is
/// left untouched: false where all do. What an earlier writer left when it died is removed. Fault::file where
/// one cannot be written; until all are, none is replaced.
[[nodiscard]] Result<bool> write_together(const std::vector<NewFile>& files);

}  // namespace gobo
