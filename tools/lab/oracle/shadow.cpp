#include <algorithm>
#include <array>
#include <cmath>

#include "lab/oracle/lights.hpp"

namespace gobo::oracle {
namespace {

/// A number, the absolute terms it is the sum of, and how fast it changes as the point moves.
struct Sum {
    double value = 0;
    double terms = 0;
    double slope = 0;
};

Sum row_of(const Shadow& shadow, int row, const glm::dvec3& position) {
    Sum sum{shadow.to_map[3][row], std::abs(shadow.to_map[3][row]), 0};
    for (int column = 0; column < 3; ++column) {
        const double entry = shadow.to_map[column][row];
        sum.value += entry * position[column];
        sum.terms += std::abs(entry * position[column]);
        sum.slope = std::hypot(sum.slope, entry);
    }
    return sum;
}

Sum scaled(const Sum& sum, double factor) {
    return {factor * sum.value, std::abs(factor) * sum.terms, std::abs(factor) * sum.slope};
}

Sum plus(const Sum& a, const Sum& b) {
    return {a.value + b.value, a.terms + b.terms, a.slope + b.slope};
}

/// A place in clip space that is scaled to [0, 1]: to be divided by w.
struct Projected {
    Sum x, y, depth, w;
};

/// A quotient of 0 to 1, and what its error is measured by.
Sum divided(const Sum& sum, const Sum& w) {
    const double quotient = sum.value / w.value;
    return {quotient, (sum.terms + std::abs(quotient) * w.terms) / w.value,
            (sum.slope + std::abs(quotient) * w.slope) / w.value};
}

/// quantity > edge, the difference measured by what its rounding is relative to.
bool above(double quantity, double edge, double unit, Decisions& decisions) {
    const double scale = std::max(unit, 1.0);
    return decisions.above(quantity / scale, edge / scale);
}

/// Whether the place lies before the light and within what the map shows.
bool is_on_map(const Projected& place, Decisions& decisions) {
    if (!above(place.w.value, 0, place.w.terms, decisions)) return false;
    for (const Sum* sum : {&place.x, &place.y, &place.depth}) {
        const double unit = std::max(sum->terms, place.w.terms);
        if (above(0, sum->value, unit, decisions)) return false;
        if (above(sum->value, place.w.value, unit, decisions)) return false;
    }
    return true;
}

/// The maps, asked about one layer at one depth.
class Layer {
  public:
    Layer(const DepthMaps& maps, double number, const Sum& depth, Decisions& decisions)
        : maps_(maps),
          layer_(std::clamp(static_cast<int>(std::lround(number)), 0, maps.layers - 1)),
          depth_(depth),
          decisions_(decisions) {}

    /// 1 where the texel's surface is not nearer to the light, else 0.
    double lit(int column, int row) {
        const int texel = (layer_ * maps_.height + row) * maps_.width + column;
        const double stored = maps_.depths[static_cast<std::size_t>(texel)];
        return above(depth_.value, stored, depth_.terms, decisions_) ? 0 : 1;
    }

    /// The sum over all texels of a tent of two texels' width about each: the place lies in four of them. At
    /// the border, as if the last texels went on.
    double filtered(const Sum& x, const Sum& y) {
        const auto tent = [](double place, int texels, int texel) {
            const double at = std::clamp(place * texels, 0.5, texels - 0.5);
            return std::max(0.0, 1 - std::abs(at - (texel + 0.5)));
        };
        double sum = 0;
        for (int row = 0; row < maps_.height; ++row)
            for (int column = 0; column < maps_.width; ++column) {
                const double weight = tent(x.value, maps_.width, column) * tent(y.value, maps_.height, row);
                if (weight > 0) sum += weight * lit(column, row);
            }
        return sum;
    }

    double nearest(const Sum& x, const Sum& y) {
        const int column = texel(x, maps_.width);
        return lit(column, texel(y, maps_.height));
    }

  private:
    /// The texel that the place lies in: decided at the nearest border between two.
    int texel(const Sum& place, int texels) {
        const int border = static_cast<int>(std::lround(place.value * texels));
        if (border <= 0) return 0;
        if (border >= texels) return texels - 1;
        const double at = static_cast<double>(border) / texels;
        return above(at, place.value, place.terms, decisions_) ? border - 1 : border;
    }

