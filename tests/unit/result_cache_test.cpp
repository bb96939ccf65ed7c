// Results on disk: found again whole or not at all, and never too many.
#include "core/result_cache.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file_trace.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;

class ResultsOnDisk : public testing::Test {
  protected:
    void SetUp() override { folder = ::mkdtemp(folder.data()); }
    void TearDown() override { fs::remove_all(folder); }
    /// The path of a result.
    [[nodiscard]] std::string path_of(const Digest& key) const {
        return folder + "/" + hex(key).front() + "/" + hex(key) + ".result";
    }
    std::string folder = "/tmp/gobo_results_XXXXXX";
};

Digest key(int number) {
    return digest_of("key " + std::to_string(number));
}

TEST_F(ResultsOnDisk, AreFoundByALaterOne) {
    DiskCache(folder, kMegabyte).keep(key(1), "one");
    DiskCache(folder, kMegabyte).keep(key(2), "");
    DiskCache(folder, kMegabyte).keep(key(1), "uno");
    DiskCache later(folder, kMegabyte);
    EXPECT_EQ(later.find(key(1)), "uno");
    EXPECT_EQ(later.find(key(2)), "");
    EXPECT_EQ(later.find(key(3)), std::nullopt);
}

struct DamageRow {
    const char* name;
    std::function<void(std::string& content)> damage;
};

void PrintTo(const DamageRow& row, std::ostream* stream) {
    *stream << row.name;
}

class Damage : public ResultsOnDisk, public testing::WithParamInterface<DamageRow> {};

TEST_P(Damage, MakesAResultNoneAndRemovesIt) {
    DiskCache cache(folder, kMegabyte);
    cache.keep(key(1), "the result of something");
    std::stringstream whole;
    whole << std::ifstream(path_of(key(1)), std::ios::binary).rdbuf();
    std::string content = whole.str();
    GetParam().damage(content);
    std::ofstream(path_of(key(1)), std::ios::binary | std::ios::trunc) << content;
    EXPECT_EQ(cache.find(key(1)), std::nullopt);
    EXPECT_FALSE(fs::exists(path_of(key(1))));
    cache.keep(key(1), "again");
    EXPECT_EQ(cache.find(key(1)), "again");
}

INSTANTIATE_TEST_SUITE_P(Rows, Damage,
                         testing::Values(DamageRow{"empty", [](auto& content) { content.clear(); }},
                                         DamageRow{"half_a_head", [](auto& content) { content.resize(20); }},
                                         DamageRow{"torn",
                                                   [](auto& content) { content.resize(content.size() - 1); }},
                                         DamageRow{"longer", [](auto& content) { content += 'x'; }},
                                         DamageRow{"other_magic", [](auto& content) { content[0] ^= 1; }},
                                         DamageRow{"other_version", [](auto& content) { content[8] ^= 1; }},
                                         DamageRow{"other_size", [](auto& content) { content[17] ^= 1; }},
                                         DamageRow{"other_sum", [](auto& content) { content[30] ^= 1; }},
                                         DamageRow{"other_byte", [](auto& content) { content.back() ^= 1; }}),
                         [](const auto& row) { return row.param.name; });

TEST_F(ResultsOnDisk, OfAnotherNameAreNone) {
    DiskCache cache(folder, kMegabyte);
    cache.keep(key(1), "one");
    fs::create_directories(fs::path(path_of(key(2))).parent_path());
    fs::copy_file(path_of(key(1)), path_of(key(2)));
    EXPECT_EQ(cache.find(key(2)), std::nullopt);
}

TEST_F(ResultsOnDisk, ThatWereUsedLongestAgoGoFirst) {
    DiskCache cache(folder, 16 * 4096);
    const std::string result(900, 'x');
    std::vector<Digest> of_a_part;  // all of one part of the folder, which may hold four of them
    for (int i = 0; of_a_part.size() < 6; ++i)
        if (hex(key(i)).front() == '0') of_a_part.push_back(key(i));
    const auto now = fs::file_time_type::clock::now();
    for (std::size_t i = 0; i < 5; ++i) {
        cache.keep(of_a_part[i], result);
        fs::last_write_time(path_of(of_a_part[i]), now - std::chrono::hours(10 - i));
    }
    EXPECT_TRUE(cache.find(of_a_part[0])) << "is marked as used";
    cache.keep(of_a_part[5], result);
    EXPECT_THAT(cache.tidy(), testing::IsEmpty());
    std::vector<bool> left;
    for (const Digest& one : of_a_part) left.push_back(cache.find(one).has_value());
    EXPECT_THAT(left, testing::ElementsAre(true, false, false, true, true, true));
}

