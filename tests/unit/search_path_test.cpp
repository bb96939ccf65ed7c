// Where pieces are found, in memory and on disk.
#include "compose/search_path.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_families.hpp"

namespace gobo {
namespace {

TEST(StaysInside, OnlyBelowItsFolder) {
    const std::pair<const char*, bool> rows[] = {
        {"a.glsl", true},
        {"fog/linear.glsl", true},
        {"./a.glsl", true},
        {"a/../b.glsl", true},
        {"", false},
        {".", false},
        {"..", false},
        {"../a.glsl", false},
        {"/etc/passwd", false},
        {"a/../../b", false},
        {"a/..", false},
        {"a\\..\\..\\b", false},
        {"a/../../a/b", false},
        {"//a", false},
    };
    for (const auto& [path, expected] : rows) EXPECT_EQ(stays_inside(path), expected) << path;
}

Piece shipped_piece(Piece piece) {
    piece.is_shipped = true;
    return piece;
}

TEST(SearchPath, TakesTheFirstFolderThatHasThePiece) {
    MemoryFileSystem own;
    ASSERT_TRUE(own.write("mine/fog/linear.glsl", "mine"));
    MemoryFileSystem shipped(
        {{"shader_lib/fog/linear.glsl", "shipped"}, {"shader_lib/fog/none.glsl", "none"}});
    SearchPath search;
    search.add(own, "mine", "", true);
    search.add(shipped, "shader_lib", "shader_lib/", false);
    EXPECT_EQ(search.find("fog/linear.glsl").value(),
              (Piece{"fog/linear.glsl", "mine/fog/linear.glsl", "mine", true}));
    EXPECT_EQ(search.find("fog/none.glsl").value(),
              shipped_piece({"shader_lib/fog/none.glsl", "shader_lib/fog/none.glsl", "none"}));
    EXPECT_EQ(search.find("fog/linear.glsl", "mine", Whose::shipped).value(),
              shipped_piece({"shader_lib/fog/linear.glsl", "shader_lib/fog/linear.glsl", "shipped"}));
    EXPECT_EQ(search.find("fog/thick.glsl").value(), std::nullopt);
    EXPECT_THAT(search.folders(), testing::ElementsAre("mine", "shader_lib"));
    EXPECT_THAT(search.all_include_paths(), testing::ElementsAre("fog/linear.glsl", "fog/none.glsl"));
}

TEST(SearchPath, RefusesAPieceThatAFileHoldsTwice) {
    MemoryFileSystem files({{"lib/fog.glsl", "#piece linear\na\n#piece none\nb\n#piece linear\nc\n"},
                            {"lib/light.glsl", "#piece off\n\n#piece on\nd\n"}});
    SearchPath search;
    search.add(files, "lib", "lib/", false);
    EXPECT_EQ(to_text(search.find("fog/linear.glsl").error().front()),
              "lib/fog.glsl:5:1: error: the piece 'linear' is here twice\n    #piece linear\n    ^\n"
              "  help: give one of them another name\n");
    EXPECT_EQ(search.find("fog/none.glsl").value().value().text, "\n\n\nb\n");
    EXPECT_EQ(search.find("light/off.glsl").value().value().text, "\n\n") << "one may be empty";
    EXPECT_EQ(search.find("light/dim.glsl").value(), std::nullopt);
}

TEST(SearchPath, FindsPiecesThatShareAFile) {
    MemoryFileSystem files(
        {{"lib/fog.glsl", "// All fogs\n\n#piece linear\na\nb\n\n#piece distance/radial\nc"},
         {"lib/fog/none.glsl", "none"},
         {"own/fog/linear.glsl", "own"},
         {"own/fog.glsl", "d\n#piece linear\ne"}});
    SearchPath search;
    search.add(files, "lib", "lib/", false);
    const auto text = [&](const char* path) { return search.find(path).value().value().text; };
    EXPECT_EQ(search.find("fog/linear.glsl").value(),
              shipped_piece({"lib/fog.glsl#linear", "lib/fog.glsl", "\n\n\na\nb\n\n", false,
                             files.read("lib/fog.glsl").value()}))
        << "lines have the file's numbers, and messages quote them";
    EXPECT_EQ(text("fog/distance/radial.glsl"), "\n\n\n\n\n\n\nc\n");
    EXPECT_EQ(text("fog/none.glsl"), "none");
    EXPECT_EQ(search.find("fog.glsl").value(), std::nullopt) << "it has nothing but a comment of its own";
    EXPECT_EQ(search.find("fog/distance/planar.glsl").value(), std::nullopt);
    EXPECT_EQ(search.find("fog/distance.glsl").value(), std::nullopt);
    EXPECT_THAT(search.all_include_paths(), testing::ElementsAre("fog.glsl", "fog/distance/radial.glsl",
                                                                 "fog/linear.glsl", "fog/none.glsl"));
    SearchPath overridden;
    overridden.add(files, "own", "", true);
    overridden.add(files, "lib", "lib/", false);
    EXPECT_EQ(overridden.find("fog/linear.glsl").value()->text, "own");
    EXPECT_EQ(overridden.find("fog.glsl").value()->text, "d\n");
}

TEST(SearchPath, TakesANamedFileWhateverFolderHoldsAnother) {
    MemoryFileSystem files({{"one/a.frag", "first"}, {"two/a.frag", "second"}, {"one/b.glsl", "b"}});
    SearchPath search;
    search.add(files, "one", "", true);
    search.add_file(files, "two/a.frag");
    EXPECT_EQ(search.find("a.frag").value()->path, "two/a.frag");
    EXPECT_EQ(search.find("b.glsl").value()->path, "one/b.glsl");
    EXPECT_THAT(search.folders(), testing::ElementsAre("one")) << "the file is no folder";
}

class OnDisk : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::create_directories(root + "/inside/deep");
        ASSERT_TRUE(disk.write(root + "/outside.glsl", "outside"));
        ASSERT_TRUE(disk.write(root + "/inside/a.glsl", "a"));
        search.add(disk, root + "/inside", "", true);
    }
    void TearDown() override { std::filesystem::remove_all(root); }

