#include "gobo/scene_selection.hpp"

#include "compose/dialect.hpp"
#include "family/key.hpp"
#include "scene/read_scene.hpp"
#include "scene/scene_keys.hpp"

namespace gobo {

Result<std::vector<NamedKey>> keys_of_scene(const World& world, LoadedFamily& family, const std::string& path,
                                            const std::string& bucket_lights, Dialect dialect) {
    const Result<scene::Buckets> buckets = scene::parse_buckets(bucket_lights);
    if (!buckets) return tl::unexpected(buckets.error());
    const Result<scene::Scene> scene = scene::read_scene(world.disk, path);
    if (!scene) return tl::unexpected(scene.error());
    family.files.insert(family.files.end(), scene->files.begin(), scene->files.end());
    const auto draws = scene::required_effects(*scene, scene::eye_of_cameras(*scene), {});
    const auto keys = scene::keys_for_draws(family.family, draws, *buckets, name_of(dialect));
    if (!keys) return tl::unexpected(keys.error());
    std::vector<NamedKey> named;
    for (const Key& key : scene::distinct_keys(*keys))
        named.push_back({key_text(family.family, key), {path, 0, 0}});
    if (!named.empty()) return named;
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = "needs no permutation: it draws no triangles";
    return fail(std::move(diagnostic));
}

}  // namespace gobo
