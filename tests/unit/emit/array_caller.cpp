// An application that fills arrays of a block, with GLM's own layout or its aligned one.
#include <cstdio>
#include <cstring>

#include <glm/glm.hpp>

#include "arrays.hpp"

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::printf("failed: %s\n", what);
    ++failures;
}

template <class Number, class Block>
Number at(const Block& block, std::size_t offset) {
    Number number{};
    std::memcpy(&number, reinterpret_cast<const std::byte*>(&block) + offset, sizeof number);
    return number;
}

void test_elements() {
    arrays::Arrays block{};
    block.taps[1] = glm::vec2(3, 4);
    block.order[3] = 7;
    block.weights[1] = 2;
    block.offsets[1] = glm::vec3(1, 2, 3);
    block.point = glm::vec3(4, 5, 6);
    const glm::vec2 tap = block.taps[1];
    const glm::vec3 offset = block.offsets[1];
    const glm::vec3 point = block.point;
    const float weight = block.weights[1];
    expect(at<float>(block, 20) == 4.0F && tap == glm::vec2(3, 4), "vec2[3]");
    expect(at<std::uint32_t>(block, 96) == 7 && block.order[3] == 7U, "uint[4]");
    expect(at<float>(block, 128) == 2.0F && weight == 2.0F, "float[2]");
    expect(at<float>(block, 248) == 3.0F && offset.z == 3.0F, "vec3[2]");
    expect(at<float>(block, 472) == 6.0F && point.z == 6.0F, "vec3");
    block.taps[2] = block.taps[1];
    expect(at<float>(block, 36) == 4.0F, "one element from another");
}

void test_bools() {
    arrays::Arrays block{};
    block.on[2] = true;
    block.lit = block.on[2];
    const bool is_on = block.on[2];
    block.on[1] = block.lit;
    block.masks[1] = glm::bvec3(false, true, true);
    block.mask = glm::bvec2(true, false);
    const glm::bvec3 mask = block.masks[1];
    expect(at<std::uint32_t>(block, 176) == 1 && is_on && block.on[2] == true, "bool[3]");
    expect(at<std::uint32_t>(block, 160) == 1 && block.lit, "a bool from an element and back");
    expect(at<std::uint32_t>(block, 216) == 1 && mask.z && !mask.x, "bvec3[2]");
    expect(at<std::uint32_t>(block, 456) == 1 && block.mask[0] && !block.mask[1], "bvec2");
    block.mask = {false, true};
    expect(glm::bvec2(block.mask) == glm::bvec2(false, true), "bvec2 from two");
    expect(block.on[0] ? false : true, "as a condition");
    expect(arrays::check(block).empty(), "bools are numbers 0 and 1");
}

void test_matrices() {
    arrays::Arrays block{};
    const glm::mat3 turn(1, 2, 3, 4, 5, 6, 7, 8, 9);
    block.turn = turn;
    block.rows = turn;
    block.turns[1] = turn;
    const glm::mat3 back = block.turn;
    const glm::mat3 rows = block.rows;
    const glm::mat3 element = block.turns[1];
    const glm::vec3 column = block.turn[2];
    expect(at<float>(block, 256 + 16) == 4.0F && back == turn, "mat3");
    expect(at<float>(block, 304 + 16) == 2.0F && rows == turn, "row-major mat3");
    expect(at<float>(block, 352 + 48 + 32) == 7.0F && element == turn, "mat3[2]");
    expect(column == glm::vec3(7, 8, 9), "a column");
}

void test_stated_offsets() {
    arrays::Order order{};
    order.early = 1.0F;
    order.late = 2.0F;
    expect(at<float>(order, 4) == 1.0F && at<float>(order, 8) == 2.0F && sizeof order == 16, "offsets");
}

}  // namespace

int main() {
    test_elements();
    test_bools();
    test_matrices();
    test_stated_offsets();
    return failures == 0 ? 0 : 1;
}
