// Includes as the world writes them: anywhere in a file, under conditions, with guards.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/key.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using Files = std::map<std::string, std::string, std::less<>>;

class Includes : public testing::Test {
  protected:
    Result<Composition> composed(const std::string& key, Comments comments = Comments::remove) {
        const MemoryFileSystem disk(files);
        SearchPath search;
        for (const std::string& folder : folders)
            search.add(disk, folder, folder.empty() ? "" : folder + "/", !folder.empty());
        const Family family = family_of(
            "[features]\nfog = { values = [\"none\", \"linear\"] }\nskinned = { define = \"SKINNED\" }\n"
            "point = { count = [0, 3], constant = \"POINTS\" }\n");
        return compose(family, {parse_key(family, key).value()}, search, Dialect::own, comments);
    }
    /// The fragment stage behind the prologue's version line, without empty lines; or the first error.
    std::string source(const std::string& key = "default") {
        const Result<Composition> composition = composed(key);
        if (!composition) return first_text(composition.error());
        std::string text;
        for (const int piece :
             composition->stage(composition->permutations.front().stages[StageKind::fragment]).pieces)
            text += composition->piece(piece).text;
        std::string dense;
        for (std::size_t at = text.find('\n') + 1; at < text.size(); ++at)
            if (text[at] != '\n' || (!dense.empty() && dense.back() != '\n')) dense += text[at];
        return dense;
    }
    std::vector<std::string> read_files(const std::string& key = "default") {
        const std::set<std::string> read = composed(key).value().files;
        return {read.begin(), read.end()};
    }

    Files files = {{"tiny.vert", "void main() {}\n"}};
    std::vector<std::string> folders = {""};
};

TEST_F(Includes, StandWhereTheyAreWritten) {
    files["tiny.frag"] = "int a;\n#include \"b.glsl\"\nint c;\nvoid main() {\n#include \"b.glsl\"\n}\n";
    files["b.glsl"] = "int b;\n";
    EXPECT_EQ(source(), "int a;\nint b;\nint c;\nvoid main() {\nint b;\n}\n") << "twice, as C does";
}

TEST_F(Includes, KeepTheLinesOfTheFile) {
    files["tiny.frag"] =
        "int a;\n#include \"b.glsl\"\n\n#include \"b.glsl\"\nint \\\n c;\n#include \"b.glsl\"\nint d;";
    files["b.glsl"] = "int b;\n";
    const Composition composition = composed("default").value();
    std::vector<std::string> texts;
    for (const int number :
         composition.stage(composition.permutations.front().stages[StageKind::fragment]).pieces) {
        const Piece& piece = composition.piece(number);
        texts.push_back(piece.path + ":" + std::to_string(piece.first_line) + "|" + piece.text);
        if (piece.path == "tiny.frag") {
            EXPECT_EQ(line_of(piece, 8), "int d;") << "as messages quote it";
        }
    }
    EXPECT_THAT(texts, ElementsAre("prologue:1|#version 450 core\n", "tiny.frag:1|int a;\n",
                                   "b.glsl:1|int b;\n", "b.glsl:1|int b;\n", "tiny.frag:5|int  c;\n",
                                   "b.glsl:1|int b;\n", "tiny.frag:8|int d;\n"))
        << "parts without code are left out";
}

TEST_F(Includes, UnderConditionsAreThoseThatHold) {
    files["tiny.frag"] =
        "#ifdef SKINNED\n#include \"skin.glsl\"\n#elif POINTS > 1\n#include \"many.glsl\"\n#else\n"
        "#include \"none.glsl\"\n#endif\nvoid main() {}\n";
    files["none.glsl"] = "int none;\n";
    EXPECT_EQ(
        source(),
        "#define POINTS 0\n#ifdef SKINNED\n#elif POINTS > 1\n#else\nint none;\n#endif\nvoid main() {}\n")
        << "what is left out is not searched for";
    EXPECT_THAT(source("skinned=on"),
                StartsWith("tiny.frag:2:1: error: no piece 'skin.glsl' [skinned=on]\n"));
    EXPECT_THAT(source("point=2"), StartsWith("tiny.frag:4:1: error: no piece 'many.glsl' [point=2]\n"));
    files["skin.glsl"] = "int skin;\n";
    EXPECT_THAT(source("skinned=on"), HasSubstr("#ifdef SKINNED\nint skin;\n#elif"));
}

