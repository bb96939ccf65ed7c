#include "verify/witness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "render/lit_shadows.hpp"
#include "render/render_selection.hpp"
#include "validate/validate.hpp"
#include "verify/parallel.hpp"

namespace gobo::verify {
namespace {

/// Depths this near to one another may be ordered either way: some twenty roundings of a depth near 1.
constexpr double kDepthError = 2e-6;
/// Of the maps that with_shadows() plans.
constexpr int kShadowSide = 64;
constexpr double kShadowDepth = 0.75;
/// As far as inputs are moved to find what lies at a discontinuity, as for the oracle's edges.
constexpr double kNudge = 1e-5;
/// Each nudged evaluation decides a question at its edge at random: 16 miss an answer once in 65,536.
constexpr std::uint64_t kNudges = 16;

using Color = std::array<double, 4>;

/// A fragment as one evaluation shaded it.
struct Candidate {
    const Fragment* fragment = nullptr;
    Shaded shaded;
};

/// The candidates of each pixel, in the order in which they are drawn.
class Layers {
  public:
    Layers(int width, int height)
        : width_(width), at_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    void add(const SoftwareObject& object, const std::vector<Shaded>& shaded) {
        for (std::size_t i = 0; i < shaded.size(); ++i) {
            const Fragment& fragment = object.fragments[i];
            at_[index(fragment.x, fragment.y)].push_back({&fragment, shaded[i]});
        }
    }
    [[nodiscard]] const std::vector<Candidate>& at(int x, int y) const { return at_[index(x, y)]; }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    int width_;
    std::vector<std::vector<Candidate>> at_;
};

Result<Layers> shade_all(const SoftwareProgram& program, const std::vector<SoftwareObject>& objects,
                         const View& view, double nudge, std::uint64_t seed) {
    Layers layers(view.width, view.height);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto shaded = shade(program, objects[i], nudge, seed * objects.size() + i);
        if (!shaded) return tl::unexpected(shaded.error());
        layers.add(objects[i], *shaded);
    }
    return layers;
}

/// What the depth test leaves; nothing is the background.
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

/// All that the pixel may show where each fragment near an edge may be covered or not, and depths that are
/// almost the same may be ordered either way.
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

/// The largest channel's error over its limit; infinite for a NaN on one side only.
double ratio_of(const Color& actual, const Color& expected, const PixelLimit& limit) {
    double largest = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        if (actual[c] == expected[c] || (std::isnan(actual[c]) && std::isnan(expected[c]))) continue;
        const double ratio =
            std::abs(actual[c] - expected[c]) / (limit.absolute + limit.relative * std::abs(expected[c]));
        largest = std::max(largest, std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
    }
    return largest;
}

/// A picture's rows run down, OpenGL's up.
Color color_at(const Image& image, int x, int y) {
    Color color{};
    for (int c = 0; c < 4; ++c)
        color[static_cast<std::size_t>(c)] = static_cast<double>(image.at(x, image.height - 1 - y, c));
    return color;
}

/// Judges one picture.
class Judge {
  public:
    Judge(const Image& drawn, const WitnessScene& scene, const PixelLimit& limit)
        : drawn_(drawn), limit_(limit), keeps_pictures_(scene.keeps_pictures) {
        std::copy(scene.view.background.begin(), scene.view.background.end(), background_.begin());
        report_.expected = Image(drawn.width, drawn.height, 4);
        report_.actual = drawn;
        report_.pixels = static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height);
    }

    /// Compares each pixel with its plain evaluation. Those out of limit stay in doubt.
    void compare(const Layers& layers) {
        for (int y = 0; y < drawn_.height; ++y)
            for (int x = 0; x < drawn_.width; ++x) compare(layers, x, y);
    }

    [[nodiscard]] bool has_doubts() const { return !doubts_.empty(); }

