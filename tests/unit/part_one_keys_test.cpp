// Keys that were written when lit had lights, highlights, toon, fog and depth only still mean the same.
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

Family lit_of_part_one() {
    const std::string path = GOBO_SOURCE_DIR "/tests/assets/part_one/lit.toml";
    return read_family(DiskFileSystem().read(path).value(), path).value();
}

/// The value of a feature in a key, by its name.
std::string value_of(const Family& family, const Key& key, const std::string& feature) {
    for (std::size_t i = 0; i < family.features.size(); ++i)
        if (family.features[i].name == feature)
            return family.features[i].values[static_cast<std::size_t>(key[i])];
    return "no such feature";
}

TEST(PartOneKeys, AreCanonicalAndValidAndMeanTheSame) {
    const Family then = lit_of_part_one();
    const Family now = lit_family();
    Selection selection;
    selection.cover = 3;
    for (const char* dialect : {"450", "330", "es300"}) {
        const std::vector<Key> keys = select(then, selection, dialect).value();
        EXPECT_GT(keys.size(), 100U) << dialect;
        for (const Key& key : keys) {
            const std::string text = key_text(then, key);
            const Result<Key> found = parse_key(now, text);
            ASSERT_TRUE(found) << text;
            EXPECT_EQ(key_text(now, canonical(now, *found, dialect)), text);
            EXPECT_EQ(forbidding_rule(now, *found, dialect), nullptr) << text;
            for (const Feature& feature : then.features)
                EXPECT_EQ(value_of(now, *found, feature.name), value_of(then, key, feature.name)) << text;
        }
    }
}

TEST(PartOneKeys, OfThenAreTakenToTheSameCanonicalForm) {
    const Family then = lit_of_part_one();
    const Family now = lit_family();
    for (const char* text :
         {"specular=blinn", "shading=vertex fog=none fog_distance=planar",
          "diffuse=toon specular=phong spot=1", "point=8 spot=8 directional=8 fog_distance=planar"}) {
        const std::string was = key_text(then, canonical(then, parse_key(then, text).value(), "450"));
        EXPECT_EQ(key_text(now, canonical(now, parse_key(now, text).value(), "450")), was) << text;
    }
}

}  // namespace
}  // namespace gobo
