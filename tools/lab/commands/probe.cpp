// gobo probe: light-probe maps and spherical-harmonic coefficients from an HDR map of an environment.
#include <fmt/format.h>

#include "lab/commands/commands.hpp"
#include "lab/probe/convolution.hpp"
#include "lab/render/image_file.hpp"

namespace gobo {
namespace {

struct ProbeOptions {
    CommonOptions common;
    std::string map;
    std::string folder;
    double shininess = 48;
    int diffuse_size = 32;
    int specular_size = 64;
};

/// The map, read and checked.
Result<probe::Environment> read_environment(const World& world, const std::string& path) {
    const Result<std::string> bytes = world.disk.read(path);
    if (!bytes) return tl::unexpected(bytes.error());
    const Result<Image> image = decode_image(*bytes, ImageFormat::exr, path);
    if (!image) {
        Diagnostics why = image.error();
        for (Diagnostic& diagnostic : why)
            diagnostic.help = "give a latitude-longitude map as an OpenEXR file with the channels R, G and B";
        return tl::unexpected(std::move(why));
    }
    return probe::environment_of(*image, path);
}

/// "studio" of "maps/studio.exr".
std::string stem_of(const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name.substr(0, name.rfind('.'));
}

Outcome run(const ProbeOptions& options, const World& world) {
    const auto environment = read_environment(world, options.map);
    if (!environment) return failed(environment.error());
    Outcome outcome;
    const auto add = [&](const std::string& name, const Result<bool>& written) {
        if (written)
            outcome.output += fmt::format("{}/{}\n", options.folder, name);
        else
            outcome.diagnostics.insert(outcome.diagnostics.end(), written.error().begin(),
                                       written.error().end());
    };
    const auto add_cube = [&](const std::string& name, double exponent, int side) {
        const probe::Lobe lobe(*environment, exponent);
        const Image cube = probe::make_cube_map(
            side, options.common.jobs, [&](const glm::dvec3& direction) { return lobe.around(direction); });
        add(name, write_image(world.disk, options.folder + "/" + name, cube));
    };
    add_cube("diffuse.exr", 1, options.diffuse_size);
    add_cube("specular.exr", options.shininess, options.specular_size);
    if (environment->negatives > 0) {
        Diagnostic note;
        note.severity = Severity::note;
        note.place.file = options.map;
        note.message = fmt::format("{} negative radiances, down to {:.3g}, are taken as 0",
                                   environment->negatives, environment->most_negative);
        outcome.diagnostics.push_back(std::move(note));
    }
    const std::string csv = probe::to_csv(probe::project(*environment), stem_of(options.map));
    add("harmonics.csv", world.disk.write(options.folder + "/harmonics.csv", csv));
    outcome.summary = fmt::format("{} x {} texels: diffuse {} and specular (shininess {}) {} texels a side",
                                  environment->width, environment->height, options.diffuse_size,
                                  options.shininess, options.specular_size);
    return outcome;
}

}  // namespace

Command probe_command(CLI::App& gobo) {
    auto options = std::make_shared<ProbeOptions>();
    CLI::App* app =
        gobo.add_subcommand("probe", "Light-probe maps and harmonics from an HDR map of an environment");
    app->add_option("MAP", options->map, "A latitude-longitude map, twice as wide as high: an OpenEXR file")
        ->type_name("MAP.exr")
        ->required();
    app->add_option("-o,--output", options->folder, "Folder for diffuse.exr, specular.exr and harmonics.csv")
        ->type_name("DIR")
        ->required();
    app->add_option("--shininess", options->shininess,
                    "Exponent of the highlight that the specular map is for")
        ->check(CLI::Range(1.0, 1e6))
        ->capture_default_str();
    app->add_option("--diffuse-size", options->diffuse_size, "Texels along a side of the diffuse cube map")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app->add_option("--specular-size", options->specular_size, "Texels along a side of the specular cube map")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    add_common_options(*app, options->common);
    app->footer(
        "Prints the paths of the files. A cube map is one picture, its faces +x -x +y -y +z -z one below the "
        "other.\n"
        "docs/probes.md tells what the numbers mean.\n\n"
        "Examples:\n"
        "  gobo probe studio.exr -o studio\n"
        "  gobo probe night.exr -o night --shininess 200 --specular-size 128");
    return {app, [options](const World& world) { return run(*options, world); }};
}

}  // namespace gobo