    /// The objects with those of their fragments alone that lie in pixels in doubt.
    [[nodiscard]] std::vector<SoftwareObject> in_doubt(std::vector<SoftwareObject> objects) const {
        std::set<std::pair<int, int>> pixels;
        for (const WrongPixel& pixel : doubts_) pixels.emplace(pixel.x, drawn_.height - 1 - pixel.y);
        for (SoftwareObject& object : objects)
            std::erase_if(object.fragments, [&](const Fragment& fragment) {
                return !pixels.contains({fragment.x, fragment.y});
            });
        return objects;
    }

    /// Clears the doubts that this evaluation explains.
    void explain(const Layers& layers) {
        std::erase_if(doubts_, [&](const WrongPixel& pixel) {
            const int y = drawn_.height - 1 - pixel.y;
            for (const Color& color : possible(layers.at(pixel.x, y), background_)) {
                if (ratio_of(pixel.actual, color, limit_) > 1) continue;
                ++report_.edges;
                return true;
            }
            return false;
        });
    }

    [[nodiscard]] PictureReport report() && {
        std::stable_sort(doubts_.begin(), doubts_.end(),
                         [](const auto& left, const auto& right) { return left.ratio > right.ratio; });
        report_.wrong = doubts_.size();
        if (!doubts_.empty()) report_.largest_ratio = doubts_.front().ratio;
        for (const WrongPixel& pixel : doubts_) measure(pixel.actual, pixel.expected);
        doubts_.resize(std::min(doubts_.size(), kWorstPixels));
        report_.worst = std::move(doubts_);
        report_.root_mean_square =
            compared_ > 0 ? std::sqrt(squares_ / (4 * static_cast<double>(compared_))) : 0;
        if (!report_.fails() && !keeps_pictures_) report_.actual = report_.expected = Image();
        return std::move(report_);
    }

  private:
    void compare(const Layers& layers, int x, int y) {
        const std::optional<Color> found = visible(layers.at(x, y));
        if (found) ++report_.drawn;
        const Color expected = found.value_or(background_);
        const Color actual = color_at(drawn_, x, y);
        const int row = drawn_.height - 1 - y;
        for (int c = 0; c < 4; ++c)
            report_.expected.at(x, row, c) = static_cast<float>(expected[static_cast<std::size_t>(c)]);
        const double ratio = ratio_of(actual, expected, limit_);
        if (ratio > 1) {
            doubts_.push_back({x, row, actual, expected, ratio});
            return;
        }
        report_.largest_ratio = std::max(report_.largest_ratio, ratio);
        measure(actual, expected);
    }

    void measure(const Color& actual, const Color& expected) {
        ++compared_;
        for (std::size_t c = 0; c < 4; ++c) {
            const double error = actual[c] == expected[c] ? 0 : std::abs(actual[c] - expected[c]);
            report_.largest_error = std::max(report_.largest_error, error);
            squares_ += error * error;
        }
    }

    const Image& drawn_;
    PixelLimit limit_;
    bool keeps_pictures_;
    Color background_{};
    std::vector<WrongPixel> doubts_;
    double squares_ = 0;
    std::size_t compared_ = 0;
    PictureReport report_;
};

bool computes(const evaluate::Program& program, std::initializer_list<evaluate::Kind> kinds) {
    for (const evaluate::Block& block : program.blocks)
        for (const auto& cost : block.costs)
            if (std::find(kinds.begin(), kinds.end(), cost.first) != kinds.end()) return true;
    return false;
}

/// The scene with what this key's shadows need: matrices as for the renderer's own maps, and in place of
/// these one depth everywhere, half way through each map: some of the scene lies before it, some behind.
WitnessScene with_shadows(WitnessScene scene, const Key& key) {
    if (scene.family == nullptr) return scene;
    const std::vector<ShadowLight> lights = shadow_lights(*scene.family, key);
    if (lights.empty()) return scene;
    const ShadowPlan plan = shadow_plan(lights, scene.objects, scene.view.camera.view(), kShadowSide);
    scene.values.insert(scene.values.end(), plan.values.begin(), plan.values.end());
    scene.values.push_back({"shadowMaps", "", {kShadowDepth}, {}});
    return scene;
}

