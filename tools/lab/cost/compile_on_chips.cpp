#include "lab/cost/compile_on_chips.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>

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

/// Pipelines that one process is asked about, one after the other.
struct Task {
    std::size_t chip = 0;
    std::deque<std::size_t> pipelines;  ///< those that are not answered
};

// The process that is asked. It answers in lines of JSON: first the driver's name, then each pipeline.

void set_environment(const Chip& chip) {
    std::string family(chip.name);
    std::transform(family.begin(), family.end(), family.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    // A caller's switches would change figures.
    for (const char* name : {"RADV_PERFTEST", "ACO_DEBUG", "NIR_DEBUG", "RADV_FORCE_VRS", "RADV_TEX_ANISO"})
        ::unsetenv(name);
    ::setenv("RADV_FORCE_FAMILY", family.c_str(), 1);
    // Without culling in the vertex stage: it is the driver's, the same for all, and as long as the stage.
    ::setenv("RADV_DEBUG", "nonggc", 1);
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

void say(int out, const nlohmann::json& answer) {
    const std::string line = answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
    for (std::size_t at = 0; at < line.size();) {
        const ::ssize_t written = ::write(out, line.data() + at, line.size() - at);
        if (written <= 0) ::_exit(1);
        at += static_cast<std::size_t>(written);
    }
}

nlohmann::json to_json(const Diagnostic& error) {
    return {{"error", error.message}, {"help", error.help}, {"is_missing", error.fault == Fault::file}};
}

[[noreturn]] void answer(int out, const Chip& chip, const std::vector<Pipeline>& pipelines, const Task& task,
                         const std::string& library) {
    set_environment(chip);
    const Result<Driver> driver = Driver::open(library);
    if (!driver) {
        say(out, to_json(driver.error().front()));
        ::_exit(0);
    }
    say(out, {{"driver", driver->name()}});
    for (const std::size_t pipeline : task.pipelines) {
        const auto stages = driver->compile(pipelines[pipeline]);
        if (!stages) {
            say(out, to_json(stages.error().front()));
            continue;
        }
        nlohmann::json told;
        for (const CompiledStage& stage : *stages)
            told.push_back({{"stage", stage.stage},
                            {"invocations", stage.invocations},
                            {"statistics", stage.statistics},
                            {"assembly", stage.assembly}});
        say(out, {{"stages", told}});
    }
    ::_exit(0);
}

CompiledPipeline read_answer(const nlohmann::json& told) {
    if (told.contains("error")) return tl::unexpected(told["error"].get<std::string>());
    std::vector<CompiledStage> stages;
    for (const nlohmann::json& stage : told["stages"])
        stages.push_back({stage["stage"], stage["invocations"], stage["statistics"], stage["assembly"]});
    return stages;
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

// The process that asks.

struct Helper {
    Task task;
    ::pid_t process = 0;
    int out = -1;     ///< its answers
    int errors = -1;  ///< whatever the driver prints
    std::string answers;
    std::string printed;
    bool has_opened = false;
    bool timed_out = false;
    Clock::time_point deadline;
};

class Compilation {
  public:
    Compilation(const std::vector<Chip>& chips, const std::vector<Pipeline>& pipelines,
                const CompileOptions& options)
        : chips_(chips), pipelines_(pipelines), options_(options) {
        const auto jobs = static_cast<std::size_t>(std::max(options.jobs, 1));
        const std::size_t shares = std::clamp<std::size_t>(pipelines.size() / 8, 1, jobs);
        for (std::size_t chip = 0; chip < chips.size(); ++chip) {
            results_.emplace_back(ChipAnswers{
                "", std::vector<CompiledPipeline>(pipelines.size(), tl::unexpected(std::string()))});
            for (std::size_t share = 0; share < shares; ++share) {
                Task& task = waiting_.emplace_back(Task{chip, {}});
                for (std::size_t i = share; i < pipelines.size(); i += shares) task.pipelines.push_back(i);
            }
        }
    }

    std::vector<Result<ChipAnswers>> run() {
        while (!waiting_.empty() || !running_.empty()) {
            while (!waiting_.empty() && static_cast<int>(running_.size()) < std::max(options_.jobs, 1))
                start_one();
            wait_for_answers();
        }
        return std::move(results_);
    }

  private:
    void start_one() {
        Task task = std::move(waiting_.front());
        waiting_.pop_front();
        if (!results_[task.chip]) return;  // another share has found that there is no driver
        int out[2];
        int errors[2];
        if (::pipe2(out, O_CLOEXEC) != 0) return lose(task.chip, "no pipe can be made");
        if (::pipe2(errors, O_CLOEXEC) != 0) {
            ::close(out[0]);
            ::close(out[1]);
            return lose(task.chip, "no pipe can be made");
        }
        const ::pid_t parent = ::getpid();
        const ::pid_t process = ::fork();
        if (process == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (::getppid() != parent) ::_exit(1);
            const ::rlimit no_core{0, 0};
            ::setrlimit(RLIMIT_CORE, &no_core);
            ::dup2(errors[1], STDOUT_FILENO);
            ::dup2(errors[1], STDERR_FILENO);
            answer(out[1], chips_[task.chip], pipelines_, task, options_.driver);
        }
        ::close(out[1]);
        ::close(errors[1]);
        Helper helper;
        helper.task = std::move(task);
        helper.process = process;
        helper.out = out[0];
        helper.errors = errors[0];
        helper.deadline = Clock::now() + std::chrono::seconds(options_.time_limit);
        if (process < 0) {
            close(helper);
            return lose(helper.task.chip, "no process can be started");
        }
        running_.push_back(std::move(helper));
    }

    void lose(std::size_t chip, const std::string& reason, const std::string& help = {},
              Fault fault = Fault::file) {
        results_[chip] = fail(fault, fmt::format("{}: {}", chips_[chip].name, reason), help);
    }

    static void close(const Helper& helper) {
        ::close(helper.out);
        ::close(helper.errors);
    }

    void wait_for_answers() {
        std::vector<::pollfd> ends;
        Clock::time_point first = Clock::time_point::max();
        for (const Helper& helper : running_) {
            ends.push_back({helper.out, POLLIN, 0});
            ends.push_back({helper.errors, POLLIN, 0});
            first = std::min(first, helper.deadline);
        }
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(first - Clock::now()).count();
        if (::poll(ends.data(), ends.size(), static_cast<int>(std::max<long>(left, 0))) < 0) return;
        std::vector<Helper> going_on;
        for (std::size_t i = 0; i < running_.size(); ++i) {
            Helper& helper = running_[i];
            if (ends[2 * i + 1].revents != 0) read_some(helper.errors, helper.printed);
            const bool has_closed = ends[2 * i].revents != 0 && !read_some(helper.out, helper.answers);
            take_answers(helper);
            helper.timed_out = !has_closed && Clock::now() >= helper.deadline;
            if (helper.timed_out) ::kill(helper.process, SIGKILL);
            if (has_closed || helper.timed_out)
                finish(helper);
            else
                going_on.push_back(std::move(helper));
        }
        running_ = std::move(going_on);
    }

    /// False at the end of what is written.
    static bool read_some(int file, std::string& text) {
        char buffer[1 << 16];
        const ::ssize_t count = ::read(file, buffer, sizeof buffer);
        if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
        return count > 0 || (count < 0 && errno == EINTR);
    }

    void take_answers(Helper& helper) {
        for (std::size_t end = helper.answers.find('\n'); end != std::string::npos;
             end = helper.answers.find('\n')) {
            const auto told = nlohmann::json::parse(
                helper.answers.begin(), helper.answers.begin() + static_cast<std::ptrdiff_t>(end));
            helper.answers.erase(0, end + 1);
            helper.deadline = Clock::now() + std::chrono::seconds(options_.time_limit);
            const std::size_t chip = helper.task.chip;
            if (!helper.has_opened && told.contains("error")) {
                lose(chip, told["error"], told["help"], told["is_missing"] ? Fault::file : Fault::input);
                helper.task.pipelines.clear();
            } else if (!helper.has_opened) {
                if (results_[chip]) results_[chip]->driver = told["driver"];
            } else {
                if (results_[chip])
                    results_[chip]->pipelines[helper.task.pipelines.front()] = read_answer(told);
                helper.task.pipelines.pop_front();
            }
            helper.has_opened = true;
        }
    }

    /// The pipeline that it was busy with is lost, the rest is asked anew.
    void finish(Helper& helper) {
        int status = 0;
        while (::waitpid(helper.process, &status, 0) < 0 && errno == EINTR) {
        }
        while (read_some(helper.errors, helper.printed) && !helper.timed_out) {
        }
        close(helper);
        const std::string ending = helper.timed_out
                                       ? fmt::format("gave no answer within {} s", options_.time_limit)
                                       : ending_of(status, helper.printed);
        const std::size_t chip = helper.task.chip;
        if (!helper.has_opened)
            return lose(chip, fmt::format("the driver {}", ending), kInstallNewer, Fault::file);
        if (helper.task.pipelines.empty()) return;
        if (results_[chip]) results_[chip]->pipelines[helper.task.pipelines.front()] = tl::unexpected(ending);
        helper.task.pipelines.pop_front();
        if (!helper.task.pipelines.empty()) waiting_.push_back(std::move(helper.task));
    }

    const std::vector<Chip>& chips_;
    const std::vector<Pipeline>& pipelines_;
    CompileOptions options_;
    std::deque<Task> waiting_;
    std::vector<Helper> running_;
    std::vector<Result<ChipAnswers>> results_;
};

}  // namespace

std::vector<Result<ChipAnswers>> compile_on_chips(const std::vector<Chip>& chips,
                                                  const std::vector<Pipeline>& pipelines,
                                                  const CompileOptions& options) {
    return Compilation(chips, pipelines, options).run();
}

}  // namespace gobo::cost
