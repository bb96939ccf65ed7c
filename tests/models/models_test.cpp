// The page of models says what was measured, and refuses what it could not show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page.hpp"

namespace gobo::models {
namespace {

using testing::HasSubstr;

const Model kFog = {"F1", "linear fog", "lit", "fog=linear", "fog == linear", {"fog.glsl"}};

/// Three permutations, two of which have linear fog.
std::map<std::string, Figures> figures() {
    return {{"lit",
             {"lit",
              {{"fog=linear", 100, 1e-7, 2e-16},
               {"fog=linear point=1", 11, 3e-8, 4.04e-16},
               {"point=1", 7, 1, 1}}}}};
}

/// The page of one model, or why there is none.
std::string page_of(const Model& model) {
    const DiskFileSystem disk;
    const Result<std::string> page = models_page(disk, GOBO_SOURCE_DIR, {model}, figures());
    return page ? *page : to_text(page.error().front());
}

TEST(ModelsPage, GivesTheLargestErrorsOfAllPermutationsThatHaveTheModel) {
    EXPECT_THAT(
        page_of(kFog),
        HasSubstr("| F1 | linear fog | `lit: fog=linear` | [fog.glsl](../shader_lib/fog.glsl) | "
                  "![F1](pictures/models/F1.png) | 1.0e-07 | 4.0e-16 | 111 points, 2 permutations |\n"));
}

TEST(ModelsPage, RefusesWhatItCannotShow) {
    struct Row {
        const char* name;
        Model model;
        const char* message;
    };
    for (const Row& row : {
             Row{"a key without the model",
                 {"F1", "", "lit", "point=1", "fog == linear", {"fog.glsl"}},
                 "F1: 'point=1' has not the model"},
             Row{"no pieces", {"F1", "", "lit", "fog=linear", "fog == linear", {}}, "F1: no pieces say it"},
             Row{"a piece that the example has not",
                 {"F1", "", "lit", "fog=linear", "fog == linear", {"fog.glsl", "spot.glsl"}},
                 "F1: the example has no piece of 'spot.glsl'"},
             Row{"nothing measured",
                 {"F3", "", "lit", "fog=exponential_squared", "fog == exponential_squared", {"fog.glsl"}},
                 "F3: no measured permutation has it"},
             Row{"an unknown value",
                 {"F1", "", "lit", "fog=murk", "fog == linear", {"fog.glsl"}},
                 "feature 'fog' has no value 'murk'"},
             Row{"a family without figures",
                 {"F1", "", "uber", "fog=linear", "fog == linear", {"fog.glsl"}},
                 "F1: no figures of the family 'uber' were given"},
         })
        EXPECT_THAT(page_of(row.model), HasSubstr(row.message)) << row.name;
}

TEST(Catalogue, KeepsTheOrderOfItsFile) {
    const auto models = read_catalogue(
        "[S2]\ntitle=\"a\"\nkey=\"b\"\nwhere=\"c\"\npieces=[\"p.glsl\"]\n[S10]\ntitle=\"d\"\nkey="
        "\"e\"\nwhere=\"f\"\n[L1]\ntitle="
        "\"\"\nkey=\"\"\nwhere=\"\"\n",
        "m.toml");
    ASSERT_TRUE(models);
    ASSERT_EQ(models->size(), 3U);
    EXPECT_EQ((*models)[0].id, "S2");
    EXPECT_EQ((*models)[0].pieces, std::vector<std::string>{"p.glsl"});
    EXPECT_EQ((*models)[1].id, "S10");
    EXPECT_EQ((*models)[1].key, "e");
    EXPECT_EQ((*models)[2].id, "L1");
}

TEST(Catalogue, HasEveryModelOnce) {
    const DiskFileSystem disk;
    const auto models =
        read_catalogue(disk.read(GOBO_SOURCE_DIR "/docs/models.toml").value(), "docs/models.toml");
    ASSERT_TRUE(models) << to_text(models.error().front());
    std::vector<std::string> wanted;
    for (const auto& [letter, count] : {std::pair('L', 9), std::pair('S', 17), std::pair('E', 4),
                                        std::pair('F', 4), std::pair('D', 6), std::pair('P', 15)})
        for (int i = 1; i <= count; ++i) wanted.push_back(letter + std::to_string(i));
    std::vector<std::string> found;
    for (const Model& model : *models) found.push_back(model.id);
    EXPECT_EQ(found, wanted);
}

TEST(Staleness, IsADifferentWordOrAnErrorThatMovedByMoreThanATenth) {
    const std::string page = "| S3 | 3.1e-07 | 12 points |";
    struct Row {
        const char* name;
        const char* other;
        bool same;
    };
    for (const Row& row : {Row{"the same", "| S3 | 3.1e-07 | 12 points |", true},
                           Row{"a rounding apart", "| S3 | 3.2e-07 | 12 points |", true},
                           Row{"grown", "| S3 | 3.6e-07 | 12 points |", false},
                           Row{"another power", "| S3 | 3.1e-06 | 12 points |", false},
                           Row{"fewer points", "| S3 | 3.1e-07 | 11 points |", false},
                           Row{"another word", "| S3 | 3.1e-07 | 12 dots |", false},
                           Row{"a row more", "| S3 | 3.1e-07 | 12 points || 1.0e-07", false}})
        EXPECT_EQ(say_the_same(page, row.other), row.same) << row.name;
}

}  // namespace
}  // namespace gobo::models
