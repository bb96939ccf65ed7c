// Composing in memory: which pieces, in which order, with which prologue.
#include "compose/compose.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "family/key.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using Files = std::map<std::string, std::string, std::less<>>;

const char* const features =
    "[features]\nfog = { values = [\"none\", \"linear\"] }\npoint = { count = [0, 3], constant = \"POINTS\" "
    "}\n"
    "bump = { define = \"USE_BUMP\" }\n";

/// Names of the pieces of one stage of a key, and its source.
struct Composed {
    std::vector<std::string> names;
    std::string source;
};

class Compose : public testing::Test {
  protected:
    Result<Composition> all_of(const std::vector<std::string>& keys, Dialect dialect = Dialect::glsl450,
                               Comments comments = Comments::remove) {
        const MemoryFileSystem disk(files);
        SearchPath search;
        for (const std::string& folder : folders)
            search.add(disk, folder, folder.empty() ? "" : folder + "/", !folder.empty());
        const Family family = family_of(body);
        std::vector<Key> read;
        for (const std::string& text : keys) read.push_back(parse_key(family, text).value());
        return compose(family, read, search, dialect, comments);
    }

    Composed stage(const std::string& key, StageKind kind, Dialect dialect = Dialect::glsl450) {
        const Composition composition = all_of({key}, dialect).value();
        const Permutation& permutation = composition.permutations.front();
        const int index = permutation.stages[kind];
        const Stage& found = composition.stages.at(static_cast<std::size_t>(index));
        Composed composed{{}, source_of(composition, found)};
        for (const int piece : found.pieces)
            composed.names.push_back(composition.pieces.at(static_cast<std::size_t>(piece)).name);
        return composed;
    }
    Composed fragment(const std::string& key) { return stage(key, StageKind::fragment); }
    Composed vertex(const std::string& key) { return stage(key, StageKind::vertex); }

    std::string first_error(const std::string& key = "default") {
        const Result<Composition> composition = all_of({key});
        return composition ? "" : first_text(composition.error());
    }

    std::string body = features;
    Files files = {{"tiny.vert", "void main() {}\n"}, {"tiny.frag", "void main() {}\n"}};
    std::vector<std::string> folders = {""};
};

TEST_F(Compose, PlacesPiecesDepthFirstEachOnce) {
    files["tiny.frag"] = "#include \"a.glsl\"\n#include \"b.glsl\"\n#include \"a.glsl\"\nvoid main() {}\n";
    files["a.glsl"] = "#include \"c.glsl\"\n#include \"d.glsl\"\n";
    files["b.glsl"] = "#include \"d.glsl\"\n#include \"e.glsl\"\n";
    files["c.glsl"] = "#include \"e.glsl\"\n";
    files["d.glsl"] = files["e.glsl"] = "";
    EXPECT_THAT(fragment("default").names,
                ElementsAre("prologue", "e.glsl", "c.glsl", "d.glsl", "a.glsl", "b.glsl", "tiny.frag"));
}

TEST_F(Compose, KeepsTheLinesBetweenTheFirstAndTheLastOfCode) {
    files["tiny.frag"] = "#version 330 core\n#include \"a.glsl\"\n\nvoid main() {\n\n}\n\n";
    files["a.glsl"] = "\nfloat a;\n";
    EXPECT_EQ(fragment("default").source, "#version 450 core\nfloat a;\nvoid main() {\n\n}\n");
    EXPECT_EQ(stage("default", StageKind::fragment, Dialect::own).source,
              "#version 330 core\nfloat a;\nvoid main() {\n\n}\n");
    const Composition composition = all_of({"default"}).value();
    const int number = composition.permutations.front().stages[StageKind::fragment];
    EXPECT_EQ(composition.piece(composition.stage(number).pieces.back()).first_line, 4);
}

TEST_F(Compose, ShipsCommentsOnlyOnRequest) {
    files["tiny.frag"] = "// head\nvoid main() {} // b\n";
    const auto source = [&](Comments comments) {
        const Composition composition = all_of({"default"}, Dialect::glsl450, comments).value();
        const int stage = composition.permutations.front().stages[StageKind::fragment];
        return source_of(composition, composition.stages.at(static_cast<std::size_t>(stage)));
    };
    EXPECT_EQ(source(Comments::remove), "#version 450 core\nvoid main() {}\n");
    EXPECT_EQ(source(Comments::keep), "#version 450 core\n// head\nvoid main() {} // b\n");
    const Composition composition = all_of({"default"}).value();
    EXPECT_EQ(line_of(composition.pieces.front(), 2), "void main() {} // b") << "as messages quote it";
}

