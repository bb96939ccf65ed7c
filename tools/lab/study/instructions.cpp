// How many instructions a fragment takes, counted by callgrind: slow, but the same in every run.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <sys/wait.h>
#include <unistd.h>
#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define GOBO_HAS_CALLGRIND 1
#else
#define GOBO_HAS_CALLGRIND 0
#endif

#include <fmt/format.h>

#include "core/text.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

/// What a program prints, both streams; nothing where it cannot be run or fails.
std::optional<std::string> printed_by(std::vector<std::string> command) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return std::nullopt;
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    const ::pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        ::dup2(ends[1], STDERR_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
        ::execvp(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    std::string text;
    std::array<char, 4096> buffer{};
    FILE* printed = ::fdopen(ends[0], "r");
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), printed))
        text.append(buffer.data(), count);
    std::fclose(printed);
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child || status != 0) return std::nullopt;
    return text;
}

/// The number after a word.
std::optional<double> number_after(const std::string& text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) return std::nullopt;
    return std::strtod(text.c_str() + at + word.size(), nullptr);
}

}  // namespace

Result<double> draw_once(const Subject& subject, const StudyScene& scene, const Context& context,
                         const Key& key, int width, int height) {
    GOBO_TRY(DrawnScene drawn, draw_scene(subject.shipped, subject.family, scene, width, height));
    drawn = with_shadows(subject.family, key, std::move(drawn));
    GOBO_TRY(const Variants variants, load_variants(subject, {key}));
    GOBO_TRY(const Framebuffer framebuffer, make_framebuffer(context, width, height));
    GOBO_TRY(const Program program, linked_program(context, variants, key));
    GOBO_TRY(const DrawList list, draw_list_of(context, program, variants.at(key), drawn));
    framebuffer.bind();
    count_fragments(context, list);  // compiles, which is not to be counted
#if GOBO_HAS_CALLGRIND
    CALLGRIND_START_INSTRUMENTATION;
#endif
    const double fragments = count_fragments(context, list);
#if GOBO_HAS_CALLGRIND
    CALLGRIND_STOP_INSTRUMENTATION;
#endif
    return fragments;
}

Result<double> count_instructions(const DrawCommand& command, const std::string& key) {
    std::array<double, 2> instructions{};
    std::array<double, 2> fragments{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto [width, height] = i == 0 ? std::pair{64, 48} : std::pair{160, 120};
        std::vector<std::string> whole = {"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"};
        // Built without valgrind's headers, all that the process does is counted, which takes ten times as
        // long.
        if (GOBO_HAS_CALLGRIND != 0) whole.emplace_back("--instr-atstart=no");
        for (std::string& argument : command(key, width, height)) whole.push_back(std::move(argument));
        const auto text = printed_by(whole);
        const auto collected = text ? number_after(*text, "Collected :") : std::nullopt;
        const auto drawn = text ? number_after(*text, "fragments ") : std::nullopt;
        if (!collected || !drawn)
            return fail(Fault::file, fmt::format("callgrind counts nothing: {}", join(whole, " ")),
                        "install valgrind, or leave out --callgrind");
        instructions[i] = *collected;
        fragments[i] = *drawn;
    }
    return (instructions[1] - instructions[0]) / (fragments[1] - fragments[0]);
}

}  // namespace gobo::study