TEST_F(ResultsOnDisk, DatedInTheFutureGoBeforeWhatIsNew) {
    DiskCache cache(folder, 16 * 4096);
    const std::string result(900, 'x');
    const auto future = fs::file_time_type::clock::now() + std::chrono::hours(24 * 365);
    std::vector<Digest> of_a_part;
    for (int i = 0; of_a_part.size() < 6; ++i)
        if (hex(key(i)).front() == '0') of_a_part.push_back(key(i));
    for (std::size_t i = 0; i < 4; ++i) {
        cache.keep(of_a_part[i], result);
        fs::last_write_time(path_of(of_a_part[i]), future);
    }
    EXPECT_TRUE(cache.find(of_a_part[0])) << "is marked as used";
    EXPECT_LT(fs::last_write_time(path_of(of_a_part[0])), future);
    cache.keep(of_a_part[4], result);
    cache.keep(of_a_part[5], result);
    EXPECT_THAT(cache.tidy(), testing::IsEmpty());
    std::vector<bool> left;
    for (const Digest& one : of_a_part) left.push_back(cache.find(one).has_value());
    EXPECT_TRUE(left[0] && left[4] && left[5]);
    EXPECT_EQ(std::ranges::count(left, true), 4);
}

TEST_F(ResultsOnDisk, ThatDeadWritersLeftAreRemovedWhenTheyAreOld) {
    DiskCache cache(folder, kMegabyte);
    cache.keep(key(1), "one");
    const std::string left = path_of(key(1)) + ".new.1.0";
    const std::string others = fs::path(path_of(key(1))).parent_path().string() + "/notes.txt";
    for (const std::string& path : {left, others}) {
        std::ofstream(path) << "half";
        fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(2));
    }
    cache.keep(key(1), "two");
    EXPECT_THAT(cache.tidy(), testing::IsEmpty());
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(others)) << "is not the cache's";
    EXPECT_EQ(cache.find(key(1)), "two");
}

TEST_F(ResultsOnDisk, AreCountedAndCleared) {
    DiskCache cache(folder, kMegabyte);
    for (int i = 0; i < 40; ++i) cache.keep(key(i), "result");
    EXPECT_EQ(cache.size().results, 40U);
    EXPECT_EQ(cache.size().bytes, 40U * (40 + 6));
    std::ofstream(folder + "/mine.txt") << "stays";
    EXPECT_EQ(cache.clear().results, 40U);
    EXPECT_EQ(cache.size().results, 0U);
    EXPECT_TRUE(fs::exists(folder + "/mine.txt"));
}

TEST_F(ResultsOnDisk, ThatCannotBeWrittenAreWarnedOfOnce) {
    std::ofstream(folder + "/file") << "in the way";
    DiskCache cache(folder + "/file", kMegabyte);
    cache.keep(key(1), "one");
    cache.keep(key(2), "two");
    const Diagnostics warnings = cache.tidy();
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].severity, Severity::warning);
    EXPECT_EQ(cache.find(key(1)), std::nullopt);
}

TEST_F(ResultsOnDisk, AreKeptWhereOthersCannotBe) {
    fs::create_directories(folder);
    std::ofstream(fmt::format("{}/{}", folder, hex(key(1)).front())) << "in the way";
    int other = 2;
    while (hex(key(other)).front() == hex(key(1)).front()) ++other;
    DiskCache cache(folder, kMegabyte);
    cache.keep(key(1), "one");
    cache.keep(key(other), "other");
    const std::string part = fmt::format("{}/{}", folder, hex(key(1)).front());
    EXPECT_EQ(to_text(cache.tidy()),
              part +
                  ": warning: cannot be written: Not a directory\n  help: results of this run are computed "
                  "again by the next; remove what is in their place\n");
    EXPECT_EQ(cache.find(key(other)), "other");
    const std::string warning = part +
                                ": warning: cannot be read: Not a directory\n"
                                "  help: no results are kept there; remove what is in their place\n";
    EXPECT_EQ(cache.size().results, 1U);
    EXPECT_EQ(to_text(cache.size().diagnostics), warning);
    const DiskCache::Size removed = cache.clear();
    EXPECT_EQ(removed.results, 1U);
    EXPECT_EQ(to_text(removed.diagnostics), warning);
    EXPECT_TRUE(fs::exists(part)) << "nothing tells whose it is";
}

struct PlaceRow {
    const char* name;
    std::function<void(const std::string& path)> fill;
    bool is_kept;  ///< a result in that place
    bool is_cleared;
};

void PrintTo(const PlaceRow& row, std::ostream* stream) {
    *stream << row.name;
}

class PlaceOfAResult : public ResultsOnDisk, public testing::WithParamInterface<PlaceRow> {};

