// teapot OUTPUT_FOLDER SCENE.gltf...: draws each scene with the permutations that it needs and writes PNG
// pictures.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "draw_scene.hpp"
#include "offscreen.hpp"
#include "picture.hpp"

namespace teapot {
namespace {

constexpr Size picture_size{800, 500};

/// "scenes/mist.gltf" gives "mist".
std::string stem_of(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name.substr(0, name.rfind('.'));
}

void write(const std::string& path, const Picture& picture) {
    write_png(path, picture);
    std::printf("%s\n", path.c_str());
}

void run(const std::string& folder, const std::vector<std::string>& scene_files) {
    const Size size{picture_size.width * samples, picture_size.height * samples};
    const Offscreen offscreen(size);
    std::vector<Picture> pictures;
    for (const std::string& file : scene_files) {
        const Scene scene = read_scene(file);
        Renderer renderer(offscreen.gl());
        const auto keys =
            draw(renderer, scene, static_cast<float>(size.width) / static_cast<float>(size.height));
        pictures.push_back(develop(offscreen.read()));
        write(folder + "/" + stem_of(file) + ".png", pictures.back());
        for (const std::string& key : keys) std::printf("  %s\n", key.c_str());
    }
    write(folder + "/teapots.png", arrange(pictures, 3));
}

}  // namespace
}  // namespace teapot

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("usage: teapot OUTPUT_FOLDER SCENE.gltf...\n", stderr);
        return 2;
    }
    try {
        teapot::run(argv[1], {argv + 2, argv + argc});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "teapot: %s\n", error.what());
        return 1;
    }
    return 0;
}
