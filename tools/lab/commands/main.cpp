// gobo-lab: what proves, draws and measures. `gobo` becomes it for these commands.
#include "gobo/application.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/lab_input.hpp"

namespace {

/// Commands of gobo that come here where a budget needs a measurement.
gobo::Command hidden(gobo::Command command) {
    command.hidden = true;
    return command;
}

}  // namespace

int main(int argc, char** argv) {
    using namespace gobo;
    return run_application(
        {"gobo-lab",
         "proves, draws and measures what gobo builds; `gobo COMMAND` runs it.",
         "  gobo test lit --cover 2\n"
         "  gobo render lit --key 'spot=1' -o pictures\n"
         "  gobo COMMAND --help",
         {eval_command(), test_command(), sanitize_command(), probe_command(), render_command(),
          study_command(), hidden(build_command()), hidden(scene_command())},
         measure_qualities},
        argc, argv);
}
