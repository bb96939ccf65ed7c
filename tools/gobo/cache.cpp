// gobo cache: what the cache holds, and an end to it.
#include <cerrno>

#include <dirent.h>
#include <fmt/format.h>

#include "core/file_error.hpp"
#include "gobo/commands.hpp"
#include "gobo/kept_answers.hpp"
#include "gobo/redis_cache.hpp"

namespace gobo {
namespace {

Result<Outcome> run(const std::string& action, const World& world) {
    const std::string folder = cache_folder(world.options);
    if (folder.empty())
        return fail(Fault::usage, "no cache is named", "give --cache DIR, or set GOBO_CACHE_DIR");
    GOBO_TRY_DO(refuse_other_caches(folder));
    if (names_redis(folder))
        return fail(Fault::usage, fmt::format("what {} holds is Redis's to say", folder),
                    "ask it: redis-cli --scan --pattern 'gobo:*', redis-cli info memory");
    // One that is not there holds nothing; one that cannot be looked at may.
    if (::DIR* const opened = ::opendir(folder.c_str()); opened != nullptr)
        ::closedir(opened);
    else if (errno != ENOENT)
        return file_error(folder, "read", errno);
    const std::uint64_t most = std::uint64_t(world.options.cache_megabytes) << 20;
    DiskCache cache(folder, most);
    if (action == "clear") {
        const DiskCache::Size removed = cache.clear();
        return Outcome{
            {},
            removed.diagnostics,
            fmt::format("{}: {} results, {} bytes removed", folder, removed.results, removed.bytes)};
    }
    const DiskCache::Size size = cache.size();
    return Outcome{fmt::format("results {}\nbytes {}\nmost_bytes {}\n", size.results, size.bytes, most),
                   size.diagnostics};
}

}  // namespace

Command cache_command() {
    const auto action = std::make_shared<std::string>();
    Command command = {
        {"cache", "How much the cache holds, or an end to it"},
        {{"ACTION",
          "stats|clear",
          "Print how much it holds, or remove it all",
          action.get(),
          {.required = true, .one_of = true}}},
        {},
        "  gobo cache stats --cache ~/.cache/gobo\n"
        "  GOBO_CACHE_DIR=~/.cache/gobo gobo cache clear",
        [action](const World& world) { return run(*action, world); },
        "A cache is used where --cache or GOBO_CACHE_DIR names its folder: what was computed from the same "
        "texts is not computed again, whatever command, build folder or checkout asks for it. It may be "
        "removed at any time, also while it is in use."};
    command.manages_cache = true;
    return command;
}

}  // namespace gobo
