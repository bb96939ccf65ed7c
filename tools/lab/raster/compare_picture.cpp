#include "lab/raster/compare_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/raster/shade.hpp"

namespace gobo::raster {
namespace {

/// As far as inputs are moved to find what lies at a discontinuity, as for the oracle's edges.
constexpr double kNudge = 1e-5;
/// Errors above this share of the limit without spread are looked at again with it.
constexpr double kDoubtfulRatio = 0.5;
/// Each nudged evaluation decides a question at its edge at random: 16 miss an answer once in 65,536.
constexpr std::uint64_t kNudges = 16;

using Color = std::array<double, 4>;

/// Depths this near to one another may be ordered either way: some twenty roundings of a depth near 1.
constexpr double kDepthError = 2e-6;

/// A depth compared by itself may be off by as much as it changes over this part of a pixel: the corners of a
/// triangle that is clipped are known to 1/256, in either direction.
constexpr double kDepthPlaceError = 1.0 / 256;

/// A fragment as one evaluation shaded it.
struct Candidate {
    const Fragment* fragment = nullptr;
    Shaded shaded;
    Color spread{};  ///< of its colour: color_spread()
};

/// The candidates of each pixel, in the order in which they are drawn; row after row, the lowest first. Refer
/// to the objects' fragments.
using Layers = std::vector<std::vector<Candidate>>;

/// Shades every object, nudged; `with_spread` finds how far its colours may be off by a
/// renderer's errors.
Result<Layers> shade_all(const Pipeline& pipeline, const std::vector<RasterObject>& objects,
                         std::size_t pixels, bool with_spread, const Nudge& nudge = {}) {
    Layers layers(pixels);
    for (std::size_t o = 0; o < objects.size(); ++o) {
        GOBO_TRY(const auto shaded,
                 shade<float>(pipeline, objects[o], nullptr, {nudge.by, nudge.seed * objects.size() + o}));
        std::vector<Color> spread(shaded.size());
        if (with_spread) {
            GOBO_TRY(spread, color_spread(pipeline, objects[o]));
            for (std::size_t i = 0; i < spread.size() && pipeline.color.empty(); ++i) {
                const Interpolator interpolator = objects[o].interpolator(objects[o].fragments[i].triangle);
                spread[i][0] += kDepthPlaceError * interpolator.depth_slope(0, 0);
            }
        }
        for (std::size_t i = 0; i < shaded.size(); ++i) {
            const Fragment& fragment = objects[o].fragments[i];
            layers[static_cast<std::size_t>(fragment.y * objects[o].width + fragment.x)].push_back(
                {&fragment, shaded[i], spread[i]});
        }
    }
    return layers;
}

/// What a pixel may show.
struct Seen {
    Color color{};
    Color spread{};
};

/// What the depth test leaves; nothing is the background.
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

/// All that the pixel may show where each fragment near an edge may be covered or not, and depths that are
/// almost the same may be ordered either way.
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

/// The largest channel's error over its limit; infinite for a NaN on one side only.
double ratio_of(const Color& actual, const Seen& expected, const PixelLimit& limit) {
    double largest = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const double color = expected.color[c];
        if (actual[c] == color || (std::isnan(actual[c]) && std::isnan(color))) continue;
        const double ratio = std::abs(actual[c] - color) /
                             (limit.absolute + limit.relative * std::abs(color) + expected.spread[c]);
        largest = std::max(largest, std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
    }
    return largest;
}

/// Judges one picture. Its rows run down, OpenGL's up.
class Judge {
  public:
    Judge(const Image& drawn, const std::array<float, 4>& background, const PixelLimit& limit,
          KeptPictures kept)
        : drawn_(drawn), limit_(limit), kept_(kept) {
        std::copy(background.begin(), background.end(), background_.begin());
        report_.expected = Image(drawn.width, drawn.height, 4);
        report_.actual = drawn;
        report_.pixels = static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height);
    }

    /// Compares each pixel with its plain evaluation. Those not well within their limit stay in doubt.
    void compare(const Layers& layers) {
        for (int y = 0; y < drawn_.height; ++y)
            for (int x = 0; x < drawn_.width; ++x) compare(layers, x, y);
    }

    /// Compares those in doubt with their evaluation and its spread. Those out of limit stay in doubt.
    void compare_closer(const Layers& layers) {
        std::erase_if(doubts_, [&](WrongPixel& pixel) {
            const Seen seen = seen_at(layers, pixel.x, pixel.y);
            pixel.ratio = ratio_of(pixel.actual, seen, limit_);
            if (pixel.ratio > 1) return false;
            accept(pixel, nearest_ratio(pixel, layers), seen.spread);
            return true;
        });
    }

    [[nodiscard]] bool has_doubts() const { return !doubts_.empty(); }
    /// Whether a pixel, counted from the lower left, is in doubt.
    [[nodiscard]] bool doubts(int x, int y) const {
        return std::any_of(doubts_.begin(), doubts_.end(), [&](const WrongPixel& pixel) {
            return pixel.x == x && pixel.y == drawn_.height - 1 - y;
        });
    }

