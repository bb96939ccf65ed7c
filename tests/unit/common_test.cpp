#include <algorithm>
#include <atomic>
#include <filesystem>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "core/bytes.hpp"
#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/text_template.hpp"
#include "core/write_together.hpp"

namespace gobo {
namespace {

TEST(Diagnostic, PrintsPlaceMessageSubjectQuotationAndHelp) {
    Diagnostic diagnostic;
    diagnostic.place = {"shader_lib/fog/linear.glsl", 12, 5};
    diagnostic.message = "unknown function 'mxi'";
    diagnostic.subject = "fog=linear point=3";
    diagnostic.quoted_line = "\tvec mxi(1)";
    diagnostic.help = "did you mean 'mix'?";
    EXPECT_EQ(to_text(diagnostic),
              "shader_lib/fog/linear.glsl:12:5: error: unknown function 'mxi' [fog=linear point=3]\n"
              "    \tvec mxi(1)\n"
              "    \t   ^\n"
              "  help: did you mean 'mix'?\n");
}

TEST(Diagnostic, ExitStatusIsThatOfTheGravestFault) {
    const Diagnostics none;
    EXPECT_EQ(exit_status(none), 0);
    Diagnostics several(2);
    several[0].fault = Fault::file;
    several[1].fault = Fault::usage;
    EXPECT_EQ(exit_status(several), 3);
    several[0].severity = Severity::warning;
    EXPECT_EQ(exit_status(several), 2);
}

struct LongRow {
    const char* name;
    std::string line;
    int column;
    std::string shown;  ///< the quoted line and the caret
};

TEST(Diagnostic, QuotesOfALongLineWhatStandsAroundTheColumn) {
    const std::string blanks(119, ' ');
    const LongRow rows[] = {
        {"begin", std::string(300, 'a'), 3, "    " + std::string(240, 'a') + "...\n      ^\n"},
        {"no_column", std::string(300, 'a'), 0, "    " + std::string(240, 'a') + "...\n"},
        {"beyond_its_end", std::string(300, 'a'), 500, "    " + std::string(240, 'a') + "...\n"},
        {"middle", std::string(499, 'a') + "b" + std::string(500, 'c'), 500,
         "    ..." + std::string(119, 'a') + "b" + std::string(120, 'c') + "...\n       " + blanks + "^\n"},
        {"end", std::string(999, 'a') + "b", 1000,
         "    ..." + std::string(119, 'a') + "b\n       " + blanks + "^\n"},
        {"characters_stay_whole", std::string(239, 'a') + "\xC3\xA9" + "b", 0,
         "    " + std::string(239, 'a') + "...\n"},
    };
    for (const LongRow& row : rows) {
        Diagnostic diagnostic;
        diagnostic.message = "x";
        diagnostic.place.column = row.column;
        diagnostic.quoted_line = row.line;
        EXPECT_EQ(to_text(diagnostic), "gobo: error: x\n" + row.shown) << row.name;
    }
}

TEST(Diagnostic, NeverPrintsMoreThanCanBeRead) {
    const std::string million(1'000'000, 'm');
    const Diagnostic diagnostic{.place = {million, 1, 1},
                                .message = million,
                                .quoted_line = million,
                                .help = million,
                                .subject = million};
    const std::string text = to_text(diagnostic);
    EXPECT_LT(text.size(), 6000U);
    EXPECT_NE(text.find("m [... 998500 bytes ...] m"), std::string::npos) << text;
}

TEST(Text, OfATerminalDoesNothing) {
    const std::pair<const char*, const char*> rows[] = {
        {"plain\ttext\n", "plain\ttext\n"},
        {"na\xC3\xAFve \xE2\x82\xAC \xF0\x9F\x98\x80", "na\xC3\xAFve \xE2\x82\xAC \xF0\x9F\x98\x80"},
        {"\x1b[1mred\x07\r", "?[1mred??"},
        {"\xC2\x9B"
         "1m",
         "?1m"},  // the escape sequence as one character
        {"a\xE2\x80\xAE"
         "b\xE2\x81\xA6"
         "c",
         "a?b?c"},  // right to left
        {"a\xE2\x80\xA8"
         "b",
         "a?b"},  // a line end of Unicode
        {"\x9B"
         "1m \xFF \xC3",
         "?1m ? ?"},  // no UTF-8
        {"\xC3(\xED", "?(?"},
    };
    for (const auto& [text, expected] : rows) EXPECT_EQ(printable(text), expected) << expected;
}

TEST(Text, FolderOfAPath) {
    EXPECT_EQ(folder_of("some/folder/tiny.toml"), "some/folder");
    EXPECT_EQ(folder_of("tiny.toml"), "");
    EXPECT_EQ(folder_of("/tiny.toml"), "/");
}

TEST(Text, NumbersAreTheWholeText) {
    EXPECT_EQ(number_from<int>("-12"), -12);
    EXPECT_EQ(number_from<double>("2.5e1"), 25.0);
    for (const char* text : {"", "-", " 1", "1 ", "+1", "1.5", "0x1", "99999999999"})
        EXPECT_FALSE(number_from<int>(text)) << text;
    EXPECT_FALSE(number_from<std::size_t>("-1"));
    EXPECT_EQ(pair_from("640x480", 'x'), std::pair(std::size_t{640}, std::size_t{480}));
    for (const char* text : {"", "x", "640", "640x", "x480", "640x480x2", "640/480", "-1x2"})
        EXPECT_FALSE(pair_from(text, 'x')) << text;
}

TEST(Text, SubscriptsOfANameAreEmptied) {
    EXPECT_EQ(without_subscripts("lights[12].rows[0][1]"), "lights[].rows[][]");
    EXPECT_EQ(without_subscripts("lights"), "lights");
}

TEST(Bytes, HoldWhatIsThereAndWhatIsMissing) {
    using Value = std::pair<std::optional<int>, Result<std::string>>;
    Diagnostics errors(2);
    errors[1].message = "no file";
    const Result<std::string> missing = tl::unexpected(errors);
    for (const Value& value : {Value{3, "a"}, Value{std::nullopt, ""}, Value{std::nullopt, missing}}) {
        const auto read = from_bytes<Value>(to_bytes(value));
        ASSERT_TRUE(read);
        EXPECT_EQ(read->first, value.first);
        ASSERT_EQ(read->second.has_value(), value.second.has_value());
        if (value.second)
            EXPECT_EQ(*read->second, *value.second);
        else
            EXPECT_EQ(to_text(read->second.error()), to_text(errors));
        const std::string bytes = to_bytes(value);
        for (std::size_t size = 0; size < bytes.size(); ++size)
            EXPECT_FALSE(from_bytes<Value>(bytes.substr(0, size))) << size;
        EXPECT_FALSE(from_bytes<Value>(bytes + 'x'));
    }
}

TEST(ParallelFor, CallsEachIndexOnce) {
    for (const int jobs : {1, 2, 7, 100}) {
        std::vector<std::atomic<int>> calls(20);
        parallel_for(jobs, calls.size(), [&](std::size_t i) { ++calls[i]; });
        EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](int count) { return count == 1; })) << jobs;
        parallel_for(jobs, 0, [&](std::size_t) { FAIL(); });
    }
}

