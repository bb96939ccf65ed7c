// The part of `gobo render` that draws a glTF scene.
#pragma once

#include <string>

#include "gobo/command.hpp"
#include "lab/render/render.hpp"

namespace gobo {

struct SceneRequest {
    std::string path;
    int camera = -1;  ///< number in the file; below 0: the scene's first, or a view of everything
    std::string bucket_lights;
    Dialect dialect = Dialect::own;
    CommonOptions common;
    std::string environment;  ///< what gobo probe wrote; empty: a studio
};

struct ScenePicture {
    std::string file;
    Diagnostics warnings;
};

/// Draws a scene, each draw with the permutation that it calls for, and writes the picture, which is named
/// after the scene's file. Fault::usage where no node holds the camera.
[[nodiscard]] Result<ScenePicture> render_scene(const SceneRequest& request, const World& world,
                                                const LoadedFamily& family, const Context& context,
                                                const PictureOptions& options);

}  // namespace gobo
