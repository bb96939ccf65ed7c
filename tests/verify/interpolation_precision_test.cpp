// How far a renderer's interpolation is from exact, in the roundings that the cross-check grants it. Each row
// prints what it found, and holds the limit between that and four times that.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "lab/raster/shade.hpp"
#include "lab/render/mesh.hpp"
#include "lab/render/render.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// A varying of lit's fragment stage, shown as `offset` and `scale` of it: what is below 0 is not shown.
struct Row {
    const char* name;
    const char* input;
    double offset;
    double scale;
};

const Row kRows[] = {{"normals", "eyeNormal", 0.5, 0.5}, {"positions", "eyePosition", 0, -1}};

/// lit with clear air that shows the varying in the place of the radiance.
struct Shown {
    Family family = lit_family();
    Composition composition;
    Validated validated;

    explicit Shown(const Row& row) {
        std::string text = piece_text("fog/none.glsl");
        const std::string radiance = "return radiance;";
        // The choice keeps drivers from moving the sum into the vertex stage, as Mesa does since 24.
        const std::string input = fmt::format("(gl_FragCoord.x < 0.0 ? vec3(0.0) : {})", row.input);
        text.replace(text.find(radiance), radiance.size(),
                     fmt::format("return {:#} + {:#} * {};", row.offset, row.scale, input));
        composition =
            compose_lit(family, keys_of(family, {"directional=1"}), {{"fog/none.glsl", text}}).value();
        ValidateOptions options;
        options.keep_spirv = true;
        validated = validate(family, composition, options);
    }

    [[nodiscard]] const Permutation& permutation() const { return composition.permutations.front(); }
    [[nodiscard]] const SpirvModule& spirv_of(int stage) const {
        return validated.stages[static_cast<std::size_t>(stage)].spirv;
    }
};

/// What is nearest to the eye in a pixel.
struct Nearest {
    double depth = 1;
    double error = 0;  ///< the largest of its components, in roundings
};

/// What the vertex stage itself rounds in a unit vector, each of whose components is a sum of three products:
/// where they cancel, drivers differ by as much.
constexpr double kVertexRounding = 3 * 0x1p-24;

/// The largest error of what is drawn of the fragment, in roundings.
double error_of(const Row& row, const std::array<float, 3>& drawn, const evaluate::Invocations& inputs,
                const std::vector<double>& rounding, std::size_t fragment) {
    double largest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = c * inputs.count + fragment;
        const double expected = row.offset + row.scale * inputs.values.at(row.input)[at];
        if (expected <= 0) continue;
        largest = std::max(largest, std::abs(static_cast<double>(drawn[c]) - expected) /
                                        (std::abs(row.scale) * (rounding[at] + kVertexRounding)));
    }
    return largest;
}

double largest_error(const Context& context, const Row& row, int side) {
    const Shown shown(row);
    const Permutation& permutation = shown.permutation();
    const Interface interface = interface_of(shown.validated, permutation);
    View view;
    view.camera = demo_camera();
    view.width = view.height = side;
    const std::vector<Object> objects = demo_objects(
        read_obj(DiskFileSystem(), std::string(GOBO_SOURCE_DIR) + "/data/meshes/teapot.obj").value());
    const Image picture =
        render_permutation(context,
                           {stage_text(shown.composition, permutation.stages[StageKind::vertex]),
                            stage_text(shown.composition, permutation.stages[StageKind::fragment])},
                           interface, objects, shown.family.render, view)
            .value()
            .color;
    const auto program = raster::pipeline_of(shown.spirv_of(permutation.stages[StageKind::vertex]),
                                             shown.spirv_of(permutation.stages[StageKind::fragment]))
                             .value();
    const std::vector<raster::RasterObject> rasterised =
        raster::rasterise_objects(program, interface, objects, shown.family.render, view).value();
    std::vector<Nearest> pixels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (const raster::RasterObject& object : rasterised) {
        const auto varyings = evaluate::run<float>(program.vertex, object.vertices).value();
        const auto inputs = raster::fragment_inputs(program, object,
                                                    raster::places_of(object, program.needs_quads), varyings);
        const auto rounding = raster::interpolation_rounding(program, object, varyings);
        for (std::size_t i = 0; i < object.fragments.size(); ++i) {
            const raster::Fragment& fragment = object.fragments[i];
            Nearest& pixel = pixels[static_cast<std::size_t>(fragment.y * side + fragment.x)];
            if (fragment.is_near_edge) pixel = {-1, 0};  // drawn or not: nobody knows
            if (!fragment.is_covered || fragment.weights.depth >= pixel.depth) continue;
            const int y = side - 1 - fragment.y;
            const std::array<float, 3> drawn = {picture.at(fragment.x, y, 0), picture.at(fragment.x, y, 1),
                                                picture.at(fragment.x, y, 2)};
            pixel = {fragment.weights.depth, error_of(row, drawn, inputs, rounding.at(row.input), i)};
        }
    }
    double largest = 0;
    for (const Nearest& pixel : pixels) largest = std::max(largest, pixel.error);
    return largest;
}

TEST(InterpolationPrecision, IsWithinTheRoundingsGranted) {
    const Context context = open_context(Backend::osmesa).value();
    double largest = 0;
    for (const Row& row : kRows)
        for (const int side : {64, 256, 1024}) {
            const double found = largest_error(context, row, side);
            fmt::print("{} at {} x {}: {:.1f} roundings\n", row.name, side, side, found);
            EXPECT_LE(found, raster::kInterpolationRoundings) << row.name << " at " << side;
            largest = std::max(largest, found);
        }
    EXPECT_GE(4 * largest, raster::kInterpolationRoundings) << "more is granted than the renderer needs";
}

}  // namespace
}  // namespace gobo
