// An application of three generated headers. emit_compile_test.cpp generates them, compiles this file as
// C++17 and C++20 with every warning an error, and runs it: it prints what fails.
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bare.hpp"
#include "expectations.hpp"
#include "lit.hpp"
#include "nasty.hpp"

namespace {

template <class Stage>
std::string text_of(const Stage& stage) {
    std::string text;
    stage.for_each_piece([&text](std::string_view piece) { text += piece; });
    return text;
}

// What is constant is so at compile time.
static_assert(lit::canonical(lit::Key{}) == lit::Key{});
static_assert(lit::find(lit::Key{}) != nullptr);
static_assert(lit::find(lit::Key{})->key() == lit::Key{});
static_assert(lit::Fog_block::binding == 3);
static_assert(lit::PointLights::bytes(0) == 16 && lit::PointLights::bytes(3) == 160);
static_assert(sizeof(lit::PointLights) == lit::PointLights::size);
static_assert(lit::attribute::position == 0 && lit::output::fragmentColor == 0 &&
              lit::sampler::shadowMaps == 4);
static_assert(std::is_standard_layout_v<lit::PointLights> && std::is_trivially_copyable_v<lit::PointLights>);
static_assert(std::is_same_v<std::underlying_type_t<lit::Shading>, std::uint8_t>);

lit::Key example() {
    lit::Key key;
    key.shading = lit::Shading::vertex;
    key.fog = lit::Fog::linear;
    key.point = 3;
    return key;
}

void test_find() {
    const lit::Permutation* found = lit::find(example());
    expect(found != nullptr && found->key() == example(), "a built key is found");
    if (found == nullptr) return;
    expect_text(text_of(found->fragment),
                "// shared\nfloat half() { return 0.5; }\n// fog=linear point=3 shading=vertex\n"
                "\"quoted\" \\ )gobo\" )gobo2\"\n");
    expect_text(found->vertex.source(), "// shared\nfloat half() { return 0.5; }\nvoid main() {}\n");
    expect(found->vertex.piece_count() == 2, "two pieces");
    expect_text(std::string(found->vertex.piece(1).name), "lit.vert");
    expect(found->vertex == lit::find(lit::Key{})->vertex, "equal stages are one");
    expect(found->fragment != lit::find(lit::Key{})->fragment, "different stages are two");
    for (const lit::Permutation& permutation : lit::permutations) {
        expect(lit::find(permutation.key()) == &permutation, "every permutation is found by its key");
    }
}

void test_canonical() {
    lit::Key key;
    key.fog_distance = lit::FogDistance::planar;
    key.specular = lit::Specular::blinn;
    expect(lit::canonical(key) == lit::Key{}, "what cannot matter stands at its default");
    expect(lit::find(key) == lit::find(lit::Key{}), "find() canonicalises");
    key.fog = lit::Fog::exponential;
    expect(lit::canonical(key).fog_distance == lit::FogDistance::planar, "what matters is kept");
}

void test_out_of_range() {
    lit::Key key;
    key.point = 9;
    expect(lit::find(key) == nullptr, "a count above its range is not found");
    expect_text(lit::describe_missing(key), "point=9 is out of range: 0 to 8");
    key.point = -1;
    expect(lit::find(key) == nullptr, "nor a negative one");
    key.point = 2147483647;
    expect(lit::canonical(key) == key, "canonical() leaves what is out of range");
    key = {};
    key.fog_distance =
        static_cast<lit::FogDistance>(77);  // would be the default, were it canonicalised first
    expect(lit::find(key) == nullptr, "no permutation stands in for a value that does not exist");
    expect_text(lit::describe_missing(key), "fog_distance=77 is out of range: 0 to 1");
}

void test_describe_missing() {
    expect_text(lit::describe_missing(example()), "");
    lit::Key key = example();
    key.point = 4;
    key.specular = lit::Specular::phong;
    expect(lit::find(key) == nullptr, "a key that was not built is not found");
    expect_text(
        lit::describe_missing(key),
        "fog=linear point=4 shading=vertex specular=phong was not built; the nearest that was: fog=linear "
        "point=3 shading=vertex (differs in point, specular); to build it, add KEYS \"fog=linear point=4 "
        "shading=vertex specular=phong\"");
    key.shading = lit::Shading::hybrid;
    key.point = 8;
    key.directional = 7;
    expect_text(
        lit::describe_missing(key),
        "directional=7 fog=linear point=8 shading=hybrid specular=phong is refused: more than the 60 varying "
        "components that OpenGL guarantees");
    expect_text(lit::key_text(lit::Key{}), "default");
    expect_text(lit::key_text(example()), "fog=linear point=3 shading=vertex");
}

void test_blocks() {
    lit::PointLights lights{};
    lights.lights[2].position = glm::vec4(1.0F, 2.0F, 3.0F, 1.0F);
    lights.lights[2].enabled = true;
    std::vector<std::byte> buffer(lit::PointLights::bytes(3));
    std::memcpy(buffer.data(), &lights, buffer.size());
    float y = 0;
    std::memcpy(&y, buffer.data() + 16 + 2 * 48 + 4, sizeof y);
    expect(y == 2.0F, "a light stands where std140 puts it");
    lit::Camera camera{};
    camera.projection = glm::mat4(2.0F);
    camera.normalMatrix = glm::mat3(1, 2, 3, 4, 5, 6, 7, 8, 9);
    float column = 0;
    std::memcpy(&column, reinterpret_cast<const std::byte*>(&camera) + 64 + 16, sizeof column);
    expect(column == 4.0F, "a column of a mat3 starts at 16 bytes");
    expect(glm::mat3(camera.normalMatrix)[2].z == 9.0F, "and comes back");
    expect(lit::blocks.size() == 3 && lit::blocks[1].name == "Fog" && lit::blocks[1].binding == 3,
           "table of blocks");
    expect(lit::uniforms[0].name == "exposure" && lit::uniforms[0].location == -1, "table of uniforms");
}

void test_nasty_names() {
    nasty::Key key;
    expect(nasty::find(key) != nullptr, "the default key");
    key.switch_ = nasty::Switch::default_;
    key.default_ = true;
    key.int_ = 5;
    expect(nasty::find(key) != nullptr, "keywords");
    expect_text(nasty::key_text(key), "default=on int=5 switch=default");
    key.switch_ = nasty::Switch::int_;  // turns default off, and that int
    expect(nasty::canonical(key) == nasty::Key{}, "rules are applied until nothing changes");
    key = {};
    key.z10 = 15;
    key.z29 = 7;
    key._2d = nasty::_2d_::_8x;
    expect(nasty::find(key) == nullptr, "`_8x` and `8x` are two values");
    key._2d = nasty::_2d_::_8x_;
    expect(nasty::find(key) != nullptr && nasty::find(key)->key() == key, "a key wider than 64 bits");
    key.z28 = 1;
    expect(nasty::find(key) == nullptr, "the second word counts");
    key.switch_ = nasty::Switch::requires_;
    key.key = nasty::Key_3::co_await_;
    expect_text(nasty::describe_missing(key).substr(nasty::key_text(key).size()),
                " is refused: because \"quoted\" \\ \t odd \?\?/");
}

void test_nasty_texts() {
    const nasty::Permutation& permutation = *nasty::find(nasty::Key{});
    std::string expected = "// shared\nfloat half() { return 0.5; }\n";
    for (int line = 3; line < 3003; ++line)
        expected += "// line " + std::to_string(line) + " of a long file\n";
    const std::string odd("bytes \x01 \xC3\xA9 \0 \?\?/ end without a line end", 39);
    expect(text_of(permutation.vertex) == expected + odd, "a long file and odd bytes come through");
    int lines = 1;
    permutation.vertex.for_each_piece(
        [](std::string_view text) { expect(text.size() < 16380, "a short literal"); });
    for (int position = 0; position + 1 < permutation.vertex.piece_count(); ++position) {
        const auto& piece = permutation.vertex.piece(position);
        expect(piece.name == "shader_lib/common.glsl" && piece.first_line == lines,
               "a part of the long file");
        for (const char character : piece.text) lines += character == '\n' ? 1 : 0;
    }
}

void test_nasty_blocks() {
    nasty::std140_block block{};
    block.weights[1] = 0.5F;
    block.pairs[1][2] = glm::vec2(3, 4);
    block.rows = glm::mat3x2(1, 2, 3, 4, 5, 6);
    block.square = glm::mat4(1.0F);
    block.flags[2] = true;
    block.outer.inner[1].switch_ = 7.0F;
    const auto number_at = [&block](std::size_t offset) {
        float number = 0;
        std::memcpy(&number, reinterpret_cast<const std::byte*>(&block) + offset, sizeof number);
        return number;
    };
    expect(number_at(16) == 0.5F, "an array of float has a stride of 16");
    expect(number_at(48 + 5 * 16 + 4) == 4.0F, "an array of arrays of vec2 too");
    expect(number_at(240) == 1.0F && number_at(244) == 3.0F && number_at(256) == 2.0F,
           "row_major transposes");
    expect(glm::mat3x2(block.rows) == glm::mat3x2(1, 2, 3, 4, 5, 6), "and comes back");
    expect(number_at(400 + 64 + 48) == 7.0F, "a struct within an array within a struct");
    expect(float(block.weights[1]) == 0.5F && block.flags[2], "elements read as plain values");
    expect(sizeof(nasty::Lights) == 32 && nasty::Lights{}.binding_.x == 0 && nasty::Lights{}.size_ == 0,
           "renamed");
    expect(nasty::default_block::binding == 1 && nasty::key_block::binding == 7, "stated bindings");
    expect(nasty::Lights::binding == 0 && nasty::std140_block::binding == 2, "the lowest free bindings");
    expect(nasty::attribute::bones == 0 && nasty::attribute::auto_ == 4, "a mat4 takes four locations");
    expect(nasty::sampler::int_ == 0 && nasty::sampler::register_ == 4,
           "an array of samplers takes its units");
}

void test_uniform_names() {
    const char* const names[] = {"lamp.tint", "lamps[0].tint", "lamps[1].tint", "table[0]", "table[1]"};
    const int locations[] = {-1, 3, 5, -1, -1};
    expect(nasty::uniforms.size() == 5, "five uniforms");
    for (std::size_t index = 0; index < nasty::uniforms.size(); ++index) {
        expect_text(std::string(nasty::uniforms[index].name), names[index]);
        expect(nasty::uniforms[index].location == locations[index], "its location");
    }
    expect(nasty::uniforms[1].count == 2 && nasty::uniforms[4].count == 3,
           "arrays of plain values are one uniform");
}

void test_check() {
    lit::Fog_block fog{};
    expect(lit::check(fog).empty(), "a block within its ranges");
    fog.near_ = fog.far_ = 1e6F;
    expect(lit::check(fog).empty(), "the ends of a range are within it");
    fog.near_ = -1.0F;
    expect(lit::check(fog).size() == 1, "a number below its range");
    expect_text(gobo::to_text(lit::check(fog).front()), "Fog.near is -1, allowed is [0, 1000000]");
    fog.near_ = std::numeric_limits<float>::quiet_NaN();
    expect(lit::check(fog).size() == 2, "a NaN is within no range and in no order");
    fog.near_ = 2.0F;
    fog.far_ = 1.0F;
    expect(lit::check(fog).size() == 1, "two members out of their order");
    expect_text(gobo::to_text(lit::check(fog).front()), "Fog.near is 2, allowed is <= Fog.far");

    lit::PointLights lights{};
    expect(lit::check(lights).empty(), "a number beside the range that is allowed");
    lights.lights[2].attenuation = glm::vec3(1, 11, 0.0001F);
    const std::vector<gobo::OutOfRange> found = lit::check(lights);
    expect(found.size() == 2, "each component counts");
    expect_text(found.front().member, "PointLights.lights[2].attenuation.y");
    expect(found.front().value == 11.0, "its value");
    expect_text(found.front().allowed, "[0.001, 10], or 0");
    expect_text(found.back().member, "PointLights.lights[2].attenuation.z");
    expect(lit::check(lights, 2).empty(), "elements that are not used are not looked at");
    lights.lights[0].attenuation.x = 0.001F;  // not 0.001 exactly
    expect(lit::check(lights, 1).empty(), "bounds are compared as the member holds them");
    lights.lights[0].attenuation = glm::vec3(3, 3, 3);
    expect(lit::check(lights, 1).size() == 1, "a component with a range of its own");
    expect_text(gobo::to_text(lit::check(lights, 1).front()),
                "PointLights.lights[0].attenuation.x is 3, allowed is [0.001, 2], or 0");
    expect(lit::check(lit::Camera{}).empty(), "a block without ranges");
    expect(nasty::check(nasty::Lights{}).empty(), "names that were changed");

    nasty::std140_block block{};
    block.weights[1] = 2.0F;
    block.outer.inner[1].switch_ = 3.0F;
    block.rows = glm::mat3x2(0, 0, 0, 9, 0, 0);
    const std::vector<gobo::OutOfRange> more = nasty::check(block);
    expect(more.size() == 3, "arrays, structs and matrices");
    if (more.size() == 3) {
        expect_text(more[0].member, "std140.weights[1]");
        expect_text(more[1].member, "std140.rows[1].y");
        expect_text(more[2].member, "std140.outer.inner[1].switch");
    }
    block.outer.Inner_ = glm::vec2(3, 4);
    expect(nasty::check(block).size() == 4, "a length");
    expect_text(gobo::to_text(nasty::check(block).back()),
                "std140.outer.Inner is 5, allowed is a length in [0, 4]");
}

void test_bare() {
    expect(bare::find(bare::Key{}) == bare::permutations.data(), "a family without features has one key");
    expect_text(bare::key_text(bare::Key{}), "default");
}

}  // namespace

int main() {
    test_find();
    test_canonical();
    test_out_of_range();
    test_describe_missing();
    test_blocks();
    test_nasty_names();
    test_nasty_texts();
    test_nasty_blocks();
    test_uniform_names();
    test_check();
    test_bare();
    return failures == 0 ? 0 : 1;
}
