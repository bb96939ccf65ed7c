// gobo library: the shipped pieces and families, listed or written out.
#include "gobo/commands.hpp"

namespace gobo {
namespace {

struct LibraryOptions {
    CommonOptions common;
    std::string folder;
};

Outcome run(const LibraryOptions& options, const World& world) {
    Outcome outcome;
    for (const std::string& path : world.shipped.files_below("")) {
        outcome.output += path + "\n";
        if (options.folder.empty()) continue;
        const Result<std::string> text = world.shipped.read(path);
        const Result<bool> written = world.disk.write(options.folder + "/" + path, text.value_or(""));
        if (!written) return failed(written.error());
    }
    return outcome;
}

}  // namespace

Command library_command(CLI::App& gobo) {
    auto options = std::make_shared<LibraryOptions>();
    CLI::App* app = gobo.add_subcommand("library", "List the shipped pieces and families, or write them out");
    app->add_option("-o,--output", options->folder, "Write the files below this folder")->type_name("DIR");
    add_common_options(*app, options->common);
    app->footer(
        "Examples:\n"
        "  gobo library\n"
        "  gobo library -o gobo_library && gobo check lit --library gobo_library");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
