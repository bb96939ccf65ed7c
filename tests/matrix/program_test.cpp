// Through the executable: an existing shader pair with #ifdef toggles as a family (tests/assets/game), and
// outputs that do not depend on where and how gobo runs.
#include <array>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/text.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Answer {
    int status = 0;
    std::string output;
};

/// Runs a shell command in the source tree's root, `gobo` being the one that was built; errors join the
/// output.
Answer run(const std::string& command) {
    const std::string line = fmt::format("cd {} && export PATH={}:$PATH && ( {} ) 2>&1", GOBO_SOURCE_DIR,
                                         GOBO_PROGRAM_FOLDER, command);
    FILE* pipe = ::popen(line.c_str(), "r");
    Answer answer;
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        answer.output.append(buffer.data(), count);
    const int status = ::pclose(pipe);
    answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return answer;
}

std::string output_of(const std::string& command) {
    const Answer answer = run(command);
    EXPECT_EQ(answer.status, 0) << command << "\n" << answer.output;
    return answer.output;
}

const std::string game = "tests/assets/game/game.toml";

TEST(Game, ListsItsKeys) {
    EXPECT_EQ(output_of("gobo list " + game + " --all --count"), "40\n")
        << "2 x 2 x 2 toggles, 0 to 4 lights";
    EXPECT_EQ(output_of("gobo list " + game + " --all --count --shard 3/3"), "13\n");
    EXPECT_EQ(output_of("gobo list " + game + " --all --where 'lights == 1 && fog == on'"),
              "fog=on lights=1\nfog=on lights=1 texture=on\nfog=on lights=1 rim=on\n"
              "fog=on lights=1 rim=on texture=on\n");
}

TEST(Game, IsValidInItsOwnVersionAndInEveryDialect) {
    for (const std::string dialect : {"", "--dialect 330", "--dialect 450", "--dialect es300"})
        EXPECT_EQ(output_of("gobo check " + game + " --all --spirv-val " + dialect), "") << dialect;
}

TEST(Game, ShowsItsOwnSourceWithItsTogglesSet) {
    const std::string shown = output_of("gobo show " + game + " 'texture=on lights=2' --stage fragment");
    EXPECT_THAT(shown, StartsWith("#version 330 core\n#define NUM_LIGHTS 2\n#define USE_TEXTURE 1\n"));
    EXPECT_THAT(shown, Not(HasSubstr("#define USE_FOG")));
    EXPECT_THAT(output_of("gobo show " + game + " default --stage vertex --dialect 450"),
                StartsWith("#version 450 core\nlayout(location = 0) in "));
    EXPECT_THAT(output_of("gobo show " + game + " default --stage vertex --pieces"),
                testing::EndsWith("prologue\ngame.vert\n"));
    EXPECT_EQ(
        run("gobo show " + game + " 'rim=on lights=4' --stage fragment | glslangValidator --stdin -S frag")
            .status,
        0);
}

TEST(Game, SharesStagesThatDoNotMentionAToggle) {
    EXPECT_EQ(output_of("gobo show " + game + " 'fog=on rim=on lights=3' --stage vertex"),
              output_of("gobo show " + game + " default --stage vertex"));
}

TEST(Game, ReflectsWhatAKeyUses) {
    EXPECT_EQ(output_of("gobo reflect " + game + " 'texture=on lights=2'"),
              "stages: vertex, fragment\n\n"
              "uniforms:\n"
              "  vec3     uAmbient       fragment\n"
              "  vec3     uBaseColor     fragment\n"
              "  vec3     uCameraPos     fragment\n"
              "  Light    uLights[2]     fragment\n"
              "    vec3     position\n"
              "    vec3     color\n"
              "    float    radius\n"
              "  mat4     uModel         vertex\n"
              "  mat3     uNormalMatrix  vertex\n"
              "  mat4     uViewProj      vertex\n\n"
              "samplers:\n"
              "  sampler2D  uAlbedo  fragment\n\n"
              "inputs:\n"
              "  vec3  aNormal    location 1\n"
              "  vec3  aPosition  location 0\n"
              "  vec2  aTexCoord  location 2\n\n"
              "outputs:\n"
              "  vec4  fragColor\n");
    EXPECT_THAT(output_of("gobo reflect " + game + " default"), Not(HasSubstr("uAlbedo")));
}

/// Whatever the number of threads, the folder and the locale.
TEST(Outputs, AreTheSameEverywhere) {
    const std::string commands[] = {"gobo list lit --cover 2", "gobo list lit --cover 2 --json",
                                    "gobo show lit 'point=2 fog=linear depth=less'",
                                    "gobo reflect lit 'spot=1 diffuse=toon' --json",
                                    "gobo check lit --cover 2 --where 'point < 3' --dialect 330"};
    for (const std::string& command : commands) {
        const std::string expected = output_of(command + " -j 1");
        EXPECT_EQ(output_of(command + " -j 2"), expected) << command;
        EXPECT_EQ(output_of("cd /tmp && " + command), expected) << command;
        for (const std::string locale : {"C", "C.UTF-8", "tr_TR.UTF-8", "de_DE.UTF-8"})
            EXPECT_EQ(output_of("LC_ALL=" + locale + " " + command), expected) << command << ", " << locale;
    }
}