TEST(ParallelFor, ThrowsWhereMemoryEnds) {
    for (const int jobs : {1, 4})
        EXPECT_THROW(parallel_for(jobs, 100,
                                  [](std::size_t i) {
                                      if (i == 30) throw std::bad_alloc();
                                  }),
                     std::bad_alloc);
}

TEST(Text, NearestNeedsFewEdits) {
    const std::vector<std::string> names = {"linear", "exponential", "exponential_squared"};
    EXPECT_EQ(nearest("linaer", names), "linear");
    EXPECT_EQ(nearest("exponental", names), "exponential");
    EXPECT_EQ(nearest("purple", names), std::nullopt);
    EXPECT_EQ(nearest(std::string(3'000'000, 'a'), {std::string(2'999'999, 'a')}), std::nullopt) << "at once";
}

TEST(DiskFileSystem, AFullDiskIsAnError) {
    DiskFileSystem files;
    const Result<bool> written = files.write("/dev/full", "some text");
    ASSERT_FALSE(written);
    EXPECT_EQ(to_text(written.error().front()),
              "/dev/full: error: cannot be written: No space left on device\n");
    EXPECT_EQ(exit_status(written.error()), 3);
}

class Together : public testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(root); }
    void TearDown() override { std::filesystem::remove_all(root); }
    /// What lies in the folder, with its text.
    [[nodiscard]] std::string listing() const {
        std::string text;
        for (const std::string& file : DiskFileSystem().files_below(root))
            text += file + "=" + DiskFileSystem().read(root + "/" + file).value() + " ";
        return text;
    }

    std::string root =
        testing::TempDir() + "together_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Together, AllOrNone) {
    EXPECT_TRUE(write_together({{root + "/a/one", "1"}, {root + "/two", "2"}}).value());
    EXPECT_EQ(listing(), "a/one=1 two=2 ");
    EXPECT_FALSE(write_together({{root + "/a/one", "1"}, {root + "/two", "2"}}).value()) << "nothing to do";
    EXPECT_TRUE(write_together({{root + "/a/one", "3"}, {root + "/two", "2"}}).value());
    EXPECT_EQ(listing(), "a/one=3 two=2 ");
    std::filesystem::create_directory(root + "/folder");
    const auto refused =
        write_together({{root + "/a/one", "4"}, {root + "/folder", "5"}, {root + "/two", "6"}});
    ASSERT_FALSE(refused);
    EXPECT_EQ(to_text(refused.error().front()), root + "/folder: error: cannot be written: Is a directory\n");
    EXPECT_EQ(listing(), "a/one=3 two=2 ");
}

