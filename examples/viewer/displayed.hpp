// What the viewer tells and leaves behind after each frame that differs from the last.
#pragma once

#include <string>

#include "options.hpp"
#include "renderer.hpp"

namespace viewer {

/// Numbers the frames, writes their pictures where the options say so, and prints keys and costs.
class Displayed {
  public:
    Displayed(const Options& options, std::string renderer_name)
        : options_(options), renderer_name_(std::move(renderer_name)) {}

    /// Draws and times the frame. `change` says what made it differ: "fog off". Errors: a picture that cannot
    /// be written.
    [[nodiscard]] gobo::Result<void> frame(Renderer& renderer, const Settings& settings, const Orbit& orbit,
                                           const std::string& change);

  private:
    const Options& options_;
    std::string renderer_name_;
    int number_ = 0;
    double time_ = 0;  ///< milliseconds of the frame before
};

}  // namespace viewer