TEST_F(Includes, SeeTheMacrosOfWhatStandsBefore) {
    files["tiny.frag"] =
        "#include \"settings.glsl\"\n#include <fog>\n#if QUALITY(1) >= 2 && defined(FOGGY)\n#include "
        "\"fine.glsl\"\n"
        "#endif\nvoid main() {}\n";
    files["settings.glsl"] = "#define QUALITY(x) \\\n  ((x) + 1) /* two\n */ + 0\n";
    files["fog/none.glsl"] = "int clear;\n";
    files["fog/linear.glsl"] = "#define FOGGY\n";
    files["fine.glsl"] = "#define FINE\n#ifdef FINE\n#include \"finest.glsl\"\n#endif\n";
    files["finest.glsl"] = "int finest;\n";
    EXPECT_THAT(source("fog=linear"), HasSubstr("int finest;"));
    EXPECT_THAT(source(), testing::Not(HasSubstr("finest")));
}

TEST_F(Includes, OnBothSidesOfWhatOnlyTheDriverKnows) {
    files["tiny.frag"] =
        "#ifdef GL_ARB_texture_gather\n#include \"gather.glsl\"\n#else\n#include \"plain.glsl\"\n#endif\n"
        "void main() {}\n";
    files["gather.glsl"] = "#extension GL_ARB_texture_gather : require\nint gather;\n";
    files["plain.glsl"] = "int plain;\n";
    EXPECT_EQ(source(),
              "#extension GL_ARB_texture_gather : require\n#ifdef GL_ARB_texture_gather\nint gather;\n#else\n"
              "int plain;\n#endif\nvoid main() {}\n");
}

TEST_F(Includes, AreFoundBesideTheirFileFirst) {
    folders = {"project", "library"};
    files = {
        {"project/tiny.vert", "void main() {}\n"},
        {"project/tiny.frag", "#include \"sub/a.glsl\"\n#include \"../library/b.glsl\"\nvoid main() {}\n"},
        {"project/sub/a.glsl",
         "#include \"b.glsl\"\n#include \"./c.glsl\"\n#include \"../d.glsl\"\n#include \"e.glsl\"\n"
         "#include \"../sub/b.glsl\"\n"},
        {"project/sub/b.glsl", "int sub_b;\n"},
        {"project/b.glsl", "int b;\n"},
        {"library/sub/c.glsl", "int library_c;\n"},
        {"project/d.glsl", "int d;\n"},
        {"library/e.glsl", "int e;\n"}};
    EXPECT_THAT(source(),
                StartsWith("project/tiny.frag:2:1: error: the path '../library/b.glsl' leaves the folders"));
    files["project/tiny.frag"] = "#include \"sub\\a.glsl\"\nvoid main() {}\n";
    EXPECT_THAT(source(), StartsWith("project/tiny.frag:1:1: error: the path 'sub\\a.glsl' holds a '\\'"));
    files["project/tiny.frag"] = "#include \"sub/a.glsl\"\n#include \"b.glsl\"\nvoid main() {}\n";
    EXPECT_EQ(source(), "int sub_b;\nint library_c;\nint d;\nint e;\nint b;\nvoid main() {}\n")
        << "each once, however its path is written";
}

TEST_F(Includes, BetweenAnglesAreFeaturesOrFiles) {
    files["tiny.frag"] =
        "#include <fog>\n#include <fog/part>\n#include <common>\n#include <lib/noise.glsl>\n#include "
        "<lib/math>\n"
        "void main() {}\n";
    files["fog/none.glsl"] = "int fog;\n";
    files["fog/part.glsl"] = "int part;\n";
    files["common.glsl"] = "int common;\n";
    files["lib/noise.glsl"] = "int noise;\n";
    files["lib/math"] = "int math;\n";
    EXPECT_EQ(source(), "int fog;\nint part;\nint common;\nint noise;\nint math;\nvoid main() {}\n");
    files["tiny.frag"] = "#include <fogg>\nvoid main() {}\n";
    EXPECT_EQ(
        source(),
        "tiny.frag:1:1: error: family 'tiny' has no feature 'fogg' [default]\n    #include <fogg>\n    ^\n"
        "  help: did you mean 'fog'?\n");
    files["tiny.frag"] = "#include <lib/nois.glsl>\nvoid main() {}\n";
    EXPECT_EQ(
        source(),
        "tiny.frag:1:1: error: no piece 'lib/nois.glsl' [default]\n    #include <lib/nois.glsl>\n    ^\n"
        "  help: searched .; nearest: 'lib/noise.glsl'\n");
}

