// Runs a decoded stage over many invocations: the public interface of evaluation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/program.hpp"

namespace gobo::evaluate {

struct Row;

/// Invocations that run at a time.
inline constexpr std::size_t kLanes = 64;

/// What a texture function asks an image for.
struct ImageRequest {
    enum class What {
        sample,  ///< filtered, normalised coordinates
        fetch,   ///< one texel, integer coordinates
        gather,  ///< component `component` of the four texels around
        size,    ///< the size of level `lod`: width, height, depth or layers
        levels,  ///< the number of levels
        lod,     ///< the level that sampling would use: x clamped, y not
    };
    What what = What::sample;
    std::array<double, 4> coordinates{};  ///< already divided where the function projects; then the layer
    int dimensions = 2;                   ///< of the coordinates, without the layer
    bool arrayed = false;                 ///< the layer follows the dimensions
    bool compares = false;                ///< a shadow lookup against `reference`
    double reference = 0;
    bool has_lod = false;  ///< `lod` is given; otherwise the gradients say which
    double lod = 0;        ///< for fetch and size, the level
    double bias = 0;
    std::array<double, 3> dx{};  ///< change of the coordinates to the right neighbour pixel
    std::array<double, 3> dy{};  ///< change of the coordinates to the neighbour pixel in +y
    std::array<int, 3> offset{};
    int sample = 0;
    int component = 0;
    std::size_t invocation = 0;
};

/// Answers in the four components; a shadow lookup in the first.
using Image = std::function<std::array<double, 4>(const ImageRequest&)>;

/// By reflected name: "tex", "maps[2]".
using Images = std::map<std::string, Image, std::less<>>;

/// What is given to a stage. All values are doubles; integers and booleans are whole numbers.
struct Invocations {
    /// How many. Those of a fragment stage come in quads of four: (x, y), (x + 1, y), (x, y + 1),
    /// (x + 1, y + 1); a count that is no multiple of four leaves the last quad without derivatives that mean
    /// anything.
    std::size_t count = 1;
    /// By reflected name ("normal", "gl_FragCoord", "PointLights.lights[0].position"), component by
    /// component: either `components` numbers that hold for all invocations, or `components * count`, with
    /// component c of invocation i at [c * count + i]. Matrices column by column. What is not named is 0.
    std::map<std::string, std::vector<double>, std::less<>> values;
    /// By the name of the uniform block: its bytes, as OpenGL would be given them. `values` overrule them.
    std::map<std::string, std::vector<std::byte>, std::less<>> blocks;
    /// Invocations that exist only for the derivatives of their quad: run, but neither counted nor shown to
    /// images and observers. Empty: none.
    std::vector<bool> helpers;
    Images images;
};

/// What the bytes of its uniform block hold of a member. Where they end before it, it is 0: a buffer for
/// fewer array elements is enough.
[[nodiscard]] std::vector<double> numbers_in_block(const Port& port, const std::vector<std::byte>& bytes);

/// Which errors arithmetic makes beside those of rounding.
enum class Errors {
    none,
    /// Divisions, roots, lengths, powers, exponentials, logarithms and functions of angles are too large by
    /// all that the specification allows.
    largest_up,
    largest_down,  ///< too small by as much
};

/// Which of the sums that the real numbers cannot tell apart is computed. Operations that the shader marks
/// `precise` (NoContraction) are always computed as written.
enum class Sums {
    as_written,
    fused,      ///< a * b + c is rounded once, in functions such as dot() and mix() too
    regrouped,  ///< (a + b) + c as a + (b + c), what cancels is gone; dot products from their last term on
    reordered,  ///< (a + b) + c as (a + c) + b, and so on as regrouped
};

/// What min(), max() and clamp() make of a NaN, which GLSL leaves open.
enum class NaNs {
    by_comparison,  ///< as GLSL's text has it: what the comparison being false gives
    kept,           ///< a NaN wherever one is given
    dropped,        ///< a number wherever one is given
};

/// Of a loop, where a shader is looked at: a GPU's driver gives up long before.
inline constexpr std::uint64_t kMostIterations = 65536;

struct Options {
    bool flush_denormals =
        false;  ///< fp32 only: denormal operands and results are taken as 0, of 16 bits too
    Errors errors = Errors::none;
    Sums sums = Sums::as_written;
    NaNs nans = NaNs::by_comparison;
    bool is_half = false;  ///< fp32 only: what is mediump or lowp is a 16-bit float after each operation
    /// With `is_half`: of each invocation, how many of the program's constants and operations, in this order,
    /// lose what is too small for 16-bit floats; the others keep it. Null: all lose it.
    const std::vector<std::uint32_t>* loses_small = nullptr;
    bool is_single = false;  ///< fp64 only: what is a 32-bit float is one after each operation
    /// fp64 only: of each operation, the one invocation in which its results are rounded to floats, or -1.
    const std::vector<std::int64_t>* rounded_in = nullptr;
    bool count = false;  ///< fill Outputs::counts
    /// A loop whose head is passed more often than this, by any of the kLanes invocations that run together,
    /// is an error.
    std::uint64_t iteration_limit = 1U << 20U;
};

/// A texel of an image that a stage reads and writes without a sampler.
struct TexelPlace {
    std::size_t invocation = 0;        ///< that writes it
    std::size_t image = 0;             ///< index into Program::images
    std::array<int, 4> coordinates{};  ///< then the layer
    int sample = 0;

