#include "lab/commands/environment.hpp"

#include <algorithm>

#include "lab/probe/convolution.hpp"
#include "lab/render/image_file.hpp"

namespace gobo {
namespace {

constexpr const char* kShippedMap = "data/environments/studio.exr";
constexpr double kShippedShininess = 48;

Result<CubeImages> shipped_environment(const World& world, int jobs) {
    const auto image = read_image(world.shipped, kShippedMap);
    if (!image) return tl::unexpected(image.error());
    const auto environment = probe::environment_of(*image, kShippedMap);
    if (!environment) return tl::unexpected(environment.error());
    const auto cube = [&](double exponent, int side) {
        const probe::Lobe lobe(*environment, exponent);
        return probe::make_cube_map(side, jobs,
                                    [&](const glm::dvec3& direction) { return lobe.around(direction); });
    };
    return CubeImages{{"diffuseMap", cube(1, 16)}, {"specularMap", cube(kShippedShininess, 32)}};
}

}  // namespace

Result<CubeImages> load_environment(const World& world, const std::string& folder, int jobs) {
    if (folder.empty()) return shipped_environment(world, jobs);
    CubeImages images;
    for (const auto& [sampler, file] :
         {std::pair("diffuseMap", "diffuse.exr"), std::pair("specularMap", "specular.exr")}) {
        auto image = read_image(world.disk, folder + "/" + file);
        if (!image) {
            Diagnostics why = image.error();
            for (Diagnostic& diagnostic : why) diagnostic.help = "name a folder that gobo probe wrote";
            return tl::unexpected(std::move(why));
        }
        images.emplace(sampler, std::move(*image));
    }
    return images;
}

Result<CubeImages> environment_for(const World& world, const std::string& folder, int jobs,
                                   const std::vector<Interface>& interfaces) {
    const auto looks_up = [](const Interface& interface) {
        return std::any_of(interface.samplers.begin(), interface.samplers.end(), [](const Sampler& sampler) {
            return sampler.name == "diffuseMap" || sampler.name == "specularMap";
        });
    };
    if (std::none_of(interfaces.begin(), interfaces.end(), looks_up)) return CubeImages{};
    return load_environment(world, folder, jobs);
}

Result<void> add_environment(const World& world, const std::string& folder, int jobs,
                             const std::vector<Interface>& interfaces, CubeMaps& cubes) {
    const auto images = environment_for(world, folder, jobs, interfaces);
    if (!images) return tl::unexpected(images.error());
    for (const auto& [sampler, image] : *images)
        if (const auto added = cubes.add(sampler, image); !added) return added;
    return {};
}

}  // namespace gobo