PictureReport without_picture(Diagnostics why) {
    PictureReport report;
    report.diagnostics = std::move(why);
    return report;
}

/// The renderer's picture of one permutation.
Result<Image> draw(const Context& context, const Composition& composition, const Permutation& permutation,
                   const Interface& interface, const WitnessScene& scene) {
    const auto picture = render_permutation(
        context, {stage_text(composition, permutation.vertex), stage_text(composition, permutation.fragment)},
        interface, scene.objects, with_plain_textures(interface, scene.values), scene.view);
    if (!picture) return tl::unexpected(picture.error());
    return picture->color;
}

}  // namespace

bool PictureReport::fails() const {
    return wrong > 0 || root_mean_square > kRmsLimit ||
           static_cast<double>(edges) > kLargestEdgePixelShare * static_cast<double>(pixels);
}

PixelLimit limit_of(const evaluate::Program& vertex, const evaluate::Program& fragment) {
    using evaluate::Kind;
    PixelLimit limit{kInterpolationError, kArithmeticError};
    for (const evaluate::Program* program : {&vertex, &fragment})
        if (computes(*program, {Kind::pow, Kind::exp, Kind::log, Kind::trig}))
            limit.relative = kArithmeticError + kPowerError;
    return limit;
}

PictureReport compare_picture(const Image& drawn, const SpirvModule& vertex, const SpirvModule& fragment,
                              const Interface& interface, const WitnessScene& scene) {
    const Result<SoftwareProgram> program = software_program(vertex, fragment);
    if (!program) return without_picture(program.error());
    auto objects = rasterise_scene(*program, interface, scene);
    if (!objects) return without_picture(objects.error());
    Judge judge(drawn, scene, limit_of(program->vertex, program->fragment));
    const Result<Layers> plain = shade_all(*program, *objects, scene.view, 0, 0);
    if (!plain) return without_picture(plain.error());
    judge.compare(*plain);
    judge.explain(*plain);
    *objects = judge.in_doubt(std::move(*objects));
    for (std::uint64_t seed = 1; seed <= kNudges && judge.has_doubts(); ++seed) {
        const Result<Layers> nudged = shade_all(*program, *objects, scene.view, kNudge, seed);
        if (!nudged) return without_picture(nudged.error());
        judge.explain(*nudged);
    }
    return std::move(judge).report();
}

Result<std::vector<SoftwareObject>> rasterise_scene(const SoftwareProgram& program,
                                                    const Interface& interface, const WitnessScene& scene) {
    auto objects = rasterise_objects(program, interface, scene.objects,
                                     with_plain_textures(interface, scene.values), scene.view);
    if (!objects) return objects;
    for (SoftwareObject& object : *objects) {
        for (const auto& [sampler, image] : scene.images) {
            object.vertices.images[sampler] = image;
            object.uniforms.images[sampler] = image;
        }
    }
    return objects;
}

std::vector<PictureReport> witness(const Context& context, const Composition& composition,
                                   const Validated& validated, const WitnessScene& scene, int jobs) {
    const std::vector<Permutation>& permutations = composition.permutations;
    std::vector<Result<Image>> drawn;
    std::vector<Interface> interfaces;
    for (const Permutation& permutation : permutations) {  // a context is used by one thread
        interfaces.push_back(interface_of(validated, permutation));
        drawn.push_back(
            draw(context, composition, permutation, interfaces.back(), with_shadows(scene, permutation.key)));
    }
    std::vector<PictureReport> reports(permutations.size());
    for_each_index(permutations.size(), jobs, [&](std::size_t i) {
        const Permutation& permutation = permutations[i];
        reports[i] =
            drawn[i] ? compare_picture(*drawn[i],
                                       validated.stages[static_cast<std::size_t>(permutation.vertex)].spirv,
                                       validated.stages[static_cast<std::size_t>(permutation.fragment)].spirv,
                                       interfaces[i], with_shadows(scene, permutation.key))
                     : without_picture(drawn[i].error());
        reports[i].key = permutation.key;
    });
    return reports;
}

}  // namespace gobo::verify