    friend bool operator==(const TexelPlace&, const TexelPlace&) = default;
};

struct WrittenTexel {
    TexelPlace place;
    std::array<double, 4> texel{};  ///< as written: the image's format may round it
};

/// What a stage gives.
struct Outputs {
    std::size_t count = 0;
    /// By reflected name, component by component, as Invocations::values: outputs, and what storage blocks
    /// and counters hold in the end. Each invocation is alone with them.
    std::map<std::string, std::vector<double>, std::less<>> values;
    std::vector<WrittenTexel> written;  ///< by imageStore() and its like, in their order in each invocation
    std::vector<bool> discarded;        ///< of each invocation
    std::vector<Counts> counts;         ///< of each invocation; empty unless asked for
};

/// What an observer sees of one operation, for up to kLanes invocations at once.
template <class T>
struct Step {
    const Program& program;
    std::uint32_t operation;       ///< index into Program::operations
    std::uint64_t lanes;           ///< bit i: lane i runs it (padding and helper lanes left out)
    std::size_t first_invocation;  ///< of lane 0
    const T* rows;                 ///< lane l of slot s, where it holds floats, is rows[s * kLanes + l]
    std::uint64_t discarded = 0;   ///< lanes that have been discarded
    bool is_half = false;          ///< it is computed with 16-bit floats

    [[nodiscard]] const OperationInfo& info() const { return program.infos[operation]; }
    [[nodiscard]] const Place& place() const { return program.place_of(operation); }
    /// Of the instruction table.
    [[nodiscard]] const Row& row() const;
    /// "FMul", "Pow", "Load".
    [[nodiscard]] std::string_view name() const;
    /// The value of a component of a slice in a lane, whatever it holds.
    [[nodiscard]] double value(const Slice& slice, std::uint32_t component, std::size_t lane) const;
};

/// Watches every operation. An evaluation without one pays nothing for it.
template <class T>
class Observer {
  public:
    Observer() = default;
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    virtual ~Observer() = default;
    /// A batch of invocations, which may have no steps.
    virtual void begins(std::size_t /*first_invocation*/) {}
    /// Operands stand ready; the result does not.
    virtual void before(const Step<T>& /*step*/) {}
    virtual void after(const Step<T>& /*step*/) {}
    /// A dynamic index of this step lay outside [0, extent) and is clamped to it.
    virtual void clamped(const Step<T>& /*step*/, std::size_t /*lane*/, std::int64_t /*index*/,
                         std::uint32_t /*extent*/) {}
    /// The lanes end the block; where it ends in a choice, by the slot of its condition.
    virtual void ends(const Block& /*block*/, std::uint64_t /*lanes*/) {}
    /// The lanes have passed the head of that loop more often than Options::iteration_limit. True: they are
    /// given up, as if discarded, and the others go on; otherwise the run ends with an error.
    [[nodiscard]] virtual bool gives_up(const Block& /*loop*/, std::uint64_t /*lanes*/,
                                        std::size_t /*first_invocation*/) {
        return false;
    }
    /// The lanes carry a value along an edge.
    virtual void copied(const Operation& /*copy*/, std::uint64_t /*lanes*/) {}
};

/// Runs the stage for each invocation, in arithmetic of T: float (IEEE, round to nearest) or double, where
/// each constant is the double of its shortest decimal (0.1f is 0.1). Numbers of 64 bits, of which run<float>
/// knows none, are what they are. Errors: a name that the stage does not
/// have, a wrong number of values, an image that is used but not given, a loop without end.
template <class T>
[[nodiscard]] Result<Outputs> run(const Program& program, const Invocations& invocations,
                                  const Options& options = {}, Observer<T>* observer = nullptr);

extern template Result<Outputs> run<float>(const Program&, const Invocations&, const Options&,
                                           Observer<float>*);
extern template Result<Outputs> run<double>(const Program&, const Invocations&, const Options&,
                                            Observer<double>*);

}  // namespace gobo::evaluate