TEST_P(PlaceOfAResult, IsMadeFreeWhereNothingIsLost) {
    DiskCache cache(folder, kMegabyte);
    const std::string path = path_of(key(1));
    const auto fill = [&] {
        fs::remove_all(path);
        fs::create_directories(fs::path(path).parent_path());
        GetParam().fill(path);
    };
    fill();
    EXPECT_EQ(cache.find(key(1)), std::nullopt);
    cache.keep(key(1), "one");
    EXPECT_EQ(cache.find(key(1)).has_value(), GetParam().is_kept);
    EXPECT_EQ(to_text(cache.tidy()),
              GetParam().is_kept
                  ? ""
                  : path +
                        ": warning: cannot be written: Is a directory\n  help: results of this "
                        "run are computed again by the next; remove what is in their place\n");
    fill();
    EXPECT_EQ(cache.size().results, 0U);
    EXPECT_EQ(to_text(cache.clear().diagnostics),
              GetParam().is_cleared ? "" : path + ": error: cannot be removed: Directory not empty\n");
    EXPECT_EQ(fs::exists(folder), !GetParam().is_cleared);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, PlaceOfAResult,
    testing::Values(
        PlaceRow{"empty_folder", [](auto& path) { fs::create_directory(path); }, true, true},
        PlaceRow{"full_folder", [](auto& path) { fs::create_directories(path + "/mine"); }, false, false},
        PlaceRow{"link_to_nowhere", [](auto& path) { fs::create_symlink(path, path); }, true, true},
        PlaceRow{"pipe", [](auto& path) { ::mkfifo(path.c_str(), 0600); }, true, true}),
    [](const auto& row) { return row.param.name; });

TEST_F(ResultsOnDisk, MayBeKeptByManyAtOnce) {
    constexpr int kWriters = 4;
    constexpr int kResults = 50;
    std::vector<pid_t> writers;
    for (int writer = 0; writer < kWriters; ++writer) {
        const pid_t process = ::fork();
        if (process == 0) {
            DiskCache cache(folder, 100 * kMegabyte);
            bool is_right = true;
            for (int i = 0; i < kResults; ++i) {
                const std::string result(10'000, static_cast<char>('a' + i % 26));
                const auto found = cache.find(key(i));
                is_right = is_right && (!found || *found == result);
                cache.keep(key(i), result);
            }
            ::_exit(is_right && cache.tidy().empty() ? 0 : 1);
        }
        writers.push_back(process);
    }
    for (const pid_t writer : writers) {
        int status = 0;
        ::waitpid(writer, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    EXPECT_EQ(DiskCache(folder, kMegabyte).size().results, std::uint64_t{kResults});
}

TEST(TracedFiles, AreAnsweredAlikeUntilOneChanges) {
    struct Change {
        const char* name;
        std::function<void(MemoryFileSystem&)> change;
        bool is_alike;
    };
    const std::vector<Change> changes = {
        {"none", [](MemoryFileSystem&) {}, true},
        {"a file that nobody asked for", [](auto& files) { (void)files.write("other", "x"); }, true},
        {"a file that was read", [](auto& files) { (void)files.write("lib/a.glsl", "x"); }, false},
        {"a file that was not there", [](auto& files) { (void)files.write("lib/b.glsl", "x"); }, false},
        {"a file that could not be read", [](auto& files) { (void)files.write("lib/c.glsl", "x"); }, false},
        {"a file in a folder that was listed", [](auto& files) { (void)files.write("all/d", "x"); }, false},
    };
    for (const Change& change : changes) {
        MemoryFileSystem files({{"lib/a.glsl", "a"}, {"all/one", ""}});
        TracedFiles traced(files);
        EXPECT_TRUE(traced.read("lib/a.glsl"));
        EXPECT_FALSE(traced.is_file("lib/b.glsl"));
        EXPECT_FALSE(traced.read("lib/c.glsl"));
        EXPECT_EQ(traced.files_below("all").size(), 1U);
        EXPECT_TRUE(traced.is_repeatable());
        change.change(files);
        EXPECT_EQ(are_answered_alike(traced.questions(), files), change.is_alike) << change.name;
    }
}

TEST(TracedFiles, StayAsTheyWereFirstSeenUntilWrittenThroughThem) {
    MemoryFileSystem files({{"a", "first"}, {"c", ""}});
    TracedFiles traced(files);
    EXPECT_EQ(traced.read("a").value_or(""), "first");
    EXPECT_FALSE(traced.is_file("b"));
    EXPECT_TRUE(files.write("a", "second"));
    EXPECT_TRUE(files.write("b", ""));
    EXPECT_EQ(traced.read("a").value_or(""), "first");
    EXPECT_FALSE(traced.is_file("b"));
    EXPECT_FALSE(are_answered_alike(traced.questions(), files));
    EXPECT_TRUE(traced.write("a", "third"));
    EXPECT_EQ(traced.read("a").value_or(""), "third");
    EXPECT_TRUE(traced.is_file("b"));
}

TEST(TracedFiles, AreNotRepeatableWhereSomethingIsWrittenOrAStreamIsRead) {
    DiskFileSystem disk;
    TracedFiles device(disk);
    EXPECT_TRUE(device.read("/dev/null"));
    EXPECT_FALSE(device.is_repeatable());
    EXPECT_EQ(device.read_once(), "/dev/null");
    MemoryFileSystem files;
    TracedFiles written(files);
    EXPECT_TRUE(written.write("a", "b"));
    EXPECT_FALSE(written.is_repeatable());
}

}  // namespace
}  // namespace gobo