    /// Clears the doubts that this evaluation explains.
    void explain(const Layers& layers) {
        std::erase_if(doubts_, [&](const WrongPixel& pixel) {
            const double ratio = nearest_ratio(pixel, layers);
            if (ratio > 1) return false;
            report_.largest_ratio = std::max(report_.largest_ratio, ratio);
            ++report_.edges;
            return true;
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
        if (!report_.fails() && kept_ == KeptPictures::failing) report_.actual = report_.expected = Image();
        return std::move(report_);
    }

  private:
    [[nodiscard]] const std::vector<Candidate>& candidates(const Layers& layers, int x, int y) const {
        return layers[static_cast<std::size_t>((drawn_.height - 1 - y) * drawn_.width + x)];
    }
    [[nodiscard]] Seen seen_at(const Layers& layers, int x, int y) const {
        return visible(candidates(layers, x, y)).value_or(Seen{background_, {}});
    }

    /// The ratio to whichever of the pixel's possible colours is nearest.
    [[nodiscard]] double nearest_ratio(const WrongPixel& pixel, const Layers& layers) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Seen& seen : possible(candidates(layers, pixel.x, pixel.y), background_))
            nearest = std::min(nearest, ratio_of(pixel.actual, seen, limit_));
        return nearest;
    }

    void compare(const Layers& layers, int x, int y) {
        if (visible(candidates(layers, x, y))) ++report_.drawn;
        const Seen seen = seen_at(layers, x, y);
        WrongPixel pixel{x, y, {}, seen.color, 0};
        for (int c = 0; c < 4; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            pixel.actual[channel] = static_cast<double>(drawn_.at(x, y, c));
            report_.expected.at(x, y, c) = static_cast<float>(seen.color[channel]);
        }
        pixel.ratio = ratio_of(pixel.actual, seen, limit_);
        if (pixel.ratio > kDoubtfulRatio)
            doubts_.push_back(pixel);
        else
            accept(pixel, pixel.ratio);
    }

    void accept(const WrongPixel& pixel, double ratio, const Color& spread = {}) {
        report_.largest_ratio = std::max(report_.largest_ratio, ratio);
        measure(pixel.actual, pixel.expected, spread);
    }

    void measure(const Color& actual, const Color& expected, const Color& spread = {}) {
        ++compared_;
        for (std::size_t c = 0; c < 4; ++c) {
            const double error = actual[c] == expected[c] ? 0 : std::abs(actual[c] - expected[c]);
            report_.largest_error = std::max(report_.largest_error, error);
            const double counted = std::max(error - spread[c], 0.0) / std::max(std::abs(expected[c]), 1.0);
            squares_ += counted * counted;
        }
    }

    const Image& drawn_;
    PixelLimit limit_;
    KeptPictures kept_;
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

/// The limit for a permutation that draws by these stages: it pays for powers, angles and filters only where
/// they have some. renderer_precision_test measures what is paid for.
PixelLimit limit_of(const Pipeline& pipeline) {
    using evaluate::Kind;
    PixelLimit limit{kSmallestError, kArithmeticError};
    if (pipeline.color.empty()) return {kDepthError, 0};
    for (const evaluate::Program* program : {&pipeline.vertex, &pipeline.fragment}) {
        if (!program->images.empty()) limit.absolute = kSmallestError + kFilteringError;
        if (computes(*program, {Kind::pow, Kind::exp, Kind::log, Kind::trig}))
            limit.relative = kArithmeticError + kPowerError;
    }
    return limit;
}

/// Depths as shade() gives them where there is no colour.
Image as_color(const Image& depth) {
    Image image(depth.width, depth.height, 4);
    for (int y = 0; y < depth.height; ++y)
        for (int x = 0; x < depth.width; ++x) {
            image.at(x, y, 0) = depth.at(x, y, 0);
            image.at(x, y, 3) = 1;
        }
    return image;
}

Result<PictureReport> compare(const Image& drawn, const Pipeline& pipeline,
                              const std::vector<RasterObject>& objects,
                              const std::array<float, 4>& background, KeptPictures kept) {
    Judge judge(drawn, background, limit_of(pipeline), kept);
    const auto pixels = static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height);
    GOBO_TRY(const Layers plain, shade_all(pipeline, objects, pixels, false));
    judge.compare(plain);
    const auto in_doubt = [&] {
        std::vector<RasterObject> parts;
        for (const RasterObject& object : objects)
            parts.push_back(part_of(pipeline, object, [&](int x, int y) { return judge.doubts(x, y); }));
        return parts;
    };
    if (judge.has_doubts()) {
        const std::vector<RasterObject> parts = in_doubt();
        GOBO_TRY(const Layers closer, shade_all(pipeline, parts, pixels, true));
        judge.compare_closer(closer);
        judge.explain(closer);
    }
    const std::vector<RasterObject> parts = judge.has_doubts() ? in_doubt() : std::vector<RasterObject>{};
    for (std::uint64_t seed = 1; seed <= kNudges && judge.has_doubts(); ++seed) {
        GOBO_TRY(const Layers nudged, shade_all(pipeline, parts, pixels, false, {kNudge, seed}));
        judge.explain(nudged);
    }
    return std::move(judge).report();
}

}  // namespace

bool PictureReport::fails() const {
    return wrong > 0 || root_mean_square > kRmsLimit ||
           static_cast<double>(edges) > kLargestEdgePixelShare * static_cast<double>(pixels);
}

PictureReport compare_picture(const Picture& drawn, const Pipeline& pipeline,
                              const std::vector<RasterObject>& objects,
                              const std::array<float, 4>& background, KeptPictures kept) {
    const bool has_color = !pipeline.color.empty();
    Result<PictureReport> report =
        has_color ? compare(drawn.color, pipeline, objects, background, kept)
                  : compare(as_color(drawn.depth), pipeline, objects, {1, 0, 0, 1}, kept);
    if (report) return *std::move(report);
    PictureReport none;
    none.diagnostics = std::move(report).error();
    return none;
}

}  // namespace gobo::raster
