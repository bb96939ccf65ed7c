// How long fragments and vertices take on a renderer: slopes between two sizes, in interleaved rounds. What
// one operation costs there, and how many instructions a fragment takes.
#pragma once

#include <string>
#include <vector>

#include "lab/render/context.hpp"
#include "lab/study/measure.hpp"
#include "lab/study/statistics.hpp"

namespace gobo::study {

/// Nanoseconds for one fragment and one vertex, over the rounds.
struct Slopes {
    Spread fragment;
    Spread vertex;
};

/// Whether the renderer draws in the calling thread once make_timings_repeatable() was called.
[[nodiscard]] bool draws_in_calling_thread(const std::string& renderer);

/// Something by two clocks. `elapsed` is a monotonic clock's around glFinish(), or of a GPU the one that
/// choose_clock() trusts; `processor` the calling thread's processor time, which other programs do not add
/// to. It says nothing where the renderer works elsewhere than in that thread.
template <class T>
struct ByClock {
    T elapsed{};
    T processor{};

    /// What to rank by: the processor's time where the renderer draws in the calling thread, else the elapsed
    /// time.
    [[nodiscard]] const T& ranked(const std::string& renderer) const {
        return draws_in_calling_thread(renderer) ? processor : elapsed;
    }
};

/// One permutation's times.
struct Timing : ByClock<Slopes> {
    int rounds = 0;
    std::string renderer;  ///< with the clock, where one was chosen

    [[nodiscard]] const Slopes& ranked() const { return ByClock::ranked(renderer); }
};

/// How far two copies of one program came out from one another: |ratio of the medians - 1|.
using Control = ByClock<double>;

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

/// A variant's program, ready to be drawn with, and a scene as it draws it.
[[nodiscard]] Result<Program> linked_program(const Context& context, const Variants& variants,
                                             const Key& key);
[[nodiscard]] Result<DrawList> draw_list_of(const Context& context, const Program& program,
                                            const Variant& variant, const DrawnScene& scene);

/// The fragments that pass the depth test when the list is drawn to the framebuffer that is bound.
double count_fragments(const Context& context, const DrawList& list);

/// Times the keys in rounds, each in another order, with a second copy of the first key as the control. Where
/// that fails, something else ran: all is timed anew, up to twice.
/// `scene` is drawn at 160 x 120 and 480 x 360 for the fragments, spheres of two tessellations at 16 x 12 for
/// the vertices. Where no clock can be trusted the control is 1.
[[nodiscard]] Result<TimedGroup> time_variants(const Context& context, const Family& family,
                                               const Variants& variants, const std::vector<Key>& keys,
                                               const DrawnScene& scene, int rounds);

/// One operation repeated: what it executes more, and how much longer that takes.
struct Weighing {
    std::string operation;
    ByKind counts{};     ///< of one fragment
    Spread nanoseconds;  ///< of one fragment
};

struct WeighingResult {
    Weights weights;
    std::vector<Weighing> operations;
    Control control;
};

/// Draws the family data/study/operations of `shipped` with each operation a few times and many, and solves
/// for the prices. Errors: of the driver.
[[nodiscard]] Result<WeighingResult> weigh_operations(const FileSystem& shipped, const Context& context,
                                                      int rounds, int jobs);

/// The weights, none negative, that explain the measured times best: least squares, each row weighted by the
/// inverse of its time. In nanoseconds.
[[nodiscard]] ByKind solve_for_prices(const std::vector<Weighing>& operations);

/// Draws a scene once, by a key, and gives the fragments drawn. What callgrind watches.
[[nodiscard]] Result<double> draw_once(const Subject& subject, const StudyScene& scene,
                                       const Context& context, const Key& key, int width, int height);

/// The command, without valgrind, that draws a key once at a size and prints "fragments N": a program and its
/// arguments.
using DrawCommand = std::function<std::vector<std::string>(const std::string& key, int width, int height)>;

/// The instructions of a fragment by callgrind, the same in every run: the slope between two sizes. Errors: a
/// command that fails under valgrind.
[[nodiscard]] Result<double> count_instructions(const DrawCommand& command, const std::string& key);

}  // namespace gobo::study
