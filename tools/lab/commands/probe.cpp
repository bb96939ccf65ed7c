// gobo probe: light-probe maps and spherical-harmonic coefficients from an HDR map of an environment.
#include <fmt/format.h>

#include "lab/commands/lab_input.hpp"
#include "lab/probe/environment.hpp"
#include "lab/render/image.hpp"

namespace gobo {
namespace {

struct ProbeOptions {
    std::string map;
    std::string folder;
    double shininess = 48;
    int diffuse_size = 32;
    int specular_size = 64;
};

Result<Outcome> run(const ProbeOptions& options, const World& world) {
    GOBO_TRY(const std::string bytes, world.disk.read(options.map));
    const Result<Image> image = decode_image(bytes, ImageFormat::exr, options.map);
    if (!image)
        return with_help(image.error(),
                         "give a latitude-longitude map as an OpenEXR file with the channels R, G and B");
    GOBO_TRY(const auto environment, probe::environment_of(*image, options.map));
    Outcome outcome;
    const auto add = [&](const std::string& name, std::string content) {
        outcome.files.push_back({options.folder + "/" + name, std::move(content)});
        outcome.output += outcome.files.back().path + "\n";
    };
    const auto add_cube = [&](const std::string& name, double exponent, int side) -> Result<void> {
        const Image cube = probe::lobe_map(environment, exponent, side, world.jobs());
        GOBO_TRY(std::string content, encode_image(cube, ImageFormat::exr));
        add(name, std::move(content));
        return {};
    };
    GOBO_TRY_DO(add_cube("diffuse.exr", 1, options.diffuse_size));
    GOBO_TRY_DO(add_cube("specular.exr", options.shininess, options.specular_size));
    if (environment.negatives > 0)
        outcome.diagnostics.push_back(
            note_in(options.map, fmt::format("{} negative radiances, down to {:.3g}, are taken as 0",
                                             environment.negatives, environment.most_negative)));
    add("harmonics.csv", probe::to_csv(probe::project(environment), stem_of(options.map)));
    outcome.summary = fmt::format("{} x {} texels: diffuse {} and specular (shininess {}) {} texels a side",
                                  environment.width, environment.height, options.diffuse_size,
                                  options.shininess, options.specular_size);
    return outcome;
}

}  // namespace

Command probe_command() {
    const auto options = std::make_shared<ProbeOptions>();
    return {titles::kProbe,
            {{"MAP", "MAP.exr", "A latitude-longitude map, twice as wide as high: an OpenEXR file",
              &options->map, kRequired},
             {"-o,--output", "DIR", "Folder for diffuse.exr, specular.exr and harmonics.csv",
              &options->folder, kRequired},
             {"--shininess", "X", "Exponent of the highlight that the specular map is for",
              &options->shininess, between(1, 1e6)},
             {"--diffuse-size", "N", "Texels along a side of the diffuse cube map", &options->diffuse_size,
              between(1, 1024)},
             {"--specular-size", "N", "Texels along a side of the specular cube map", &options->specular_size,
              between(1, 1024)}},
            {},
            "  gobo probe studio.exr -o studio\n"
            "  gobo probe night.exr -o night --shininess 200 --specular-size 128",
            [options](const World& world) { return run(*options, world); },
            "Prints the paths of the files. A cube map is one picture, its faces +x -x +y -y +z -z one below "
            "the other. docs/probes.md says what the numbers mean."};
}

}  // namespace gobo
