// gobo library: the shipped pieces and families, listed or written out.
#include "gobo/commands.hpp"

namespace gobo {
namespace {

Result<Outcome> run(const std::string& folder, const World& world) {
    Outcome outcome;
    for (const std::string& path : world.shipped.files_below("")) {
        outcome.output += path + "\n";
        if (folder.empty()) continue;
        GOBO_TRY(const std::string text, world.shipped.read(path));
        GOBO_TRY_DO(world.disk.write(folder + "/" + path, text));
    }
    return outcome;
}

}  // namespace

Command library_command() {
    const auto folder = std::make_shared<std::string>();
    return {{"library", "List the shipped pieces and families, or write them out"},
            {{"-o,--output", "DIR", "Write the files below this folder", folder.get()}},
            {},
            "  gobo library\n"
            "  gobo library -o gobo_library && gobo check lit --library gobo_library",
            [folder](const World& world) { return run(*folder, world); }};
}

}  // namespace gobo
