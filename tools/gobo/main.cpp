// gobo, the compiler: what a build needs. What proves, draws and measures is gobo-lab's (tools/lab/commands).
#include "gobo/commands.hpp"
#include "gobo/program.hpp"

int main(int argc, char** argv) {
    using namespace gobo;
    Program program;
    program.name = "gobo";
    program.description =
        "gobo composes lighting shaders from pieces, validates every permutation and emits a C++ header.";
    program.footer =
        "Exit status: 0 fine, 1 the input has errors or a check failed, 2 wrong usage, 3 a file could not be "
        "read or written, 4 a fault of gobo's own.\n\n"
        "Examples:\n  gobo list lit --all --where 'point <= 1' --count\n  gobo build lit --key 'fog=linear "
        "point=3' -o generated\n  gobo COMMAND --help";
    program.add_commands = [](CLI::App& app) {
        return std::vector{list_command(app),    show_command(app),  check_command(app),  build_command(app),
                           reflect_command(app), scene_command(app), library_command(app)};
    };
    program.elsewhere = {{"eval", "Run one invocation of a stage, in fp32 and fp64 (gobo-lab)"},
                         {"test", "Hold every permutation against the oracle (gobo-lab)"},
                         {"sanitize", "Look for undefined operations on hard inputs (gobo-lab)"},
                         {"probe", "Light-probe maps and coefficients from an HDR map (gobo-lab)"},
                         {"render", "Draw pictures without a window (gobo-lab)"},
                         {"study", "Measure error against cost (gobo-lab)"}};
    program.measure = [](const World&, const LoadedFamily&, const StudiedEffects&, const Key&, int) {
        return fail(Fault::needs_lab, "measuring effects that the study does not hold");
    };
    return run_program(program, argc, argv);
}
