// The pieces read so far, each scanned once, and the resolution of includes to them.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "compose/scan_piece.hpp"
#include "compose/search_path.hpp"

namespace gobo {

/// Pieces by number. Files are read when first asked for; whatever does not depend on the key is computed
/// once.
class PieceLibrary {
  public:
    /// A file with what the composer asks of it again and again.
    struct Entry {
        Piece piece;
        std::string version;
        std::vector<Include> includes;
        std::vector<char> mentions;  ///< per identifier of interest
    };

    /// `interest` lists the identifiers that mentions() will be asked for.
    PieceLibrary(const Family& family, const SearchPath& search, std::vector<std::string> interest,
                 Comments comments);

    /// The piece of a template or of a fixed include: PATH.STAGE.EXTENSION where there is one, else PATH.
    [[nodiscard]] Result<int> fixed(const std::string& path, StageKind stage, const Include* from);
    /// The piece that an include of a feature means for a value; nothing for a count of 0.
    [[nodiscard]] Result<std::optional<int>> chosen(const Include& include, const Key& key, StageKind stage);
    /// The number of a generated text; equal texts have equal numbers.
    [[nodiscard]] int generated(Piece piece);

    [[nodiscard]] const Entry& entry(int piece) const { return entries_[static_cast<std::size_t>(piece)]; }
    [[nodiscard]] std::vector<Piece> pieces() const;
    [[nodiscard]] std::vector<std::string> files() const;
    [[nodiscard]] const std::map<std::string, int>& stated_bindings() const { return stated_bindings_; }
    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }
    [[nodiscard]] const std::vector<std::string>& interest() const { return interest_; }

  private:
    Result<std::optional<int>> load(const std::string& path);
    tl::unexpected<Diagnostics> missing(const std::string& wanted, const Include* from,
                                        std::string reason) const;
    Result<std::optional<int>> find_value(const Include& include, const Feature& feature, int value,
                                          StageKind stage);

    const Family& family_;
    const SearchPath& search_;
    std::vector<std::string> interest_;
    Comments comments_;
    std::deque<Entry> entries_;  ///< not a vector: who holds an entry may load more of them
    std::map<std::string, int> stated_bindings_;
    Diagnostics warnings_;
    std::map<std::string, std::optional<int>, std::less<>> by_path_;  ///< also what is known to be absent
    std::map<std::string, int, std::less<>> by_generated_text_;
    /// Target of the include, value, stage.
    std::map<std::tuple<std::string, int, StageKind>, std::optional<int>, std::less<>> by_choice_;
};

}  // namespace gobo
