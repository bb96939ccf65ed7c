// Reflection against an independent witness, spirv-cross, over shaders with every hard layout.
#include "reflect_witness.hpp"

#include <gtest/gtest.h>

#include "reflect/reflect.hpp"
#include "reflect_compile.hpp"
#include "reflect_shaders.hpp"

namespace gobo {
namespace {

class Witnessed : public ::testing::TestWithParam<testing::Shader> {};

TEST_P(Witnessed, AgreesWithSpirvCross) {
    const testing::Compiled compiled = testing::compile(GetParam().stage, source_of(GetParam()));
    ASSERT_EQ(compiled.log, "");
    const Result<Interface> interface = reflect_stage(compiled.spirv);
    ASSERT_TRUE(interface) << to_text(interface.error().front());
    const std::vector<std::string> facts = testing::facts_of(*interface);
    ASSERT_FALSE(facts.empty());
    EXPECT_EQ(facts, testing::facts_of_spirv_cross(compiled.spirv, GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(Blocks, Witnessed, ::testing::ValuesIn(testing::block_shaders),
                         [](const auto& row) { return row.param.name; });
INSTANTIATE_TEST_SUITE_P(Others, Witnessed, ::testing::ValuesIn(testing::other_shaders),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