TEST_F(Compose, TakesTheValueThatTheKeyChooses) {
    files["tiny.frag"] = "#include <fog>\nvoid main() {}\n";
    files["fog/none.glsl"] = files["fog/linear.glsl"] = "";
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "fog/none.glsl", "tiny.frag"));
    EXPECT_THAT(fragment("fog=linear").names, ElementsAre("prologue", "fog/linear.glsl", "tiny.frag"));
}

TEST_F(Compose, ACountOfZeroIncludesNothing) {
    files["tiny.frag"] = "#include <point>\nvoid main() {}\n";
    files["point/point.glsl"] = "";
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "tiny.frag"));
    EXPECT_THAT(fragment("point=2").names, ElementsAre("prologue", "point/point.glsl", "tiny.frag"));
}

TEST_F(Compose, ADefineIsOffOrOn) {
    files["tiny.frag"] = "#include <bump>\nvoid main() {}\n";
    files["bump/off.glsl"] = files["bump/on.glsl"] = "";
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "bump/off.glsl", "tiny.frag"));
    EXPECT_THAT(fragment("bump=on").names, ElementsAre("prologue", "bump/on.glsl", "tiny.frag"));
}

TEST_F(Compose, PrefersThePieceOfTheStage) {
    files["tiny.vert"] = files["tiny.frag"] = "#include <fog>\n#include \"a.glsl\"\nvoid main() {}\n";
    files["fog/none.glsl"] = files["fog/none.frag.glsl"] = files["a.glsl"] = files["a.vert.glsl"] = "";
    EXPECT_THAT(fragment("default").names,
                ElementsAre("prologue", "fog/none.frag.glsl", "a.glsl", "tiny.frag"));
    EXPECT_THAT(vertex("default").names,
                ElementsAre("prologue", "fog/none.glsl", "a.vert.glsl", "tiny.vert"));
}

TEST_F(Compose, TakesAPartOfTheValueThatTheKeyChooses) {
    files["tiny.frag"] = "#include <fog/distance>\n#include <point/ray>\nvoid main() {}\n";
    files["fog/distance.glsl"] = files["fog/distance/linear.frag.glsl"] = files["point/ray/point.glsl"] = "";
    EXPECT_THAT(fragment("fog=linear point=1").names, ElementsAre("prologue", "fog/distance/linear.frag.glsl",
                                                                  "point/ray/point.glsl", "tiny.frag"));
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "fog/distance.glsl", "tiny.frag"))
        << "what all other values share; of a count of 0 there is no part";
}

TEST_F(Compose, AnEarlierFolderOverlaysALaterOne) {
    files = {{"mine/fog/none.glsl", ""},
             {"theirs/fog/none.glsl", ""},
             {"theirs/fog/linear.glsl", ""},
             {"theirs/tiny.vert", "void main() {}\n"},
             {"theirs/tiny.frag", "#include <fog>\nvoid main() {}\n"}};
    folders = {"mine", "theirs"};
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "mine/fog/none.glsl", "theirs/tiny.frag"));
    EXPECT_THAT(fragment("fog=linear").names,
                ElementsAre("prologue", "theirs/fog/linear.glsl", "theirs/tiny.frag"));
    EXPECT_THAT(all_of({"fog=linear"}).value().files,
                ElementsAre("theirs/fog/linear.glsl", "theirs/tiny.frag", "theirs/tiny.vert"))
        << "what a depfile must name";
}

TEST_F(Compose, APrologueHoldsOnlyWhatItsStageMentions) {
    files["tiny.vert"] = "#if POINTS > 1\n#endif\nvoid main() {}\n";
    files["tiny.frag"] = "// POINTS is not mentioned here\n#ifdef USE_BUMP\n#endif\nvoid main() {}\n";
    EXPECT_EQ(vertex("point=3 bump=on").source,
              "#version 450 core\n#define POINTS 3\n#if POINTS > 1\n#endif\nvoid main() {}\n");
    EXPECT_EQ(fragment("point=3 bump=on").source.substr(0, 37), "#version 450 core\n#define USE_BUMP 1\n");
    EXPECT_EQ(fragment("point=3").source.substr(0, 25), "#version 450 core\n#ifdef ") << "off is not defined";
    EXPECT_EQ(vertex("default").source.substr(0, 35), "#version 450 core\n#define POINTS 0\n");
}

