#include "gobo/kept_answers.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "core/file_trace.hpp"
#include "gobo/redis_cache.hpp"

namespace gobo {
namespace {

/// Raised where Answer changes.
constexpr int kFormat = 2;
/// Bytes. What is longer takes more room than it saves time.
constexpr std::size_t kLongestAnswer = std::size_t{64} << 20;

struct Answer {
    std::vector<FileQuestion> questions;  ///< of the files, with their answers
    Result<Outcome> outcome;
};
GOBO_FIELDS(Answer, questions, outcome)

Digest key_of(const std::string& program, const std::vector<std::string>& arguments) {
    std::error_code error;
    const std::string folder = std::filesystem::current_path(error).string();
    return digest_of(to_bytes(kFormat, program_identity(), program, folder, arguments));
}

/// Whether another run may find something else with the same arguments and files.
bool may_change(const Diagnostics& found) {
    return std::ranges::any_of(found, [](const Diagnostic& diagnostic) {
        return (diagnostic.fault != Fault::input && diagnostic.fault != Fault::usage) ||
               is_of_stopped_glslang(diagnostic);
    });
}

std::optional<Answer> kept_answer(ResultCache& cache, const Digest& key, const FileSystem& disk) {
    const std::optional<std::string> bytes = cache.find(key);
    if (!bytes) return std::nullopt;
    std::optional<Answer> answer = from_bytes<Answer>(*bytes);
    if (answer && !are_answered_alike(answer->questions, disk)) answer.reset();
    return answer;
}

void keep(ResultCache& cache, const Digest& key, const TracedFiles& files, const Result<Outcome>& outcome) {
    if (!files.is_repeatable() || may_change(outcome ? outcome->diagnostics : outcome.error())) return;
    Answer answer{files.questions(), outcome};
    if (outcome && outcome->compiled > 0) answer.outcome->compiled = 0;
    const std::string bytes = to_bytes(answer);
    if (bytes.size() <= kLongestAnswer) cache.keep(key, bytes);
}

}  // namespace

std::string cache_folder(const CommonOptions& options) {
    const char* const named = std::getenv("GOBO_CACHE_DIR");
    return options.cache.empty() && named != nullptr ? named : options.cache;
}

Result<Outcome> run_with_cache(const Command& command, const World& world, const std::string& program,
                               const std::vector<std::string>& arguments, Diagnostics& warnings) {
    const std::string folder = cache_folder(world.options);
    if (folder.empty() || command.manages_cache) return command.run(world);
    GOBO_TRY_DO(refuse_other_caches(folder));
    std::unique_ptr<ResultCache> opened;
    if (names_redis(folder)) {
        GOBO_TRY(opened, RedisCache::open(folder));
    } else {
        opened = std::make_unique<DiskCache>(folder, std::uint64_t(world.options.cache_megabytes) << 20);
    }
    ResultCache& cache = *opened;
    const Digest key = key_of(program, arguments);
    if (command.is_repeatable)
        if (std::optional<Answer> answer = kept_answer(cache, key, world.disk))
            return std::move(answer->outcome);
    TracedFiles traced(world.disk);
    FileSystem& disk = command.is_repeatable ? static_cast<FileSystem&>(traced) : world.disk;
    Result<Outcome> outcome = command.run(
        {disk, world.shipped, world.options, world.measure, &cache, world.tell, world.given, world.spare});
    if (command.is_repeatable) keep(cache, key, traced, outcome);
    append(warnings, cache.tidy());
    return outcome;
}

}  // namespace gobo
