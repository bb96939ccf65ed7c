// gobo watch: what gobo build does, again whenever a file that it read changes.
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "core/file_error.hpp"
#include "core/file_trace.hpp"
#include "core/file_watch.hpp"
#include "core/result_cache.hpp"
#include "gobo/application.hpp"
#include "gobo/build.hpp"
#include "gobo/commands.hpp"
#include "gobo/reload_server.hpp"

namespace gobo {
namespace {

using Clock = std::chrono::steady_clock;

/// Milliseconds of quiet after which a file is taken for saved, and between two looks where nobody tells.
constexpr int kQuiet = 5;
constexpr int kBetweenLooks = 200;
/// Milliseconds after which a socket that was removed is made again, and tried again what no change of a file
/// that was read mends: a build that had no descriptors left, an output that could not be written.
constexpr int kBetweenTries = 1000;

struct WatchOptions : BuildOptions {
    std::string socket;
    bool looks = false;
};

/// Ends of the process that others ask for, as something to wait for.
class Ending {
  public:
    Ending() {
        sigset_t ends;
        sigemptyset(&ends);
        for (const int end : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, end);
        sigprocmask(SIG_BLOCK, &ends, &before_);
        descriptor_ = ::signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
    }
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;
    ~Ending() {
        signalfd_siginfo told{};
        while (::read(descriptor_, &told, sizeof told) > 0) {
        }
        ::close(descriptor_);
        sigprocmask(SIG_SETMASK, &before_, nullptr);
    }
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    sigset_t before_{};
    int descriptor_ = -1;
};

/// Ends the process as soon as that is asked for, however long a build would take. Nothing is written while
/// this lives.
class EndingAtOnce {
  public:
    /// Removes the socket, if it has a name.
    EndingAtOnce(const Ending& ending, const std::string& socket) : done_(::eventfd(0, EFD_CLOEXEC)) {
        if (done_ < 0) return;
        try {
            thread_ = std::thread([this, &ending, &socket] {
                std::array<pollfd, 2> waited = {{{ending.descriptor(), POLLIN, 0}, {done_, POLLIN, 0}}};
                while (::poll(waited.data(), waited.size(), -1) < 0) {
                }
                if (waited[0].revents == 0) return;
                if (!socket.empty()) ::unlink(socket.c_str());
                std::_Exit(0);
            });
        } catch (const std::system_error&) {  // no more threads: it ends behind the build
        }
    }
    EndingAtOnce(const EndingAtOnce&) = delete;
    EndingAtOnce& operator=(const EndingAtOnce&) = delete;
    ~EndingAtOnce() {
        if (thread_.joinable()) {
            ::eventfd_write(done_, 1);
            thread_.join();
        }
        if (done_ >= 0) ::close(done_);
    }

  private:
    int done_;
    std::thread thread_;
};

class Watcher {
  public:
    Watcher(const WatchOptions& options, const World& world, std::unique_ptr<ReloadServer> server)
        : options_(options),
          world_(world),
          cache_(world.cache == nullptr ? memory_ : *world.cache),
          server_(std::move(server)) {}

    /// Builds until it is asked to end. The error of the first build where no saved file can change it.
    Result<Outcome> run() {
        Next next = Next::change;
        for (bool is_first = true;; is_first = false) {
            Clock::time_point start = Clock::now();
            TracedFiles files(world_.disk);
            Result<Built> built = [&] {
                const EndingAtOnce at_once(ending_, options_.socket);
                return build(options_,
                             {files, world_.shipped, world_.options, world_.measure, &cache_, world_.tell});
            }();
            if (!built && is_first && exit_status(built.error()) > 1)
                return tl::unexpected(std::move(built).error());
            if (const std::string& once = files.read_once(); !once.empty() && (built || is_first)) {
                built = fail({.fault = Fault::usage,
                              .place = {once},
                              .message = "a file that is read only once cannot be watched",
                              .help = "name files, not standard input or a pipe"});
                if (is_first) return tl::unexpected(std::move(built).error());
            }
            if (auto there = refuse_lost_folders(); built && !there)
                built = tl::unexpected(std::move(there).error());
            do {
                std::vector<FileQuestion> questions = files.questions();
                for (const FileQuestion& question : tell(built, start, next != Next::change))
                    questions.push_back(question);
                next = wait(questions);
                start = Clock::now();
            } while (next == Next::write);
            if (next == Next::end) return Outcome{};
        }
    }

  private:
    /// What follows a wait: a build as something changed, or a second try to build, or to write what is
    /// built.
    enum class Next { end, change, build, write };

    /// One may not be there yet; without one that was there, other pieces would be taken in silence.
    Result<void> refuse_lost_folders() {
        for (const std::string& folder : world_.options.include_folders) {
            std::error_code error;
            if (std::filesystem::is_directory(folder, error))
                folders_.insert(folder);
            else if (folders_.contains(folder))
                return fail(Fault::file, fmt::format("-I '{}' is no folder any more", folder),
                            "put it back, or watch without it");
        }
        return {};
    }

