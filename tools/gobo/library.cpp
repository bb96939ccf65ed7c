// gobo library: the shipped pieces and families, listed or written out.
#include <algorithm>

#include <fmt/format.h>

#include "gobo/commands.hpp"

namespace gobo {
namespace {

/// How many files a message names.
constexpr std::size_t kMostNames = 10;

/// The shipped files that are not in the folder. An error where one there is not as shipped: it may be the
/// user's work.
Result<std::vector<std::string>> absent_files(const std::string& folder, const World& world) {
    std::vector<std::string> absent;
    std::vector<std::string> changed;
    for (const std::string& path : world.shipped.files_below("")) {
        const std::string there = folder + "/" + path;
        if (!world.disk.is_file(there)) {
            absent.push_back(path);
            continue;
        }
        GOBO_TRY(const std::string text, world.disk.read(there));
        GOBO_TRY(const std::string shipped, world.shipped.read(path));
        if (text != shipped) changed.push_back(there);
    }
    if (changed.empty()) return absent;
    const bool is_one = changed.size() == 1;
    const std::size_t more = changed.size() - std::min(changed.size(), kMostNames);
    changed.resize(changed.size() - more);
    return fail(Fault::usage,
                fmt::format("'{}'{} would be written over, but {} not as shipped", fmt::join(changed, "', '"),
                            more == 0 ? "" : fmt::format(" and {} more", more), is_one ? "is" : "are"),
                fmt::format("remove {0} if nothing of yours is in {0}, or name another folder",
                            is_one ? "it" : "them"));
}

Result<Outcome> run(const std::string& folder, const World& world) {
    Outcome outcome;
    for (const std::string& path : world.shipped.files_below("")) outcome.output += path + "\n";
    if (folder.empty()) return outcome;
    GOBO_TRY(const std::vector<std::string> absent, absent_files(folder, world));
    for (const std::string& path : absent) {
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
