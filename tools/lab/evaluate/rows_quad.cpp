// Differences inside a quad of fragments. Lanes 4k to 4k+3 are (x, y), (x + 1, y), (x, y + 1), (x + 1, y +
// 1).
#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/loops.hpp"
#include "lab/evaluate/quads.hpp"

namespace gobo::evaluate {
namespace {

enum class Derivative { along_x, along_y, width };

/// Fine: each row or column of the quad has its own difference. Coarse: the quad has one.
template <Derivative kWhich, bool kFine, class T>
void derivative(const Operation& operation, Machine<T>& machine) {
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* value = machine.reals(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t at = kFine ? lane : lane - lane % 4;
            if constexpr (kWhich == Derivative::along_x)
                result[lane] = difference_x(value, at);
            else if constexpr (kWhich == Derivative::along_y)
                result[lane] = difference_y(value, at);
            else
                result[lane] = std::fabs(difference_x(value, at)) + std::fabs(difference_y(value, at));
        }
    }
}

template <Derivative kWhich, bool kFine = true>
inline constexpr Execution kDerivative{&derivative<kWhich, kFine, float>, &derivative<kWhich, kFine, double>};

/// An input at an offset from the pixel's centre: continued linearly. Operands: the input, the offset.
template <class T>
void at_offset(const Operation& operation, Machine<T>& machine) {
    const T* offset_x = machine.reals(operation.operands[1]);
    const T* offset_y = machine.reals(operation.operands[1] + 1);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        T* __restrict result = machine.reals(operation.result + component);
        const T* value = machine.reals(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = value[lane] + difference_x(value, lane) * offset_x[lane] +
                           difference_y(value, lane) * offset_y[lane];
    }
}

/// One sample at the centre of each pixel: centroid and sample are that centre.
template <class T>
void at_center(const Operation& operation, Machine<T>& machine) {
    for (std::uint32_t component = 0; component < operation.count; ++component)
        std::copy_n(machine.reals(operation.operands[0] + component), kLanes,
                    machine.reals(operation.result + component));
}

constexpr Execution kAtCenter{&at_center<float>, &at_center<double>};

constexpr Row kRows[] = {
    {spv::OpDPdx, "DPdx", Kind::derivative, "f:f", kDerivative<Derivative::along_x>},
    {spv::OpDPdy, "DPdy", Kind::derivative, "f:f", kDerivative<Derivative::along_y>},
    {spv::OpFwidth, "Fwidth", Kind::derivative, "f:f", kDerivative<Derivative::width>},
    {spv::OpDPdxFine, "DPdxFine", Kind::derivative, "f:f", kDerivative<Derivative::along_x>},
    {spv::OpDPdyFine, "DPdyFine", Kind::derivative, "f:f", kDerivative<Derivative::along_y>},
    {spv::OpFwidthFine, "FwidthFine", Kind::derivative, "f:f", kDerivative<Derivative::width>},
    {spv::OpDPdxCoarse, "DPdxCoarse", Kind::derivative, "f:f", kDerivative<Derivative::along_x, false>},
    {spv::OpDPdyCoarse, "DPdyCoarse", Kind::derivative, "f:f", kDerivative<Derivative::along_y, false>},
    {spv::OpFwidthCoarse, "FwidthCoarse", Kind::derivative, "f:f", kDerivative<Derivative::width, false>},
    {kExtended + GLSLstd450InterpolateAtCentroid, "InterpolateAtCentroid", Kind::derivative, "", kAtCenter},
    {kExtended + GLSLstd450InterpolateAtSample, "InterpolateAtSample", Kind::derivative, "", kAtCenter},
    {kExtended + GLSLstd450InterpolateAtOffset,
     "InterpolateAtOffset",
     Kind::derivative,
     "",
     {&at_offset<float>, &at_offset<double>}},
};

}  // namespace

std::span<const Row> quad_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
