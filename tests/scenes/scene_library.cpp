#include "scene_library.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/render/program.hpp"
#include "scene/read_scene.hpp"

namespace gobo::scene {
namespace {

const std::string source = GOBO_SOURCE_DIR;

std::string scene_folder() {
    return source + "/tests/assets/scenes";
}

}  // namespace

ShippedFamily::ShippedFamily(const std::string& name) {
    const std::string own_folder = name == "uber" ? "tests/ubershader" : "templates";
    const std::string path = source + "/" + own_folder + "/" + name + ".toml";
    const FindFamily find_base = [this](const std::string& base) -> Result<FamilyText> {
        const std::string base_path = source + "/templates/" + base + ".toml";
        Result<std::string> text = files.read(base_path);
        if (!text) return tl::unexpected(text.error());
        return FamilyText{std::move(*text), base_path};
    };
    Result<std::string> text = files.read(path);
    EXPECT_TRUE(text) << path;
    Result<Family> read = read_family(*text, path, find_base);
    EXPECT_TRUE(read) << to_text(read.error());
    family = std::move(*read);
    for (const std::string& folder : {own_folder, std::string("shader_lib"), std::string("templates")})
        search.add(files, source + "/" + folder, folder + "/", false);
}

DepthPass shipped_depth_pass(int side) {
    const ShippedFamily depth("depth");
    const auto shaders = shaders_of(depth.family, depth.search, std::vector<Draw>(1),
                                    {default_key(depth.family)}, Dialect::own, 1);
    EXPECT_TRUE(shaders) << to_text(shaders.error());
    const Composition& composition = shaders->composition;
    DepthPass pass;
    pass.stages = {stage_text(composition, composition.permutations[0].stages[StageKind::vertex]),
                   stage_text(composition, composition.permutations[0].stages[StageKind::fragment])};
    pass.interface = shaders->interfaces[0];
    pass.values = depth.family.render;
    pass.side = side;
    return pass;
}

Scene shipped_scene(const std::string& file) {
    const DiskFileSystem files;
    Result<Scene> scene = read_scene(files, scene_folder() + "/" + file);
    EXPECT_TRUE(scene) << to_text(scene.error());
    return scene ? std::move(*scene) : Scene();
}

std::vector<std::string> shipped_scenes() {
    const DiskFileSystem files;
    std::vector<std::string> scenes = files.files_below(scene_folder());
    std::erase_if(
        scenes, [](const std::string& name) { return !name.ends_with(".gltf") && !name.ends_with(".glb"); });
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

}  // namespace gobo::scene
