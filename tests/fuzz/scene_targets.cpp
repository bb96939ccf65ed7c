#include <string>

#include "core/file_system.hpp"
#include "results.hpp"
#include "scene/effects.hpp"
#include "scene/picture.hpp"
#include "scene/read_scene.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

void read_gltf(std::string_view input) {
    MemoryFileSystem disk({{"a.gltf", std::string(input)}, {"a.glb", std::string(input)}});
    for (const char* path : {"a.gltf", "a.glb"}) {
        const Result<scene::Scene> scene = scene::read_scene(disk, path);
        if (is_value(scene))
            static_cast<void>(scene::required_effects(*scene, scene::eye_of_cameras(*scene), {}));
    }
}

void read_picture(std::string_view input) {
    const auto picture = scene::decode_picture(input);
    if (!picture) return require(!picture.error().message.empty());
    require(picture->texels.size() == std::size_t{4} * static_cast<std::size_t>(picture->width) *
                                          static_cast<std::size_t>(picture->height));
}

}  // namespace gobo::fuzz
