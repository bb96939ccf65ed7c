// What gobo render --environment shows of metals: a panorama blurred by roughness, by as much light as the
// table of the environment BRDF says.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "lab/probe/environment.hpp"
#include "lab/raster/shared_textures.hpp"
#include "lab/render/image.hpp"
#include "lab/render/texture.hpp"

namespace gobo::scene {
namespace {

constexpr int kPixels = 65;

/// A white metal plate of the given roughness that faces the viewer, with room behind nothing else.
std::string plate(double roughness, const std::string& extras) {
    return fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
"nodes": [{{"mesh": 0}}, {{"camera": 0, "translation": [0, 0, 1]}}],
"cameras": [{{"type": "perspective", "perspective": {{"yfov": 1.5, "znear": 0.1, "zfar": 10}}}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "NORMAL": 1}}, "material": 0}}]}}],
"materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 1, "roughnessFactor": {}}}{}}}],
"buffers": [{{"uri": "plate.bin", "byteLength": 144}}],
"bufferViews": [{{"buffer": 0, "byteLength": 72}}, {{"buffer": 0, "byteOffset": 72, "byteLength": 72}}],
"accessors": [
{{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-2, -2, 0], "max": [2, 2, 0]}},
{{"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC3"}}]}})",
                       roughness, extras);
}

std::string plate_vertices() {
    constexpr float kVertices[] = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, -2, 0, 2, 2, 0, -2, 2, 0,
                                   0,  0,  1, 0, 0,  1, 0, 0, 1, 0,  0,  1, 0, 0, 1, 0,  0, 1};
    std::string bytes(sizeof(kVertices), '\0');
    std::memcpy(bytes.data(), kVertices, sizeof(kVertices));
    return bytes;
}

class PlatePictures : public testing::Test {
  protected:
    /// The middle row of the plate's picture, red, from left to right.
    std::vector<float> row(double roughness, const std::string& extras, const std::string& environment) {
        EXPECT_TRUE(files_.write(folder_ + "/plate.gltf", plate(roughness, extras)));
        EXPECT_TRUE(files_.write(folder_ + "/plate.bin", plate_vertices()));
        run("render pbr --scene plate.gltf --format exr --size " + fmt::format("{0}x{0}", kPixels) +
            " -o . --environment " + environment);
        const auto picture = read_image(files_, folder_ + "/plate.exr");
        EXPECT_TRUE(picture) << files_.read(folder_ + "/log").value();
        std::vector<float> values;
        for (int x = 0; picture && x < kPixels; ++x) values.push_back(picture->at(x, kPixels / 2, 0));
        return values;
    }

    void run(const std::string& arguments) const {
        const std::string command =
            fmt::format("cd '{}' && '{}/gobo' {} > log 2>&1", folder_, GOBO_PROGRAM_FOLDER, arguments);
        EXPECT_EQ(std::system(command.c_str()), 0) << files_.read(folder_ + "/log").value();
    }

