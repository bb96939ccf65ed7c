#include "scene/funnel.hpp"

#include <algorithm>
#include <limits>

#include "family/key_space.hpp"

namespace gobo::scene {
namespace {

std::uint64_t full_product(const Family& family) {
    std::uint64_t product = 1;
    for (const Feature& feature : family.features) {
        const std::uint64_t count = feature.values.size();
        const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
        product = product > most / count ? most : product * count;
    }
    return product;
}

}  // namespace

Result<Funnel> measure_funnel(const Family& family, const std::vector<Draw>& draws, const Buckets& buckets,
                              std::string_view dialect) {
    const auto exact = keys_for_draws(family, draws, {}, dialect);
    if (!exact) return tl::unexpected(exact.error());
    const auto rounded = keys_for_draws(family, draws, buckets, dialect);
    if (!rounded) return tl::unexpected(rounded.error());
    Funnel funnel;
    funnel.full_product = full_product(family);
    funnel.valid = KeySpace(family, dialect, {{}, {}, true}).count();
    funnel.draws = static_cast<std::size_t>(
        std::count_if(exact->begin(), exact->end(), [](const auto& draw) { return draw.has_value(); }));
    funnel.called_for = distinct_keys(*exact).size();
    funnel.bucketed = distinct_keys(*rounded).size();
    return funnel;
}

Result<std::vector<BucketingRow>> compare_bucketings(const Family& family, const std::vector<Draw>& draws,
                                                     const Buckets& chosen, std::string_view dialect) {
    std::vector<Buckets> bucketings = {{}, {0, 1, 2, 4, 8}, {0, 2, 8}, {0, 8}, {8}};
    if (std::find(bucketings.begin(), bucketings.end(), chosen) == bucketings.end())
        bucketings.push_back(chosen);
    std::vector<BucketingRow> rows;
    for (const Buckets& buckets : bucketings) {
        const auto keys = keys_for_draws(family, draws, buckets, dialect);
        if (!keys) return tl::unexpected(keys.error());
        BucketingRow row{buckets, distinct_keys(*keys).size(), 0, 0};
        for (const auto& key : *keys) {
            row.lights += key ? key->lights : 0;
            row.shaded_lights += key ? key->shaded_lights : 0;
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace gobo::scene
