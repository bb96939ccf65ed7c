// Generated headers, compiled by both compilers in both standards with every warning an error, and used.
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

struct Compiler {
    const char* name;
    const char* command;
    const char* constant_data_only = "";  ///< refuses what must run before main()
};

class GeneratedHeader : public testing::TestWithParam<Compiler> {
  protected:
    void write_header(const sample::Built& built, const std::string& name) {
        write_header(built, name, name);
    }
    void write_header(const sample::Built& built, const std::string& name, const std::string& cpp_namespace,
                      bool is_split = false) {
        const auto templates = read_header_templates(files_, GOBO_SOURCE_DIR "/templates/header");
        ASSERT_TRUE(templates) << to_text(templates.error().front());
        EmitInput input = built.input(cpp_namespace);
        if (is_split) input.split_from = name + ".hpp";
        const auto emitted = emit_header(input, *templates);
        ASSERT_TRUE(emitted) << to_text(emitted.error().front());
        EXPECT_EQ(emitted->source.empty(), !is_split);
        ASSERT_TRUE(files_.write(fmt::format("{}/{}.hpp", folder_, name), emitted->header));
        ASSERT_TRUE(files_.write(fmt::format("{}/{}.cpp", folder_, name), emitted->source));
    }

    /// Compiles a caller with the headers and runs it: what both print; empty where all is well.
    std::string compile_and_run(const std::string& caller, const std::string& options = {}) {
        const std::string program = fmt::format("{}/{}", folder_, caller);
        const std::string log = program + ".log";
        const std::string command = fmt::format(
            "{} -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Werror {} "
            "-I'{}' "
            "-I'{}/include' "
            "'{}/tests/unit/emit/{}.cpp' -o '{}' > '{}' 2>&1 && '{}' '{}' > '{}' 2>&1",
            GetParam().command, options, folder_, GOBO_SOURCE_DIR, GOBO_SOURCE_DIR, caller, program, log,
            program, folder_, log);
        const int status = std::system(command.c_str());
        const Result<std::string> printed = files_.read(log);
        const std::string text = printed ? *printed : "no log";
        return status == 0 || !text.empty() ? text : "failed without a word";
    }

    DiskFileSystem files_;
    std::string folder_ = fmt::format("{}gobo_generated_header_{}", testing::TempDir(), GetParam().name);
};

TEST_P(GeneratedHeader, WithItsTablesInASourceFileAnswersTheSame) {
    write_header(sample::lit(), "lit");
    write_header(sample::lit(), "split", "split", true);
    EXPECT_EQ(compile_and_run("split_caller", fmt::format("'{}/split.cpp'", folder_)), "");
}

/// As a build that was killed between two renames leaves them.
TEST_P(GeneratedHeader, DoesNotCompileWithASourceFileOfAnotherBuild) {
    write_header(sample::lit(), "lit");
    write_header(sample::lit(), "split", "split", true);
    const Result<std::string> old_source = files_.read(folder_ + "/split.cpp");
    ASSERT_TRUE(old_source);
    sample::Built edited = sample::lit();
    edited.composition.pieces.back().text += "\n";
    write_header(edited, "split", "split", true);
    ASSERT_TRUE(files_.write(folder_ + "/split.cpp", *old_source));
    const std::string said = compile_and_run("split_caller", fmt::format("'{}/split.cpp'", folder_));
    EXPECT_NE(said.find("split.hpp and this file are of two builds: run gobo again"), std::string::npos)
        << said;
}

TEST_P(GeneratedHeader, CompilesWithoutWarningsAndAnswersAsItShould) {
    write_header(sample::lit(), "lit");
    write_header(sample::nasty(), "nasty");
    write_header(sample::bare(), "bare");
    EXPECT_EQ(compile_and_run("header_caller", GetParam().constant_data_only), "");
}

TEST_P(GeneratedHeader, FindsPermutationsByAStateAndRecordsKeys) {
    write_header(sample::lit(), "lit");
    write_header(sample::nasty(), "nasty");
    write_header(sample::bare(), "bare");
    EXPECT_EQ(compile_and_run("state_caller", GetParam().constant_data_only), "");
}

TEST_P(GeneratedHeader, StandsBehindTheMacrosOfPlatforms) {
    write_header(sample::macros(), "macros");
    EXPECT_EQ(compile_and_run("macro_caller", "-DMACROS_FIRST"), "");
    EXPECT_EQ(compile_and_run("macro_caller"), "");
}

TEST_P(GeneratedHeader, HasANamespaceWhateverTheFamilyIsCalled) {
    std::string includes =
        "#include <cmath>\n#include <csignal>\n#include <cstdio>\n#include <ctime>\n#include <unistd.h>\n";
    for (const char* name :
         {"main", "std",  "glm",     "gobo", "log",   "gamma", "time", "tm",        "signal", "index", "y0",
          "int",  "near", "INT_MAX", "NULL", "linux", "4x",    "a b",  "attribute", "detail", "Key"}) {
        sample::Built built = sample::lit();
        built.family.name = name;
        write_header(built, std::string(name) + "_family", "");
        includes += fmt::format("#include \"{}_family.hpp\"\n", name);
    }
    ASSERT_TRUE(files_.write(folder_ + "/families.hpp", includes));
    EXPECT_EQ(compile_and_run("family_caller"), "");
}

TEST_P(GeneratedHeader, StandsBehindAndBeforeXlib) {
    write_header(sample::macros(), "macros");
    EXPECT_EQ(compile_and_run("xlib_caller", "-DXLIB_FIRST"), "");
    EXPECT_EQ(compile_and_run("xlib_caller"), "");
}

TEST_P(GeneratedHeader, TakesElementsOfArraysWhateverGlmsLayout) {
    write_header(sample::arrays(), "arrays");
    EXPECT_EQ(compile_and_run("array_caller"), "");
    EXPECT_EQ(compile_and_run("array_caller", "-DGLM_FORCE_DEFAULT_ALIGNED_GENTYPES"), "");
}

TEST_P(GeneratedHeader, ACallerSurvivesOneFeatureAndOneValueMore) {
    write_header(sample::lit(), "lit");
    EXPECT_EQ(compile_and_run("old_caller"), "");
    write_header(sample::grown_lit(), "lit");
    EXPECT_EQ(compile_and_run("old_caller"), "");
}

TEST_P(GeneratedHeader, BuildsAProgramThroughAnyLoader) {
    write_header(sample::lit(), "lit");
    EXPECT_EQ(compile_and_run("gl_caller"), "");
    EXPECT_EQ(compile_and_run("gl_caller", "-DGLM_FORCE_DEFAULT_ALIGNED_GENTYPES"), "");
}

INSTANTIATE_TEST_SUITE_P(Compilers, GeneratedHeader,
                         testing::Values(Compiler{"gcc17", "g++ -std=c++17"},
                                         Compiler{"gcc20", "g++ -std=c++20"},
                                         Compiler{"clang17", "clang++ -std=c++17", "-Wglobal-constructors"},
                                         Compiler{"clang20", "clang++ -std=c++20", "-Wglobal-constructors"}),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gobo
