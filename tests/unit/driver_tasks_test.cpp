// Tasks of drivers in child processes: what one that dies costs.
#include "lab/render/driver_tasks.hpp"

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace gobo {
namespace {

struct DeathRow {
    const char* name;
    void (*die)();
    const char* ending;
};

void hang() {
    for (;;) ::pause();
}

class DriverDeath : public testing::TestWithParam<DeathRow> {
  protected:
    /// Five tasks by two processes, of which the third dies in its part 4. What each came to, as text.
    static Result<std::vector<std::string>> run(const std::function<Result<int>()>& open) {
        std::vector<std::string> texts(5);
        DriverTasks<int, std::string> tasks{"the driver", texts.size(), 2, open};
        tasks.work = [](int, std::size_t task, DriverClock& clock) -> Result<std::string> {
            clock.begin(4);
            if (task == 2) GetParam().die();
            clock.stop();
            if (task == 1) ::usleep(1'500'000);  // longer than the driver may take
            return std::string(task, '*');
        };
        tasks.done = [&](std::size_t task, Result<std::string> value, std::optional<int> death) {
            texts[task] = value ? *value : value.error().front().message;
            if (death) texts[task] += " in part " + std::to_string(*death);
        };
        tasks.seconds = 1;
        GOBO_TRY_DO(ask_driver(tasks));
        return texts;
    }
};

TEST_P(DriverDeath, CostsItsTaskAlone) {
    const auto texts = run([] { return Result<int>(1); });
    ASSERT_TRUE(texts);
    EXPECT_THAT(*texts,
                testing::ElementsAre("", "*", std::string("the driver ") + GetParam().ending + " in part 4",
                                     "***", "****"));
}

TEST_P(DriverDeath, WhileItIsOpenedIsTheOnlyError) {
    const auto texts = run([]() -> Result<int> {
        GetParam().die();
        return 1;
    });
    ASSERT_FALSE(texts);
    EXPECT_EQ(to_text(texts.error().front()),
              std::string("gobo: error: the driver ") + GetParam().ending +
                  "\n  help: try the other --backend, or another version of Mesa\n");
    EXPECT_EQ(exit_status(texts.error()), 3);
}

INSTANTIATE_TEST_SUITE_P(Rows, DriverDeath,
                         testing::Values(DeathRow{"crash", [] { std::raise(SIGSEGV); }, "crashed"},
                                         DeathRow{"hang", hang, "gave no answer within 1 s"},
                                         DeathRow{"exit", [] { ::_exit(0); }, "ended the process"},
                                         DeathRow{"killed", [] { std::raise(SIGKILL); }, "was killed"}),
                         [](const auto& row) { return std::string(row.param.name); });

/// A driver that has answered with an error may answer so for ever: the next task has a process of its own.
TEST(DriverTasks, AFailureOfTheDriverCostsItsTaskAlone) {
    std::vector<std::string> texts(4);
    DriverTasks<int, int> tasks{"the driver", texts.size(), 1};
    tasks.open = [] { return Result<int>(0); };
    tasks.work = [](int& asked, std::size_t, DriverClock& clock) -> Result<int> {
        clock.begin(3);
        if (++asked > 1) return fail(Fault::file, "the device is lost");
        return asked;
    };
    tasks.done = [&](std::size_t task, Result<int> value, std::optional<int> death) {
        texts[task] = value ? "done" : value.error().front().message;
        if (death) texts[task] += " in part " + std::to_string(*death);
        EXPECT_EQ(value ? 0 : exit_status(value.error()), death ? 1 : 0);
    };
    ASSERT_TRUE(ask_driver(tasks));
    EXPECT_THAT(texts, testing::ElementsAre("done", "the device is lost in part 3", "done",
                                            "the device is lost in part 3"));
}

TEST(DriverTasks, AnErrorOfOpeningIsTheOnlyError) {
    DriverTasks<int, int> tasks{"the driver", 3, 2};
    tasks.open = []() -> Result<int> { return fail(Fault::file, "there is no driver"); };
    tasks.work = [](int, std::size_t, DriverClock&) -> Result<int> { return 1; };
    tasks.done = [](std::size_t, Result<int>, std::optional<int>) { ADD_FAILURE() << "nothing was done"; };
    const auto done = ask_driver(tasks);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().front().message, "there is no driver");
}

}  // namespace
}  // namespace gobo
