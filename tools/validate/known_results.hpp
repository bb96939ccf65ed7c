// What earlier runs found of stages and programs, by the texts that it was found from.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result_cache.hpp"
#include "validate/batch.hpp"

namespace gobo {

/// The declarations of a piece: its text without the bodies of functions, but for the directives in them; all
/// of it where brackets or comments hide what is a body.
[[nodiscard]] std::string declarations_of(std::string_view text);
/// Whether a body may give something that is declared outside of it its size.
[[nodiscard]] bool sizes_by_use(std::string_view text);

class KnownResults {
  public:
    /// `programs` and `placing` as BatchWorker wants them.
    KnownResults(const Composition& composition, const std::vector<Program>& programs,
                 const std::set<int>& placing, const ValidateOptions& options);

    [[nodiscard]] std::optional<BatchResult::OfStage> stage(int number) const;
    /// What linking says. A program whose stages declare what those of another declare links as that one
    /// does.
    [[nodiscard]] std::optional<Diagnostics> program(std::size_t number);

    void keep(const BatchResult::OfStage& result);
    void keep(const BatchResult::OfProgram& result);
    /// Keeps what keep() was told of programs that link, all at once.
    void keep_links();

  private:
    struct OfStage {
        Digest text;          ///< all that its result hangs on but for the places in messages
        Digest places;        ///< what places and quotations in messages hang on
        Digest declarations;  ///< what linking hangs on
    };

    void digest_pieces();
    [[nodiscard]] OfStage digests_of(int stage, bool is_placing) const;
    [[nodiscard]] Digest key_of_link(std::size_t program, Digest OfStage::*part) const;
    [[nodiscard]] Digest places_of(std::size_t program) const;
    [[nodiscard]] Digest key_of_links() const;
    [[nodiscard]] std::optional<BatchResult> find(const Digest& key, const Digest& places) const;
    void keep(const Digest& key, const Digest& places, const BatchResult& result);

    struct OfPiece {
        Digest text;
        Digest places;
        Digest declarations;
        bool knows_lines = false;
        bool sizes_by_use = false;
    };

    const Composition& composition_;
    const std::vector<Program>& programs_;
    const ValidateOptions& options_;
    ResultCache& cache_;
    std::string identity_;
    std::vector<OfPiece> pieces_;
    std::vector<OfStage> stages_;
    /// Of programs that link without a message, the keys of their declarations. They are kept together: a
    /// file for each would be most of what the cache costs.
    std::set<Digest> links_;
    std::set<Digest> new_links_;
};

}  // namespace gobo
