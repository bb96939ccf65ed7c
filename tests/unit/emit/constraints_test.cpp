// check() of a generated header: what of blocks breaks the constraints of the family, within one and between
// two.
#include "constraints.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gobo {
namespace {

using namespace ::constraints;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Blocks {
    Camera camera{};
    Fog fog{};
    Lamps lamps{};
    Object object{};

    /// All that every check() finds, a line each.
    [[nodiscard]] std::string found(int count = 3) const {
        std::string text;
        const auto add = [&](const std::vector<OutOfRange>& list) {
            for (const OutOfRange& one : list) text += to_text(one) + "\n";
        };
        add(check(camera));
        add(check(fog));
        add(check(lamps, count));
        add(check(object));
        add(check(camera, fog));
        add(check(camera, lamps, count));
        add(check(camera, object));
        return text;
    }
};

/// Those that keep every constraint.
Blocks kept() {
    Blocks blocks;
    const glm::mat4 model = glm::scale(glm::rotate(glm::mat4(1), 0.7F, {1, 2, 3}), {2, 0.5F, 3});
    blocks.camera.view = glm::mat4(1);
    blocks.camera.normals = glm::inverseTranspose(glm::mat3(model));
    blocks.camera.eye = glm::vec3(0, 0, 5);
    blocks.camera.far_ = 100;
    blocks.fog.color = glm::vec3(0.2F, 0.3F, 0.4F);
    blocks.fog.near_ = 1;
    blocks.fog.far_ = 100;
    blocks.fog.density = 0.05F;
    blocks.fog.steps = 4;
    blocks.lamps.center = glm::vec4(0, 0, 0, 1);
    blocks.lamps.reach[0] = blocks.lamps.reach[1] = 2.0F;
    blocks.lamps.least = 1;
    for (Lamp& lamp : blocks.lamps.lamps) {
        lamp.position = glm::vec3(0, 2, 0);
        lamp.axis = glm::normalize(glm::vec3(1, -3, 2));
        lamp.inner = 0.1F;
        lamp.outer = 0.2F;
    }
    blocks.object.model = model;
    blocks.object.normals = blocks.camera.normals;
    blocks.object.turn = glm::mat3(glm::rotate(glm::mat4(1), 0.3F, {3, 1, 2}));
    return blocks;
}

struct Row {
    const char* name;
    std::function<void(Blocks&)> change;
    const char* found;
};

class CheckedConstraints : public testing::TestWithParam<Row> {};

TEST_P(CheckedConstraints, AreToldWhereTheyAreBroken) {
    Blocks blocks = kept();
    GetParam().change(blocks);
    EXPECT_EQ(blocks.found(), GetParam().found);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, CheckedConstraints,
    testing::Values(
        Row{"none", [](Blocks&) {}, ""},
        Row{"an_order", [](Blocks& blocks) { blocks.fog.near_ = 100; },
            "Fog.near is 100, allowed is < Fog.far\n"},
        Row{"components_of_one_vector", [](Blocks& blocks) { blocks.fog.color.x = 0.5F; },
            "Fog.color.r is 0.5, allowed is <= Fog.color.b\n"},
        Row{"a_least_number", [](Blocks& blocks) { blocks.fog.density = 0.04F; },
            "Fog.density is 0.04, allowed is >= 0.05\n"},
        Row{"a_number_that_is_never_reached", [](Blocks& blocks) { blocks.fog.density = 2; },
            "Fog.density is 2, allowed is < 2\n"},
        Row{"a_number_that_is_nearly_reached",
            [](Blocks& blocks) { blocks.fog.density = std::nextafter(2.0F, 0.0F); },
            "Fog.density is 1.9999999, allowed is < 2 by 1e-06\n"},
        Row{"a_whole_number", [](Blocks& blocks) { blocks.fog.steps = 3; },
            "Fog.steps is 3, allowed is > 3\n"},
        Row{"each_of_a_vector", [](Blocks& blocks) { blocks.fog.tint.y = 0.5F; },
            "Fog.tint.y is 0.5, allowed is != 0.5\n"},
        Row{"a_zero_vector", [](Blocks& blocks) { blocks.fog.color = glm::vec3(0); },
            "Fog.color is 0, allowed is a length above 0\n"},
        Row{"a_nan_before_other_components",
            [](Blocks& blocks) {
                blocks.fog.color = {0.1F, kNan, 1};
            },
            "Fog.color is nan, allowed is a length above 0\n"},
        Row{"an_infinite_vector",
            [](Blocks& blocks) {
                blocks.fog.color = {0.1F, -kInfinity, 1};
            },
            "Fog.color is inf, allowed is a finite length above 0\n"},
        Row{"a_nan_in_a_distance",
            [](Blocks& blocks) {
                blocks.lamps.lamps[0].position = {kNan, 5, 2};
            },
            "Lamps.lamps[0].position is nan, allowed is a distance above 0 from Lamps.center\n"
            "Camera.eye is nan, allowed is a distance above 0 from Lamps.lamps[0].position\n"},
        Row{"an_infinite_direction",
            [](Blocks& blocks) {
                blocks.lamps.lamps[1].axis = {0, kInfinity, 0};
            },
            "Lamps.lamps[1].axis is inf, allowed is a length of 1\n"},
        Row{"a_component_of_a_matrix", [](Blocks& blocks) { blocks.camera.view[1].y = 2e6F; },
            "Camera.view[1].y is 2000000, allowed is [-1000000, 1000000]\n"},
        Row{"a_range_of_an_element", [](Blocks& blocks) { blocks.lamps.lamps[2].outer = 4; },
            "Lamps.lamps[2].outer is 4, allowed is [0, 3.2]\n"},
        Row{"a_nan", [](Blocks& blocks) { blocks.fog.density = -kNan; },
            "Fog.density is nan, allowed is < 2\nFog.density is nan, allowed is >= 0.05\n"},
        Row{"a_direction_of_an_element",
            [](Blocks& blocks) { blocks.lamps.lamps[1].axis = glm::vec3(0, 2, 0); },
            "Lamps.lamps[1].axis is 2, allowed is a length of 1\n"},
        Row{"an_order_within_an_element", [](Blocks& blocks) { blocks.lamps.lamps[2].inner = 0.2F; },
            "Lamps.lamps[2].inner is 0.2, allowed is < Lamps.lamps[2].outer\n"},
        Row{"vectors_of_two_sizes", [](Blocks& blocks) { blocks.lamps.lamps[0].position = glm::vec3(0); },
            "Lamps.lamps[0].position is 0, allowed is a distance above 0 from Lamps.center\n"},
        Row{"an_element_and_a_number", [](Blocks& blocks) { blocks.lamps.reach[1] = 1.0F; },
            "Lamps.least is 1, allowed is < Lamps.reach[1]\n"},
        Row{"a_column_that_is_too_long",
            [](Blocks& blocks) { blocks.object.turn = glm::mat3(1, 0, 0, 0, 2, 0, 0, 0, 1); },
            "Object.turn[1] is 2, allowed is a length of 1\n"},
        Row{"columns_that_are_not_perpendicular",
            [](Blocks& blocks) { blocks.object.turn = glm::mat3(1, 0, 0, 0, 1, 0, 0.6F, 0, 0.8F); },
            "Object.turn[2] is 0.6, allowed is a dot product of 0 with Object.turn[0]\n"},
        Row{"the_model_matrix_for_normals",
            [](Blocks& blocks) {
                blocks.object.model = glm::scale(glm::mat4(1), {2, 1, 1});
                blocks.camera.normals = glm::mat3(0.5F, 0, 0, 0, 1, 0, 0, 0, 1);
                blocks.object.normals = glm::mat3(blocks.object.model);
            },
            "Object.normals[0].x is 2, allowed is 0.5 for the inverse transpose of Object.model\n"},
        Row{"a_model_without_an_inverse",
            [](Blocks& blocks) {
                blocks.object.model = glm::scale(glm::mat4(1), {1, 1, 0});
            },
            "determinant of Object.model is 0, allowed is a size above 1e-06 of the cube of the matrix's "
            "largest "
            "number\n"
            "determinant of Object.model is 0, allowed is a size above 1e-06 of the cube of the matrix's "
            "largest "
            "number\n"},
        Row{"a_matrix_of_another_block", [](Blocks& blocks) { blocks.camera.normals[1].z += 0.5F; },
            "Camera.normals[1].z is 1.0459127, allowed is 0.545913 for the inverse transpose of "
            "Object.model\n"},
        Row{"an_order_between_blocks", [](Blocks& blocks) { blocks.camera.far_ = 50; },
            "Fog.far is 100, allowed is <= Camera.far\n"},
        Row{"a_lamp_at_the_eye", [](Blocks& blocks) { blocks.lamps.lamps[2].position = blocks.camera.eye; },
            "Camera.eye is 0, allowed is a distance above 0 from Lamps.lamps[2].position\n"}),
    [](const auto& row) { return row.param.name; });

TEST(ConstraintChecks, OfElementsThatAreNotUsedAreNotLookedAt) {
    Blocks blocks = kept();
    blocks.lamps.lamps[2] = {};
    blocks.lamps.lamps[2].position = blocks.camera.eye;
    EXPECT_EQ(blocks.found(2), "");
    EXPECT_NE(blocks.found(3), "");
}

/// What stands behind the array keeps neither ranges nor constraints.
TEST(ConstraintChecks, LookAtNothingBehindAnArray) {
    struct {
        Lamps lamps = kept().lamps;
        float behind[64];
    } memory;
    std::fill(std::begin(memory.behind), std::end(memory.behind), 7.0F);
    EXPECT_EQ(check(memory.lamps, 5).size(), 0U);
    EXPECT_EQ(check(kept().camera, memory.lamps, 5).size(), 0U);
}

TEST(ConstraintChecks, PrintTheShortestTextThatReadsBack) {
    const auto text_of = [](double value, bool is_single) { return to_text({"A.x", value, "1", is_single}); };
    EXPECT_EQ(text_of(4000000001.0, false), "A.x is 4000000001, allowed is 1");
    EXPECT_EQ(text_of(2147483647.0, false), "A.x is 2147483647, allowed is 1");
    EXPECT_EQ(text_of(4294967296.0, false), "A.x is 4294967296, allowed is 1");
    EXPECT_EQ(text_of(10000000001.0, false), "A.x is 10000000001, allowed is 1");
    EXPECT_EQ(text_of(0.1, false), "A.x is 0.1, allowed is 1");
    EXPECT_EQ(text_of(0.1 + 0.2, false), "A.x is 0.30000000000000004, allowed is 1");
    EXPECT_EQ(text_of(0.04F, false), "A.x is 0.03999999910593033, allowed is 1");
    EXPECT_EQ(text_of(0.04F, true), "A.x is 0.04, allowed is 1");
    EXPECT_EQ(text_of(16777216.0, true), "A.x is 16777216, allowed is 1");
    EXPECT_EQ(text_of(1e20F, true), "A.x is 1e+20, allowed is 1");
    EXPECT_EQ(text_of(0.999999978, true), "A.x is 0.999999978, allowed is 1");
    EXPECT_EQ(text_of(-kInfinity, true), "A.x is -inf, allowed is 1");
    EXPECT_EQ(text_of(-static_cast<double>(kNan), false), "A.x is nan, allowed is 1");

    std::vector<OutOfRange> found;
    runtime::check_bound(found, runtime::operand("A.n", {}, 4000000001U), "<", 4000000001.0);
    runtime::check_bound(found, runtime::operand("A.f", {}, 3.5F), "<", 0.1);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(to_text(found[0]), "A.n is 4000000001, allowed is < 4000000001");
    EXPECT_EQ(to_text(found[1]), "A.f is 3.5, allowed is < 0.1");
}

/// Of every matrix, whatever its shape.
TEST(ConstraintChecks, NameColumnAndComponent) {
    std::vector<OutOfRange> found;
    const runtime::Range range{0, 1, false, {}, "[0, 1]"};
    runtime::check_member(found, "A.m", {}, std140::PlainMatrix<2, 2, float>(glm::mat2(0, 0, 2, 0)), range);
    runtime::check_member(found, "A.w[]", {3},
                          std140::PlainMatrix<2, 3, float>(glm::mat2x3(0, 0, 0, 0, 0, 2)), range);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].member, "A.m[1].x");
    EXPECT_EQ(found[1].member, "A.w[3][1].z");
}

