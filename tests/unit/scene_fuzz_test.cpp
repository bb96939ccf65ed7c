// Broken files of every kind: whatever is changed in a scene, it is read or refused with one clear error,
// soon.
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file_system.hpp"
#include "lab/scene_picture/posed_mesh.hpp"
#include "scene/effects.hpp"
#include "scene/read_scene.hpp"

namespace gobo::scene {
namespace {

using json = nlohmann::json;
using Content = std::map<std::string, std::string, std::less<>>;

constexpr int tries = 1000;  ///< of each seed
/// Processor time of one try. The largest takes 0.05 s; an endless loop, or one over the square of a number
/// that the file states, takes for ever.
constexpr double most_seconds = 5;

const std::string folder = GOBO_SOURCE_DIR "/tests/assets/scenes/";

/// Numbers at the ends of what types hold, and others that files should not state.
const std::vector<json> nasty = {nullptr,
                                 true,
                                 false,
                                 -1,
                                 0,
                                 1,
                                 2,
                                 3,
                                 7,
                                 255,
                                 256,
                                 65535,
                                 65536,
                                 2147483647,
                                 -2147483648LL,
                                 4294967295LL,
                                 1e18,
                                 1e300,
                                 -1e300,
                                 1e-320,
                                 0.5,
                                 5120,
                                 5126,
                                 "",
                                 "VEC3",
                                 "MAT4",
                                 "SCALAR",
                                 "none",
                                 "a.bin",
                                 json::array(),
                                 json::array({0, 1, 2}),
                                 json::array({1e300, 1e300, 1e300, 1e300}),
                                 json::object(),
                                 json::array({json::array({json::array()})})};

struct Seed {
    const char* name;
    const char* file;
    std::vector<const char*> beside;  ///< other files that it names
};

void PrintTo(const Seed& seed, std::ostream* stream) {
    *stream << seed.name;
}

class Mutator {
  public:
    explicit Mutator(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t count) {
        return count == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    /// Changes one to four bytes, cuts the end off, or repeats a part.
    void change_bytes(std::string& bytes) {
        if (bytes.empty()) return;
        const std::size_t at = below(bytes.size());
        switch (below(4)) {
            case 0:
                bytes.resize(at);
                return;
            case 1:
                bytes.insert(at, bytes.substr(below(bytes.size()), below(64)));
                return;
            default:
                for (std::size_t i = 0; i <= below(4); ++i)
                    bytes[below(bytes.size())] = static_cast<char>(below(256));
        }
    }

    /// Changes one value anywhere in the document, or takes it away, or puts another of its values there.
    void change_value(json& document) {
        const json whole = document.flatten();
        const std::string path = path_in(whole);
        // A prefix of a leaf's path names an object or an array.
        std::string cut = path;
        for (std::size_t up = below(3); up > 0 && cut.rfind('/') != 0; --up) cut.resize(cut.rfind('/'));
        const json::json_pointer place(cut);
        switch (below(6)) {
            case 0: {
                json& parent = document[place.parent_pointer()];
                if (parent.is_object()) parent.erase(place.back());
                if (parent.is_array()) parent.erase(parent.begin());
                return;
            }
            case 1:
                document[place] = document.at(json::json_pointer(path_in(whole)));
                return;
            case 2:
                if (document[place].is_array()) {
                    const json copy = document[place];
                    document[place].insert(document[place].end(), copy.begin(), copy.end());
                    return;
                }
                [[fallthrough]];
            default:
                document[place] = nasty[below(nasty.size())];
        }
    }

  private:
    std::string path_in(const json& flat) {
        auto at = flat.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(flat.size())));
        return at.key();
    }

    std::mt19937 random_;
};

/// The JSON of a container, and what follows it.
struct Parts {
    std::string json;
    std::string rest;
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i > 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
    return word;
}

std::string word_bytes(std::size_t word) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> 8 * i & 0xFF);
    return bytes;
}

Parts parts_of(const std::string& file) {
    if (!file.starts_with("glTF")) return {file, ""};
    const std::size_t length = word_at(file, 12);
    return {file.substr(20, length), file.substr(20 + length)};
}

