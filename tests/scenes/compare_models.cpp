// Scenes of others drawn by OpenGL and by the oracle: two pictures of each, and a line of a table.
//
// usage: compare_models FOLDER WIDTHxHEIGHT FILE...
// Into FOLDER go N.drawn.png and N.oracle.png for the N-th file, from 0. A line: N, pixels inside draws,
// those of them that differ by more than 4 of 255 steps of sRGB, the mean difference in steps, the fragments
// that the oracle was asked about, and the stage's largest difference from it, tab-separated.
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "compare_scene.hpp"

namespace gobo::scene {
namespace {

Result<void> write_pictures(const std::string& stem, Comparison comparison) {
    DiskFileSystem disk;
    for (Image* image : {&comparison.drawn, &comparison.expected})
        for (std::size_t i = 3; i < image->values.size(); i += 4) image->values[i] = 1;
    GOBO_TRY_DO(write_image(disk, stem + ".drawn.png", comparison.drawn));
    GOBO_TRY_DO(write_image(disk, stem + ".oracle.png", comparison.expected));
    return {};
}

int run(const std::vector<std::string>& arguments) {
    int width = 0;
    int height = 0;
    if (arguments.size() < 3 || std::sscanf(arguments[1].c_str(), "%dx%d", &width, &height) != 2) {
        fmt::print(stderr, "usage: compare_models FOLDER WIDTHxHEIGHT FILE...\n");
        return 2;
    }
    const ShippedFamily pbr("pbr");
    const auto studio = Studio::make();
    if (!studio) {
        fmt::print(stderr, "{}", to_text(studio.error()));
        return 3;
    }
    int status = 0;
    for (std::size_t i = 2; i < arguments.size(); ++i) {
        auto comparison = compare_scene(pbr, *studio, arguments[i], width, height);
        const auto written = comparison
                                 ? write_pictures(fmt::format("{}/{}", arguments[0], i - 2), *comparison)
                                 : Result<void>(tl::unexpected(comparison.error()));
        if (!written) {
            fmt::print(stderr, "{}", to_text(written.error()));
            status = 1;
            continue;
        }
        fmt::print("{}\t{}\t{}\t{:.3f}\t{}\t{:.2g}\n", i - 2, comparison->inside, comparison->different,
                   comparison->mean, comparison->asked, comparison->largest);
        static_cast<void>(std::fflush(stdout));
    }
    return status;
}

}  // namespace
}  // namespace gobo::scene

int main(int count, char** arguments) {
    // llvmpipe filters by weights of 8 bits, with one level for four pixels, unless told otherwise.
    setenv("GALLIVM_PERF", "no_aos_sampling,no_quad_lod", 1);
    return gobo::scene::run({arguments + 1, arguments + count});
}
