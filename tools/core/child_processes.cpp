#include "core/child_processes.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gobo {
namespace {

constexpr std::size_t kNoTask = ~std::size_t{0};
constexpr int kOutOfMemory = 77;
constexpr int kLookEvery = 200;  // milliseconds, whether a child is late

using Clock = std::chrono::steady_clock;

/// Memory that all the processes share.
struct Shared {
    struct Child {
        std::atomic<std::size_t> task = kNoTask;
        Note note = 0;
    };
    std::atomic<std::size_t> next = 0;  ///< the first task that nobody has taken
    std::array<Child, 1024> children;
};
static_assert(std::atomic<std::size_t>::is_always_lock_free && Note::is_always_lock_free);

/// Stands before the bytes of a result.
struct Head {
    std::uint64_t task;
    std::uint64_t size;
};

void limit(int resource, rlim_t most) {
    rlimit now{};
    getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
    now.rlim_cur = std::min(most, now.rlim_max);
    setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
}

/// The address space that this process holds, in bytes.
std::size_t held_memory() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void set_limits(const ChildLimits& limits) {
    if (limits.memory > 0) limit(RLIMIT_AS, held_memory() + limits.memory);
    limit(RLIMIT_STACK, limits.stack);
    if (!limits.writes_files) limit(RLIMIT_FSIZE, 0);
    limit(RLIMIT_CORE, 0);
    // Where the parent ignores or handles them, the child dies all the same.
    for (const int number : {SIGXCPU, SIGPIPE, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
        std::signal(number, SIG_DFL);
    std::set_new_handler([] { _exit(kOutOfMemory); });
    // What calls exit() may hold what its libraries' destructors wait for.
    ::on_exit([](int status, void*) { _exit(status); }, nullptr);
}

/// The processor time of a process counts from its start.
void limit_time(int seconds) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 + seconds));
}

class Pool {
  public:
    Pool(int jobs, std::size_t count, const ChildWork& work, const ChildLimits& limits)
        : count_(count), work_(work), limits_(limits), is_done_(count, false) {
        void* const memory =
            mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) return;
        shared_ = new (memory) Shared;
        const std::size_t children =
            std::min({static_cast<std::size_t>(jobs), count, shared_->children.size()});
        for (std::size_t i = 0; i < children; ++i) start(i, kNoTask);
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;
    ~Pool() {
        if (shared_ != nullptr) munmap(shared_, sizeof(Shared));
    }

    std::vector<std::size_t> run() {
        while (!children_.empty()) {
            std::vector<pollfd> files;
            for (const Child& child : children_) files.push_back({child.file, POLLIN, 0});
            const int wait = limits_.wall_seconds > 0 ? kLookEvery : -1;
            if (poll(files.data(), files.size(), wait) < 0) continue;  // a signal came
            for (std::size_t i = files.size(); i-- > 0;)
                if (files[i].revents != 0) read_from(i);
            if (limits_.wall_seconds > 0)
                for (Child& child : children_) end_if_late(child);
        }
        std::vector<std::size_t> left;
        for (std::size_t task = 0; task < count_; ++task)
            if (!is_done_[task]) left.push_back(task);
        return left;
    }

  private:
    struct Child {
        pid_t process;
        int file;           ///< the end of its pipe to read from
        std::size_t place;  ///< in Shared::children
        std::string received = {};
        std::size_t task = kNoTask;  ///< as last seen, and since when
        int note = 0;
        Clock::time_point since = Clock::now();
        bool is_late = false;
    };

    /// Kills a child that has been at one thing for too long; its pipe closes then.
    void end_if_late(Child& child) const {
        const Shared::Child& own = shared_->children[child.place];
        if (child.task != own.task || child.note != own.note || own.note == kClockStands) {
            child.task = own.task;
            child.note = own.note;
            child.since = Clock::now();
        } else if (!child.is_late && child.task != kNoTask &&
                   Clock::now() - child.since > std::chrono::seconds(limits_.wall_seconds)) {
            child.is_late = true;
            kill(child.process, SIGKILL);
        }
    }