TEST_F(Includes, HonourGuards) {
    const char* const guarded = "#ifndef B_\n#define B_\nint b;\n#endif\n";
    files["tiny.frag"] =
        "int a;\n#include \"b.glsl\"\n#include \"c.glsl\"\n#include \"b.glsl\"\nvoid main() {}\n";
    files["b.glsl"] = guarded;
    files["c.glsl"] = "int c;\n#include \"b.glsl\"\n";
    EXPECT_EQ(source(), std::string("int a;\n") + guarded + "int c;\nvoid main() {}\n");
    files["b.glsl"] = "#pragma once\nint b;\n";
    EXPECT_EQ(source(), "int a;\nint b;\nint c;\nvoid main() {}\n");
}

TEST_F(Includes, MayLeadBackWhereAGuardEndsThem) {
    files["tiny.frag"] = "int a;\n#include \"b.glsl\"\nvoid main() {}\n";
    files["b.glsl"] = "#ifndef B_\n#define B_\n#include \"c.glsl\"\nint b;\n#endif\n";
    files["c.glsl"] = "#ifndef C_\n#define C_\n#include \"b.glsl\"\nint c;\n#endif\n";
    EXPECT_EQ(source(),
              "int a;\n#ifndef B_\n#define B_\n#ifndef C_\n#define C_\nint c;\n#endif\nint b;\n#endif\nvoid "
              "main() {}\n");
    files["b.glsl"] = "#pragma once\n#include \"c.glsl\"\nint b;\n";
    files["c.glsl"] = "#pragma once\n#include \"b.glsl\"\nint c;\n";
    EXPECT_EQ(source(), "int a;\nint c;\nint b;\nvoid main() {}\n");
    files["b.glsl"] = "int b;\n#include \"b.glsl\"\n";
    EXPECT_THAT(source(), StartsWith("b.glsl:2:1: error: include cycle: b.glsl -> b.glsl [default]\n"));
}

TEST_F(Includes, AtTheTopComeOnceAndBelowItAgain) {
    files["tiny.frag"] =
        "#include \"b.glsl\"\n#include \"b.glsl\"\nint a;\n#include \"b.glsl\"\nvoid main() {}\n";
    files["b.glsl"] = "int b;\n";
    EXPECT_EQ(source(), "int b;\nint a;\nint b;\nvoid main() {}\n");
}

TEST_F(Includes, OfFeaturesMayStandAnywhere) {
    files["tiny.frag"] = "int a;\n#include <fog>\n#if POINTS > 0\n#include <point>\n#endif\nvoid main() {}\n";
    files["fog/none.glsl"] = "int none;\n";
    files["fog/linear.glsl"] = "int linear;\n";
    files["point/point.glsl"] = "int points[POINTS];\n";
    EXPECT_THAT(source(), HasSubstr("int a;\nint none;\n#if POINTS > 0\n#endif\n"));
    EXPECT_THAT(source("fog=linear point=1"),
                HasSubstr("int a;\nint linear;\n#if POINTS > 0\nint points[POINTS];\n#endif\n"));
}

TEST_F(Includes, MalformedMatterOnlyWhereTheyCount) {
    files["tiny.frag"] = "int a;\n#ifdef SKINNED\n#include skin\n#endif\nvoid main() {}\n";
    EXPECT_EQ(source(), "int a;\n#ifdef SKINNED\n#endif\nvoid main() {}\n");
    EXPECT_EQ(source("skinned=on"),
              "tiny.frag:3:1: error: malformed #include [skinned=on]\n    #include skin\n    ^\n"
              "  help: write #include <feature> or #include \"folder/piece.glsl\"\n");
}

TEST_F(Includes, ThatDoubleAtEachStepAreRefused) {
    files["tiny.frag"] = "int a;\n#include \"0.glsl\"\nvoid main() {}\n";
    for (int i = 0; i < 30; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + ".glsl\"\n";
        files[std::to_string(i) + ".glsl"] = "int i;\n" + next + next;
    }
    files["30.glsl"] = "int last;\n";
    EXPECT_THAT(source(), HasSubstr("error: the stage takes more than 10000 includes [default]\n"));
}

TEST_F(Includes, OfTooMuchTextAreRefused) {
    files["tiny.frag"] = "int a;\n";
    for (int i = 0; i < 10; ++i) files["tiny.frag"] += "#include \"long.glsl\"\n";
    files["long.glsl"] = "int b;\n" + std::string(2'000'000, 'x') + "\n";
    EXPECT_THAT(source(), HasSubstr("error: the stage's text is longer than 16000000 bytes [default]\n"));
}

