// gobo-lab: what proves, draws and measures. `gobo` becomes it for these commands.
#include "gobo/application.hpp"
#include "lab/commands/lab_input.hpp"

int main(int argc, char** argv) {
    using namespace gobo;
    // Commands of gobo that come here where a budget needs a measurement.
    Command build = repeatable(build_command());
    Command scene = repeatable(scene_command());
    build.hidden = scene.hidden = true;
    return run_application({"gobo-lab",
                            "proves, draws and measures what gobo builds; `gobo COMMAND` runs it.",
                            "  gobo test lit --cover 2\n"
                            "  gobo render lit --key 'spot=1' -o pictures\n"
                            "  gobo COMMAND --help",
                            {eval_command(), test_command(), sanitize_command(), prove_command(),
                             probe_command(), render_command(), link_command(), cost_command(),
                             study_command(), build, scene, compile_pipelines_command()},
                            {measure_qualities, worst_errors}},
                           argc, argv);
}
