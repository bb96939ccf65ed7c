#include "lab/raster/shade.hpp"

#include <algorithm>
#include <cmath>

#include "lab/raster/random.hpp"

namespace gobo::raster {
namespace {

constexpr std::size_t kQuad = 4;

/// From a pixel's y, upwards, to its row as the window counts them, and back.
int row_of(const RasterObject& object, int y) {
    return object.clip_space == ClipSpace::vulkan ? object.height - 1 - y : y;
}

/// A depth as its buffer holds it.
double stored_depth(double depth) {
    return static_cast<float>(std::clamp(depth, 0.0, 1.0));
}

Shaded shaded(const Pipeline& pipeline, const evaluate::Outputs& outputs, std::size_t invocation,
              const Fragment& fragment) {
    Shaded result;
    result.depth = stored_depth(fragment.weights.depth);
    result.is_discarded = outputs.discarded[invocation];
    if (const auto color = outputs.values.find(pipeline.color); color != outputs.values.end())
        for (std::size_t c = 0; c < std::min<std::size_t>(color->second.size() / outputs.count, 4); ++c)
            result.color[c] = color->second[c * outputs.count + invocation];
    const auto depth = outputs.values.find("gl_FragDepth");
    if (depth != outputs.values.end() && !pipeline.tests_early)
        result.depth = stored_depth(depth->second[invocation]);
    if (pipeline.color.empty()) result.color[0] = result.depth;
    return result;
}

void add(const evaluate::Counts& counts, evaluate::Counts& sum) {
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) sum[kind] += counts[kind];
}

/// Each component moved at random by up to `by` of the largest of its vector.
void move(std::vector<double>& values, std::uint32_t components, std::size_t count, double by,
          Random& random) {
    if (by == 0 || values.size() != components * count) return;
    for (std::size_t i = 0; i < count; ++i) {
        double size = 0;
        for (std::size_t c = 0; c < components; ++c) size = std::max(size, std::abs(values[c * count + i]));
        for (std::size_t c = 0; c < components; ++c) values[c * count + i] += size * random.between(-by, by);
    }
}

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

/// As far for each place of a quad, but neighbours the opposite ways.
std::vector<double> apart_in_quads(std::vector<double> distances) {
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (i % kQuad == 1 || i % kQuad == 2) distances[i] = -distances[i];
    return distances;
}

/// Adds how far each colour moves by the one shift or the other, whichever is less.
void add_smaller(const std::vector<Shaded>& plain, const std::vector<Shaded>& one,
                 const std::vector<Shaded>& other, std::vector<std::array<double, 4>>& spread) {
    for (std::size_t i = 0; i < plain.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            spread[i][c] += std::min(std::abs(one[i].color[c] - plain[i].color[c]),
                                     std::abs(other[i].color[c] - plain[i].color[c]));
}

/// The fragment stage at the inputs of the places_of() that it needs. Adds to `work` unless it is null.
template <class T>
Result<std::vector<Shaded>> shade_fragments(const Pipeline& pipeline, const RasterObject& object,
                                            const evaluate::Invocations& inputs, Work* work = nullptr,
                                            evaluate::Errors errors = evaluate::Errors::none) {
    evaluate::Options options;
    options.count = work != nullptr;
    options.errors = errors;
    GOBO_TRY(const auto outputs, evaluate::run<T>(pipeline.fragment, inputs, options));
    std::vector<Shaded> result;
    const std::size_t each = pipeline.needs_quads ? kQuad : 1;
    for (std::size_t i = 0; i < object.fragments.size(); ++i) {
        const std::size_t own = own_place(object, i, pipeline.needs_quads);
        result.push_back(shaded(pipeline, outputs, own, object.fragments[i]));
        for (std::size_t place = each * i; work != nullptr && place < each * (i + 1); ++place)
            add(outputs.counts[place], place == own ? work->fragments : work->helpers);
    }
    return result;
}

}  // namespace

std::vector<FragmentPlace> places_of(const RasterObject& object, bool in_quads) {
    std::vector<FragmentPlace> places;
    for (const Fragment& fragment : object.fragments) {
        const int own_row = row_of(object, fragment.y);
        if (!in_quads) {
            places.push_back({&fragment, fragment.x, fragment.y, fragment.weights, own_row + 0.5});
            continue;
        }
        const Interpolator interpolator = object.interpolator(fragment.triangle);
        for (int i = 0; i < static_cast<int>(kQuad); ++i) {
            const int x = (fragment.x & ~1) + i % 2;
            const int row = (own_row & ~1) + i / 2;
            const int y = row_of(object, row);
            places.push_back({&fragment, x, y, interpolator.at(x + 0.5, y + 0.5), row + 0.5});
        }
    }
    return places;
}

std::size_t own_place(const RasterObject& object, std::size_t index, bool in_quads) {
    const Fragment& fragment = object.fragments[index];
    const int row = row_of(object, fragment.y);
    return in_quads ? kQuad * index + static_cast<std::size_t>(fragment.x % 2 + 2 * (row % 2)) : index;
}

std::vector<double> interpolated(const std::vector<double>& at_vertices, std::uint32_t components,
                                 const RasterObject& object, const std::vector<FragmentPlace>& places,
                                 Interpolation interpolation) {
    std::vector<double> values;
    values.reserve(components * places.size());
    for (std::uint32_t c = 0; c < components; ++c)
        for (const FragmentPlace& place : places) {
            const double* first = &at_vertices[c * object.vertices.count];
            const std::uint32_t* corner = &object.indices[3 * std::size_t{place.fragment->triangle}];
            const auto at = [&](std::size_t i) { return first[corner[i]]; };
            const bool is_linear = interpolation == Interpolation::linear;
            const auto& weights = is_linear ? place.weights.linear : place.weights.perspective;
            values.push_back(interpolation == Interpolation::flat
                                 ? at(2)
                                 : weights[0] * at(0) + weights[1] * at(1) + weights[2] * at(2));
        }
    return values;
}

evaluate::Invocations fragment_inputs(const Pipeline& pipeline, const RasterObject& object,
                                      const std::vector<FragmentPlace>& places,
                                      const evaluate::Outputs& outputs) {
    evaluate::Invocations invocations = object.uniforms;
    invocations.count = places.size();
    for (const Varying& varying : pipeline.varyings)
        invocations.values[varying.input] = interpolated(
            outputs.values.at(varying.output), varying.components, object, places, varying.interpolation);
    for (const evaluate::Port& port : pipeline.fragment.inputs) {
        if (port.name == "gl_PrimitiveID") {
            std::vector<double>& to = invocations.values[port.name];
            for (const FragmentPlace& place : places) to.push_back(place.fragment->primitive);
        }
        if (port.name != "gl_FragCoord" && port.name != "gl_FrontFacing") continue;
        std::vector<double>& to = invocations.values[port.name];
        to.resize(port.components * places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double front = places[i].fragment->is_front_facing ? 1 : 0;
            const std::array<double, 4> at = places[i].window_position();
            for (std::size_t c = 0; c < port.components; ++c)
                to[c * places.size() + i] = port.name == "gl_FragCoord" ? at[c] : front;
        }
    }
    return invocations;
}

Result<evaluate::Invocations> exact_fragment_inputs(const Pipeline& pipeline, const RasterObject& object) {
    GOBO_TRY(const auto varyings, evaluate::run<double>(pipeline.vertex, object.vertices));
    return fragment_inputs(pipeline, object, places_of(object, false), varyings);
}

template <class T>
Result<std::vector<Shaded>> shade(const Pipeline& pipeline, const RasterObject& object, Work* work,
                                  const Nudge& nudge) {
    if (object.fragments.empty()) return std::vector<Shaded>{};
    Random random(nudge.seed);
    evaluate::Invocations vertices = object.vertices;
    for (const evaluate::Port& port : pipeline.vertex.inputs)
        if (const auto found = vertices.values.find(port.name);
            found != vertices.values.end() && evaluate::is_float(port.scalar))
            move(found->second, port.components, vertices.count, nudge.by, random);
    evaluate::Options options;
    options.count = work != nullptr;
    GOBO_TRY(const auto varyings, evaluate::run<T>(pipeline.vertex, vertices, options));
    evaluate::Invocations inputs =
        fragment_inputs(pipeline, object, places_of(object, pipeline.needs_quads), varyings);
    for (const Varying& varying : pipeline.varyings)
        if (varying.interpolation != Interpolation::flat)
            move(inputs.values[varying.input], varying.components, inputs.count, nudge.by, random);
    for (const evaluate::Counts& counts : varyings.counts) add(counts, work->vertices);
    return shade_fragments<T>(pipeline, object, inputs, work);
}

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

Result<std::vector<std::array<double, 4>>> color_spread(const Pipeline& pipeline,
                                                        const RasterObject& object) {
    std::vector<std::array<double, 4>> spread(object.fragments.size());
    if (object.fragments.empty()) return spread;
    GOBO_TRY(const auto varyings, evaluate::run<float>(pipeline.vertex, object.vertices));
    const evaluate::Invocations inputs =
        fragment_inputs(pipeline, object, places_of(object, pipeline.needs_quads), varyings);
    GOBO_TRY(const auto plain, shade_fragments<float>(pipeline, object, inputs));
    for (const auto& [input, rounding] : interpolation_rounding(pipeline, object, varyings))
        for (std::size_t from = 0; from < rounding.size(); from += inputs.count) {
            const auto add_moved = [&, &name = input](const std::vector<double>& error) -> Result<void> {
                const auto with = [&](double roundings) {
                    return shade_fragments<float>(pipeline, object,
                                                  moved(inputs, name, from, error, roundings));
                };
                GOBO_TRY(const auto one, with(kInterpolationRoundings));
                GOBO_TRY(const auto other, with(-kInterpolationRoundings));
                add_smaller(plain, one, other, spread);
                return {};
            };
            GOBO_TRY_DO(add_moved(rounding));
            // Each pixel of a quad is rounded by itself: a derivative sees what two of them differ by.
            if (pipeline.needs_quads) GOBO_TRY_DO(add_moved(apart_in_quads(rounding)));
        }
    const auto with_errors = [&](evaluate::Errors errors) {
        return shade_fragments<float>(pipeline, object, inputs, nullptr, errors);
    };
    GOBO_TRY(const auto up, with_errors(evaluate::Errors::largest_up));
    GOBO_TRY(const auto down, with_errors(evaluate::Errors::largest_down));
    add_smaller(plain, up, down, spread);
    return spread;
}

template Result<std::vector<Shaded>> shade<float>(const Pipeline&, const RasterObject&, Work*, const Nudge&);
template Result<std::vector<Shaded>> shade<double>(const Pipeline&, const RasterObject&, Work*, const Nudge&);

}  // namespace gobo::raster
