#include "lab/gallery/evaluation.hpp"

#include <algorithm>

#include "lab/verify/render_feed.hpp"
#include "lab/verify/shade.hpp"

namespace gobo::gallery {
namespace {

/// Costs are averages: a picture this small tells them to a few parts in a hundred.
constexpr int kCostWidth = 80;
constexpr int kCostHeight = 60;

Result<void> add_costs(const verify::SoftwareProgram& program, const verify::SoftwareObject& object,
                       verify::Work& work, std::size_t& fragments, std::size_t& vertices) {
    const auto shaded = verify::shade_in<float>(program, object, &work);
    if (!shaded) return tl::unexpected(shaded.error());
    fragments += shaded->size();
    vertices += shaded->empty() ? 0 : object.positions.size();
    return {};
}

}  // namespace

Result<Evaluation> evaluate_drawing(const Drawing& drawing, const Scene& scene, const SpirvModule& vertex,
                                    const SpirvModule& fragment, const Interface& interface,
                                    const study::Weights& weights) {
    const Result<verify::SoftwareProgram> program = verify::software_program(vertex, fragment);
    if (!program) return tl::unexpected(program.error());
    const auto objects_in = [&](const View& view) {
        return verify::rasterise_objects(*program, interface, scene.objects,
                                         verify::with_plain_textures(interface, drawing.values), view,
                                         drawing.images);
    };
    const auto seen = objects_in(scene.view);
    if (!seen) return tl::unexpected(seen.error());
    Evaluation evaluation;
    evaluation.report = verify::compare_picture(drawing.color, *program, *seen, scene.view.background,
                                                verify::KeptPictures::all);
    if (!evaluation.report.diagnostics.empty()) return tl::unexpected(evaluation.report.diagnostics);

    View small = scene.view;
    small.width = kCostWidth;
    small.height = kCostHeight;
    const auto objects = objects_in(small);
    if (!objects) return tl::unexpected(objects.error());
    verify::Work work;
    std::size_t fragments = 0;
    std::size_t vertices = 0;
    for (const verify::SoftwareObject& object : *objects)
        if (const auto added = add_costs(*program, object, work, fragments, vertices); !added)
            return tl::unexpected(added.error());
    const auto each = [](double all, std::size_t count) {
        return all / static_cast<double>(std::max<std::size_t>(count, 1));
    };
    evaluation.fragment_cost = each(study::weighted(work.fragments, weights), fragments);
    evaluation.vertex_cost = each(study::weighted(work.vertices, weights), vertices);
    return evaluation;
}

}  // namespace gobo::gallery