TEST_F(Includes, MacrosWithoutEndAreRefused) {
    files["tiny.frag"] = "#define A0 1\n";
    for (int i = 1; i <= 40; ++i)
        files["tiny.frag"] += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " + A" +
                              std::to_string(i - 1) + "\n";
    files["tiny.frag"] += "#if A40\n#include \"b.glsl\"\n#endif\nvoid main() {}\n";
    EXPECT_THAT(source(),
                StartsWith("tiny.frag:20:1: error: this macro expands to more than a million tokens"));
}

TEST_F(Includes, NameTheFilesThatADepfileMustName) {
    folders = {"p"};
    files = {{"p/tiny.vert", "void main() {}\n"},
             {"p/tiny.frag", "int a;\n#ifdef SKINNED\n#include \"b.glsl\"\n#endif\nvoid main() {}\n"},
             {"p/b.glsl", "int b;\n"}};
    EXPECT_THAT(read_files(), ElementsAre("p/tiny.frag", "p/tiny.vert"));
    EXPECT_THAT(read_files("skinned=on"), ElementsAre("p/b.glsl", "p/tiny.frag", "p/tiny.vert"));
}

TEST_F(Includes, OfLooseFilesLieBesideThem) {
    const MemoryFileSystem disk(Files{{"one/a.vert", "#include \"common.glsl\"\nvoid main() {}\n"},
                                      {"two/b.frag", "#include \"common.glsl\"\nvoid main() {}\n"},
                                      {"one/common.glsl", "int one;\n"},
                                      {"two/common.glsl", "int two;\n"}});
    SearchPath search;
    const Family family = family_of_files({"one/a.vert", "two/b.frag"}, disk, search).value();
    const Composition composition = compose(family, {Key()}, search, Dialect::own).value();
    EXPECT_EQ(
        source_of(composition, composition.stage(composition.permutations.front().stages[StageKind::vertex])),
        "#version 450 core\nint one;\nvoid main() {}\n");
    EXPECT_EQ(source_of(composition,
                        composition.stage(composition.permutations.front().stages[StageKind::fragment])),
              "#version 450 core\nint two;\nvoid main() {}\n");
}

struct ExtensionRow {
    const char* name;
    const char* file;  ///< a.glsl, which the template includes
    const char* prologue;
};

class ExtensionsOf : public Includes, public testing::WithParamInterface<ExtensionRow> {};

TEST_P(ExtensionsOf, StandBehindTheVersion) {
    files["tiny.frag"] = "#version 330 core\n#extension GL_B : enable\n#include \"a.glsl\"\nvoid main() {}\n";
    files["a.glsl"] = GetParam().file;
    const Composition composition = composed("default").value();
    EXPECT_EQ(composition
                  .piece(composition.stage(composition.permutations.front().stages[StageKind::fragment])
                             .pieces.front())
                  .text,
              "#version 330 core\n" + std::string(GetParam().prologue));
}

INSTANTIATE_TEST_SUITE_P(
    Rows, ExtensionsOf,
    testing::Values(
        ExtensionRow{"sorted", "int a;\n#extension GL_A : warn\n",
                     "#extension GL_A : warn\n#extension GL_B : enable\n"},
        ExtensionRow{"once", "int a;\n#extension GL_B : enable\n", "#extension GL_B : enable\n"},
        ExtensionRow{"stronger", "#extension GL_B : require\n", "#extension GL_B : require\n"},
        ExtensionRow{"weaker", "#extension GL_B : disable\n", "#extension GL_B : enable\n"},
        ExtensionRow{"of_all_first", "#extension all : warn\n#extension GL_A : enable\n",
                     "#extension all : warn\n#extension GL_A : enable\n#extension GL_B : enable\n"},
        ExtensionRow{"left_out", "#ifdef SKINNED\n#extension GL_A : enable\n#endif\n",
                     "#extension GL_B : enable\n"},
        ExtensionRow{"under_a_condition", "#if __VERSION__ < 400\n#extension GL_A : require\n#endif\n",
                     "#extension GL_A : require\n#extension GL_B : enable\n"},
        ExtensionRow{"where_there_is_one", "#ifdef GL_A\n#extension GL_A : require\n#endif\n",
                     "#extension GL_A : enable\n#extension GL_B : enable\n"},
        ExtensionRow{"within_a_guard", "#ifndef G\n#define G\n#extension GL_A : enable\n#endif\n",
                     "#extension GL_A : enable\n#extension GL_B : enable\n"},
        ExtensionRow{"malformed",
                     "#extension GL_A\n#extension GL_A : perhaps\n#extension GL_A : enable int\n",
                     "#extension GL_B : enable\n"}),
    [](const auto& row) { return row.param.name; });

