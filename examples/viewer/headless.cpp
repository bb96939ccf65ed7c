#include "headless.hpp"

#include <chrono>
#include <thread>

#include <glm/trigonometric.hpp>

#include "lab/render/context.hpp"

namespace viewer {

namespace {

/// Waits until shaders change, for a minute at most.
std::string await_change(Renderer& renderer) {
    std::string change;
    for (int i = 0; i < 6000 && change.empty(); ++i) {
        change = renderer.take_changes();
        if (change.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return change;
}

}  // namespace

gobo::Result<void> run_headless(const Options& options, const Stage& stage, gobo::KeyRecord& record) {
    const gobo::Result<gobo::Context> context = gobo::open_context(gobo::Backend::osmesa);
    if (!context) return tl::unexpected(context.error());
    Renderer renderer(context->gl(), stage, options.size, record, options.reload);
    Displayed displayed(options, context->renderer());
    Settings settings;
    Orbit orbit = orbit_of(stage, options.size.width, options.size.height);
    const double turn = options.turn < 0 ? 360.0 / options.frames : options.turn;
    for (int i = 0; i < options.frames; ++i) {
        const std::size_t pressed = static_cast<std::size_t>(i) - 1;
        std::string change =
            i > 0 && pressed < options.keys.size() ? press(options.keys[pressed], settings) : "";
        if (i > 0 && !options.reload.empty()) change = await_change(renderer);
        orbit.angle = glm::radians(turn * i);
        const gobo::Result<void> shown = displayed.frame(renderer, settings, orbit, change);
        if (!shown) return shown;
    }
    return {};
}

}  // namespace viewer
