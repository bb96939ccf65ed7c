#include "lab/cost/driver_process.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/bytes.hpp"
#include "core/child_processes.hpp"
#include "core/text.hpp"

namespace gobo::cost {

GOBO_FIELDS(Descriptor, kind, count)
GOBO_FIELDS(VertexInput, location, scalar, components)
GOBO_FIELDS(PipelineStage, kind, words, loop_varies)
GOBO_FIELDS(Pipeline, stages, descriptors, inputs, outputs, constants, push_bytes)
GOBO_FIELDS(CompiledStage, stage, invocations, statistics, assembly)

namespace {

using Clock = std::chrono::steady_clock;

/// Messages stand after their length.
using Length = std::uint64_t;

std::string message_of(const std::string& content) {
    return to_bytes(Length{content.size()}) + content;
}

/// The first whole message of `received`, taken out of it; nothing where none is whole.
std::optional<std::string> take_message(std::string& received) {
    const std::size_t head = std::min(sizeof(Length), received.size());
    const auto length = from_bytes<Length>(std::string_view(received).substr(0, head));
    if (!length || received.size() - head < *length) return std::nullopt;
    std::string content = received.substr(head, *length);
    received.erase(0, head + *length);
    return content;
}

// The process that is asked.

// The process that asks.

constexpr std::array kSwitches = {"RADV_PERFTEST",  "ACO_DEBUG", "NIR_DEBUG", "RADV_FORCE_VRS",
                                  "RADV_TEX_ANISO", "NAK_DEBUG", "NVK_DEBUG", "LD_PRELOAD"};

void set_environment(const DriverPlace& place, const Chip& chip) {
    // A caller's switches would change figures.
    for (const char* name : kSwitches) ::unsetenv(name);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    if (!place.libraries.empty()) ::setenv("LD_LIBRARY_PATH", place.libraries.c_str(), 1);
    if (chip.maker == Maker::nvidia) {
        ::setenv("NOUVEAU_CHIPSET", std::string(chip.chipset).c_str(), 1);
        ::setenv("NVK_I_WANT_A_BROKEN_VULKAN_DRIVER", "1", 1);
        ::setenv("LD_PRELOAD", place.shim.c_str(), 1);
        return;
    }
    std::string family(chip.name);
    std::transform(family.begin(), family.end(), family.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    ::setenv("RADV_FORCE_FAMILY", family.c_str(), 1);
    // Without culling in the vertex stage: it is the driver's, the same for all, and as long as the stage.
    ::setenv("RADV_DEBUG", "nonggc", 1);
}

/// Limits that the calling process has for itself: what stands in for a GPU makes large files in memory.
void lift_limits() {
    for (const auto resource : {RLIMIT_AS, RLIMIT_FSIZE, RLIMIT_CPU}) {
        ::rlimit limit{};
        ::getrlimit(resource, &limit);
        limit.rlim_cur = limit.rlim_max;
        ::setrlimit(resource, &limit);
    }
    const ::rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    std::signal(SIGPIPE, SIG_DFL);
}

[[noreturn]] void become_driver(const DriverPlace& place, const Chip& chip, const std::string& program) {
    lift_limits();
    set_environment(place, chip);
    const std::string first = place.loader.empty() ? program : place.loader;
    std::vector<std::string> words = {first};
    if (!place.loader.empty()) words.push_back(program);
    words.insert(words.end(), {kServeCommand, place.library});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(first.c_str(), arguments.data());
    const std::string reason = fmt::format("{} cannot be run: {}\n", first, std::strerror(errno));
    write_or_exit(STDERR_FILENO, reason);
    ::_exit(127);
}

/// Both ends of a pipe, the first to read from.
std::optional<std::array<int, 2>> make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
    return ends;
}

/// False at the end of what is written.
bool read_some(int file, std::string& text) {
    std::array<char, 1 << 16> buffer;
    const ::ssize_t count = ::read(file, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

/// "crashed with signal 6 (Aborted): radv: ...", with the last line that it printed: the reason why where it
/// ends itself, elsewhere perhaps of something else.
std::string ending_of(int status, const std::string& printed) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    constexpr std::array kCrashes = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
    const bool crashed = std::find(kCrashes.begin(), kCrashes.end(), signal) != kCrashes.end();
    std::string text = signal != 0
                           ? fmt::format("{} signal {} ({})", crashed ? "crashed with" : "was ended by",
                                         signal, ::strsignal(signal))
                           : fmt::format("ended with status {}", WEXITSTATUS(status));
    const std::vector<std::string> lines = split(printed, '\n');
    if (lines.empty()) return text;
    const bool says_why = signal == 0 || signal == SIGABRT;
    return fmt::format("{}{}: {}", text, says_why ? "" : "; before that it printed", printable(lines.back()));
}

}  // namespace

void serve_pipelines(const std::string& library) {
    // What the driver prints goes where errors go.
    const int out = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    const Result<Driver> driver = Driver::open(library);
    write_or_exit(out, message_of(to_bytes(driver ? Result<std::string>(driver->name())
                                                  : tl::unexpected(driver.error()))));
    if (!driver) return;
    std::string received;
    while (read_some(STDIN_FILENO, received))
        while (const auto request = take_message(received))
            write_or_exit(out, message_of(to_bytes(driver->compile(from_bytes<Pipeline>(*request).value()))));
    // Without the driver's own clean-up, which may crash.
    ::_exit(0);
}

/// What a process answered, or how it ended.
struct DriverProcess::Answer {
    std::optional<std::string> content;
    std::string ending;
};

DriverProcess::DriverProcess(const DriverPlace& place, const Chip& chip, const std::string& program,
                             int time_limit)
    : time_limit_(time_limit), name_(open(place, chip, program)) {}

Result<std::string> DriverProcess::open(const DriverPlace& place, const Chip& chip,
                                        const std::string& program) {
    const auto lose = [&](const std::string& reason, std::string_view help, Fault fault = Fault::file) {
        return fail(fault, fmt::format("{}: {}", chip.name, reason), std::string(help));
    };
    const auto requests = make_pipe();
    const auto answers = make_pipe();
    const auto errors = make_pipe();
    if (!requests || !answers || !errors) return lose("no pipe can be made", "");
    std::signal(SIGPIPE, SIG_IGN);  // of a process that has died: its end is seen otherwise
    const ::pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(1);
        ::dup2((*requests)[0], STDIN_FILENO);
        ::dup2((*answers)[1], STDOUT_FILENO);
        ::dup2((*errors)[1], STDERR_FILENO);
        become_driver(place, chip, program);
    }
    for (const int end : {(*requests)[0], (*answers)[1], (*errors)[1]}) ::close(end);
    requests_ = (*requests)[1];
    answers_ = (*answers)[0];
    errors_ = (*errors)[0];
    ::fcntl(requests_, F_SETFL, O_NONBLOCK);
    if (process_ < 0) return lose("no process can be started", "");
    const Answer answer = exchange("");
    if (!answer.content) {
        // RADV writes "Unknown family" before it aborts; else that it knows the chip is not in doubt.
        const bool is_unknown = chip.maker == Maker::amd && answer.ending.find("nknown") != std::string::npos;
        return lose(fmt::format("the driver {}", answer.ending),
                    is_unknown ? install_newer(chip)
                               : "'gobo cost --gpu list' says of which chips this driver has figures");
    }
    const auto name = from_bytes<Result<std::string>>(*answer.content).value();
    if (name) return *name;
    const Diagnostic& error = name.error().front();
    return lose(error.message, error.help.empty() ? install_driver(chip.maker) : error.help,
                error.fault == Fault::file ? Fault::file : Fault::input);
}

DriverProcess::~DriverProcess() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        end(false);
    }
    for (const int file : {requests_, answers_, errors_})
        if (file >= 0) ::close(file);
}

