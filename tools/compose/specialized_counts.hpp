// Counts of a family as specialisation constants of SPIR-V: one stage serves every count above 0.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "compose/placing.hpp"

namespace gobo {

/// Behind the macro of a count that is a specialisation constant: what its macro is named in conditions,
/// which ask for a macro where the count itself is a constant of the pipeline.
inline constexpr std::string_view kLargest = "_LARGEST";

/// The features that the family wants specialised, with their constant_id; none where texts are shipped.
[[nodiscard]] std::map<int, int> specialized_counts(const Family& family, Dialect dialect);

/// The text with conditions of the preprocessor asking for MACRO_LARGEST instead of the counts' own macros.
[[nodiscard]] std::string with_largest_counts(const std::string& text, const Family& family,
                                              const std::map<int, int>& counts);

/// What stands for a count in a prologue: its macro or its constant, and what conditions ask for.
[[nodiscard]] std::string count_text(const Feature& count, const std::string& value, std::optional<int> id);

/// The constant_ids of the counts that a prologue declares so.
[[nodiscard]] std::set<std::uint32_t> count_ids(std::string_view prologue);

/// Decides key by key which counts are constants.
class CountSpecializer {
  public:
    CountSpecializer(const Family& family, Dialect dialect)
        : family_(family), counts_(specialized_counts(family, dialect)) {}

    /// The counts, by feature with their constant_id, that are constants in the stages of a key: those above
    /// 0 of which nothing hangs on the number but loops and the sizes of arrays. `read` are the varyings that
    /// the fragment stage reads.
    [[nodiscard]] Result<std::map<int, int>> in_stages(const Key& key,
                                                       const std::vector<Placement>& placements,
                                                       const std::vector<int>& read,
                                                       const PieceLibrary& library);

    /// Why keys keep counts as literals, each reason once.
    [[nodiscard]] Diagnostics notes() const;

  private:
    /// Whether a directive means the same however many there are of the count.
    Result<bool> holds_for_all_counts(const Directive& directive, int feature, const Key& key);
    void note(const Place& place, std::string message, std::string_view line, const Key& key);

    const Family& family_;
    std::map<int, int> counts_;
    std::map<std::string, Diagnostic> notes_;
    std::map<std::tuple<const Directive*, int, std::string>, bool> same_for_counts_;
};

}  // namespace gobo
