#include "scene_support.hpp"

#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene/read_scene.hpp"

namespace gobo::scene {
namespace {

std::string word_bytes(std::uint32_t word) {
    std::string bytes(4, '\0');
    std::memcpy(bytes.data(), &word, 4);
    return bytes;
}

constexpr std::string_view quad_text = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
  "scene": 0,
  "scenes": [{"nodes": [0, 1, 2]}],
  "nodes": [
    {"name": "quad", "mesh": 0},
    {"name": "lamp", "translation": [0, 0, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "camera", "translation": [0, 0, 5], "camera": 0}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
  "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.5}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
  "animations": [],
  "skins": [],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
    {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
    {"bufferView": 2, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}],
  "bufferViews": [
    {"buffer": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 12},
    {"buffer": 0, "byteOffset": 60, "byteLength": 32}],
  "buffers": [{"byteLength": 92, "uri": "quad.bin"}]
})";

}  // namespace

std::string float_bytes(std::initializer_list<float> numbers) {
    std::string bytes(4 * numbers.size(), '\0');
    std::memcpy(bytes.data(), numbers.begin(), bytes.size());
    return bytes;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string quad_buffer() {
    std::string bytes = float_bytes({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    for (const char index : {0, 1, 2, 0, 2, 3}) {
        bytes += index;
        bytes += '\0';
    }
    return bytes + float_bytes({0, 1}) + float_bytes({0, 0, 0, 0, 0, -10});
}

nlohmann::json quad_scene() {
    return nlohmann::json::parse(quad_text);
}

std::string put(std::string_view path, std::string_view value) {
    return R"([{"op": "add", "path": ")" + std::string(path) + R"(", "value": )" + std::string(value) + "}]";
}

std::string take(std::string_view path) {
    return R"([{"op": "remove", "path": ")" + std::string(path) + R"("}])";
}

std::string instanced(std::string_view attributes) {
    return put("/nodes/0/extensions",
               fmt::format(R"({{"EXT_mesh_gpu_instancing": {{"attributes": {}}}}})", attributes));
}

nlohmann::json patched_scene(std::string_view patch) {
    return quad_scene().patch(nlohmann::json::parse(patch));
}

Result<Scene> read_json(const nlohmann::json& json) {
    const MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"quad.gltf", json.dump()}, {"quad.bin", quad_buffer()}});
    return read_scene(files, "quad.gltf");
}

Scene read_patched(std::string_view patch) {
    Result<Scene> scene = read_json(patched_scene(patch));
    EXPECT_TRUE(scene) << to_text(scene.error().front());
    return scene ? std::move(*scene) : Scene();
}

std::string container_of(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto size = static_cast<std::uint32_t>(28 + json.size() + binary.size());
    return "glTF" + word_bytes(2) + word_bytes(size) + word_bytes(static_cast<std::uint32_t>(json.size())) +
           "JSON" + json + word_bytes(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) +
           binary;
}

}  // namespace gobo::scene
