// Every distinct stage through glslang once, every distinct program linked: SPIR-V and interface of every
// stage, or the diagnostics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"
#include "family/family.hpp"
#include "reflect/interface.hpp"

namespace gobo {

class ResultCache;

/// A SPIR-V module, as words.
using SpirvModule = std::vector<std::uint32_t>;

/// One distinct stage after glslang.
struct ValidatedStage {
    SpirvModule spirv;       ///< empty unless asked for
    std::uint64_t hash = 0;  ///< of its SPIR-V: stages of the same do the same
    Interface interface;  ///< of this stage alone; a location or binding that the source does not state is -1
    Diagnostics diagnostics;  ///< what glslang lets pass within this stage: warnings
};

/// The text of a stage that crashed glslang, or took it too much time or memory.
struct StoppedStage {
    StageKind kind = StageKind::vertex;
    std::string text;
};

/// The stages in the order of Composition::stages.
struct Validated {
    std::vector<ValidatedStage> stages;  ///< those of failed permutations are empty
    Diagnostics diagnostics;             ///< errors and warnings, grouped over permutations
    std::set<std::size_t> failed;        ///< permutations that have errors
    std::vector<StoppedStage> stopped;
    std::size_t compiled = 0;  ///< how many stages went through glslang; the others were in the cache

    [[nodiscard]] const ValidatedStage& stage(int number) const {
        return stages[static_cast<std::size_t>(number)];
    }
};

struct ValidateOptions {
    int jobs = 1;  ///< threads, or child processes
    bool keep_spirv = false;
    /// OpSource and OpLine in the SPIR-V: which piece and line an operation comes from.
    bool debug_information = false;
    /// glslang runs in as many child processes instead: what crashes it, or takes it too much time or memory,
    /// is an error at its stage.
    bool child_processes = false;
    bool spirv_val = false;  ///< also ask SPIRV-Tools' validator; SPIR-V that is shipped is asked always
    bool optimize = false;   ///< SPIR-V for speed, by SPIRV-Tools' optimizer
    bool strip = false;      ///< SPIR-V without names
    /// What is known there of stages and programs is not found out again; what is not is put there. Null:
    /// nothing is known.
    ResultCache* cache = nullptr;
};

/// Validates a composition. What several permutations share is reported once, with how many there are; errors
/// come in the order of the permutations, whatever the number of jobs.
[[nodiscard]] Validated validate(const Family& family, const Composition& composition,
                                 const ValidateOptions& options);

/// Whether the message says that glslang was stopped, by its limits or a crash: another run may not be.
[[nodiscard]] bool is_of_stopped_glslang(const Diagnostic& diagnostic);

/// A warning where several keys give the same program: how many of the keys are distinct, the first two that
/// are not, and the features that change nothing in any key. The family lacks a rule then by which what
/// cannot matter stands at its default.
[[nodiscard]] Diagnostics same_programs(const Family& family, const Composition& composition,
                                        const Validated& validated);

/// For dialects of SPIR-V: errors where keys that are each fine cannot share a header, whose tables hold one
/// name for each set and binding, and one constant for each constant_id.
[[nodiscard]] Diagnostics clashes_of_keys(const Family& family, const Composition& composition,
                                          const Validated& validated);

/// The interface of a permutation's stages as one program.
[[nodiscard]] Interface interface_of(const Validated& validated, const Permutation& permutation);

}  // namespace gobo
