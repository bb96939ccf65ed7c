// The manifest and the depfile.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file_system.hpp"
#include "emit/depfile_names.hpp"
#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

/// The names of a permutation's pieces in a stage, as docs/formats.md says how to read them.
std::vector<std::string> pieces_of(const nlohmann::json& manifest, const nlohmann::json& permutation,
                                   const char* kind) {
    const auto& stage = manifest["stages"][kind];
    const std::string row = stage["rows"][permutation[kind].get<std::size_t>()];
    EXPECT_EQ(row.size(), stage["columns"].size());
    std::vector<std::string> pieces;
    for (std::size_t column = 0; column < row.size(); ++column)
        for (const auto& number :
             stage["columns"][column][manifest["digits"].get<std::string>().find(row[column])])
            pieces.push_back(manifest["pieces"][number.get<std::size_t>()]);
    return pieces;
}

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
    EXPECT_EQ(
        pieces_of(manifest, permutation, "fragment"),
        (std::vector<std::string>{"shader_lib/common.glsl", "piece of fog=linear point=3 shading=vertex"}));
    EXPECT_EQ(manifest["interface"]["blocks"][1]["name"], "Fog");
    EXPECT_EQ(manifest["interface"]["outputs"][0]["location"], 0) << "as in the header";
}

TEST(Manifest, ListsThePiecesOfEachStage) {
    const sample::Built built = sample::large(500);
    const EmitInput input = built.input();
    const auto manifest = nlohmann::json::parse(emit_manifest(input));
    ASSERT_EQ(manifest["permutations"].size(), 500U);
    for (const auto& row : manifest["permutations"]) {
        const std::string key = row["key"];
        const auto permutation = std::ranges::find_if(
            input.composition.permutations,
            [&](const Permutation& one) { return key_text(input.family, one.key) == key; });
        ASSERT_NE(permutation, input.composition.permutations.end()) << key;
        for (const StageKind kind : {StageKind::vertex, StageKind::fragment}) {
            std::vector<std::string> pieces;
            for (const int piece : input.composition.stage(permutation->stages[kind]).pieces)
                pieces.push_back(input.composition.piece(piece).name);
            EXPECT_EQ(pieces_of(manifest, row, name_of(kind).data()), pieces) << key;
        }
    }
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
    EXPECT_EQ(emit_depfile({"a.hpp"}, {"d:e", "left;out", "line\nend"}), "a.hpp: \\\n  d\\:e\n");
    EXPECT_EQ(emit_depfile({"a.hpp"}, {"a=b/c", "d", "e"}), "a.hpp: \\\n  d \\\n  a=b/c \\\n  e\n");
}

TEST(Depfile, WarnsOfNamesThatItCannotHold) {
    const auto texts = [](const std::string& output, const std::set<std::string>& files) {
        return to_text(check_depfile_names(output, files));
    };
    const std::string help =
        "  help: rename the file or its folder: letters, digits, blanks and . _ - + , @ are safe\n";
    EXPECT_EQ(texts("out/a b#c.hpp", {"a b", "c:d", "e#f", "$g", "h\\i"}), "");
    EXPECT_EQ(texts("out/lit.hpp", {"Kim's/a.glsl", "Kim's/b.glsl", "x;y"}),
              "x;y: warning: a depfile cannot hold this name: build tools will not see the file change\n" +
                  help +
                  "Kim's/a.glsl: warning: a depfile cannot hold this name (and of 1 more): make reads it, "
                  "but ninja "
                  "builds every time\n" +
                  help);
    EXPECT_EQ(
        texts("out/lit.hpp", {"a=b"}),
        "a=b: warning: a depfile cannot hold this name: make takes it for a variable, and will not see the "
        "file change\n" +
            help);
    EXPECT_EQ(
        texts("out\n/lit.hpp", {}),
        "out /lit.hpp: warning: a depfile cannot hold this name: build tools will not know what it is for\n" +
            help);
}

/// How often a tool runs a rule whose depfile names the file: made, asked again, and asked again once the
/// file is newer.
std::string runs_of(const std::string& tool, const std::string& name) {
    DiskFileSystem disk;
    const std::string folder = testing::TempDir() + "depfile_of_" + tool;
    std::filesystem::remove_all(folder);
    const auto put = [&](const std::string& file, const std::string& text) {
        EXPECT_TRUE(disk.write(folder + "/" + file, text));
    };
    put("first", "");
    put(name, "");
    put("out.d.in", emit_depfile({"out"}, {name, "first"}));
    if (tool == "make") put("out.d", emit_depfile({"out"}, {name, "first"}));
    put("Makefile", "out:\n\techo ran >>log; touch out\n-include out.d\n");
    put("build.ninja",
        "rule r\n  command = cp out.d.in out.d; echo ran >>log; touch out\n  depfile = out.d\nbuild out: "
        "r\n");
    std::string runs;
    for (int i = 0; i < 3; ++i) {
        if (i == 2)
            std::filesystem::last_write_time(
                folder + "/" + name, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
        const std::string command = "cd '" + folder + "' && " + tool + " out >/dev/null 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << tool << " " << name;
        const std::string log = disk.read(folder + "/log").value_or("");
        runs += std::to_string(std::count(log.begin(), log.end(), '\n'));
    }
    return runs;
}

TEST(Depfile, IsReadByMakeAndNinja) {
    const char* names[] = {"plain.glsl", "a b", " a",  "a#b",   "#a",        "a$b", "$a",
                           "$$",         "a:b", ":a",  "a: b",  "a\\b",      "\\a", "a\\ b",
                           "a\\\\ b",    "a=b", "a%b", "a[1]b", "~a",        "a(b", "a!b",
                           "a@b",        "a,b", "a{b", "-a",    "\xC3\xA4 b"};
    for (const std::string name : names) {
        EXPECT_TRUE(check_depfile_names("out", {"first", name}).empty()) << name;
        for (const std::string tool : {"make", "ninja"})
            EXPECT_EQ(runs_of(tool, name), "112") << tool << " " << name;
    }
    for (const std::string name :
         {"a'b", "a\"b", "a&b", "a`b", "a?b", "a*b", "a<b", "a\tb", "a\\#b", "a\\:b"}) {
        EXPECT_EQ(check_depfile_names("out", {name}).size(), 1U) << name;
        EXPECT_EQ(runs_of("make", name), "112") << name;
        EXPECT_EQ(runs_of("ninja", name), "123") << name;
    }
    for (const std::string name : {"a;b", "a|b", "a\nb", "a\rb", "a\\", "a ", "a(b)"}) {
        EXPECT_EQ(check_depfile_names("out", {name}).size(), 1U) << name;
        for (const std::string tool : {"make", "ninja"})
            EXPECT_EQ(runs_of(tool, name), "111") << tool << " " << name;
    }
}

}  // namespace
}  // namespace gobo