TEST_F(Compose, EqualListsAreTheSameStage) {
    files["tiny.frag"] = "#include <fog>\nvoid main() {}\n";
    files["tiny.vert"] = "#if POINTS > 0\n#endif\nvoid main() {}\n";
    files["fog/none.glsl"] = files["fog/linear.glsl"] = "";
    const Composition composition =
        all_of({"default", "fog=linear", "point=1", "point=1 fog=linear", "point=1 bump=on"}).value();
    EXPECT_EQ(composition.stages.size(), 4u) << "two vertex, two fragment stages";
    EXPECT_EQ(composition.permutations[0].stages[StageKind::vertex],
              composition.permutations[1].stages[StageKind::vertex]);
    EXPECT_EQ(composition.permutations[0].stages[StageKind::fragment],
              composition.permutations[2].stages[StageKind::fragment]);
    EXPECT_EQ(composition.permutations[2].stages[StageKind::vertex],
              composition.permutations[4].stages[StageKind::vertex]);
    EXPECT_NE(composition.permutations[0].stages[StageKind::vertex],
              composition.permutations[2].stages[StageKind::vertex]);
}

const char* const varyings =
    "[varyings.eyeNormal]\nlocation = 1\ntype = \"vec3\"\npiece = \"normal.glsl\"\nvalue = \"normal()\"\n"
    "interpolation = \"flat\"\n"
    "[varyings.eyePosition]\nlocation = 0\ntype = \"vec4\"\nvalue = \"vec4(1.0)\"\n";

TEST_F(Compose, WritesExactlyTheVaryingsThatAreRead) {
    body = varyings;
    files["tiny.vert"] = "#include <varyings>\nvoid main() { writeVaryings(); }\n";
    files["normal.glsl"] = "vec3 normal() { return vec3(0.0); }\n";

    EXPECT_EQ(vertex("default").source,
              "#version 450 core\nvoid writeVaryings() {\n}\nvoid main() { writeVaryings(); }\n");
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "tiny.frag"));

    files["tiny.frag"] = "void main() { eyePosition; } // not eyeNormal\n";
    EXPECT_EQ(
        vertex("default").source,
        "#version 450 core\n#define VARYING(location_) layout(location = location_) out\n"
        "VARYING(0) vec4 eyePosition; void writeVaryingEyePosition() { eyePosition = vec4(1.0); }\n"
        "void writeVaryings() {\n    writeVaryingEyePosition();\n}\nvoid main() { writeVaryings(); }\n");

    files["tiny.frag"] = "void main() { eyeNormal; eyePosition; }\n";
    EXPECT_THAT(vertex("default").names,
                ElementsAre("prologue", "normal.glsl", "tiny[varyings]", "tiny.vert"));
    EXPECT_EQ(fragment("default").source,
              "#version 450 core\n#define VARYING(location_) layout(location = location_) in\n"
              "flat VARYING(1) vec3 eyeNormal;\n\n\n\n\n\nVARYING(0) vec4 eyePosition;\n"
              "void main() { eyeNormal; eyePosition; }\n");
}

TEST_F(Compose, PlacesPiecesThatShareAFile) {
    files["tiny.frag"] = "#include \"a/two.glsl\"\n#include \"a/one.glsl\"\nvoid main() {}\n";
    files["a.glsl"] = "// Both\n#piece one\nint one;\n\n#piece two\n#include \"a/one.glsl\"\nint two;\n";
    EXPECT_EQ(fragment("default").source, "#version 450 core\nint one;\nint two;\nvoid main() {}\n");
    EXPECT_THAT(fragment("default").names, ElementsAre("prologue", "a.glsl#one", "a.glsl#two", "tiny.frag"));
}

