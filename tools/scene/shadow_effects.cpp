#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scene/subject.hpp"

namespace gobo::scene {
namespace {

/// A surface may shade itself unless it is flat.
bool may_shade_itself(const Draw& draw) {
    if (!draw.bounds) return true;
    const glm::dvec3 size = draw.bounds->high - draw.bounds->low;
    return size.x > 0 && size.y > 0 && size.z > 0;
}

struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

/// Of the box along a direction.
Extent extent_of(const Box& box, const glm::dvec3& direction) {
    Extent extent;
    for (int i = 0; i < 8; ++i) {
        const double along = glm::dot(direction, box.corner(i));
        extent.low = std::min(extent.low, along);
        extent.high = std::max(extent.high, along);
    }
    return extent;
}

/// Whether no plane along the light's direction parts the two: seen from the light they may lie on each
/// other. The planes tried are those that contain the direction and an axis of the world, which are all that
/// can part the shadows of two boxes.
bool may_overlap_along(const glm::dvec3& direction, const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 unit(0);
        unit[axis] = 1;
        const glm::dvec3 across = glm::cross(direction, unit);
        const Extent of_a = extent_of(a, across);
        const Extent of_b = extent_of(b, across);
        if (of_a.high < of_b.low || of_b.high < of_a.low) return false;
    }
    return true;
}

/// Whether a part of the box may lie on a segment between two points of `between`, not just at its ends:
/// where the box only touches the other from outside, it shades nothing.
bool may_lie_within(const Box& box, const Box& between) {
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_flat = between.low[axis] == between.high[axis];
        const bool is_beside = box.high[axis] < between.low[axis] || box.low[axis] > between.high[axis];
        const bool touches = box.high[axis] <= between.low[axis] || box.low[axis] >= between.high[axis];
        if (is_beside || (touches && !is_flat)) return false;
    }
    return true;
}

/// Whether a caster may stand between the light and the receiver: it must reach into the box around both or,
/// for a directional light, not lie wholly behind the receiver nor beside it.
bool may_stand_between(const PlacedLight& light, const Draw& caster, const Draw& receiver) {
    if (!caster.bounds || !receiver.bounds) return true;
    if (light.light->kind != LightKind::directional) {
        Box between = light.positions;
        between.add(*receiver.bounds);
        return may_lie_within(*caster.bounds, between);
    }
    if (light.turns) return true;
    const glm::dvec3 toward = -light.direction;
    return extent_of(*caster.bounds, toward).high > extent_of(*receiver.bounds, toward).low &&
           may_overlap_along(toward, *caster.bounds, *receiver.bounds);
}

/// The first draw that may shade the subject; null: none.
const Draw* shading_draw(const Subject& subject, const PlacedLight& light, const std::vector<Draw>& draws) {
    for (const Draw& caster : draws) {
        if (!caster.excluded.empty()) continue;
        const bool is_self = &caster == &subject.draw;
        if (is_self ? may_shade_itself(caster) : may_stand_between(light, caster, subject.draw))
            return &caster;
    }
    return nullptr;
}

/// "directional_shadows" for a light labelled "directional 2".
std::string feature_of(const PlacedLight& light) {
    return light.label.substr(0, light.label.find(' ')) + "_shadows";
}

Effect judge_shadow(const Subject& subject, const PlacedLight& light, bool is_light_in,
                    const std::vector<Draw>& draws) {
    Effect effect{"shadow of " + light.label, feature_of(light), "", false, ""};
    if (!subject.overrides.shadow.value_or(true)) {
        effect.reason = "it receives none";
    } else if (!is_light_in) {
        effect.reason = "the light is out";
    } else if (const Draw* caster = shading_draw(subject, light, draws)) {
        effect.is_in = true;
        effect.reason = fmt::format("'{}' may shade it", caster->name);
    } else {
        effect.reason = "nothing can shade it";
    }
    return effect;
}

}  // namespace

std::vector<Effect> judge_shadows(const Subject& subject, const std::vector<PlacedLight>& lights,
                                  const std::vector<Draw>& draws) {
    std::vector<Effect> effects;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].light->casts_shadow)
            effects.push_back(judge_shadow(subject, lights[i], subject.draw.effects[i].is_in, draws));
    if (effects.empty()) effects.push_back({"shadow", "shadow", "", false, "no light casts any"});
    return effects;
}

}  // namespace gobo::scene