    const DepthMaps& maps_;
    int layer_;
    Sum depth_;
    Decisions& decisions_;
};

Visibility look_up(const Model& model, const Scene& scene, const Projected& projected, double layer,
                   Decisions& decisions) {
    if (!is_on_map(projected, decisions) || projected.w.value <= 0) return {};
    const Sum x = divided(projected.x, projected.w);
    const Sum y = divided(projected.y, projected.w);
    const DepthMaps& maps = scene.maps;
    Layer asked(maps, layer, divided(projected.depth, projected.w), decisions);
    // A place that moves by a texel changes the weight by at most 1, and so does the centre of a texel: it
    // then gets so much of the next one.
    const double centres = maps.width + maps.height;
    if (model.shadow_filter == ShadowFilter::nearest) return {asked.nearest(x, y), 0, 0, centres};
    return {asked.filtered(x, y), x.terms * maps.width + y.terms * maps.height,
            x.slope * maps.width + y.slope * maps.height,
            model.shadow_filter == ShadowFilter::bilinear ? centres : 0};
}

/// A face of the cube: the axis that it lies on, and along which of the ray's components its sides run
/// (OpenGL 4.5, table 8.19).
struct Face {
    std::size_t s_axis, t_axis;
    double s_sign, t_sign;
};

constexpr std::array<Face, 6> kFaces = {
    {{2, 1, -1, -1}, {2, 1, 1, -1}, {0, 2, 1, 1}, {0, 2, 1, -1}, {0, 1, 1, -1}, {0, 1, -1, -1}}};

/// In one map: of directional and spot lights.
Visibility visibility_in_map(const Model& model, const Scene& scene, const Shadow& shadow,
                             const glm::dvec3& position, Decisions& decisions) {
    const Projected projected{row_of(shadow, 0, position), row_of(shadow, 1, position),
                              row_of(shadow, 2, position), row_of(shadow, 3, position)};
    return look_up(model, scene, projected, shadow.layer, decisions);
}

/// In the six maps of a cube: of point lights.
Visibility visibility_in_cube(const Model& model, const Scene& scene, const Shadow& shadow,
                              const glm::dvec3& position, Decisions& decisions) {
    const std::array ray = {row_of(shadow, 0, position), row_of(shadow, 1, position),
                            row_of(shadow, 2, position)};
    const double unit = std::max({ray[0].terms, ray[1].terms, ray[2].terms});
    std::size_t largest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
        if (above(std::abs(ray[axis].value), std::abs(ray[largest].value), unit, decisions)) largest = axis;
    const bool is_positive = ray[largest].value > 0;
    const std::size_t number = 2 * largest + (is_positive ? 0 : 1);
    const Face& face = kFaces[number];
    const Sum w = scaled(ray[largest], is_positive ? 1 : -1);
    const Sum half = scaled(w, 0.5);
    const Projected projected{
        plus(half, scaled(ray[face.s_axis], face.s_sign * shadow.spread)),
        plus(half, scaled(ray[face.t_axis], face.t_sign * shadow.spread)),
        plus(scaled(w, shadow.depth_scale), {shadow.depth_shift, std::abs(shadow.depth_shift), 0}), w};
    return look_up(model, scene, projected, shadow.layer + static_cast<double>(number), decisions);
}

}  // namespace

void cast_shadows(const Model& model, const Scene& scene, const glm::dvec3& position,
                  std::vector<IncidentLight>& lights, Decisions& decisions) {
    const auto cast = [&](int first_light, int first_shadow, int count, auto visibility) {
        for (int i = 0; i < count; ++i) {
            const Shadow& shadow = scene.shadows[static_cast<std::size_t>(first_shadow + i)];
            IncidentLight& light = lights[static_cast<std::size_t>(first_light + i)];
            light.shadow = visibility(model, scene, shadow, position, decisions);
            light.radiance *= light.shadow.weight;
            light.is_shadowed = true;
        }
    };
    cast(0, 0, model.directional_shadows, visibility_in_map);
    cast(model.directional + model.point, model.directional_shadows, model.spot_shadows, visibility_in_map);
    cast(model.directional, model.directional_shadows + model.spot_shadows, model.point_shadows,
         visibility_in_cube);
}

}  // namespace gobo::oracle
