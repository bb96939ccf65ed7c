// Programs through glslang, some at a time: what a thread or a child process does at once.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/child_processes.hpp"
#include "validate/active_text.hpp"
#include "validate/validate.hpp"

namespace gobo {

class GlslangStage;

/// The stages that some permutation puts together, in the order of the pipeline.
using Program = std::vector<int>;

struct Batch {
    std::vector<std::size_t> programs;  ///< numbers
    std::vector<int>
        own;  ///< the stages of these programs that no earlier batch has, sorted: it makes their SPIR-V
};

/// All programs, those with stages in common together.
[[nodiscard]] std::vector<Batch> batches_of(const std::vector<Program>& programs, int jobs);

struct BatchResult {
    struct OfStage {
        int stage = 0;
        bool is_fine = false;
        Diagnostics diagnostics;
        ValidatedStage validated;
    };
    struct OfProgram {
        std::size_t program = 0;
        Diagnostics diagnostics;  ///< of linking
    };
    std::vector<OfStage> stages;      ///< the batch's own
    std::vector<OfProgram> programs;  ///< those whose stages are fine
};

/// What a child process sends to its parent.
[[nodiscard]] std::string bytes_of(const BatchResult& result);
/// Nothing where the bytes are damaged.
[[nodiscard]] std::optional<BatchResult> result_of(std::string_view bytes);

/// What a Note says: 1 and up a stage's number plus 1, -1 and down a program's.
[[nodiscard]] inline int note_of_stage(int stage) {
    return stage + 1;
}
[[nodiscard]] inline int note_of_program(std::size_t program) {
    return -1 - static_cast<int>(program);
}

/// The texts of a stage.
[[nodiscard]] std::vector<const Piece*> pieces_of(const Composition& composition, int stage);

/// Those that in some program no stage follows which places vertices anew.
[[nodiscard]] std::set<int> placing_stages(const Composition& composition,
                                           const std::vector<Program>& programs);

/// By their notes, the stages and programs that nobody shall try again, with the reason.
using GivenUp = std::map<int, Diagnostics>;

/// Works off one batch after the other. Stages that the next one needs too are kept, but for the last of each
/// program, which hardly recurs.
class BatchWorker {
  public:
    /// What it is given must outlive it.
    BatchWorker(const Composition& composition, const std::vector<Program>& programs,
                const std::set<int>& placing, const ValidateOptions& options);
    BatchWorker(const BatchWorker&) = delete;
    BatchWorker& operator=(const BatchWorker&) = delete;
    ~BatchWorker();

    /// `note` always says what is being done.
    [[nodiscard]] BatchResult work_off(const Batch& batch, const GivenUp& given_up, Note& note);

  private:
    struct Parsed {
        std::unique_ptr<GlslangStage> glslang;
        bool is_fine = false;
        Diagnostics diagnostics = {};
    };

    Parsed& parsed(int stage, const GivenUp& given_up, Note& note);
    [[nodiscard]] Diagnostics link_program(std::size_t program, const GivenUp& given_up, Note& note);
    [[nodiscard]] BatchResult::OfStage generate(int stage, Note& note);

    const Composition& composition_;
    const std::vector<Program>& programs_;
    const std::set<int>& placing_;
    const ValidateOptions& options_;
    ReadPieces read_;
    std::map<int, Parsed> parsed_;
};

}  // namespace gobo
