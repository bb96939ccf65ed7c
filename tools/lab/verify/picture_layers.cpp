#include "lab/verify/picture_layers.hpp"

#include <algorithm>

#include "lab/verify/interpolation_spread.hpp"

namespace gobo::verify {

void Layers::add(const SoftwareObject& object, const std::vector<Shaded>& shaded,
                 const std::vector<Color>& spread) {
    for (std::size_t i = 0; i < shaded.size(); ++i) {
        const Fragment& fragment = object.fragments[i];
        at_[index(fragment.x, fragment.y)].push_back(
            {&fragment, shaded[i], spread.empty() ? Color{} : spread[i]});
    }
}

namespace {

Layers empty_layers(const std::vector<SoftwareObject>& objects) {
    return objects.empty() ? Layers(0, 0) : Layers(objects.front().width, objects.front().height);
}

}  // namespace

Result<Layers> shade_all(const SoftwareProgram& program, const std::vector<SoftwareObject>& objects,
                         const Nudge& nudge) {
    Layers layers = empty_layers(objects);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto shaded = shade(program, objects[i], {nudge.by, nudge.seed * objects.size() + i});
        if (!shaded) return tl::unexpected(shaded.error());
        layers.add(objects[i], *shaded);
    }
    return layers;
}

Result<Layers> shade_with_spread(const SoftwareProgram& program, const std::vector<SoftwareObject>& objects) {
    Layers layers = empty_layers(objects);
    for (const SoftwareObject& object : objects) {
        const auto shaded = shade(program, object);
        if (!shaded) return tl::unexpected(shaded.error());
        const auto spread = interpolation_spread(program, object);
        if (!spread) return tl::unexpected(spread.error());
        layers.add(object, *shaded, *spread);
    }
    return layers;
}

std::optional<Seen> visible(const std::vector<Candidate>& candidates) {
    std::optional<Seen> seen;
    double nearest = 1;
    for (const Candidate& candidate : candidates) {
        const bool is_drawn = candidate.fragment->is_covered && !candidate.shaded.is_discarded;
        if (!is_drawn || candidate.shaded.depth >= nearest) continue;
        nearest = candidate.shaded.depth;
        seen = Seen{candidate.shaded.color, candidate.spread};
    }
    return seen;
}

std::vector<Seen> possible(const std::vector<Candidate>& candidates, const Color& background) {
    double nearest = 1;
    bool is_certain = false;
    for (const Candidate& candidate : candidates) {
        if (candidate.fragment->is_near_edge || !candidate.fragment->is_covered ||
            candidate.shaded.is_discarded)
            continue;
        nearest = std::min(nearest, candidate.shaded.depth);
        is_certain = true;
    }
    std::vector<Seen> seen;
    for (const Candidate& candidate : candidates)
        if (!candidate.shaded.is_discarded && candidate.shaded.depth <= nearest + kDepthError)
            seen.push_back({candidate.shaded.color, candidate.spread});
    if (!is_certain) seen.push_back({background, {}});
    return seen;
}

}  // namespace gobo::verify
