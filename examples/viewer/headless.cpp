#include "headless.hpp"

#include <glm/trigonometric.hpp>

#include "lab/render/context.hpp"

namespace viewer {

gobo::Result<void> run_headless(const Options& options, const Stage& stage, gobo::KeyRecord& record) {
    const gobo::Result<gobo::Context> context = gobo::open_context(gobo::Backend::osmesa);
    if (!context) return tl::unexpected(context.error());
    Renderer renderer(context->gl(), stage, options.size, record);
    Displayed displayed(options, context->renderer());
    Settings settings;
    Orbit orbit = orbit_of(stage, options.size.width, options.size.height);
    const double turn = options.turn < 0 ? 360.0 / options.frames : options.turn;
    for (int i = 0; i < options.frames; ++i) {
        const std::size_t pressed = static_cast<std::size_t>(i) - 1;
        const std::string change =
            i > 0 && pressed < options.keys.size() ? press(options.keys[pressed], settings) : "";
        orbit.angle = glm::radians(turn * i);
        const gobo::Result<void> shown = displayed.frame(renderer, settings, orbit, change);
        if (!shown) return shown;
    }
    return {};
}

}  // namespace viewer