CompiledPipeline DriverProcess::compile(const Pipeline& pipeline) {
    const Answer answer = exchange(message_of(to_bytes(pipeline)));
    if (!answer.content) return tl::unexpected(answer.ending);
    auto stages = from_bytes<Result<std::vector<CompiledStage>>>(*answer.content).value();
    if (!stages) return tl::unexpected(stages.error().front().message);
    return *std::move(stages);
}

/// Writes the request and waits for a message.
DriverProcess::Answer DriverProcess::exchange(std::string request) {
    const Clock::time_point deadline = Clock::now() + std::chrono::seconds(time_limit_);
    for (;;) {
        if (auto content = take_message(received_)) return {std::move(*content), ""};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) return {std::nullopt, end(true)};
        std::array<::pollfd, 3> files = {::pollfd{answers_, POLLIN, 0}, ::pollfd{errors_, POLLIN, 0},
                                         ::pollfd{request.empty() ? -1 : requests_, POLLOUT, 0}};
        if (::poll(files.data(), files.size(), static_cast<int>(left)) < 0) continue;
        if (files[1].revents != 0 && !read_some(errors_, printed_)) {
            ::close(errors_);
            errors_ = -1;
        }
        if (files[2].revents != 0) {
            const ::ssize_t written = ::write(requests_, request.data(), request.size());
            if (written > 0)
                request.erase(0, static_cast<std::size_t>(written));
            else if (errno != EAGAIN && errno != EINTR)
                request.clear();  // it has died, as the end of its answers will tell
        }
        if (files[0].revents != 0 && !read_some(answers_, received_)) return {std::nullopt, end(false)};
    }
}

/// Waits for the process, which is at its end or is killed, and says how it ended.
std::string DriverProcess::end(bool timed_out) {
    if (timed_out) ::kill(process_, SIGKILL);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    if (timed_out) return fmt::format("gave no answer within {} s", time_limit_);
    while (errors_ >= 0 && read_some(errors_, printed_)) {
    }
    return ending_of(status, printed_);
}

}  // namespace gobo::cost
