// What an operation of each kind costs on a renderer, measured.
#include <algorithm>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

Result<ByKind> counts_of(const ScenePoints& points, const Variant& variant) {
    raster::Work work;
    GOBO_TRY_DO(shade_points<float>(points, variant, &work));
    ByKind counts{};
    for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
        counts[kind] = static_cast<double>(work.fragments[kind]) / static_cast<double>(points.pixels);
    return counts;
}

Weights weights_of(const ByKind& prices, const std::string& renderer) {
    Weights weights;
    weights.renderer = renderer;
    weights.nanoseconds = prices[static_cast<std::size_t>(evaluate::Kind::add)];
    for (std::size_t kind = 0; kind < evaluate::kKinds && weights.nanoseconds > 0; ++kind)
        weights.by_kind[kind] = prices[kind] / weights.nanoseconds;
    return weights;
}

}  // namespace

// Minimises the squares over weights that are not negative, one weight at a time: the problem is convex, and
// so small that this ends soon.
ByKind solve_for_prices(const std::vector<Weighing>& operations) {
    constexpr int kSweeps = 20000;
    // Where two kinds always come together, the least prices that explain the times are taken.
    constexpr double kRidge = 1e-6;
    double typical = 0;
    for (const Weighing& row : operations)
        typical += row.nanoseconds.median / static_cast<double>(operations.size());
    ByKind prices{};
    const auto improve = [&](std::size_t kind) {
        double slope = 0;
        double curvature = 0;
        for (const Weighing& row : operations) {
            double residual = row.nanoseconds.median;
            for (std::size_t other = 0; other < evaluate::kKinds; ++other)
                residual -= row.counts[other] * prices[other];
            // What takes hardly any time is noise: it counts as a tenth of the typical row.
            const double scale = 1 / (row.nanoseconds.median + typical / 10);
            const double count = row.counts[kind] * scale;
            slope += count * (residual * scale + count * prices[kind]);
            curvature += count * count;
        }
        if (curvature > 0) prices[kind] = std::max(0.0, slope / (curvature * (1 + kRidge)));
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind) improve(kind);
    return prices;
}

Result<WeighingResult> weigh_operations(const FileSystem& shipped, const Context& context, int rounds,
                                        int jobs) {
    const std::string folder = "data/study/operations";
    const std::string path = folder + "/operations.toml";
    GOBO_TRY(const std::string text, shipped.read(path));
    GOBO_TRY(const Family family, read_family(text, path));
    SearchPath search;
    search.add(shipped, folder, folder + "/", false);
    const int operation = family.index_of("operation").value();
    const std::vector<std::string>& names = family.features[static_cast<std::size_t>(operation)].values;
    std::vector<Key> keys;  // of each operation, a few and many
    for (const std::string& name : names)
        for (const char* repeats : {"", "repeats=many "})
            keys.push_back(parse_key(family, fmt::format("{}operation={}", repeats, name)).value());
    GOBO_TRY(const Variants variants, load_variants({shipped, family, search, jobs}, keys));
    GOBO_TRY(const DrawnScene scene, draw_scene(shipped, family, default_plan(family).scenes.front()));
    GOBO_TRY(const ScenePoints points, find_points(family, variants.at(keys.front()), scene));
    // Where a program's code happens to lie changes its time by more than its rounds tell: so each is linked,
    // and timed, so many times, and the one whose median is the middle one counts.
    constexpr int kLinks = 3;
    WeighingResult result;
    std::vector<std::vector<Spread>> spreads(keys.size());
    for (int link = 0; link < kLinks; ++link) {
        GOBO_TRY(const TimedGroup group, time_variants(context, family, variants, keys, scene, rounds));
        result.control.elapsed = std::max(result.control.elapsed, group.control.elapsed);
        result.control.processor = std::max(result.control.processor, group.control.processor);
        for (std::size_t i = 0; i < keys.size(); ++i)
            spreads[i].push_back(group.timings[i].ranked().fragment);
    }
    for (std::vector<Spread>& own : spreads)
        std::sort(own.begin(), own.end(),
                  [](const Spread& a, const Spread& b) { return a.median < b.median; });
    for (std::size_t i = 0; i < names.size(); ++i) {
        GOBO_TRY(const ByKind few_counts, counts_of(points, variants.at(keys[2 * i])));
        GOBO_TRY(const ByKind many_counts, counts_of(points, variants.at(keys[2 * i + 1])));
        const Spread& few = spreads[2 * i][kLinks / 2];
        const Spread& many = spreads[2 * i + 1][kLinks / 2];
        Weighing& row = result.operations.emplace_back();
        row.operation = names[i];
        for (std::size_t kind = 0; kind < evaluate::kKinds; ++kind)
            row.counts[kind] = many_counts[kind] - few_counts[kind];
        row.nanoseconds = {std::max(0.0, many.median - few.median), std::max(0.0, many.low - few.high),
                           std::max(0.0, many.high - few.low)};
    }
    result.weights = weights_of(solve_for_prices(result.operations), context.renderer());
    return result;
}

}  // namespace gobo::study
