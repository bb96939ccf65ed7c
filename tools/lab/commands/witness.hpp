// gobo test --render: the renderer as the evaluator's witness.
#pragma once

#include "gobo/command.hpp"

namespace gobo {

/// Options of `gobo test` that concern pictures.
struct WitnessOptions {
    bool render = false;
    std::string backend = "osmesa";
};

/// The option that asks for pictures is returned.
CLI::Option* add_witness_options(CLI::App& app, WitnessOptions& options);

/// Draws every permutation and holds each picture against its evaluation. A picture that fails is an error
/// for its key, and three images in `folder`.
[[nodiscard]] Outcome run_witness(const World& world, const WitnessOptions& options, const Family& family,
                                  const Composition& composition, const std::string& folder,
                                  const CommonOptions& common);

}  // namespace gobo
