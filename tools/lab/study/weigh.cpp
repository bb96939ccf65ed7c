#include "lab/study/weigh.hpp"

#include <algorithm>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "budget/qualities.hpp"

namespace gobo::study {
namespace {

const std::string kFolder = "data/study/operations";

struct Pair {
    std::string operation;
    Key few;
    Key many;
};

std::vector<Pair> pairs_of(const Family& family) {
    std::vector<Pair> pairs;
    const int operation = family.index_of("operation").value();
    for (const std::string& name : family.features[static_cast<std::size_t>(operation)].values)
        pairs.push_back({name, parse_key(family, "operation=" + name).value(),
                         parse_key(family, "repeats=many operation=" + name).value()});
    return pairs;
}

Result<std::array<double, evaluate::kKinds>> counts_of(const ScenePoints& points, const Variant& variant) {
    verify::Work work;
    const auto colors = shade_points<float>(points, variant, &work);
    if (!colors) return tl::unexpected(colors.error());
    std::array<double, evaluate::kKinds> counts{};
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        counts[kind] = static_cast<double>(work.fragments[kind]) / static_cast<double>(points.pixels);
    return counts;
}

/// Where a program's code happens to lie changes its time by more than its rounds tell: so each is linked,
/// and timed, so many times.
constexpr int kLinks = 3;

Result<std::vector<TimedGroup>> time_linked_anew(const Context& context, const Family& family,
                                                 const Variants& variants, const std::vector<Key>& keys,
                                                 const DrawnScene& scene, int rounds) {
    std::vector<TimedGroup> groups;
    for (int link = 0; link < kLinks; ++link) {
        auto group = time_variants(context, family, variants, keys, scene, rounds);
        if (!group) return tl::unexpected(group.error());
        groups.push_back(std::move(*group));
    }
    return groups;
}

/// The spread whose median is the middle one.
Spread middle_of(std::vector<Spread> spreads) {
    std::sort(spreads.begin(), spreads.end(),
              [](const Spread& a, const Spread& b) { return a.median < b.median; });
    return spreads[spreads.size() / 2];
}

Spread difference(const Spread& many, const Spread& few) {
    return {std::max(0.0, many.median - few.median), std::max(0.0, many.low - few.high),
            std::max(0.0, many.high - few.low)};
}

/// Minimises the squares over weights that are not negative, one weight at a time: the problem is convex, and
/// so small that this ends soon.
class PriceSolver {
  public:
    explicit PriceSolver(const std::vector<Weighing>& rows) : rows_(rows) {
        double typical = 0;
        for (const Weighing& row : rows) typical += row.nanoseconds.median / static_cast<double>(rows.size());
        // What takes hardly any time is noise: it counts as a tenth of the typical row.
        for (const Weighing& row : rows) scales_.push_back(1 / (row.nanoseconds.median + typical / 10));
    }

    std::array<double, evaluate::kKinds> solve() {
        constexpr int sweeps = 20000;
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) improve(kind);
        return prices_;
    }

  private:
    void improve(std::size_t kind) {
        // Where two kinds always come together, the least prices that explain the times are taken.
        constexpr double ridge = 1e-6;
        double slope = 0;
        double curvature = 0;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const double count = rows_[i].counts[kind] * scales_[i];
            slope += count * (residual(i) * scales_[i] + count * prices_[kind]);
            curvature += count * count;
        }
        if (curvature == 0) return;
        prices_[kind] = std::max(0.0, slope / (curvature * (1 + ridge)));
    }

    [[nodiscard]] double residual(std::size_t row) const {
        double rest = rows_[row].nanoseconds.median;
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            rest -= rows_[row].counts[kind] * prices_[kind];
        return rest;
    }

    const std::vector<Weighing>& rows_;
    std::vector<double> scales_;
    std::array<double, evaluate::kKinds> prices_{};
};

Weights weights_of(const std::array<double, evaluate::kKinds>& prices, const std::string& renderer) {
    Weights weights;
    weights.renderer = renderer;
    weights.nanoseconds = prices[static_cast<std::size_t>(evaluate::Kind::add)];
    for (std::size_t kind = 0; kind < evaluate::kKinds && weights.nanoseconds > 0; ++kind)
        weights.by_kind[kind] = prices[kind] / weights.nanoseconds;
    return weights;
}

}  // namespace

std::array<double, evaluate::kKinds> solve_for_prices(const std::vector<Weighing>& operations) {
    return PriceSolver(operations).solve();
}

Result<WeighingResult> weigh_operations(const FileSystem& shipped, const Context& context, int rounds,
                                        int jobs) {
    const std::string path = kFolder + "/operations.toml";
    const Result<std::string> text = shipped.read(path);
    if (!text) return tl::unexpected(text.error());
    const Result<Family> family = read_family(*text, path);
    if (!family) return tl::unexpected(family.error());
    SearchPath search;
    search.add(shipped, kFolder, kFolder + "/", false);
    const std::vector<Pair> pairs = pairs_of(*family);
    std::vector<Key> keys;
    for (const Pair& pair : pairs) keys.insert(keys.end(), {pair.few, pair.many});
    const Result<Variants> variants = load_variants(*family, search, keys, jobs);
    if (!variants) return tl::unexpected(variants.error());
    const auto scene = draw_scene(shipped, *family, default_plan(*family).scenes.front());
    if (!scene) return tl::unexpected(scene.error());
    const auto points = find_points(*family, variants->at(pairs.front().few), *scene);
    if (!points) return tl::unexpected(points.error());
    const auto timed = time_linked_anew(context, *family, *variants, keys, *scene, rounds);
    if (!timed) return tl::unexpected(timed.error());
    WeighingResult result;
    for (const TimedGroup& group : *timed) {
        result.control.elapsed = std::max(result.control.elapsed, group.control.elapsed);
        result.control.processor = std::max(result.control.processor, group.control.processor);
    }
    const bool by_processor = draws_in_calling_thread(context.renderer());
    const auto time_of = [&](std::size_t i) {
        std::vector<Spread> spreads;
        for (const TimedGroup& group : *timed)
            spreads.push_back(
                (by_processor ? group.timings[i].processor : group.timings[i].elapsed).fragment);
        return middle_of(std::move(spreads));
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto few = counts_of(*points, variants->at(pairs[i].few));
        if (!few) return tl::unexpected(few.error());
        const auto many = counts_of(*points, variants->at(pairs[i].many));
        if (!many) return tl::unexpected(many.error());
        Weighing& row = result.operations.emplace_back();
        row.operation = pairs[i].operation;
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            row.counts[kind] = (*many)[kind] - (*few)[kind];
        row.nanoseconds = difference(time_of(2 * i + 1), time_of(2 * i));
    }
    result.weights = weights_of(solve_for_prices(result.operations), context.renderer());
    return result;
}

}  // namespace gobo::study
