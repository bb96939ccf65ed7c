// Every piece of the library says what it is: a head that tells the model and its source, and a comment at
// each function.
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Pieces that compute no model of their own: they hand a value on.
const std::vector<std::string> kWithoutModel = {
    "directional_shadows/directional_shadows.glsl", "point_shadows/point_shadows.glsl",
    "spot_shadows/spot_shadows.glsl", "shading/directional_ray.glsl", "shading/halfway.glsl"};

bool matches(const std::string& text, const std::string& pattern) {
    return std::regex_search(text, std::regex(pattern));
}

/// What a piece leaves out, or says in vain.
std::vector<std::string> faults_of(const std::string& piece, bool has_model) {
    std::vector<std::string> faults;
    if (!piece.starts_with("// ")) faults.push_back("no head");
    if (has_model && piece.find("Source:") == std::string::npos) faults.push_back("no source");
    if (matches(piece, "// (.*[.] )?(Edges?|Ranges?|Spaces?|Model): *(none|as the others?)\\b"))
        faults.push_back("a line that says nothing");
    if (matches(piece, "[(, ](H-[A-Z]+|[SEFD])[0-9]+[,);: ]")) faults.push_back("a code for a name");
    std::istringstream lines(piece);
    std::string before;
    for (std::string line; std::getline(lines, line); before = line)
        if (matches(line, "^(void|float|int|bool|vec[234]|mat[34]) \\w+\\(.*\\{") &&
            !before.starts_with("//"))
            faults.push_back("no comment at: " + line);
    return faults;
}

TEST(PieceHead, IsReadLineByLine) {
    EXPECT_THAT(faults_of("float f;\n", true), ElementsAre("no head", "no source"));
    EXPECT_THAT(faults_of("// Fog. Source: a book.\n/// The factor.\nfloat f() { return 1.0; }\n", true),
                IsEmpty());
    EXPECT_THAT(faults_of("// Fog.\n\nfloat f() { return 1.0; }\n", false),
                ElementsAre("no comment at: float f() { return 1.0; }"));
    EXPECT_THAT(faults_of("// Fog (F1).\n// Space:  eye. Edges: none.\n", false),
                ElementsAre("a line that says nothing", "a code for a name"));
}

TEST(Pieces, TellModelSourceAndEachFunction) {
    const DiskFileSystem disk;
    const std::string folder = GOBO_SOURCE_DIR "/shader_lib";
    const std::vector<std::string> pieces = disk.files_below(folder);
    EXPECT_GT(pieces.size(), 40U);
    EXPECT_LE(pieces.size(), 120U) << "values of a feature that are short belong in one file";
    for (const std::string& piece : pieces) {
        const bool has_model =
            std::find(kWithoutModel.begin(), kWithoutModel.end(), piece) == kWithoutModel.end();
        EXPECT_THAT(faults_of(disk.read(folder + "/" + piece).value(), has_model), IsEmpty()) << piece;
    }
}

}  // namespace
}  // namespace gobo
