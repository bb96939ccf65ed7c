// The viewer in a window under Xvfb against the viewer without one: the same keys, the same pictures.
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../unit/image_comparison.hpp"
#include "core/file_system.hpp"
#include "lab/render/image.hpp"

namespace gobo {
namespace {

constexpr const char* kScene = GOBO_SOURCE_DIR "/tests/assets/scenes/teapot.gltf";

/// Pictures hold 8 bits a channel. Both are drawn by llvmpipe, through different doors, and may round apart.
constexpr double kOneLevel = 1.5 / 255;

std::string fresh_folder(const std::string& name) {
    const std::string folder = testing::TempDir() + "gobo_viewer_" + name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

int run(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int draw_headless(const std::string& keys, const std::string& folder) {
    return run(
        fmt::format("'{}' '{}' --headless --frames {} --turn 0 --press '{}' --width 320 --height 200 "
                    "--record '{}/viewer.keys' -o '{}' > '{}/log' 2>&1",
                    GOBO_VIEWER, kScene, keys.size() + 1, keys, folder, folder, folder));
}

std::string text_of(const std::string& path) {
    return DiskFileSystem().read(path).value_or("");
}

Image frame(const std::string& folder, int number) {
    const Result<Image> image =
        read_image(DiskFileSystem(), fmt::format("{}/frame_{:03}.png", folder, number));
    EXPECT_TRUE(image) << folder << " has no frame " << number << "\n" << text_of(folder + "/log");
    return image.value_or(Image());
}

double difference(const Image& first, const Image& second) {
    const Result<Comparison> comparison = compare(first, second);
    return comparison ? comparison->root_mean_square : 1;
}

TEST(Viewer, ShowsInAWindowWhatItDrawsWithoutOne) {
    const std::string keys = "ft1s";
    const std::string window = fresh_folder("window");
    const std::string headless = fresh_folder("headless");
    ASSERT_EQ(run(fmt::format("'{}/tests/viewer/press_keys.sh' '{}' '{}' '{}' {}", GOBO_SOURCE_DIR,
                              GOBO_VIEWER, kScene, window, keys)),
              0)
        << text_of(window + "/log") << text_of(window + "/xvfb.log");
    ASSERT_EQ(draw_headless(keys, headless), 0) << text_of(headless + "/log");
    for (int number = 0; number <= static_cast<int>(keys.size()); ++number) {
        const Result<Comparison> comparison = compare(frame(window, number), frame(headless, number));
        ASSERT_TRUE(comparison);
        EXPECT_LE(comparison->percentile_999, kOneLevel) << "frame " << number << "\n"
                                                         << to_text(*comparison);
    }
}

TEST(Viewer, StartsAtTheScenesCamera) {
    const std::string folder = fresh_folder("start");
    ASSERT_EQ(draw_headless("", folder), 0) << text_of(folder + "/log");
    ASSERT_EQ(run(fmt::format("'{}' render --scene '{}' --size 320x200 -o '{}' 2> '{}/render.log'",
                              GOBO_PROGRAM, kScene, folder, folder)),
              0)
        << text_of(folder + "/render.log");
    const Result<Image> rendered = read_image(DiskFileSystem(), folder + "/teapot.png");
    ASSERT_TRUE(rendered);
    const Result<Comparison> comparison = compare(frame(folder, 0), *rendered);
    ASSERT_TRUE(comparison);
    EXPECT_LE(comparison->percentile_999, kOneLevel) << to_text(*comparison);
}

/// The still life, with the shadow that its spot light casts.
TEST(Viewer, DrawsMaterialsOfGltfAsTheyAre) {
    const std::string folder = fresh_folder("physical");
    std::filesystem::copy(GOBO_SOURCE_DIR "/examples/still_life", folder);
    DiskFileSystem disk;
    const std::string log = folder + "/log";
    ASSERT_EQ(
        run(fmt::format("cd '{}' && '{}' still_life.gltf --family pbr --headless --width 320 --height 200 "
                        "-o . > log 2>&1 && '{}' render pbr --scene still_life.gltf --size 320x200 -o . -q",
                        folder, GOBO_VIEWER, GOBO_PROGRAM)),
        0)
        << text_of(log);
    EXPECT_EQ(text_of(log).find("viewer: "), std::string::npos) << text_of(log);
    EXPECT_NE(
        text_of(log).find("\n  ambient=image clearcoat=layer fog=linear point=1 reflection=image spot=1 "
                          "spot_shadows=1\n"),
        std::string::npos)
        << text_of(log);
    const Result<Image> rendered = read_image(disk, folder + "/still_life.png");
    ASSERT_TRUE(rendered);
    const Result<Comparison> comparison = compare(frame(folder, 0), *rendered);
    ASSERT_TRUE(comparison);
    EXPECT_LE(comparison->percentile_999, kOneLevel) << to_text(*comparison);
}

TEST(Viewer, EveryKeyChangesThePicture) {
    const std::string keys = "ft123s";
    const std::string folder = fresh_folder("keys");
    ASSERT_EQ(draw_headless(keys, folder), 0) << text_of(folder + "/log");
    for (int number = 1; number < static_cast<int>(keys.size()); ++number)
        EXPECT_GT(difference(frame(folder, number - 1), frame(folder, number)), 1e-4)
            << "key " << keys[static_cast<std::size_t>(number) - 1];
}

TEST(Viewer, NamesThePermutationOfEachFrame) {
    const std::string folder = fresh_folder("names");
    ASSERT_EQ(draw_headless("f", folder), 0);
    const std::string log = text_of(folder + "/log");
    EXPECT_NE(log.find("\n  directional=1 fog=linear point=1 specular=blinn spot=1\n"), std::string::npos)
        << log;
    EXPECT_NE(log.find("frame 1, fog off: "), std::string::npos) << log;
    EXPECT_NE(log.find("\n  directional=1 point=1 specular=blinn spot=1\n"), std::string::npos) << log;
    EXPECT_FALSE(std::filesystem::exists(folder + "/viewer.keys")) << "nothing was asked for in vain";
}

TEST(Viewer, RecordsWhatWasNotBuilt) {
    const std::string folder = fresh_folder("missing");
    std::string scene = text_of(kScene);
    const std::string linear = "\"linear\"";
    const auto at = scene.find(linear);
    ASSERT_NE(at, std::string::npos);
    scene.replace(at, linear.size(), "\"exponential\"");
    DiskFileSystem disk;
    ASSERT_TRUE(disk.write(folder + "/teapot.gltf", scene));
    std::filesystem::copy(GOBO_SOURCE_DIR "/tests/assets/scenes/teapot.bin", folder + "/teapot.bin");
    EXPECT_EQ(run(fmt::format(
                  "'{0}' '{1}/teapot.gltf' --headless --width 64 --height 64 --record '{1}/viewer.keys' "
                  "> '{1}/log' 2>&1",
                  GOBO_VIEWER, folder)),
              0);
    EXPECT_NE(text_of(folder + "/log")
                  .find("viewer: directional=1 fog=exponential point=1 specular=blinn spot=1 was "
                        "not built; the nearest that was: "),
              std::string::npos)
        << text_of(folder + "/log");
    EXPECT_NE(text_of(folder + "/viewer.keys")
                  .find("directional=1 fog=exponential point=1 specular=blinn spot=1\n"),
              std::string::npos);
}

TEST(Viewer, TakesAPieceThatIsEditedWhileItRuns) {
    const std::string folder = fresh_folder("reload");
    std::filesystem::create_directories(folder + "/library");
    for (const char* part : {"shader_lib", "templates"})
        std::filesystem::copy(fmt::format("{}/{}", GOBO_SOURCE_DIR, part),
                              fmt::format("{}/library/{}", folder, part),
                              std::filesystem::copy_options::recursive);
    // Saves each edit when the frame before is drawn.
    const std::string script = fmt::format(
        R"(cd '{0}' || exit 1
'{1}' watch lit --library library --key 'directional=1 fog=linear point=1 specular=blinn spot=1' --key default -o out --serve reload 2> watched &
watching=$!
trap 'kill $watching' EXIT
for i in $(seq 600); do [ -S reload ] && break; sleep 0.05; done
'{2}' '{3}' --headless --frames 4 --turn 0 --width 160 --height 100 --record keys --reload reload -o . > log 2>&1 &
viewing=$!
frame() {{ for i in $(seq 1200); do grep -q "^frame $1" log && return; sleep 0.05; done; exit 1; }}
frame 0
sed -i 's/clamp(ahead \/ depth, 0.0, 1.0)/0.25 * clamp(ahead \/ depth, 0.0, 1.0)/' library/shader_lib/fog.glsl
frame 1
sed -i 's/0.25 [*] clamp/missing * clamp/' library/shader_lib/fog.glsl
frame 2
sed -i 's/missing [*] clamp/clamp/' library/shader_lib/fog.glsl
wait $viewing)",
        folder, GOBO_PROGRAM, GOBO_VIEWER, kScene);
    DiskFileSystem disk;
    ASSERT_TRUE(disk.write(folder + "/edit.sh", script));
    ASSERT_EQ(run(fmt::format("bash '{}/edit.sh'", folder)), 0)
        << text_of(folder + "/log") << text_of(folder + "/watched");
    const std::string log = text_of(folder + "/log");
    EXPECT_NE(log.find("frame 1, 1 program changed: "), std::string::npos) << log;
    EXPECT_NE(log.find("frame 2, errors: "), std::string::npos) << log;
    EXPECT_NE(log.find("fog.glsl:22: error: 'missing' : undeclared"), std::string::npos) << log;
    EXPECT_GT(difference(frame(folder, 0), frame(folder, 1)), 1e-2);
    EXPECT_EQ(difference(frame(folder, 1), frame(folder, 2)), 0) << "the old program stays";
    EXPECT_EQ(difference(frame(folder, 0), frame(folder, 3)), 0)
        << "and is as it was when the edit is undone";
}

}  // namespace
}  // namespace gobo