    void write_panorama(const std::function<float(int column)>& radiance) {
        Image image(256, 128, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int channel = 0; channel < 3; ++channel) image.at(x, y, channel) = radiance(x);
        EXPECT_TRUE(write_image(files_, folder_ + "/panorama.exr", image));
    }

    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    DiskFileSystem files_;
    std::string folder_ =
        testing::TempDir() + "gobo_plate_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

/// The largest step between neighbours, in parts of all that the row spans.
double sharpness(const std::vector<float>& row) {
    double step = 0;
    for (std::size_t i = 1; i < row.size(); ++i)
        step = std::max(step, static_cast<double>(std::abs(row[i] - row[i - 1])));
    const auto [least, most] = std::ranges::minmax(row);
    return step / static_cast<double>(most - least);
}

/// A fade to grey keeps the edge as sharp as it was.
TEST_F(PlatePictures, RoughMetalsBlurAPanorama) {
    write_panorama([](int column) { return column < 128 ? 1.0F : 0.0F; });
    const double smooth = sharpness(row(0, "", "panorama.exr"));
    const double satin = sharpness(row(0.4, "", "panorama.exr"));
    const double rough = sharpness(row(0.8, "", "panorama.exr"));
    EXPECT_GT(smooth, 0.3);
    EXPECT_LT(satin, 0.5 * smooth);
    EXPECT_LT(rough, 0.5 * satin);
}

TEST_F(PlatePictures, AFolderIsOneLobeWhichIsTold) {
    write_panorama([](int column) { return column < 128 ? 1.0F : 0.0F; });
    run("probe panorama.exr -o probes --diffuse-size 4 --specular-size 8");
    (void)row(0.4, "", "probes");
    const std::string warning =
        "probes/specular.exr: warning: it is mirrored equally sharp by surfaces of every roughness\n"
        "  help: give --environment the latitude-longitude map that it was made from, FILE.exr\n";
    const auto told = [&] {
        return files_.read(folder_ + "/log").value().find(warning) != std::string::npos;
    };
    EXPECT_TRUE(told());
    for (const char* backend : {"osmesa", "vulkan"}) {
        run(fmt::format(
            "render pbr --key 'reflection=image' -o . --environment probes --size 8x8 --backend {}",
            backend));
        EXPECT_TRUE(told()) << backend;
    }
}

/// The demonstration mesh of a key, too: across the middle of a sphere that mirrors stripes.
TEST_F(PlatePictures, KeysBlurAPanoramaByRoughness) {
    write_panorama([](int column) { return column / 16 % 2 == 0 ? 1.0F : 0.0F; });
    const std::string shipped = files_.read(GOBO_SOURCE_DIR "/templates/pbr.toml").value();
    const std::string stated = R"("Material.roughness"           = 0.35)";
    ASSERT_NE(shipped.find(stated), std::string::npos);
    for (const char* backend : {"osmesa", "vulkan"}) {
        const auto steepest_at = [&](double roughness) {
            std::string family = shipped;
            family.replace(family.find(stated), stated.size(),
                           fmt::format("\"Material.roughness\" = {}", roughness));
            EXPECT_TRUE(files_.write(folder_ + "/metal.toml", family));
            run(
                fmt::format("render metal.toml --key 'reflection=image ambient=image' --mesh sphere --format "
                            "exr --size {0}x{0} -o {1} --environment panorama.exr --backend {1}",
                            kPixels, backend));
            const auto picture =
                read_image(files_, folder_ + "/" + backend + "/ambient-image+reflection-image.exr");
            EXPECT_TRUE(picture);
            float step = 0;
            for (int x = 25; picture && x < 40; ++x)
                step = std::max(
                    step, std::abs(picture->at(x, kPixels / 2, 0) - picture->at(x - 1, kPixels / 2, 0)));
            return step;
        };
        const float smooth = steepest_at(0);
        EXPECT_GT(smooth, 0.2F) << backend;
        EXPECT_LT(steepest_at(0.8), 0.2F * smooth) << backend;
    }
}

/// Head on: what stripes give, in parts of what a world of radiance 1 does.
TEST_F(PlatePictures, ScenesLookUpTheLevelOfTheirRoughness) {
    const auto stripes = [](int column) {
        return 0.5F + 0.5F * std::cos(0.0982F * static_cast<float>(column));
    };
    write_panorama(stripes);
    const auto panorama = read_image(files_, folder_ + "/panorama.exr");
    ASSERT_TRUE(panorama);
    const auto environment = probe::environment_of(*panorama, "panorama.exr");
    ASSERT_TRUE(environment);
    const auto levels = raster::colors_of_cube(probe::roughness_maps(*environment, 64, kRoughnessLevels, 2));
    for (const double roughness : {0.0, 0.25, 0.4, 0.75}) {
        evaluate::ImageRequest request;
        request.coordinates = {0, 0, 1};
        request.dimensions = 3;
        request.lod = roughness * (kRoughnessLevels - 1);
        write_panorama(stripes);
        const float striped = row(roughness, "", "panorama.exr").at(kPixels / 2);
        write_panorama([](int) { return 1.0F; });
        const float even = row(roughness, "", "panorama.exr").at(kPixels / 2);
        EXPECT_NEAR(striped / even, levels(request)[0], 0.005) << roughness;
    }
}

/// Head on, in a world of radiance 1: A + B of the integral.
TEST_F(PlatePictures, ATableHoldsTheEnvironmentBrdf) {
    write_panorama([](int) { return 1.0F; });
    for (const auto& [roughness, expected] :
         {std::pair(0.0, 1.0), std::pair(0.2, 0.997), std::pair(0.5, 0.916), std::pair(1.0, 0.307)}) {
        const auto values = row(
            roughness, R"(, "extras": {"gobo": {"quality": {"environment_brdf": "table"}}})", "panorama.exr");
        EXPECT_NEAR(values.at(kPixels / 2), expected, 0.02) << roughness;
    }
}

}  // namespace
}  // namespace gobo::scene
