// The environment that pictures are lit by: what gobo probe wrote, or the shipped studio.
#pragma once

#include <map>

#include "gobo/command.hpp"
#include "lab/render/image.hpp"
#include "lab/render/texture.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// Cube maps by the name of their sampler.
using CubeImages = std::map<std::string, Image>;

/// `folder`/diffuse.exr and `folder`/specular.exr as diffuseMap and specularMap. Where `folder` is empty,
/// those of the shipped environment `studio`, for a shininess of 48.
[[nodiscard]] Result<CubeImages> load_environment(const World& world, const std::string& folder, int jobs);

/// The same; none where no interface looks any up.
[[nodiscard]] Result<CubeImages> environment_for(const World& world, const std::string& folder, int jobs,
                                                 const std::vector<Interface>& interfaces);

/// Gives `cubes` the maps of the environment, where an interface looks any up.
[[nodiscard]] Result<void> add_environment(const World& world, const std::string& folder, int jobs,
                                           const std::vector<Interface>& interfaces, CubeMaps& cubes);

}  // namespace gobo
