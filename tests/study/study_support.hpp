// The shipped family, its study and the files that both need, for tests.
#pragma once

#include "lab/study/study.hpp"

namespace gobo::study {

/// lit from the source tree with where its pieces are.
struct LitUnderStudy {
    Family family;
    SearchPath search;
    Weights weights;
};
[[nodiscard]] const LitUnderStudy& lit_under_study();

/// Files as in the source tree: "data/meshes/teapot.obj".
[[nodiscard]] const FileSystem& source_files();

[[nodiscard]] Key lit_key(const std::string& text);

/// A family without an oracle, with one quality feature: `good`, `slow` (good with needless work) and
/// `rough`.
[[nodiscard]] Family read_small_family();
[[nodiscard]] SearchPath search_for_small_family();

/// As append_to_disk(), in memory.
[[nodiscard]] Append append_to(MemoryFileSystem& files);

/// lit, by so many threads.
[[nodiscard]] Subject lit_subject(int jobs = 2);

/// The shipped plan and weights.
[[nodiscard]] StudyOptions quick_options(std::vector<std::string> effects);

}  // namespace gobo::study