TEST_F(Together, NoFolderIsLeftWithoutFiles) {
    std::filesystem::create_directory(root + "/folder");
    EXPECT_FALSE(write_together({{root + "/folder", "1"}, {root + "/new/deep/two", "2"}}));
    EXPECT_FALSE(std::filesystem::exists(root + "/new"));
    EXPECT_TRUE(write_together({{root + "/one", "1"}, {root + "/new/deep/two", "2"}}));
    EXPECT_TRUE(std::filesystem::exists(root + "/new/deep/two"));
}

TEST_F(Together, WhatADeadWriterLeftGoes) {
    DiskFileSystem disk;
    for (const char* text : {"1", "1", "2"}) {
        for (const char* file : {"/one.gobo-new", "/two.gobo-new"})
            std::fclose(std::fopen((root + file).c_str(), "w"));
        ASSERT_TRUE(write_together({{root + "/one", text}, {root + "/two", "2"}}));
        EXPECT_EQ(listing(), std::string("one=") + text + " two=2 ");
    }
}

TEST_F(Together, ALinkIsReplacedNotFollowed) {
    ASSERT_TRUE(DiskFileSystem().write(root + "/victim", "mine"));
    std::filesystem::create_symlink("victim", root + "/one");
    EXPECT_TRUE(write_together({{root + "/one", "1"}}).value());
    EXPECT_EQ(listing(), "one=1 victim=mine ");
    std::filesystem::create_symlink("victim", root + "/two.gobo-new");
    EXPECT_EQ(to_text(write_together({{root + "/two", "2"}}).error().front()),
              root + "/two.gobo-new: error: cannot be written: Too many levels of symbolic links\n");
    EXPECT_EQ(DiskFileSystem().read(root + "/victim").value(), "mine");
}

TEST(TextTemplate, APlaceholderWithoutValueIsAFaultOfOurOwn) {
    const TextTemplate text_template{"header.hpp.in", "one {{known}}\ntwo {{unknown}}\n"};
    const auto text = fill(text_template, {{"known", "1"}});
    ASSERT_FALSE(text);
    EXPECT_EQ(to_text(text.error().front()),
              "header.hpp.in:2: error: the placeholder 'unknown' has no value\n"
              "    two {{unknown}}\n");
    EXPECT_EQ(exit_status(text.error()), 4);
}

}  // namespace
}  // namespace gobo
