// Pipelines compiled for several chips, in processes of their own: a driver that aborts or hangs costs its
// own figures and nobody else's.
#pragma once

#include "lab/cost/driver_process.hpp"

namespace gobo::cost {

struct CompileOptions {
    std::string driver = {};   ///< find_driver()'s `where`
    std::string program = {};  ///< the gobo-lab that opens drivers; empty: this program
    int jobs = 1;              ///< processes at a time
    int time_limit = 60;       ///< seconds for a pipeline
};

/// What a driver made as one chip.
struct ChipAnswers {
    std::string driver;  ///< "radv Mesa 22.3.6"
    std::vector<CompiledPipeline> pipelines;
};

/// For each chip the pipelines in their order, or why its driver cannot be asked: it is missing
/// (Fault::file), or does not know the chip. The calling process must not have other threads that run.
[[nodiscard]] std::vector<Result<ChipAnswers>> compile_on_chips(const FileSystem& disk,
                                                                const std::vector<Chip>& chips,
                                                                const std::vector<Pipeline>& pipelines,
                                                                const CompileOptions& options);

}  // namespace gobo::cost
