#include "window.hpp"

#include <cctype>
#include <memory>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace viewer {
namespace {

constexpr double degrees_a_press = 10;

struct Library {
    ~Library() { glfwTerminate(); }
};
using Window = std::unique_ptr<GLFWwindow, decltype(&glfwDestroyWindow)>;

/// What was pressed since the last frame.
struct Pressed {
    std::string keys;
    double turn = 0;  ///< degrees
};

void on_key(GLFWwindow* window, int key, int /*scancode*/, int action, int /*modifiers*/) {
    if (action == GLFW_RELEASE) return;
    Pressed& pressed = *static_cast<Pressed*>(glfwGetWindowUserPointer(window));
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (key == GLFW_KEY_LEFT) pressed.turn -= degrees_a_press;
    if (key == GLFW_KEY_RIGHT) pressed.turn += degrees_a_press;
    if (action == GLFW_PRESS && key > 0 && key < 128) pressed.keys += static_cast<char>(std::tolower(key));
}

Window open_window(const Options& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_TRUE);
    glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);  // the picture has one size
    return {
        glfwCreateWindow(options.size.width, options.size.height, options.scene.c_str(), nullptr, nullptr),
        &glfwDestroyWindow};
}

tl::unexpected<gobo::Diagnostics> no_window() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return gobo::fail(gobo::Fault::file,
                      fmt::format("no window with OpenGL 4.5: {}", reason ? reason : "no reason given"),
                      "run it under a display, or use --headless");
}

void show(GLFWwindow* window, const Renderer& renderer) {
    Size size;
    glfwGetFramebufferSize(window, &size.width, &size.height);
    renderer.show(size);
    glfwSwapBuffers(window);
}

/// Shows the stage, and each change as its key is pressed.
gobo::Result<void> look(GLFWwindow* window, const GladGLContext& gl, const Options& options,
                        const Stage& stage, gobo::KeyRecord& record) {
    Pressed pressed;
    glfwSetWindowUserPointer(window, &pressed);
    glfwSetKeyCallback(window, &on_key);
    Renderer renderer(gl, stage, options.size, record, options.reload);
    Displayed displayed(options, reinterpret_cast<const char*>(gl.GetString(GL_RENDERER)));
    Settings settings;
    Orbit orbit = orbit_of(stage, options.size.width, options.size.height);
    gobo::Result<void> shown = displayed.frame(renderer, settings, orbit, "");
    while (shown && glfwWindowShouldClose(window) == GLFW_FALSE) {
        show(window, renderer);
        glfwWaitEventsTimeout(0.1);
        const std::string reloaded = renderer.take_changes();
        if (shown && !reloaded.empty()) shown = displayed.frame(renderer, settings, orbit, reloaded);
        const Pressed now = std::exchange(pressed, {});
        for (const char key : now.keys) {
            const std::string change = press(key, settings);
            if (shown && !change.empty()) shown = displayed.frame(renderer, settings, orbit, change);
        }
        if (now.turn == 0) continue;
        orbit.angle += glm::radians(now.turn);
        renderer.draw(settings, orbit);
    }
    return shown;
}

}  // namespace

gobo::Result<void> run_window(const Options& options, const Stage& stage, gobo::KeyRecord& record) {
    if (glfwInit() == GLFW_FALSE) return no_window();
    const Library library;
    const Window window = open_window(options);
    if (!window) return no_window();
    glfwMakeContextCurrent(window.get());
    GladGLContext gl = {};
    if (gladLoadGLContext(&gl, glfwGetProcAddress) == 0) return no_window();
    return look(window.get(), gl, options, stage, record);
}

}  // namespace viewer
