// Reading family files: every table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;

TEST(ReadFamily, ReadsEveryTable) {
    const Family family = read_family(R"toml(name     = "tiny"
vertex   = "tiny.vert"
fragment = "tiny.frag"

[features.fog]
role    = "quality"
values  = ["none", "linear", "old"]
excluded = ["old"]
[features.bump]
define = "USE_BUMP"
[features.point]
role     = "pipeline"
count    = [0, 2]
constant = "POINT_LIGHTS"

[[rules]]
when    = "point == 0"
default = ["bump", "fog"]
[[rules]]
forbid   = "fog == linear"
reason   = "too slow"
dialects = ["330", "es300"]

[varyings.eyeNormal]
location      = 1
type          = "vec3"
interpolation = "flat"
piece         = "surface/normal.glsl"
value         = "surfaceNormal()"
[varyings.eyePosition]
location = 0
type     = "vec3"
value    = "vec3(0.0)"

[domain]
"Fog.near"   = [0, 1e6]
"normal"     = { length = [0.5, 2], also = [0] }
"Fog.colour" = { range = [-1, 1] }

[render]
uModel   = "model"
uColor   = [1, 0.5, 0]
uShine   = 8
"sun.to" = { source = "eye_direction", numbers = [0, 1, 0] }

[default_set]
keys  = ["point=1"]
cover = 2
over  = ["fog"]
where = "point < 2"
)toml",
                                      "some/folder/tiny.toml", {})
                              .value();
    EXPECT_EQ(family.name, "tiny");
    EXPECT_EQ(family.programs.front()[StageKind::vertex], std::vector<std::string>{"tiny.vert"});
    EXPECT_EQ(family.programs.front()[StageKind::fragment], std::vector<std::string>{"tiny.frag"});

    ASSERT_EQ(family.features.size(), 3u) << "sorted by name";
    EXPECT_EQ(family.features[0].name, "bump");
    EXPECT_EQ(family.features[0].kind, FeatureKind::define);
    EXPECT_EQ(family.features[0].macro, "USE_BUMP");
    EXPECT_THAT(family.features[0].values, ElementsAre("off", "on"));
    EXPECT_EQ(family.features[0].role, Role::effect);
    EXPECT_EQ(family.features[1].role, Role::quality);
    EXPECT_THAT(family.features[1].values, ElementsAre("none", "linear", "old"));
    EXPECT_THAT(family.features[1].excluded, ElementsAre("old"));
    EXPECT_EQ(family.features[2].role, Role::pipeline);
    EXPECT_EQ(family.features[2].macro, "POINT_LIGHTS");
    EXPECT_THAT(family.features[2].values, ElementsAre("0", "1", "2"));

    ASSERT_EQ(family.rules.size(), 2u);
    EXPECT_EQ(family.rules[0].kind, Rule::Kind::defaults);
    EXPECT_THAT(family.rules[0].defaults, ElementsAre(0, 1));
    EXPECT_EQ(family.rules[0].place.line, 16);
    EXPECT_EQ(family.rules[1].kind, Rule::Kind::forbid);
    EXPECT_EQ(family.rules[1].reason, "too slow");
    EXPECT_THAT(family.rules[1].dialects, ElementsAre("330", "es300"));

    ASSERT_EQ(family.varyings.size(), 2u) << "sorted by location";
    EXPECT_EQ(family.varyings[0].name, "eyePosition");
    EXPECT_EQ(family.varyings[1].interpolation, "flat");
    EXPECT_EQ(family.varyings[1].piece, "surface/normal.glsl");
    EXPECT_EQ(family.varyings[1].value, "surfaceNormal()");

    ASSERT_EQ(family.domains.size(), 3u);
    EXPECT_EQ(family.domains[1].name, "Fog.near");
    EXPECT_EQ(family.domains[1].high, 1e6);
    EXPECT_TRUE(family.domains[2].of_length);
    EXPECT_THAT(family.domains[2].also, ElementsAre(0.0));

    ASSERT_EQ(family.render.size(), 4u);
    EXPECT_EQ(family.render[0].name, "sun.to");
    EXPECT_EQ(family.render[0].source, "eye_direction");
    EXPECT_THAT(family.render[1].numbers, ElementsAre(1, 0.5, 0));
    EXPECT_EQ(family.render[2].source, "model");
    EXPECT_THAT(family.render[3].numbers, ElementsAre(8));

    ASSERT_TRUE(family.default_selection);
    ASSERT_EQ(family.default_selection->keys.size(), 1u);
    EXPECT_EQ(family.default_selection->keys.front().text, "point=1");
    EXPECT_EQ(family.default_selection->cover, 2);
    EXPECT_THAT(family.default_selection->over, ElementsAre("fog"));
    EXPECT_EQ(family.default_selection->where, "point < 2");
}

