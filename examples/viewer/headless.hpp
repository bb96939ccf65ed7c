// The viewer without a window.
#pragma once

#include "displayed.hpp"

namespace viewer {

/// Draws the frames that the options ask for, through OSMesa.
[[nodiscard]] gobo::Result<void> run_headless(const Options& options, const Stage& stage,
                                              gobo::KeyRecord& record);

}  // namespace viewer
