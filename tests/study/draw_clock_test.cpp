// Clocks of draws, held to a load that is known.
#include "lab/study/draw_clock.hpp"

#include <ctime>

#include <gtest/gtest.h>

#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

struct LoadRow {
    const char* name;
    std::vector<LoadTime> times;
    double error;
};

class LoadErrors : public testing::TestWithParam<LoadRow> {};

TEST_P(LoadErrors, TellHowFarAClockIsFromALoad) {
    EXPECT_NEAR(load_error(GetParam().times), GetParam().error, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, LoadErrors,
    testing::Values(LoadRow{"in_proportion", {{1, 10}, {2, 20}, {3, 30}, {4, 40}}, 0},
                    LoadRow{"with_a_beginning", {{1, 110}, {2, 120}, {3, 130}, {4, 140}}, 0},
                    // The line through the others' middle: 10, 20, 30, 40 with 3 too many at one end.
                    LoadRow{"one_is_off", {{1, 10}, {2, 20}, {3, 30}, {4, 43}}, 1.2 / 32.7},
                    LoadRow{"constant", {{1, 10}, {2, 10}, {3, 10}, {4, 10}}, 1},
                    LoadRow{"backwards", {{1, 40}, {2, 30}, {3, 20}, {4, 10}}, 1},
                    LoadRow{"too_few", {{1, 10}, {2, 20}}, 1}, LoadRow{"none", {}, 1}),
    [](const auto& row) { return row.param.name; });

/// A software renderer stands in for a GPU: it draws in this thread, whose processor time is a clock that
/// other programs do not disturb.
class KnownLoad : public testing::Test {
  protected:
    void SetUp() override {
        make_timings_repeatable();
        auto opened = open_context(Backend::egl);
        // EGL is optional, and what is known of a load holds for a renderer that draws in the calling thread.
        if (!opened) GTEST_SKIP() << "SKIPPED: " << to_text(opened.error().front());
        context_.emplace(*std::move(opened));
        if (!draws_in_calling_thread(context_->renderer())) GTEST_SKIP() << "SKIPPED: a GPU";
    }

    /// The thread's processor time, as `distorted` has it.
    DrawClock processor_clock(const std::function<double(double)>& distorted) const {
        return [this, distorted](const std::function<void()>& draw) {
            const auto now = [] {
                timespec time{};
                clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
                return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
            };
            context_->gl().Finish();
            const double start = now();
            draw();
            context_->gl().Finish();
            return distorted(now() - start);
        };
    }

    std::optional<Context> context_;
};

TEST_F(KnownLoad, BearsOutAClockThatCounts) {
    const auto error = known_load_error(*context_, processor_clock([](double time) { return time; }));
    ASSERT_TRUE(error);
    EXPECT_LT(*error, 2 * kLargestLoadError) << context_->renderer();
}

TEST_F(KnownLoad, RefusesClocksThatDoNot) {
    const auto stopped = known_load_error(*context_, processor_clock([](double) { return 5e6; }));
    const auto counter =
        known_load_error(*context_, processor_clock([](double time) { return std::min(time, 5e6); }));
    ASSERT_TRUE(stopped && counter);
    EXPECT_EQ(*stopped, 1);
    EXPECT_GT(*counter, kLargestLoadError) << "a counter that is full";
}

/// Whether llvmpipe's own clock is trusted is its affair: what is chosen must have been tried.
TEST_F(KnownLoad, DecidesWhichClockIsChosen) {
    const auto query = known_load_error(*context_, timer_query(*context_));
    const auto chosen = choose_clock(*context_);
    ASSERT_TRUE(query && chosen);
    EXPECT_TRUE(chosen->name == "glFinish" || chosen->is_trusted()) << chosen->name << " " << chosen->error;
    EXPECT_GT(chosen->clock([] {}), -1);
    std::printf("%s: timer query off by %.3f, chosen %s, off by %.3f\n", context_->renderer().c_str(), *query,
                chosen->name.c_str(), chosen->error);
}

}  // namespace
}  // namespace gobo::study