    DiskFileSystem disk;
    std::string root =
        testing::TempDir() + "search_path_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    SearchPath search;
};

TEST_F(OnDisk, LinksWithinTheFolderAreFollowed) {
    std::filesystem::create_symlink("../a.glsl", root + "/inside/deep/link.glsl");
    EXPECT_EQ(search.find("deep/link.glsl").value()->text, "a");
}

TEST_F(OnDisk, LinksOutOfTheFolderAreRefused) {
    std::filesystem::create_symlink("../outside.glsl", root + "/inside/link.glsl");
    std::filesystem::create_directory_symlink("..", root + "/inside/up");
    for (const std::string path : {"link.glsl", "up/outside.glsl"}) {
        const auto found = search.find(path);
        ASSERT_FALSE(found) << path;
        EXPECT_EQ(first_text(found.error()),
                  root + "/inside/" + path + ": error: is a link that leads out of '" + root +
                      "/inside'\n  help: put the piece itself into the folder, name its folder with -I, or "
                      "follow such links with --follow\n");
    }
}

TEST_F(OnDisk, ANamedLinkIsFollowedWhereverItLeads) {
    std::filesystem::create_symlink("../outside.glsl", root + "/inside/link.glsl");
    search.add_file(disk, root + "/inside/link.glsl");
    EXPECT_EQ(search.find("link.glsl").value()->text, "outside");
}

TEST_F(OnDisk, AFolderWhoseNameBeginsAlikeIsOutside) {
    ASSERT_TRUE(disk.write(root + "/inside_not/b.glsl", "b"));
    std::filesystem::create_symlink("../inside_not/b.glsl", root + "/inside/b.glsl");
    EXPECT_FALSE(search.find("b.glsl"));
}

TEST_F(OnDisk, AFolderReachedThroughALinkIsFine) {
    std::filesystem::create_directory_symlink("inside", root + "/alias");
    SearchPath through;
    through.add(disk, root + "/alias", "", true);
    EXPECT_EQ(through.find("a.glsl").value()->text, "a");
}

}  // namespace
}  // namespace gobo
