#include "lab/commands/guarded.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>

#include "core/child_processes.hpp"

namespace gobo {
namespace {

using nlohmann::json;

/// What was told last, in memory that both processes see.
struct Shared {
    bool has_begun = false;
    std::array<char, 1024> text;
};

json to_json(const Diagnostics& diagnostics) {
    json list = json::array();
    for (const Diagnostic& one : diagnostics)
        list.push_back({static_cast<int>(one.severity), static_cast<int>(one.fault), one.place.file,
                        one.place.line, one.place.column, one.message, one.quoted_line, one.help,
                        one.subject});
    return list;
}

Diagnostics diagnostics_in(const json& list) {
    Diagnostics diagnostics;
    for (const json& one : list)
        diagnostics.push_back({static_cast<Severity>(one[0].get<int>()),
                               static_cast<Fault>(one[1].get<int>()),
                               {one[2], one[3], one[4]},
                               one[5],
                               one[6],
                               one[7],
                               one[8]});
    return diagnostics;
}

/// Texts as they are: MessagePack's strings are not checked to be UTF-8.
std::string bytes_of(const Result<Outcome>& outcome) {
    json told;
    if (outcome)
        told = {{"output", outcome->output},
                {"diagnostics", to_json(outcome->diagnostics)},
                {"summary", outcome->summary}};
    else
        told = {{"errors", to_json(outcome.error())}};
    const std::vector<std::uint8_t> bytes = json::to_msgpack(told);
    return {bytes.begin(), bytes.end()};
}

std::string ending_of(Death death, int seconds) {
    switch (death) {
        case Death::time:
            return fmt::format("does nothing for {} s", seconds);
        case Death::memory:
            return "ran out of memory";
        case Death::killed:
            return "was killed";
        case Death::crash:
            break;
    }
    return "crashed";
}

}  // namespace

Result<Outcome> run_guarded(const std::string& what,
                            const std::function<Result<Outcome>(const Progress&)>& run, int seconds) {
    void* const memory =
        ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return run([](std::string_view) {});
    auto* const shared = new (memory) Shared{};
    std::optional<Result<Outcome>> result;
    const auto lose = [&](const std::string& ending) {
        const std::string last = shared->text.data();
        result = Result<Outcome>(fail(
            Fault::file,
            fmt::format("{} {}{}", what, ending, last.empty() ? "" : fmt::format("; before that, {}", last)),
            "try the other --backend, or another version of Mesa; a command with fewer keys tells "
            "which one it is"));
    };
    ChildWork work;
    std::mutex telling;  // pictures are drawn by one thread and written by others
    work.work = [&](std::size_t, Note& note) {
        shared->has_begun = true;
        return bytes_of(run([&](std::string_view text) {
            const std::scoped_lock lock(telling);
            const std::size_t size = std::min(text.size(), shared->text.size() - 1);
            std::memcpy(shared->text.data(), text.data(), size);
            shared->text[size] = '\0';
            ++note;
        }));
    };
    work.done = [&](std::size_t, std::string_view bytes) {
        const json told = json::from_msgpack(bytes.begin(), bytes.end(), true, false);
        if (!told.is_object()) return false;
        if (told.contains("errors"))
            result = Result<Outcome>(tl::unexpected(diagnostics_in(told["errors"])));
        else
            result = Outcome{told["output"], diagnostics_in(told["diagnostics"]), told["summary"]};
        return true;
    };
    work.died = [&](std::size_t, int, Death death) {
        lose(ending_of(death, seconds));
        return false;
    };
    const auto left = run_in_children(
        1, 1, work, {.processor_seconds = 0, .memory = 0, .wall_seconds = seconds, .writes_files = true});
    // A driver may end the process without a word and with status 0.
    if (!result && (left.empty() || shared->has_begun)) lose("ended the process");
    ::munmap(memory, sizeof(Shared));
    if (!result) return fail(Fault::internal, "no process can be started for " + what);
    return *std::move(result);
}

}  // namespace gobo
