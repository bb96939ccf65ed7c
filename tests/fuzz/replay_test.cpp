// What libFuzzer kept and what it found, through the same code as it is shipped.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "targets.hpp"

namespace gobo::fuzz {
namespace {

const std::string corpus = GOBO_SOURCE_DIR "/tests/fuzz/corpus/";

std::vector<std::string> inputs_of(const Target& target) {
    const DiskFileSystem disk;
    const std::string folder = corpus + std::string(target.name);
    std::vector<std::string> inputs;
    for (const std::string& file : disk.files_below(folder))
        inputs.push_back(disk.read(folder + "/" + file).value());
    return inputs;
}

class Replay : public testing::TestWithParam<Target> {};

TEST_P(Replay, EndsInAValueOrInErrors) {
    bool is_some_value = false;
    for (const std::string& input : inputs_of(GetParam())) {
        is_some_value = GetParam().run(input) || is_some_value;
        // Half of it is another one, and so is what has another byte in its middle.
        GetParam().run(std::string_view(input).substr(0, input.size() / 2));
        std::string other = input;
        if (!other.empty()) other[other.size() / 2] ^= 0x10;
        GetParam().run(other);
    }
    EXPECT_TRUE(is_some_value) << "what is behind a good input is never reached";
}

/// Bytes changed, repeated, left out and taken from other inputs.
std::string mutated(const std::vector<std::string>& inputs, std::mt19937& random) {
    const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
    std::string input = inputs[below(inputs.size())];
    for (std::size_t change = 1 + below(6); change > 0; --change) {
        const std::size_t at = below(input.size() + 1);
        const std::string& other = inputs[below(inputs.size())];
        const std::size_t from = below(other.size() + 1);
        switch (below(5)) {
            case 0:
                if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
                break;
            case 1:
                input.erase(at, below(32));
                break;
            case 2:
                input.insert(at, other.substr(from, below(64)));
                break;
            case 3:
                input.insert(at, std::string(1 + below(200), "()[]{}!+,.#\"\\ \n\0\xff"[below(17)]));
                break;
            default:
                if (at + 4 <= input.size())
                    input.replace(at, 4, std::string(4, static_cast<char>(below(2) * 255)));
        }
    }
    return input;
}

/// As many as a normal run has time for; more where GOBO_FUZZ_TRIES says so.
TEST_P(Replay, EndsSoForMutantsToo) {
    const std::vector<std::string> inputs = inputs_of(GetParam());
    ASSERT_FALSE(inputs.empty());
    const char* const wanted = std::getenv("GOBO_FUZZ_TRIES");
    const char* const seed = std::getenv("GOBO_FUZZ_SEED");
    const int tries = wanted == nullptr ? 300 : std::atoi(wanted);
    std::mt19937 random(seed == nullptr ? 1U : static_cast<unsigned>(std::atoi(seed)));
    const std::string kept = testing::TempDir() + "gobo_fuzz_" + std::string(GetParam().name);
    for (int i = 0; i < tries; ++i) {
        const std::string input = mutated(inputs, random);
        std::ofstream(kept, std::ios::binary) << input;  // where it ends this program
        GetParam().run(input);
    }
    std::remove(kept.c_str());
}

/// What the targets of headers make of the corpus and of mutants of it, as C++17.
TEST(Headers, Compile) {
    const DiskFileSystem disk;
    const std::string folder = testing::TempDir() + "gobo_fuzz_headers";
    std::filesystem::remove_all(folder);
    ::setenv("GOBO_FUZZ_HEADERS", folder.c_str(), 1);
    std::mt19937 random(1);
    for (const Target& target : kTargets) {
        if (target.name != "header" && target.name != "names") continue;
        const std::vector<std::string> inputs = inputs_of(target);
        for (const std::string& input : inputs) target.run(input);
        for (int i = 0; i < 300; ++i) target.run(mutated(inputs, random));
    }
    ::unsetenv("GOBO_FUZZ_HEADERS");
    EXPECT_GE(disk.files_below(folder).size(), 10U);
    const std::string log = folder + ".log";
    const std::string command =
        fmt::format("'{}/tests/fuzz/compile_headers.sh' '{}' > '{}' 2>&1", GOBO_SOURCE_DIR, folder, log);
    EXPECT_EQ(std::system(command.c_str()), 0) << disk.read(log).value();
}

INSTANTIATE_TEST_SUITE_P(Targets, Replay, testing::ValuesIn(kTargets),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gobo::fuzz
