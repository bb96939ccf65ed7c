#include "options.hpp"

#include <CLI/CLI.hpp>

namespace viewer {

CommandLine read_command_line(int argc, char** argv) {
    CommandLine result;
    Options& options = result.options;
    CLI::App app("Shows a glTF scene, each draw with the permutation that it needs.\n\n" + help_text());
    app.add_option("SCENE", options.scene, "A .gltf or .glb file")->required();
    app.add_option("--family", options.family,
                   "lit: by diffuse and specular reflectivities; pbr: glTF's materials as they are, in the "
                   "shipped studio where the scene states no light")
        ->check(CLI::IsMember({"lit", "pbr"}))
        ->capture_default_str();
    app.add_flag("--headless", options.headless, "No window: draws by OSMesa and ends");
    app.add_option("--frames", options.frames, "How many frames to draw without a window")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--turn", options.turn,
                   "Degrees from one of these to the next; once around in all unless given");
    app.add_option("--press", options.keys,
                   "Keys of the keyboard, one pressed before each frame but the first");
    app.add_option("-o", options.folder, "Folder for a picture of each frame (in a window: of each change)")
        ->type_name("DIR");
    app.add_option("--record", options.record,
                   "File of keys that were asked for but not built; by default viewer.keys, with "
                   "--family pbr viewer_pbr.keys");
    app.add_option(
        "--reload", options.reload,
        "Socket of gobo watch --serve: changed shaders are taken as they are saved. Without a window "
        "each frame but the first waits for a change");
    app.add_option("--width", options.size.width, "Pixels")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    app.add_option("--height", options.size.height, "Pixels")
        ->check(CLI::Range(16, 8192))
        ->capture_default_str();
    app.footer(
        "Examples:\n"
        "  viewer scene.gltf\n"
        "  viewer scene.gltf --family pbr\n"
        "  viewer scene.gltf --headless --frames 8 -o pictures\n"
        "  viewer scene.gltf --headless --frames 3 --turn 0 --press ft -o pictures");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int status = app.exit(error);
        result.exit_status = status == 0 ? 0 : 2;
    }
    if (options.record.empty()) options.record = options.family == "pbr" ? "viewer_pbr.keys" : "viewer.keys";
    return result;
}

}  // namespace viewer
