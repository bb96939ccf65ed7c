// What libFuzzer kept and what it found, through the same code as it is shipped.
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "targets.hpp"

namespace gobo::fuzz {
namespace {

const std::string corpus = GOBO_SOURCE_DIR "/tests/fuzz/corpus/";

class Replay : public testing::TestWithParam<Target> {};

TEST_P(Replay, EndsInAValueOrInErrors) {
    const DiskFileSystem disk;
    const std::string folder = corpus + std::string(GetParam().name);
    const std::vector<std::string> files = disk.files_below(folder);
    EXPECT_FALSE(files.empty());
    for (const std::string& file : files) {
        SCOPED_TRACE(file);
        const std::string input = disk.read(folder + "/" + file).value();
        GetParam().run(input);
        // Half of it is another one, and so is what has another byte in its middle.
        GetParam().run(std::string_view(input).substr(0, input.size() / 2));
        std::string other = input;
        if (!other.empty()) other[other.size() / 2] ^= 0x10;
        GetParam().run(other);
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, Replay, testing::ValuesIn(kTargets),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gobo::fuzz
