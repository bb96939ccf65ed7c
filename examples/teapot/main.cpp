// teapot OUTPUT_FOLDER TEAPOT.obj: draws one scene with several permutations of lit and writes PNG pictures.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "offscreen.hpp"
#include "picture.hpp"
#include "renderer.hpp"
#include "scene.hpp"

namespace teapot {
namespace {

constexpr Size picture_size{800, 500};

struct Shot {
    std::string name;
    lit::Key key;
};

lit::Key all_lights() {
    lit::Key key;
    key.directional = 1;
    key.point = 1;
    key.spot = 1;
    return key;
}

/// Keys are made at run time: by the scene, by the user's settings.
std::vector<Shot> shots() {
    std::vector<Shot> shots(6, {"", all_lights()});
    shots[0].name = "mist";
    shots[0].key.specular = lit::Specular::blinn;
    shots[0].key.fog = lit::Fog::exponential_squared;
    shots[1].name = "per_vertex";
    shots[1].key.specular = lit::Specular::blinn;
    shots[1].key.shading = lit::Shading::vertex;
    shots[2].name = "phong";
    shots[2].key.specular = lit::Specular::phong;
    shots[3].name = "toon";
    shots[3].key.diffuse = lit::Diffuse::toon;
    shots[3].key.fog = lit::Fog::linear;
    shots[4] = {"spot", {}};
    shots[4].key.spot = 1;
    shots[4].key.specular = lit::Specular::blinn;
    shots[4].key.fog = lit::Fog::linear;
    shots[5] = {"moonlight", {}};
    shots[5].key.directional = 1;
    shots[5].key.specular = lit::Specular::blinn;
    shots[5].key.fog = lit::Fog::exponential;
    return shots;
}

void write(const std::string& path, const Picture& picture, const std::string& note) {
    write_png(path, picture);
    std::printf("%s  %s\n", path.c_str(), note.c_str());
}

void run(const std::string& folder, const std::string& teapot_file) {
    const Size size{picture_size.width * samples, picture_size.height * samples};
    const Offscreen offscreen(size);
    Renderer renderer(offscreen.gl());
    const Scene scene(teapot_file);
    std::vector<Picture> pictures;
    for (const Shot& shot : shots()) {
        scene.draw(renderer, shot.key, static_cast<float>(size.width) / static_cast<float>(size.height));
        pictures.push_back(develop(offscreen.read()));
        write(folder + "/" + shot.name + ".png", pictures.back(), lit::key_text(shot.key));
    }
    write(folder + "/teapots.png", arrange(pictures, 3), "all of them");
}

}  // namespace
}  // namespace teapot

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: teapot OUTPUT_FOLDER TEAPOT.obj\n", stderr);
        return 2;
    }
    try {
        teapot::run(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "teapot: %s\n", error.what());
        return 1;
    }
    return 0;
}