std::string join(const Parts& parts, bool is_container) {
    if (!is_container) return parts.json;
    std::string text = parts.json;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return "glTF" + word_bytes(2) + word_bytes(20 + text.size() + parts.rest.size()) +
           word_bytes(text.size()) + "JSON" + text + parts.rest;
}

/// The files after some changes.
Content changed(Content files, const std::string& file, Mutator& mutator) {
    if (mutator.below(4) == 0) {  // bytes, of any of the files
        auto at = files.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(mutator.below(files.size())));
        mutator.change_bytes(at->second);
        return files;
    }
    const bool is_container = files[file].starts_with("glTF");
    Parts parts = parts_of(files[file]);
    json document = json::parse(parts.json);
    const std::size_t changes = 1 + mutator.below(3);
    for (std::size_t i = 0; i < changes && document.is_structured() && !document.empty(); ++i)
        mutator.change_value(document);
    parts.json = document.dump(-1, ' ', false, json::error_handler_t::replace);
    files[file] = join(parts, is_container);
    return files;
}

/// Reads the scene and does with it what gobo does: decides effects, poses meshes. Whether it was read.
bool use(const Content& files, const std::string& file) {
    const MemoryFileSystem disk(files);
    const Result<Scene> scene = read_scene(disk, file);
    if (!scene) {
        EXPECT_EQ(scene.error().size(), 1U);
        EXPECT_FALSE(scene.error().front().message.empty());
        const int status = exit_status(scene.error());
        EXPECT_TRUE(status == 1 || status == 3) << to_text(scene.error().front());
        return false;
    }
    for (const Draw& draw : required_effects(*scene, eye_of_cameras(*scene), {}))
        if (draw.excluded.empty())
            static_cast<void>(posed_mesh(*scene, draw.node, primitive_of(*scene, draw)));
    return true;
}

class Fuzzed : public testing::TestWithParam<Seed> {};

TEST_P(Fuzzed, ScenesAreReadOrRefusedSoon) {
    const DiskFileSystem disk;
    const std::string file = GetParam().file;
    Content files;
    std::vector<std::string> names = {file};
    names.insert(names.end(), GetParam().beside.begin(), GetParam().beside.end());
    for (const std::string& name : names) {
        const Result<std::string> content = disk.read(folder + name);
        ASSERT_TRUE(content) << name;
        files[name] = *content;
    }
    ASSERT_TRUE(use(files, file)) << "the scene itself is in order";
    Mutator mutator(20);
    int read = 0;
    for (int i = 0; i < tries; ++i) {
        SCOPED_TRACE(fmt::format("try {}", i));
        const Content broken = changed(files, file, mutator);
        const std::clock_t begin = std::clock();
        read += use(broken, file) ? 1 : 0;
        const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        ASSERT_LE(seconds, most_seconds);
        ASSERT_FALSE(HasFailure());
    }
    // Some changes are of no concern, most are: both must occur, or the changes show nothing.
    EXPECT_GT(read, tries / 20);
    EXPECT_LT(read, tries * 19 / 20);
}

const Seed seeds[] = {
    {"lights_and_fog", "made/lamp.gltf", {"made/shapes.bin"}},
    {"holes_by_a_picture", "made/leaves.gltf", {"made/colored_shapes.bin"}},
    {"gpu_instances", "made/gpu_instances.gltf", {"made/colored_shapes.bin"}},
    {"morph_targets", "others/AnimatedMorphCube.gltf", {"others/AnimatedMorphCube.bin"}},
    {"skin", "others/simple_skin.gltf", {}},
    {"strips", "others/Mesh_PrimitiveMode_13.gltf", {"others/Mesh_PrimitiveMode_13.bin"}},
    {"container", "others/BoxBadNormals.glb", {}},
    {"cameras", "others/Cameras.gltf", {"others/simpleSquare.bin"}},
};

INSTANTIATE_TEST_SUITE_P(Seeds, Fuzzed, testing::ValuesIn(seeds),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo::scene