/// Errors found by several threads come in the order of the keys.
TEST(Outputs, OfErrorsAreTheSameForAnyNumberOfThreads) {
    const std::string setup =
        "mkdir -p fog && echo 'vec3 throughFog(vec3 radiance) { return wrong; }' > fog/linear.glsl "
        "&& echo 'vec3 throughFog(vec2 radiance) { return radiance; }' > fog/none.glsl && ";
    const auto errors = [&](const std::string& jobs) {
        return run("d=$(mktemp -d) && cd $d && " + setup + "gobo check lit -I . --cover 2 -j " + jobs +
                   "; s=$?; rm -r $d; exit $s");
    };
    const Answer alone = errors("1");
    EXPECT_EQ(alone.status, 1);
    EXPECT_THAT(alone.output, HasSubstr("fog/linear.glsl:1: error: 'wrong' : undeclared identifier ["));
    EXPECT_THAT(alone.output, HasSubstr(" more keys]\n"));
    EXPECT_EQ(errors("4").output, alone.output);
}

TEST(Outputs, OfAKeyGoThroughGlslangValidatorByThemselves) {
    for (const std::string stage : {"vert", "frag"}) {
        const Answer answer = run("gobo show lit 'spot=2 point=1 fog=exponential depth=less' --stage " +
                                  stage + " | glslangValidator -G --stdin -S " + stage + " -o /dev/null");
        EXPECT_EQ(answer.status, 0) << answer.output;
    }
}

TEST(Outputs, CountTheSelectionOfTheEvaluatedMatrix) {
    EXPECT_EQ(
        output_of(
            "gobo list lit --all --count --over shading,directional,point,spot,specular,diffuse,fog,depth "
            "--where 'directional <= 1 && point <= 5 && spot <= 1 && specular != phong && "
            "(fog == none || fog == linear) && (diffuse == lambert || diffuse == toon) && "
            "(shading == fragment || shading == vertex)'"),
        "1668\n");
}

TEST(Shells, AreToldWhatMayComeNext) {
    EXPECT_EQ(output_of("gobo complete bu | cut -f 1"), "build\n");
    EXPECT_EQ(output_of("gobo complete build --na | cut -f 1"), "--namespace\n");
    EXPECT_EQ(output_of("gobo complete build lit --color ''"), "auto\t\nalways\t\nnever\t\n");
    EXPECT_EQ(output_of("gobo complete build lit -o ''"), "") << "the shell offers files";
    EXPECT_EQ(output_of("gobo complete show l"), "lit\t\n");
    EXPECT_EQ(output_of("gobo complete test --sh | cut -f 1"), "--shard\n") << "the lab's options";
}

TEST(Shells, BashCompletesCommandsAndOptions) {
    const std::string script = "share/bash-completion/completions/gobo";
    EXPECT_EQ(output_of("bash -n " + script), "");
    const auto completed = [&](const std::string& words, int current) {
        return output_of(
            fmt::format("bash -c 'source {}; COMP_WORDS=({}); COMP_CWORD={}; _gobo gobo; "
                        "echo \"${{COMPREPLY[*]}}\"'",
                        script, words, current));
    };
    EXPECT_EQ(completed("gobo bu", 1), "build\n");
    EXPECT_EQ(completed("gobo build --na", 2), "--namespace\n");
    EXPECT_EQ(completed("gobo build lit --dialect \"\"", 4), "450 330 es300 vulkan gl_spirv\n");
    EXPECT_EQ(completed("gobo sanitize lit --ro", 3), "--rounding\n");
}

/// Each option of each command, once, in pages that groff formats without a warning.
TEST(Manual, ListsWhatTheHelpLists) {
    for (const std::string program : {"gobo", "gobo-lab"}) {
        const std::string page = output_of(program + " manual");
        EXPECT_THAT(page, StartsWith(".TH "));
        EXPECT_THAT(page, HasSubstr(".SH EXIT STATUS"));
        const std::string formatted =
            " manual | if command -v groff > /dev/null; then groff -man -ww -Tutf8; else cat; fi > /dev/null";
        EXPECT_EQ(output_of(program + formatted), "") << program;
    }
    EXPECT_THAT(output_of("gobo manual"), HasSubstr("\\-\\-namespace"));
    EXPECT_THAT(output_of("gobo manual"), HasSubstr(".SS gobo sanitize\n"));
    EXPECT_THAT(output_of("gobo-lab manual"), HasSubstr("\\-\\-shard"));
}

}  // namespace
}  // namespace gobo
