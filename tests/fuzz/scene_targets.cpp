#include <string>

#include "core/file_system.hpp"
#include "results.hpp"
#include "scene/effects.hpp"
#include "scene/picture.hpp"
#include "scene/read_scene.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

bool read_gltf(std::string_view input) {
    MemoryFileSystem disk({{"a.gltf", std::string(input)}, {"a.glb", std::string(input)}});
    bool is_scene = false;
    for (const char* path : {"a.gltf", "a.glb"}) {
        const Result<scene::Scene> scene = scene::read_scene(disk, path);
        if (!is_value(scene)) continue;
        is_scene = true;
        static_cast<void>(scene::required_effects(*scene, scene::eye_of_cameras(*scene), {}));
    }
    return is_scene;
}

bool read_picture(std::string_view input) {
    const auto picture = scene::decode_picture(input);
    if (!picture) {
        require(!picture.error().message.empty());
        return false;
    }
    require(picture->texels.size() == std::size_t{4} * static_cast<std::size_t>(picture->width) *
                                          static_cast<std::size_t>(picture->height));
    return true;
}

}  // namespace gobo::fuzz
