// The manifest and the depfile.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

TEST(Manifest, SaysWhatWasBuilt) {
    const sample::Built built = sample::lit();
    const auto manifest = nlohmann::json::parse(emit_manifest(built.input()));
    EXPECT_EQ(manifest["family"], "lit");
    EXPECT_EQ(manifest["dialect"], "450");
    EXPECT_EQ(manifest["features"][2],
              nlohmann::json::parse(R"({"name": "fog", "role": "effect", "kind": "choice",
        "values": ["none", "linear", "exponential"]})"));
    ASSERT_EQ(manifest["permutations"].size(), 5U);
    EXPECT_EQ(manifest["permutations"][0]["key"], "default");
    const auto& permutation = manifest["permutations"][3];
    EXPECT_EQ(permutation["key"], "fog=linear point=3 shading=vertex");
    const auto& fragment = manifest["stages"][permutation["fragment"].get<std::size_t>()];
    EXPECT_EQ(fragment["stage"], "fragment");
    std::vector<std::string> pieces;
    for (const auto& number : fragment["pieces"])
        pieces.push_back(manifest["pieces"][number.get<std::size_t>()]);
    EXPECT_EQ(pieces, (std::vector<std::string>{"shader_lib/common.glsl",
                                                "piece of fog=linear point=3 shading=vertex"}));
    EXPECT_EQ(manifest["interface"]["blocks"][1]["name"], "Fog");
    EXPECT_EQ(manifest["interface"]["outputs"][0]["location"], 0) << "as in the header";
}

TEST(Manifest, OfAFamilyWithoutFeatures) {
    const sample::Built built = sample::bare();
    const auto manifest = nlohmann::json::parse(emit_manifest(built.input()));
    EXPECT_EQ(manifest["features"], nlohmann::json::array());
    EXPECT_EQ(manifest["permutations"][0]["key"], "default");
}

TEST(Depfile, NamesEachFileOnce) {
    EXPECT_EQ(emit_depfile({"out/lit.hpp", "out/lit.json"}, {"lit.toml", "fog/linear.glsl", "lit.toml"}),
              "out/lit.hpp out/lit.json: \\\n  lit.toml \\\n  fog/linear.glsl\n");
    EXPECT_EQ(emit_depfile({"out/lit.hpp"}, {}), "out/lit.hpp:\n");
}

TEST(Depfile, EscapesWhatMakeWouldRead) {
    EXPECT_EQ(emit_depfile({"a b.hpp"}, {"c#d", "$HOME/e", "back\\slash", "odd\\ name"}),
              "a\\ b.hpp: \\\n  c\\#d \\\n  $$HOME/e \\\n  back\\slash \\\n  odd\\\\\\ name\n");
}

}  // namespace
}  // namespace gobo
