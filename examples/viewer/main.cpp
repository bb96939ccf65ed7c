// viewer SCENE.gltf: shows a scene, each draw with the permutation that it needs.
#include <fmt/format.h>

#include "headless.hpp"
#include "window.hpp"

namespace viewer {
namespace {

int leave(const gobo::Diagnostics& diagnostics) {
    for (const gobo::Diagnostic& diagnostic : diagnostics) fmt::print(stderr, "{}", to_text(diagnostic));
    return exit_status(diagnostics);
}

int run(const Options& options) {
    const gobo::DiskFileSystem disk;
    const gobo::Result<Stage> stage =
        read_stage(disk, options.scene,
                   options.family == "pbr" ? gobo::scene::Reading::physical : gobo::scene::Reading::classic);
    if (!stage) return leave(stage.error());
    gobo::KeyRecord record(options.record);
    const gobo::Result<void> shown =
        options.headless ? run_headless(options, *stage, record) : run_window(options, *stage, record);
    return shown ? 0 : leave(shown.error());
}

}  // namespace
}  // namespace viewer

int main(int argc, char** argv) {
    const viewer::CommandLine line = viewer::read_command_line(argc, argv);
    return line.exit_status ? *line.exit_status : viewer::run(line.options);
}
