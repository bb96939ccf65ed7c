// An application that fills arrays of a block, with GLM's own layout or its aligned one.
#include <cstring>
#include <vector>

#include <glm/glm.hpp>

#include "arrays.hpp"
#include "expectations.hpp"

namespace {

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

void test_storage() {
    arrays::Grid grid{};
    grid.cells[3] = 1.0F;
    grid.turn = glm::mat2(1, 2, 3, 4);
    grid.pair.a = glm::vec2(5, 6);
    grid.after = 7.0F;
    grid.on[1] = true;
    grid.pairs[1].a = glm::vec2(8, 9);
    expect(at<float>(grid, 12) == 1.0F && at<float>(grid, 24) == 3.0F && at<float>(grid, 36) == 6.0F,
           "std430");
    expect(at<float>(grid, 40) == 7.0F && at<std::uint32_t>(grid, 48) == 1, "behind a struct of 8 bytes");
    expect(at<float>(grid, 68) == 9.0F && sizeof grid == 72 && arrays::Grid::binding == 3,
           "an array of structs");
    expect(arrays::check(grid).size() == 1, "a storage block has ranges too");
    static_assert(sizeof(arrays::Pair) == 8 && sizeof(arrays::Loose) == 32, "one struct in two layouts");
    arrays::Loose loose{};
    loose.pairs[1].a = glm::vec2(1, 2);
    expect(at<float>(loose, 20) == 2.0F, "the other layout");
}

void test_tails() {
    arrays::Particles head{};
    head.count = 3;
    head.awake = true;
    std::vector<std::byte> buffer(arrays::Particles::bytes(3));
    expect(buffer.size() == 112 && arrays::Particles::size == 16, "bytes of a block with three elements");
    std::memcpy(buffer.data(), &head, arrays::Particles::size);
    const auto particles = arrays::Particles::particles(buffer.data(), buffer.size());
    expect(particles.size() == 3, "as many as fit");
    for (arrays::Particle& particle : particles) particle.position = glm::vec3(1, 2, 3);
    particles[2].fixed = true;
    particles[2].tint = glm::vec2(4, 5);
    expect(at<float>(buffer.front(), 16 + 64 + 8) == 3.0F &&
               at<float>(buffer.front(), 16 + 64 + 20) == 5.0F &&
               at<std::uint32_t>(buffer.front(), 16 + 64 + 24) == 1,
           "elements stand where std430 puts them");
    const std::vector<std::byte>& read = buffer;
    expect(arrays::Particles::particles(read.data(), read.size())[1].position == glm::vec3(1, 2, 3), "read");
    expect(arrays::Particles::particles(read.data(), 47).size() == 0, "none where none fits whole");

    std::vector<std::byte> points(arrays::Samples::bytes(2));
    arrays::Samples::samples(points.data(), points.size())[1] = glm::vec3(1, 2, 3);
    expect(points.size() == 32 && at<float>(points.front(), 24) == 3.0F, "a block of nothing else");
    std::vector<std::byte> rows(arrays::Mixed::bytes(2));
    arrays::Mixed::rest(rows.data(), rows.size())[1][2] = 4.0F;
    expect(rows.size() == 36 && at<float>(rows.front(), 32) == 4.0F, "arrays, at an offset of four bytes");
}

void test_arrays_of_blocks() {
    static_assert(arrays::Shadows::count == 11 && arrays::Shadows::binding == 2);
    for (const gobo::runtime::BlockBinding& block : arrays::blocks) {
        if (block.name == "Shadows[10]")
            expect(block.binding == 12, "the last of the array has the last binding");
        if (block.name == "Shadows[2]") expect(block.binding == 4, "and the third the third");
    }
    expect(arrays::storage_blocks.size() == 5 && arrays::storage_blocks[1].binding == 0, "the lowest free");
}

}  // namespace

int main() {
    test_storage();
    test_tails();
    test_arrays_of_blocks();
    test_elements();
    test_bools();
    test_matrices();
    test_stated_offsets();
    return failures == 0 ? 0 : 1;
}
