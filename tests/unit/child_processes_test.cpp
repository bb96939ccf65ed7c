// Work in child processes: results come back, and who dies takes nothing along.
#include "core/child_processes.hpp"

#include <csignal>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gobo {
namespace {

using testing::IsEmpty;

/// A busy machine may take a second to fill the memory: only the row about time has so little of it.
constexpr ChildLimits limits_for(Death death) {
    return {.processor_seconds = death == Death::time ? 1 : 60,
            .memory = std::size_t{256} << 20,
            .stack = std::size_t{8} << 20};
}
constexpr std::size_t kTasks = 20;
constexpr std::size_t kBadTask = 7;

struct DeathRow {
    const char* name;
    void (*die)();
    Death death;
};

void PrintTo(const DeathRow& row, std::ostream* stream) {
    *stream << row.name;
}

/// Without end as far as anybody knows.
int depth_of(volatile int* above) {
    volatile int here = *above + 1;
    return here < 0 ? 0 : depth_of(&here) + here;
}

void spin() {
    for (volatile unsigned i = 0;;) i = i + 1;
}

void take_memory() {
    for (;;) {
        auto* const taken = new char[1 << 20];
        for (int i = 0; i < 1 << 20; i += 4096) static_cast<volatile char*>(taken)[i] = 1;
    }
}

void exhaust_stack() {
    volatile int zero = 0;
    static_cast<void>(depth_of(&zero));
}

class ChildDeath : public testing::TestWithParam<DeathRow> {};

TEST_P(ChildDeath, IsToldWithItsNoteAndTheRestIsDone) {
    std::set<std::size_t> done;
    std::vector<int> notes;
    bool is_given_up = false;
    const ChildWork work{[&](std::size_t task, Note& note) {
                             note = 100 + static_cast<int>(task);
                             if (task == kBadTask && !is_given_up) GetParam().die();
                             return std::to_string(task) + (is_given_up ? " at last" : "");
                         },
                         [&](std::size_t task, std::string_view bytes) {
                             EXPECT_TRUE(bytes.starts_with(std::to_string(task)));
                             EXPECT_TRUE(task != kBadTask || bytes == "7 at last") << "by a child that knows";
                             return done.insert(task).second;
                         },
                         [&](std::size_t task, int note, Death death) {
                             EXPECT_EQ(task, kBadTask);
                             EXPECT_EQ(death, GetParam().death);
                             notes.push_back(note);
                             is_given_up = true;
                             return true;
                         }};
    EXPECT_THAT(run_in_children(3, kTasks, work, limits_for(GetParam().death)), IsEmpty());
    EXPECT_EQ(done.size(), kTasks);
    EXPECT_THAT(notes, testing::ElementsAre(107));
}

INSTANTIATE_TEST_SUITE_P(Rows, ChildDeath,
                         testing::Values(DeathRow{"segment", [] { std::raise(SIGSEGV); }, Death::crash},
                                         DeathRow{"abort", [] { std::abort(); }, Death::crash},
                                         DeathRow{"kill", [] { std::raise(SIGKILL); }, Death::killed},
                                         DeathRow{"exit", [] { _exit(3); }, Death::crash},
                                         DeathRow{"exit_as_if_done", [] { _exit(0); }, Death::exit},
                                         DeathRow{"stack", exhaust_stack, Death::crash},
                                         DeathRow{"memory", take_memory, Death::memory},
                                         DeathRow{"time", spin, Death::time}),
                         [](const auto& row) { return std::string(row.param.name); });

/// A task that is given up is not tried again; neither is one whose result cannot be read.
TEST(ChildProcesses, LeaveOutWhatIsGivenUp) {
    std::set<std::size_t> done;
    int deaths = 0;
    const ChildWork work{
        [](std::size_t task, Note&) { return std::string(1 << 20, static_cast<char>('a' + task)); },
        [&](std::size_t task, std::string_view bytes) {
            EXPECT_EQ(bytes.size(), 1U << 20) << "more than a pipe holds";
            return task != 2 && done.insert(task).second;
        },
        [&](std::size_t, int, Death) {
            ++deaths;
            return false;
        }};
    EXPECT_THAT(run_in_children(2, 5, work), IsEmpty());
    EXPECT_EQ(done, (std::set<std::size_t>{0, 1, 3, 4}));
    EXPECT_LE(deaths, 1);
}

/// One that only waits takes no processor time; what tells of progress, or that its clock stands, is left
/// alone.
TEST(ChildProcesses, EndWhereTheyAreLate) {
    std::vector<Death> deaths;
    const ChildWork work{[](std::size_t task, Note& note) {
                             for (int i = 0; task == 0 && i < 4; ++i) {
                                 usleep(500'000);
                                 note = i + 1;
                             }
                             if (task == 0) {
                                 note = kClockStands;
                                 usleep(2'000'000);
                             }
                             while (task == 1) pause();
                             return std::string();
                         },
                         [](std::size_t task, std::string_view) { return task == 0; },
                         [&](std::size_t task, int, Death death) {
                             EXPECT_EQ(task, 1U);
                             deaths.push_back(death);
                             return false;
                         }};
    EXPECT_THAT(run_in_children(2, 2, work, {.wall_seconds = 1}), IsEmpty());
    EXPECT_THAT(deaths, testing::ElementsAre(Death::time));
}

TEST(ChildProcesses, MayWriteNoFile) {
    const std::string path = testing::TempDir() + "written_by_a_child";
    bool has_died = false;
    const ChildWork work{[&](std::size_t, Note&) {
                             FILE* const file = std::fopen(path.c_str(), "w");
                             std::fputs("no", file);
                             std::fclose(file);
                             return std::string();
                         },
                         [](std::size_t, std::string_view) { return true; },
                         [&](std::size_t, int, Death) {
                             has_died = true;
                             return false;
                         }};
    EXPECT_THAT(run_in_children(1, 1, work), IsEmpty());
    EXPECT_TRUE(has_died) << "by SIGXFSZ";
    std::remove(path.c_str());
}

/// The parent is killed while its child works: the child ends with it.
TEST(ChildProcesses, EndWithTheirParent) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        const ChildWork work{[&](std::size_t, Note&) {
                                 const pid_t self = getpid();
                                 if (write(ends[1], &self, sizeof self) != sizeof self) _exit(1);
                                 for (;;) pause();
                                 return std::string();
                             },
                             [](std::size_t, std::string_view) { return true; },
                             [](std::size_t, int, Death) { return false; }};
        static_cast<void>(run_in_children(1, 1, work));
        _exit(0);
    }
    close(ends[1]);
    pid_t child = 0;
    ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    char nothing = 0;
    EXPECT_EQ(read(ends[0], &nothing, 1), 0) << "nobody holds the other end any more";
    close(ends[0]);
}

}  // namespace
}  // namespace gobo
