// How long a fragment and a vertex take on a renderer: slopes between two sizes, in interleaved rounds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/render/context.hpp"
#include "lab/render/draw_list.hpp"
#include "lab/study/statistics.hpp"
#include "lab/study/variants.hpp"

namespace gobo::study {

/// Nanoseconds for one fragment and one vertex, over the rounds.
struct Slopes {
    Spread fragment;
    Spread vertex;
};

/// One permutation's times. `elapsed` is a monotonic clock's around glFinish(); `processor` the calling
/// thread's processor time, which other programs on the machine do not add to. It says nothing where the
/// renderer works elsewhere than in that thread.
struct Timing {
    Slopes elapsed;
    Slopes processor;
    int rounds = 0;
    std::string renderer;
};

/// How far two copies of one program came out from one another: |ratio of the medians - 1|.
struct Control {
    double elapsed = 0;
    double processor = 0;
};

/// Nothing is ranked by a clock whose control is off by more.
inline constexpr double kLargestControl = 0.02;
/// Fewer rounds give no quartiles worth the name.
inline constexpr int kLeastRounds = 20;

struct TimedGroup {
    std::vector<Timing> timings;  ///< in the order of the keys
    Control control;
};

/// Makes Mesa's software renderer work in the calling thread and compile what it is given. Before the first
/// context is opened.
void make_timings_repeatable();

/// Whether the renderer draws in the calling thread once make_timings_repeatable() was called.
[[nodiscard]] bool draws_in_calling_thread(const std::string& renderer);

/// The fragments that pass the depth test when the list is drawn to the framebuffer that is bound.
double count_fragments(const Context& context, const DrawList& list);

/// The control of the clock to rank by: see cost_against_time().
[[nodiscard]] double ranked_control(const Control& control, const std::string& renderer);

/// Times the keys in rounds, each in another order, with a second copy of the first key as the control. Where
/// that fails, something else ran: all is timed anew, up to twice.
/// `scene` is drawn at 160 x 120 and 480 x 360 for the fragments, spheres of two tessellations at 16 x 12 for
/// the vertices.
[[nodiscard]] Result<TimedGroup> time_variants(const Context& context, const Family& family,
                                               const Variants& variants, const std::vector<Key>& keys,
                                               const DrawnScene& scene, int rounds);

}  // namespace gobo::study