TEST_F(Compose, LaysCountedVaryingsBehindTheOthers) {
    body = std::string(features) +
           "[varyings.rays]\ncount = \"point + point\"\ntype = \"vec4\"\nvalue = \"allRays()\"\n"
           "[varyings.halves]\ncount = \"point\"\ntype = \"vec3\"\nvalue = \"allHalves()\"\n"
           "[varyings.eyePosition]\nlocation = 3\ntype = \"vec3\"\nvalue = \"vec3(1.0)\"\n";
    files["tiny.vert"] = "#include <varyings>\nvoid main() { writeVaryings(); }\n";
    files["tiny.frag"] = "void main() { halves; rays; eyePosition; }\n";
    const auto declarations = [&](const std::string& key) {
        std::string text = fragment(key).source;
        text = text.substr(text.find(" in\n") + 4);
        text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
        return text.substr(0, text.find("void"));
    };
    EXPECT_EQ(declarations("point=2"),
              "VARYING(6) vec4 rays[4];VARYING(4) vec3 halves[2];VARYING(3) vec3 eyePosition;");
    EXPECT_EQ(declarations("point=1"),
              "VARYING(5) vec4 rays[2];VARYING(4) vec3 halves[1];VARYING(3) vec3 eyePosition;");
    EXPECT_THAT(vertex("point=1").source,
                testing::HasSubstr("vec4 rays[2]; void writeVaryingRays() { rays = allRays(); }"));
    body.replace(body.find("location = 3"), 12, "location = 8");
    EXPECT_EQ(declarations("point=2"),
              "VARYING(11) vec4 rays[4];VARYING(9) vec3 halves[2];VARYING(8) vec3 eyePosition;");
    EXPECT_EQ(declarations("point=3"),
              "VARYING(4) vec4 rays[6];VARYING(1) vec3 halves[3];VARYING(0) vec3 eyePosition;")
        << "no gaps where they would lead past 15 locations";
    files["tiny.frag"] = "void main() { rays; }\n";
    EXPECT_EQ(declarations("point=1"), "VARYING(0) vec4 rays[2];");
    body = std::string(features) +
           "[varyings.cosines]\ncount = \"point + point\"\nvalues_per_element = 4\ntype = \"vec4\"\n"
           "value = \"allCosines()\"\n";
    files["tiny.frag"] = "void main() { cosines; }\n";
    EXPECT_EQ(declarations("point=2"), "VARYING(0) vec4 cosines[1];");
    EXPECT_EQ(declarations("point=3"), "VARYING(0) vec4 cosines[2];");
}

TEST_F(Compose, PrintsTheWholeCycle) {
    files["tiny.frag"] = "#include \"a.glsl\"\nvoid main() {}\n";
    files["a.glsl"] = "#include \"b.glsl\"\n";
    files["b.glsl"] = "// b\n#include \"c.glsl\"\n";
    files["c.glsl"] = "#include \"b.glsl\"\n";
    EXPECT_EQ(first_error(),
              "c.glsl:1:1: error: include cycle: b.glsl -> c.glsl -> b.glsl [default]\n    #include "
              "\"b.glsl\"\n    ^\n"
              "  help: move what both need into a piece of its own\n");
    files["b.glsl"] = "#include \"b.glsl\"\n";
    EXPECT_THAT(first_error(),
                testing::StartsWith("b.glsl:1:1: error: include cycle: b.glsl -> b.glsl [default]\n"));
}

TEST_F(Compose, RefusesAVaryingsIncludeThatNeedsItself) {
    body = varyings;
    files["tiny.vert"] = "#include <varyings>\nvoid main() { writeVaryings(); }\n";
    files["tiny.frag"] = "void main() { eyeNormal; }\n";
    files["normal.glsl"] = "#include <varyings>\n";
    EXPECT_THAT(first_error(), testing::HasSubstr("include cycle: normal.glsl -> normal.glsl"));
}

TEST_F(Compose, RefusesEndlessChains) {
    files["tiny.frag"] = "#include \"0.glsl\"\nvoid main() {}\n";
    for (int i = 0; i < 200; ++i)
        files[std::to_string(i) + ".glsl"] = "#include \"" + std::to_string(i + 1) + ".glsl\"\n";
    EXPECT_EQ(first_error(),
              "99.glsl:1:1: error: includes are nested more than 100 deep [default]\n    #include "
              "\"100.glsl\"\n    ^\n"
              "  help: include the piece from the template\n");
}

TEST_F(Compose, NamesTheFoldersSearchedAndTheNearestFile) {
    files["tiny.frag"] = "// head\n#include \"common/mth.glsl\"\n";
    files["common/math.glsl"] = "";
    EXPECT_EQ(first_error(),
              "tiny.frag:2:1: error: no piece 'common/mth.glsl' [default]\n    #include "
              "\"common/mth.glsl\"\n    ^\n"
              "  help: searched .; nearest: 'common/math.glsl'\n");
    files.erase("tiny.frag");
    files["tinny.frag"] = "";
    EXPECT_EQ(first_error(),
              "tiny.toml: error: no template 'tiny.frag'\n  help: searched .; nearest: 'tinny.frag'\n");
}

}  // namespace
}  // namespace gobo