    /// Starts a child, which begins with a task of its own where `first` is one. Where the system refuses
    /// it, the others do all.
    void start(std::size_t place, std::size_t first) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
        const pid_t parent = getpid();
        const pid_t process = fork();
        if (process == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (getppid() != parent) _exit(1);
            work_off(shared_->children[place], first, ends[1]);
        }
        close(ends[1]);
        if (process < 0)
            close(ends[0]);
        else
            children_.push_back({process, ends[0], place});
    }

    [[noreturn]] void work_off(Shared::Child& self, std::size_t first, int file) {
        set_limits(limits_);
        for (std::size_t task = first == kNoTask ? shared_->next++ : first; task < count_;
             task = shared_->next++) {
            self.note = 0;
            self.task = task;
            if (limits_.processor_seconds > 0) limit_time(limits_.processor_seconds);
            const std::string bytes = work_.work(task, self.note);
            const Head head{task, bytes.size()};
            write_or_exit(file, {reinterpret_cast<const char*>(&head), sizeof head});
            write_or_exit(file, bytes);
            self.task = kNoTask;
            if (self.note == kStartAnew) break;
        }
        _exit(0);
    }

    void read_from(std::size_t index) {
        Child& child = children_[index];
        std::array<char, 65536> buffer;
        const ssize_t size = read(child.file, buffer.data(), buffer.size());
        if (size < 0 && errno == EINTR) return;
        if (size <= 0) return ended(index);
        child.received.append(buffer.data(), static_cast<std::size_t>(size));
        std::string_view rest = child.received;
        while (rest.size() >= sizeof(Head)) {
            Head head{};
            std::memcpy(&head, rest.data(), sizeof head);
            if (rest.size() - sizeof head < head.size) break;
            const auto task = static_cast<std::size_t>(head.task);
            if (task >= count_ || !work_.done(task, rest.substr(sizeof head, head.size)))
                return broken(index, task);
            is_done_[task] = true;
            rest.remove_prefix(sizeof head + head.size);
        }
        child.received.erase(0, child.received.size() - rest.size());
    }

    /// Closes a child's pipe and waits for its end.
    int reap(std::size_t index) {
        const Child child = std::move(children_[index]);
        children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(index));
        close(child.file);
        int status = 0;
        while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) {
        }
        return status;
    }

    /// A child's result cannot be read: nothing it sends can be trusted. Another one does what it is doing
    /// now.
    void broken(std::size_t index, std::size_t task) {
        const std::size_t place = children_[index].place;
        kill(children_[index].process, SIGKILL);
        reap(index);
        if (task >= count_) return;
        work_.died(task, 0, Death::crash);
        is_done_[task] = true;
        const std::size_t next = shared_->children[place].task.exchange(kNoTask);
        start(place, next < count_ && !is_done_[next] ? next : kNoTask);
    }

    /// A child is at its end, or has died.
    void ended(std::size_t index) {
        const std::size_t place = children_[index].place;
        const bool is_late = children_[index].is_late;
        const int status = reap(index);
        const bool is_exit = WIFEXITED(status) && WEXITSTATUS(status) == 0;
        const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        const bool is_full = WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory;
        const Death death = is_late || signal == SIGXCPU ? Death::time
                            : signal == SIGKILL          ? Death::killed
                            : is_full                    ? Death::memory
                            : is_exit                    ? Death::exit
                                                         : Death::crash;
        Shared::Child& last = shared_->children[place];
        std::size_t task = last.task.exchange(kNoTask);
        if (task >= count_ && last.note.exchange(0) == kStartAnew) return start(place, kNoTask);
        if (task >= count_) return;  // all is done, or it died of itself: so would the next
        if (!is_done_[task] && !work_.died(task, last.note, death)) is_done_[task] = true;
        if (is_done_[task]) task = kNoTask;
        start(place, task);
    }

    std::size_t count_;
    const ChildWork& work_;
    const ChildLimits& limits_;
    std::vector<bool> is_done_;
    Shared* shared_ = nullptr;
    std::vector<Child> children_;
};

}  // namespace

void write_or_exit(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(file, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) _exit(1);
        bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
}

std::vector<std::size_t> run_in_children(int jobs, std::size_t count, const ChildWork& work,
                                         const ChildLimits& limits) {
    return Pool(jobs, count, work, limits).run();
}

}  // namespace gobo