TEST(ConstraintChecks, OfValuesInNoBlockAreToldToo) {
    EXPECT_TRUE(is_unit(glm::vec3(0.6F, 0, 0.8F)));
    EXPECT_FALSE(is_unit(glm::vec3(0.6F, 0, 0.7F)));
    EXPECT_TRUE(is_orthonormal(glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1)));
    EXPECT_FALSE(is_orthonormal(glm::mat3(1, 1, 0, 1, 0, 0, 0, 0, 1)));
    EXPECT_TRUE(is_inverse_transpose(glm::mat3(0.5F), glm::mat4(2)));
    EXPECT_FALSE(is_inverse_transpose(glm::mat3(2), glm::mat3(2)));
}

/// Inverse transposes in single precision of models scaled by up to 1 : 100 are within what is allowed.
TEST(ConstraintChecks, AllowWhatSinglePrecisionLoses) {
    float seed = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto next = [&seed] { return std::fmod(seed += 0.6180339887F, 1.0F); };
        const glm::vec3 axis(next() - 0.5F, next() - 0.5F, next() + 0.1F);
        const glm::vec3 scale(std::pow(100.0F, next()), std::pow(100.0F, next()), 1);
        const glm::mat4 turned = glm::rotate(glm::mat4(1), 6.0F * next(), axis);
        const glm::mat4 model = turned * glm::scale(glm::mat4(1), scale) * glm::transpose(turned);
        EXPECT_TRUE(is_inverse_transpose(glm::inverseTranspose(glm::mat3(model)), model)) << i;
    }
}

}  // namespace
}  // namespace gobo