TEST(ReadFamily, PutsAnExplicitDefaultFirstAndKeepsTheOrderOfTheList) {
    const Family family = read_family(
                              "name = \"tiny\"\nvertex = \"v\"\nfragment = \"f\"\n"
                              "[features.sum]\nrole = \"quality\"\n"
                              "values = [\"exact\", \"good\", \"plain\", \"poor\"]\n"
                              "default = \"plain\"\n",
                              "tiny.toml", {})
                              .value();
    const Feature& sum = family.features[0];
    EXPECT_THAT(sum.values, ElementsAre("plain", "exact", "good", "poor"));
    EXPECT_EQ(sum.default_place, 2);
    EXPECT_EQ(key_text(family, {0}), "default");
    EXPECT_EQ(key_text(family, {2}), "sum=good");
}

// What a family leaves out stands still in the rules that it keeps, each as it must come out.
TEST(ReadFamily, KeepsRulesOfWhatIsLeftOut) {
    constexpr const char* kBase = R"toml(name     = "base"
vertex   = "base.vert"
fragment = "base.frag"
[features.fog]
values = ["none", "thin", "thick"]
[features.shine]
values = ["none", "blinn"]
[features.lamp]
count    = [0, 4]
constant = "LAMPS"
[features.star]
count    = [0, 4]
constant = "STARS"
[[rules]]
when    = "shine == none"   # never
default = ["fog"]
[[rules]]
when    = "shine == blinn && star == 0"   # star == 0
default = ["fog", "shine"]
[[rules]]
when    = "fog == thick"   # nothing is left to stand at its default
default = ["shine"]
[[rules]]
forbid = "lamp + star > 3"   # star > 1
reason = "too many"
[[rules]]
forbid = "star > lamp || fog == thick"   # star > 2 || fog == thick
reason = "too thick"
[domain]
"Shine.power" = [0, 1]
"Lamps[].color" = [0, 1]
[[relations]]
off = "shine"
at  = { "Shine.power" = 0 }
[[relations]]
any_order = "Stars"
when      = "shine == blinn && lamp == 2"
[[relations]]
any_order = "Lamps"
)toml";
    const Family family = read_family(R"toml(name    = "over"
extends = "base"
without = ["shine=blinn", "lamp=2", "Lamps", "Shine"]
[features.fog]
values  = ["thickest"]
default = "thick"
)toml",
                                      "over.toml",
                                      [&](const std::string&) -> Result<FamilyText> {
                                          return FamilyText{kBase, "base.toml"};
                                      })
                              .value();
    ASSERT_EQ(family.features.size(), 2U);
    EXPECT_THAT(family.features[0].values, ElementsAre("thick", "none", "thin", "thickest"));
    EXPECT_TRUE(family.domains.empty());
    ASSERT_EQ(family.rules.size(), 3U);
    const auto which = [&](const Expression& condition) {
        std::string text;
        for (int fog = 0; fog < 4; ++fog)
            for (int star = 0; star < 5; ++star) text += holds(condition, {fog, star}) ? 'x' : '.';
        return text;
    };
    EXPECT_EQ(which(family.rules[0].when), "x....x....x....x....");
    EXPECT_THAT(family.rules[0].defaults, ElementsAre(0));
    EXPECT_EQ(which(family.rules[1].when), "..xxx..xxx..xxx..xxx");
    EXPECT_EQ(which(family.rules[2].when), "xxxxx...xx...xx...xx");
    ASSERT_EQ(family.relations.size(), 1U);
    EXPECT_THAT(family.relations[0].names, ElementsAre("Stars"));
    EXPECT_EQ(which(*family.relations[0].when), "xxxxxxxxxxxxxxxxxxxx");
}

}  // namespace
}  // namespace gobo