    /// Writes what was built, and says so; of a second try not what was said of the first. That what was
    /// written is there is asked, too.
    std::vector<FileQuestion> tell(const Result<Built>& built, Clock::time_point start, bool is_second_try) {
        Result<Outcome> outcome = built ? with_files_written(built->outcome) : tl::unexpected(built.error());
        second_try_ = std::nullopt;
        if (!outcome && built) second_try_ = Next::write;
        if (!built && are_of_descriptors(built.error())) second_try_ = Next::build;
        const std::string errors = outcome ? "" : to_text(outcome.error());
        const bool is_told = errors == std::exchange(told_, errors);
        if (is_told && (is_second_try || second_try_ == Next::build) && !outcome) return {};
        if (!outcome) {
            if (server_) server_->offer_errors(errors);
            world_.tell(
                {{}, std::move(outcome).error(), fmt::format("{}: waiting for a change", options_.family)});
            return {};
        }
        if (server_) {
            const std::size_t changed = server_->offer(built->family, built->composition);
            outcome->summary += fmt::format(", {} {} sent", changed, changed == 1 ? "program" : "programs");
        }
        const auto taken = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
        outcome->summary += fmt::format(", {} ms", taken.count());
        world_.tell(*outcome);
        const TracedFiles written(world_.disk);
        for (const OutputFile& file : outcome->files) static_cast<void>(written.is_file(file.path));
        return written.questions();
    }

    /// Until an answer is another one, or it is time to try again.
    Next wait(const std::vector<FileQuestion>& questions) {
        watch_.take_news();  // of what was written here, and of what is asked now
        watch_.follow(questions);
        const bool looks = options_.looks || watch_.descriptor() < 0;
        while (are_answered_alike(questions, world_.disk)) {
            for (bool has_news = false; !has_news;) {
                std::vector<pollfd> waited = {{ending_.descriptor(), POLLIN, 0},
                                              {watch_.descriptor(), POLLIN, 0},
                                              {STDERR_FILENO, 0, 0}};
                if (server_)
                    for (const pollfd& socket : server_->descriptors()) waited.push_back(socket);
                const int timeout = looks ? kBetweenLooks : second_try_ || server_ ? kBetweenTries : -1;
                const int ready = ::poll(waited.data(), waited.size(), timeout);
                if (ready < 0) continue;
                // Or nobody reads any more what is told.
                if (waited[0].revents != 0 || (waited[2].revents & POLLERR) != 0) return Next::end;
                if (server_) server_->serve(waited);
                if (server_) server_->restore_socket();
                if (ready == 0 && second_try_) return *second_try_;
                has_news = looks || waited[1].revents != 0;
            }
            // An editor writes a file, then renames it; a checkout changes many.
            for (pollfd news{watch_.descriptor(), POLLIN, 0}; ::poll(&news, 1, kQuiet) > 0;)
                watch_.take_news();
            if (looks) continue;
            // New folders are followed where it is not urgent, then asked for what they held already.
            if (!are_answered_alike(questions, world_.disk)) return Next::change;
            watch_.follow(questions);
        }
        return Next::change;
    }

    const WatchOptions& options_;
    const World& world_;
    MemoryCache memory_;
    ResultCache& cache_;
    std::unique_ptr<ReloadServer> server_;
    std::set<std::string> folders_;  ///< of -I, that were there
    Ending ending_;
    FileWatch watch_;
    std::string told_;                ///< the errors of the last state
    std::optional<Next> second_try_;  ///< where no change of a file that was read need mend the last state
};

Result<Outcome> run(const WatchOptions& options, const World& world) {
    if (options.folder == kStandardOutput)
        return fail(Fault::usage, "what is printed cannot be built again", "name a folder with -o");
    std::unique_ptr<ReloadServer> server;
    if (!options.socket.empty()) {
        GOBO_TRY(server, ReloadServer::open(options.socket));
    }
    return Watcher(options, world, std::move(server)).run();
}

}  // namespace

Command watch_command() {
    const auto options = std::make_shared<WatchOptions>();
    Command command = {{"watch", "Build, and build again whenever a file is saved"},
                       build_arguments(*options),
                       build_groups(*options),
                       "  gobo watch game.toml --keys-from game.keys -I pieces -o generated\n"
                       "  gobo watch game.toml --keys-from game.keys -o generated --serve /tmp/game.reload",
                       [options](const World& world) { return run(*options, world); },
                       "It ends with control-C. After each build the errors of the last state are told, and "
                       "nothing else; the "
                       "header stays as it was until there are none."};
    command.options.push_back(
        {"--serve", "FILE",
         "A socket at which running applications take changed programs, by <gobo/reload.hpp>",
         &options->socket});
    command.options.push_back(
        {"--look", "",
         "Look for changes five times a second, where the system tells of none: files of a "
         "network, or of a host computer",
         &options->looks});
    return command;
}

}  // namespace gobo
