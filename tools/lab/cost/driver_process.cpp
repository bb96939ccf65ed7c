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
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/text.hpp"

namespace gobo::cost {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

/// Messages are CBOR after their length.
using Length = std::uint64_t;

std::string message_of(const json& content) {
    const std::vector<std::uint8_t> bytes = json::to_cbor(content);
    const Length length = bytes.size();
    std::string message(reinterpret_cast<const char*>(&length), sizeof length);
    message.append(bytes.begin(), bytes.end());
    return message;
}

/// The first whole message of `received`, taken out of it; nothing where none is whole.
std::optional<json> take_message(std::string& received) {
    Length length = 0;
    if (received.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, received.data(), sizeof length);
    if (received.size() - sizeof length < length) return std::nullopt;
    const auto begin = received.begin() + sizeof length;
    json content = json::from_cbor(begin, begin + static_cast<std::ptrdiff_t>(length), true, false);
    received.erase(0, sizeof length + length);
    return content;
}

json to_json(const Words& words) {
    std::vector<std::uint8_t> bytes(words.size() * sizeof(words[0]));
    std::memcpy(bytes.data(), words.data(), bytes.size());
    return json::binary(std::move(bytes));
}

Words words_in(const json& content) {
    const auto& bytes = content.get_binary();
    Words words(bytes.size() / sizeof(Words::value_type));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(words[0]));
    return words;
}

json to_json(const Pipeline& pipeline) {
    json content = {{"stages", json::array()},    {"descriptors", json::array()},
                    {"inputs", json::array()},    {"outputs", json::array()},
                    {"constants", json::array()}, {"push_bytes", pipeline.push_bytes}};
    for (const PipelineStage& stage : pipeline.stages)
        content["stages"].push_back({static_cast<int>(stage.kind), to_json(stage.words)});
    for (const auto& [id, value] : pipeline.constants) content["constants"].push_back({id, value});
    for (const Descriptor& descriptor : pipeline.descriptors)
        content["descriptors"].push_back({static_cast<int>(descriptor.kind), descriptor.count});
    for (const VertexInput& input : pipeline.inputs)
        content["inputs"].push_back({input.location, static_cast<int>(input.scalar), input.components});
    for (const auto& output : pipeline.outputs)
        content["outputs"].push_back(output ? static_cast<int>(*output) : -1);
    return content;
}

Pipeline pipeline_in(const json& content) {
    Pipeline pipeline;
    for (const json& stage : content["stages"])
        pipeline.stages.push_back({static_cast<StageKind>(stage[0].get<int>()), words_in(stage[1])});
    for (const json& descriptor : content["descriptors"])
        pipeline.descriptors.push_back(
            {static_cast<Descriptor::Kind>(descriptor[0].get<int>()), descriptor[1]});
    for (const json& input : content["inputs"])
        pipeline.inputs.push_back({input[0], static_cast<Scalar>(input[1].get<int>()), input[2]});
    for (const json& output : content["outputs"]) {
        const int scalar = output.get<int>();
        pipeline.outputs.push_back(scalar < 0 ? std::nullopt : std::optional(static_cast<Scalar>(scalar)));
    }
    for (const json& constant : content["constants"])
        pipeline.constants.emplace_back(constant[0], constant[1]);
    pipeline.push_bytes = content["push_bytes"];
    return pipeline;
}

// The process that is asked.

void write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ::ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) ::_exit(1);
        bytes.remove_prefix(static_cast<std::size_t>(std::max<::ssize_t>(written, 0)));
    }
}

json error_in(const Diagnostics& errors) {
    return {{"error", errors.front().message},
            {"help", errors.front().help},
            {"is_missing", errors.front().fault == Fault::file}};
}

json compiled(const Driver& driver, const Pipeline& pipeline) {
    const auto stages = driver.compile(pipeline);
    if (!stages) return error_in(stages.error());
    json told = {{"stages", json::array()}};
    for (const CompiledStage& stage : *stages)
        // Texts as bytes: what a driver writes need not be UTF-8.
        told["stages"].push_back(
            {{"stage", stage.stage},
             {"invocations", stage.invocations},
             {"statistics", stage.statistics},
             {"assembly", json::binary({stage.assembly.begin(), stage.assembly.end()})}});
    return told;
}

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
    write_all(STDERR_FILENO, reason);
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

/// "was ended by signal 6 (Aborted): radv: ...", with the last line that it printed.
std::string ending_of(int status, const std::string& printed) {
    std::string text = WIFSIGNALED(status) ? fmt::format("was ended by signal {} ({})", WTERMSIG(status),
                                                         ::strsignal(WTERMSIG(status)))
                                           : fmt::format("ended with status {}", WEXITSTATUS(status));
    const std::vector<std::string> lines = split(printed, '\n');
    if (!lines.empty()) text += ": " + printable(lines.back());
    return text;
}

}  // namespace

void serve_pipelines(const std::string& library) {
    // What the driver prints goes where errors go.
    const int out = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    const Result<Driver> driver = Driver::open(library);
    write_all(out, message_of(driver ? json{{"driver", driver->name()}} : error_in(driver.error())));
    if (!driver) return;
    std::string received;
    while (read_some(STDIN_FILENO, received))
        while (const auto request = take_message(received))
            write_all(out, message_of(compiled(*driver, pipeline_in(*request))));
    // Without the driver's own clean-up, which may crash.
    ::_exit(0);
}

/// What a process answered, or how it ended.
struct DriverProcess::Answer {
    std::optional<json> content;
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
    if (answer.content->contains("error")) {
        const auto help = (*answer.content)["help"].get<std::string>();
        return lose((*answer.content)["error"], help.empty() ? install_driver(chip.maker) : help,
                    (*answer.content)["is_missing"] ? Fault::file : Fault::input);
    }
    return (*answer.content)["driver"].get<std::string>();
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
    const Answer answer = exchange(message_of(to_json(pipeline)));
    if (!answer.content) return tl::unexpected(answer.ending);
    const json& content = *answer.content;
    if (content.contains("error")) return tl::unexpected(content["error"].get<std::string>());
    std::vector<CompiledStage> stages;
    for (const json& stage : content["stages"]) {
        const auto& assembly = stage["assembly"].get_binary();
        stages.push_back(
            {stage["stage"], stage["invocations"], stage["statistics"], {assembly.begin(), assembly.end()}});
    }
    return stages;
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