struct EndedRow {
    const char* name;
    const char* file;   ///< the template
    const char* other;  ///< a.glsl, which it may include
    const char* prologue;
    const char* warning;
};

class EndedExtension : public Includes, public testing::WithParamInterface<EndedRow> {};

TEST_P(EndedExtension, IsWarnedOfOrHolds) {
    files["tiny.frag"] = GetParam().file;
    files["a.glsl"] = GetParam().other;
    const Composition composition = composed("default").value();
    EXPECT_EQ(composition
                  .piece(composition.stage(composition.permutations.front().stages[StageKind::fragment])
                             .pieces.front())
                  .text,
              "#version 450 core\n" + std::string(GetParam().prologue));
    EXPECT_EQ(first_text(composition.warnings), GetParam().warning);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, EndedExtension,
    testing::Values(
        EndedRow{"at_once", "#extension GL_A : enable\n#extension GL_A : disable\nvoid main() {}\n", "",
                 "#extension GL_A : disable\n", ""},
        EndedRow{"begun_again", "#extension GL_A : disable\n#extension GL_A : enable\nvoid main() {}\n", "",
                 "#extension GL_A : enable\n", ""},
        EndedRow{
            "behind_code", "#extension GL_A : enable\nint a;\n#extension GL_A : disable\nvoid main() {}\n",
            "", "#extension GL_A : enable\n",
            "tiny.frag:3:1: warning: 'GL_A' stays on: tiny.frag:1 says enable, and a stage says so once, "
            "in front of all code\n    #extension GL_A : disable\n    ^\n  help: leave one of the two out\n"},
        EndedRow{
            "in_an_included_file", "#extension GL_A : enable\n#include \"a.glsl\"\nvoid main() {}\n",
            "#extension GL_A : disable\nint a;\n", "#extension GL_A : enable\n",
            "a.glsl:1:1: warning: 'GL_A' stays on: tiny.frag:1 says enable, and a stage says so once, "
            "in front of all code\n    #extension GL_A : disable\n    ^\n  help: leave one of the two out\n"},
        EndedRow{
            "by_the_includer", "#include \"a.glsl\"\n#extension GL_A : disable\nvoid main() {}\n",
            "#extension GL_A : require\nint a;\n", "#extension GL_A : require\n",
            "tiny.frag:2:1: warning: 'GL_A' stays on: a.glsl:1 says require, and a stage says so once, "
            "in front of all code\n    #extension GL_A : disable\n    ^\n  help: leave one of the two out\n"},
        EndedRow{"begun_by_the_included_file",
                 "#extension GL_A : disable\n#include \"a.glsl\"\nvoid main() {}\n",
                 "#extension GL_A : enable\nint a;\n", "#extension GL_A : enable\n", ""},
        EndedRow{
            "under_a_condition",
            "#extension GL_A : enable\n#if 1\n#extension GL_A : disable\n#endif\nvoid main() {}\n", "",
            "#extension GL_A : enable\n",
            "tiny.frag:3:1: warning: 'GL_A' stays on: tiny.frag:1 says enable, and a stage says so once, "
            "in front of all code\n    #extension GL_A : disable\n    ^\n  help: leave one of the two out\n"},
        EndedRow{"under_a_condition_that_fails",
                 "#extension GL_A : enable\n#if 0\n#extension GL_A : disable\n#endif\nvoid main() {}\n", "",
                 "#extension GL_A : enable\n", ""}),
    [](const auto& row) { return row.param.name; });

TEST_F(Includes, MayStateTheVersion) {
    files["tiny.frag"] = "#include \"a.glsl\"\nvoid main() {}\n";
    files["a.glsl"] = "#version 330 core\nint a;\n";
    const auto prologue = [&] {
        const Composition composition = composed("default").value();
        return composition
            .piece(composition.stage(composition.permutations.front().stages[StageKind::fragment])
                       .pieces.front())
            .text;
    };
    EXPECT_EQ(prologue(), "#version 330 core\n") << "where the template states none";
    files["tiny.frag"] = "#version 410\n#include \"a.glsl\"\nvoid main() {}\n";
    EXPECT_EQ(prologue(), "#version 410\n");
}

}  // namespace
}  // namespace gobo
