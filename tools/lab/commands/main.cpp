// gobo-lab: what proves, draws and measures. `gobo` becomes it for these commands.
#include "gobo/commands.hpp"
#include "gobo/program.hpp"
#include "lab/commands/commands.hpp"
#include "lab/commands/measure_qualities.hpp"

int main(int argc, char** argv) {
    using namespace gobo;
    Program program;
    program.name = "gobo-lab";
    program.description = "gobo-lab proves, draws and measures what gobo builds; `gobo COMMAND` runs it.";
    program.footer =
        "Exit status: 0 fine, 1 the input has errors or a check failed, 2 wrong usage, 3 a file could not be "
        "read or written, 4 a fault of gobo's own.\n\n"
        "Examples:\n  gobo test lit --cover 2\n  gobo render lit --key 'spot=1' -o pictures\n"
        "  gobo COMMAND --help";
    program.add_commands = [](CLI::App& app) {
        return std::vector{eval_command(app),  test_command(app),   sanitize_command(app),
                           probe_command(app), render_command(app), study_command(app),
                           build_command(app), scene_command(app)};
    };
    program.measure = measure_qualities;
    return run_program(program, argc, argv);
}
