#include "lab/raster/interpolation_spread.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::raster {
namespace {

using Spread = std::vector<std::array<double, 4>>;

/// So far from a place its neighbours are evaluated, in pixels: the differences of doubles keep 6 digits.
constexpr double kStep = 0x1p-10;

/// The unit roundoff of a float.
constexpr double kRounding = 0x1p-24;

/// The places, moved by so many pixels.
std::vector<FragmentPlace> beside(const RasterObject& object, std::vector<FragmentPlace> places, double x,
                                  double y) {
    for (FragmentPlace& place : places)
        place.weights =
            object.interpolator(place.fragment->triangle).at(place.x + 0.5 + x, place.y + 0.5 + y);
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
    const Pipeline& pipeline, const RasterObject& object, const evaluate::Outputs& varyings) {
    const std::vector<FragmentPlace> places = places_of(object, pipeline.needs_quads);
    const auto here = fragment_inputs(pipeline, object, places, varyings);
    const auto right = fragment_inputs(pipeline, object, beside(object, places, kStep, 0), varyings);
    const auto above = fragment_inputs(pipeline, object, beside(object, places, 0, kStep), varyings);
    std::map<std::string, std::vector<double>, std::less<>> errors;
    for (const Varying& varying : pipeline.varyings) {
        if (varying.interpolation == Interpolation::flat) continue;
        const std::vector<double>& value = here.values.at(varying.input);
        std::vector<double>& error = errors[varying.input];
        for (std::size_t i = 0; i < value.size(); ++i)
            error.push_back(kRounding *
                            (std::abs(value[i]) +
                             object.width * std::abs(right.values.at(varying.input)[i] - value[i]) / kStep +
                             object.height * std::abs(above.values.at(varying.input)[i] - value[i]) / kStep));
    }
    return errors;
}

Result<Spread> interpolation_spread(const Pipeline& pipeline, const RasterObject& object) {
    Spread spread(object.fragments.size());
    if (object.fragments.empty()) return spread;
    GOBO_TRY(const auto varyings, evaluate::run<float>(pipeline.vertex, object.vertices));
    const evaluate::Invocations inputs =
        fragment_inputs(pipeline, object, places_of(object, pipeline.needs_quads), varyings);
    GOBO_TRY(const auto plain, shade_fragments<float>(pipeline, object, inputs));
    for (const auto& [input, rounding] : interpolation_rounding(pipeline, object, varyings))
        for (std::size_t from = 0; from < rounding.size(); from += inputs.count) {
            const auto with = [&, &input = input, &rounding = rounding](double roundings) {
                return shade_fragments<float>(pipeline, object,
                                              moved(inputs, input, from, rounding, roundings));
            };
            GOBO_TRY(const auto one, with(kInterpolationRoundings));
            GOBO_TRY(const auto other, with(-kInterpolationRoundings));
            add_smaller(plain, one, other, spread);
        }
    return spread;
}

}  // namespace gobo::raster
