#include "verify/picture_layers.hpp"

#include <algorithm>

namespace gobo::verify {

void Layers::add(const SoftwareObject& object, const std::vector<Shaded>& shaded) {
    for (std::size_t i = 0; i < shaded.size(); ++i) {
        const Fragment& fragment = object.fragments[i];
        at_[index(fragment.x, fragment.y)].push_back({&fragment, shaded[i]});
    }
}

Result<Layers> shade_all(const SoftwareProgram& program, const std::vector<SoftwareObject>& objects,
                         double nudge, std::uint64_t seed) {
    Layers layers(objects.empty() ? 0 : objects.front().width, objects.empty() ? 0 : objects.front().height);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto shaded = shade(program, objects[i], nudge, seed * objects.size() + i);
        if (!shaded) return tl::unexpected(shaded.error());
        layers.add(objects[i], *shaded);
    }
    return layers;
}

std::optional<Color> visible(const std::vector<Candidate>& candidates) {
    std::optional<Color> color;
    double nearest = 1;
    for (const Candidate& candidate : candidates) {
        const bool is_drawn = candidate.fragment->is_covered && !candidate.shaded.is_discarded;
        if (!is_drawn || candidate.shaded.depth >= nearest) continue;
        nearest = candidate.shaded.depth;
        color = candidate.shaded.color;
    }
    return color;
}

std::vector<Color> possible(const std::vector<Candidate>& candidates, const Color& background) {
    double nearest = 1;
    bool is_certain = false;
    for (const Candidate& candidate : candidates) {
        if (candidate.fragment->is_near_edge || !candidate.fragment->is_covered ||
            candidate.shaded.is_discarded)
            continue;
        nearest = std::min(nearest, candidate.shaded.depth);
        is_certain = true;
    }
    std::vector<Color> colors;
    for (const Candidate& candidate : candidates)
        if (!candidate.shaded.is_discarded && candidate.shaded.depth <= nearest + kDepthError)
            colors.push_back(candidate.shaded.color);
    if (!is_certain) colors.push_back(background);
    return colors;
}

}  // namespace gobo::verify
