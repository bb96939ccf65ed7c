// The viewer's window.
#pragma once

#include "displayed.hpp"

namespace viewer {

/// Shows the stage until the window is closed. Fault::file where no window can be opened.
[[nodiscard]] gobo::Result<void> run_window(const Options& options, const Stage& stage,
                                            gobo::KeyRecord& record);

}  // namespace viewer
