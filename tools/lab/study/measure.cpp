#include "lab/study/measure.hpp"

namespace gobo::study {

template <class T>
Result<Colors> shade_points(const ScenePoints& points, const Variant& variant, verify::Work* work) {
    Colors colors;
    for (const ObjectPoints& part : points.objects) {
        std::vector<Color>& of_object = colors.emplace_back();
        if (part.fragments.empty()) continue;
        const auto object = shaded_object(variant, points.scene, part);
        if (!object) return tl::unexpected(object.error());
        const auto shaded = verify::shade_in<T>(variant.program, *object, work);
        if (!shaded) return tl::unexpected(shaded.error());
        for (const verify::Shaded& one : *shaded)
            of_object.push_back(one.is_discarded ? Color{} : Color{one.color[0], one.color[1], one.color[2]});
    }
    return colors;
}

template Result<Colors> shade_points<float>(const ScenePoints&, const Variant&, verify::Work*);
template Result<Colors> shade_points<double>(const ScenePoints&, const Variant&, verify::Work*);

Result<Measurement> measure(const ScenePoints& points, const Variant& variant, const Variant& at_full_rate) {
    Measurement measurement;
    const auto in_float = shade_points<float>(points, variant, &measurement.work);
    if (!in_float) return tl::unexpected(in_float.error());
    const auto in_double = shade_points<double>(points, variant);
    if (!in_double) return tl::unexpected(in_double.error());
    const bool is_own = &variant == &at_full_rate;
    const auto full_rate = is_own ? in_double : shade_points<double>(points, at_full_rate);
    if (!full_rate) return tl::unexpected(full_rate.error());
    const Colors reference = reference_colors(points);
    measurement.total = error_between(points, *in_float, reference);
    measurement.rounding = error_between(points, *in_float, *in_double);
    measurement.approximation = error_between(points, *full_rate, reference);
    measurement.rate = error_between(points, *in_double, *full_rate);
    measurement.relative = relative_error(points, *in_float);
    measurement.pixels = points.pixels;
    measurement.edges = points.edges;
    measurement.shown_vertices = points.shown_vertices;
    measurement.mesh_vertices = points.mesh_vertices;
    measurement.from_oracle = points.from_oracle;
    return measurement;
}

}  // namespace gobo::study
