#include "lab/verify/interpolation_spread.hpp"

#include <algorithm>
#include <cmath>

#include "lab/verify/rounding.hpp"

namespace gobo::verify {
namespace {

using Spread = std::vector<std::array<double, 4>>;

/// So far from a place its neighbours are evaluated, in pixels: the differences of doubles keep 6 digits.
constexpr double kStep = 0x1p-10;

Interpolator interpolator_of(const SoftwareObject& object, std::uint32_t triangle) {
    const std::uint32_t* corner = &object.indices[3 * std::size_t{triangle}];
    return {{object.positions[corner[0]], object.positions[corner[1]], object.positions[corner[2]]},
            object.width,
            object.height};
}

/// The places, moved by so many pixels.
std::vector<FragmentPlace> beside(const SoftwareObject& object, std::vector<FragmentPlace> places, double x,
                                  double y) {
    for (FragmentPlace& place : places)
        place.weights =
            interpolator_of(object, place.fragment->triangle).at(place.x + 0.5 + x, place.y + 0.5 + y);
    return places;
}

/// One input of the fragment stage with a component moved, for each place by its own distance.
evaluate::Invocations moved(const evaluate::Invocations& inputs, const std::string& input, std::size_t from,
                            const std::vector<double>& distances, double times) {
    evaluate::Invocations result = inputs;
    std::vector<double>& values = result.values[input];
    for (std::size_t i = from; i < from + inputs.count; ++i) values[i] += times * distances[i];
    return result;
}

/// Adds how far each colour moves by the one shift or the other, whichever is less.
void add_smaller(const std::vector<Shaded>& plain, const std::vector<Shaded>& one,
                 const std::vector<Shaded>& other, Spread& spread) {
    for (std::size_t i = 0; i < plain.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            spread[i][c] += std::min(std::abs(one[i].color[c] - plain[i].color[c]),
                                     std::abs(other[i].color[c] - plain[i].color[c]));
}

}  // namespace

std::map<std::string, std::vector<double>, std::less<>> interpolation_rounding(
    const SoftwareProgram& program, const SoftwareObject& object, const evaluate::Outputs& varyings) {
    const std::vector<FragmentPlace> places = shading_places(program, object);
    const auto here = fragment_inputs(program, object, places, varyings);
    const auto right = fragment_inputs(program, object, beside(object, places, kStep, 0), varyings);
    const auto above = fragment_inputs(program, object, beside(object, places, 0, kStep), varyings);
    std::map<std::string, std::vector<double>, std::less<>> errors;
    for (const Varying& varying : program.link.varyings) {
        if (varying.interpolation == Interpolation::flat) continue;
        const std::vector<double>& value = here.values.at(varying.input);
        std::vector<double>& error = errors[varying.input];
        for (std::size_t i = 0; i < value.size(); ++i)
            error.push_back(kUnitRoundoff *
                            (std::abs(value[i]) +
                             object.width * std::abs(right.values.at(varying.input)[i] - value[i]) / kStep +
                             object.height * std::abs(above.values.at(varying.input)[i] - value[i]) / kStep));
    }
    return errors;
}

Result<Spread> interpolation_spread(const SoftwareProgram& program, const SoftwareObject& object) {
    Spread spread(object.fragments.size());
    if (object.fragments.empty()) return spread;
    const Result<evaluate::Outputs> varyings = evaluate::run<float>(program.vertex, object.vertices);
    if (!varyings) return tl::unexpected(varyings.error());
    const evaluate::Invocations inputs =
        fragment_inputs(program, object, shading_places(program, object), *varyings);
    const auto plain = shade_fragments(program, object, inputs);
    if (!plain) return tl::unexpected(plain.error());
    for (const auto& [input, rounding] : interpolation_rounding(program, object, *varyings))
        for (std::size_t from = 0; from < rounding.size(); from += inputs.count) {
            const auto one = shade_fragments(program, object,
                                             moved(inputs, input, from, rounding, kInterpolationRoundings));
            if (!one) return tl::unexpected(one.error());
            const auto other = shade_fragments(
                program, object, moved(inputs, input, from, rounding, -kInterpolationRoundings));
            if (!other) return tl::unexpected(other.error());
            add_smaller(*plain, *one, *other, spread);
        }
    return spread;
}

}  // namespace gobo::verify
