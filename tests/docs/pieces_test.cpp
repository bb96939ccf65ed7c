// Every piece of the library tells what it is: model id, equation, source, spaces or ranges, edges.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The comment that a piece begins with, and what follows it.
std::pair<std::string, std::string> split_header(const std::string& text) {
    std::size_t end = 0;
    while (text.compare(end, 2, "//") == 0 && text.compare(end, 3, "///") != 0) {
        const std::size_t newline = text.find('\n', end);
        end = newline == std::string::npos ? text.size() : newline + 1;
    }
    return {text.substr(0, end), text.substr(end)};
}

/// Whether a line begins with `// Label:`, or with a list of labels that has it, or a sentence does.
bool tells(const std::string& header, const std::string& label) {
    const std::regex pattern("(// |\\. )(\\w+, )*" + label + "s?(, \\w+)*:", std::regex::icase);
    return std::regex_search(header, pattern);
}

/// Nothing but includes: what it says is said there.
bool only_includes(const std::string& text) {
    static const std::regex line("^(#include.*|//.*|\\s*)$");
    std::istringstream lines(text);
    for (std::string one; std::getline(lines, one);)
        if (!std::regex_match(one, line)) return false;
    return true;
}

/// What a piece's header leaves out. One that stands for the absence of a model names the model alone.
std::vector<std::string> left_out(const std::string& piece) {
    const auto [header, rest] = split_header(piece);
    if (only_includes(rest)) return {};
    std::vector<std::string> missing;
    static const std::regex id("[(, ][LSEFD][0-9]+[,);: ]");
    if (!std::regex_search(header, id)) missing.push_back("model id");
    if (header.find("not asked for") != std::string::npos) return missing;
    for (const char* label : {"model", "source", "edge"})
        if (!tells(header, label)) missing.push_back(label);
    if (!tells(header, "space") && !tells(header, "range")) missing.push_back("space or range");
    return missing;
}

TEST(PieceHeader, IsReadLineByLine) {
    EXPECT_THAT(left_out("// Fog.\nfloat f;\n"),
                ElementsAre("model id", "model", "source", "edge", "space or range"));
    EXPECT_THAT(left_out("// Fog (F1).\n// Model, source, range, edges: fog().\nfloat f;\n"), IsEmpty());
    EXPECT_THAT(
        left_out("// Fog (F1).\n// Model:  a.\n// Source: b.\n// Space:  eye. Edges: none.\nfloat f;\n"),
        IsEmpty());
    EXPECT_THAT(left_out("// Fog (F1).\n/// Model, source, range: not the header.\nfloat f;\n"),
                testing::SizeIs(4));
    EXPECT_THAT(left_out("// Clear air (F1 is not asked for).\nfloat f;\n"), IsEmpty());
    EXPECT_THAT(left_out("// As fog.\n#include \"fog.glsl\"\n"), IsEmpty());
}

TEST(Pieces, TellModelEquationSourceRangesAndEdges) {
    const DiskFileSystem disk;
    const std::string folder = GOBO_SOURCE_DIR "/shader_lib";
    const std::vector<std::string> pieces = disk.files_below(folder);
    EXPECT_GT(pieces.size(), 150U);
    for (const std::string& piece : pieces)
        EXPECT_THAT(left_out(disk.read(folder + "/" + piece).value()), IsEmpty()) << piece;
}

}  // namespace
}  // namespace gobo
