// docs/models.md: every model with its pieces, a picture, and the errors that were measured.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "catalogue.hpp"
#include "core/file_system.hpp"
#include "figures.hpp"

namespace gobo::models {

/// The page. `files` holds the source tree at `root`; `figures` those of each family.
///
/// Errors: a key that does not check or has not the model that it is an example of; a model that no piece of
/// its example names in its header comment ("(S3)") or that no measured permutation has; a missing picture.
[[nodiscard]] Result<std::string> models_page(const FileSystem& files, const std::string& root,
                                              const std::vector<Model>& models,
                                              const std::map<std::string, Figures>& figures);

/// Whether two texts of the page say the same. Errors of the measured kind may differ by a tenth: the last
/// digits of sines and powers differ between the C libraries' builds for one processor and another.
[[nodiscard]] bool say_the_same(std::string_view page, std::string_view other);

}  // namespace gobo::models
