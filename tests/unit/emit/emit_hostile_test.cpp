// Whatever a text holds, it stays within the comment, the literal or the name that it is written to.
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic.hpp"
#include "core/text.hpp"
#include "emit/cpp_text.hpp"
#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

/// What ends a comment, a literal or a line in one of the languages that are written; each then names
/// `pwned`.
const std::vector<std::pair<const char*, std::string>> hostile = {
    {"line_end", "a\nint pwned;"},
    {"carriage_return", "a\rint pwned;//"},
    {"windows_line_end", "a\r\nint pwned;\r\n"},
    {"end_of_comment", "a*/int pwned;/*"},
    {"joined_line", "a\\\nint pwned;\n\\"},
    {"backslash", "int pwned;\\"},
    {"quotation_mark", "a\";int pwned;\""},
    {"end_of_raw_literal", "a\n)gobo\";int pwned;R\"gobo("},
    {"end_of_other_raw_literals", "a\n)gobo\")gobo2\")\"))delim\";int pwned;R\"("},
    {"escape", "\x1b[2J\x1b]0;int pwned;\x07"},
    {"trigraph", "a?\?/\nint pwned;?\?/"},
    {"backslash_and_blanks", "a \\ \nint pwned; \\\t"},
    {"line_separator", "a\xE2\x80\xA8int pwned;\xE2\x80\xA9"},
    {"next_line", "a\xC2\x85int pwned;"},
    {"no_utf8", "a\xFF\xC0\xAFint pwned;\x80"},
    {"dollars", "$(pwned) $$ ${pwned} #{pwned}"},
    {"hash", "#define pwned\n#include <pwned>\n # pwned"},
    {"nul", std::string("a\0int pwned;", 12)},
    {"template", "{{pwned}} {{family}} }}"},
    {"braces", "};int pwned;{"},
    {"script", "</script><script>pwned</script><!--"},
    {"attribute", "\" onload='pwned' x=\""},
};

struct Field {
    const char* name;
    void (*fill)(sample::Built& built, const std::string& text);
};

/// Every text that a header and a manifest are made of.
const Field fields[] = {
    {"family", [](auto& built, const auto& text) { built.family.name = text; }},
    {"feature", [](auto& built, const auto& text) { built.family.features[2].name = text; }},
    {"count", [](auto& built, const auto& text) { built.family.features[4].name = text; }},
    {"value", [](auto& built, const auto& text) { built.family.features[2].values[1] = text; }},
    {"enum_name", [](auto& built, const auto& text) { built.family.features[2].enum_name = text; }},
    {"reason", [](auto& built, const auto& text) { built.family.rules.back().reason = text; }},
    {"piece", [](auto& built, const auto& text) { built.composition.pieces.back().name = text; }},
    {"text", [](auto& built, const auto& text) { built.composition.pieces.back().text = text; }},
    {"prologue",
     [](auto& built, const auto& text) {
         built.composition.dialect = Dialect::own;
         built.composition.pieces.front().name = "prologue";
         built.composition.pieces.front().text = "#version 450 " + text;
     }},
    {"block", [](auto& built, const auto& text) { built.interface.blocks.front().name = text; }},
    {"member",
     [](auto& built, const auto& text) { built.interface.blocks.front().members.back().name = text; }},
    {"input",
     [](auto& built, const auto& text) {
         built.interface.inputs.push_back({text, "vec3", 9, {}});
     }},
    {"type",
     [](auto& built, const auto& text) {
         built.interface.inputs.push_back({"odd", text, 9, {}});
     }},
    {"output",
     [](auto& built, const auto& text) {
         built.interface.outputs.push_back({text, "vec4", 5, {}});
     }},
};

std::string header_of(const sample::Built& built) {
    DiskFileSystem files;
    return emit_header(built.input("shaders"),
                       read_header_templates(files, GOBO_SOURCE_DIR "/templates/header").value())
        .value()
        .header;
}

/// C++ without its comments and literals, as a compiler with trigraphs sees it; names become `name`.
std::string bare_cpp(std::string text) {
    for (std::size_t at = text.find("?\?/"); at != std::string::npos; at = text.find("?\?/"))
        text.replace(at, 3, "\\");
    std::string bare;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view rest = std::string_view(text).substr(i);
        if (rest.starts_with("//")) {
            while (i < text.size() && ((text[i] != '\n' && text[i] != '\r') || text[i - 1] == '\\')) ++i;
        } else if (rest.starts_with("R\"")) {
            const std::string end = ")" + std::string(rest.substr(2, rest.find('(') - 2)) + "\"";
            i += rest.find(end) + end.size();
        } else if (rest.starts_with("\"")) {
            for (++i; text[i] != '"'; ++i)
                if (text[i] == '\\') ++i;
            ++i;
        } else {
            bare += text[i++];
        }
    }
    return bare;
}

TEST(HostileText, StaysWithinTheHeader) {
    for (const auto& [name, text] : hostile) {
        for (const Field& field : fields) {
            sample::Built built = sample::lit();
            field.fill(built, text);
            const std::string bare = bare_cpp(header_of(built));
            for (const char* escaped : {"int pwned;", "define pwned", "$(", "</", "\r", "\x1b"})
                EXPECT_EQ(bare.find(escaped), std::string::npos) << name << " as " << field.name;
        }
    }
}

TEST(HostileText, LeavesTheHeaderOneThatCompiles) {
    DiskFileSystem files;
    const std::string folder = testing::TempDir() + "gobo_hostile";
    std::string sources;
    for (std::size_t round = 0; round < 2; ++round) {  // each text in some field, each field with two texts
        sample::Built built = sample::lit();
        for (std::size_t i = 0; i < std::size(fields); ++i)
            fields[i].fill(built, hostile[(i + round * std::size(fields)) % hostile.size()].second);
        ASSERT_TRUE(files.write(fmt::format("{}/{}.hpp", folder, round), header_of(built)));
        ASSERT_TRUE(files.write(fmt::format("{}/{}.cpp", folder, round),
                                fmt::format("#include \"{}.hpp\"\nint pwned;\n", round)));
        sources += fmt::format(" '{}/{}.cpp'", folder, round);
    }
    const std::string command =
        fmt::format("g++ -std=c++17 -trigraphs -fsyntax-only -I'{}/include'{} > '{}/log' 2>&1",
                    GOBO_SOURCE_DIR, sources, folder);
    EXPECT_EQ(std::system(command.c_str()), 0) << files.read(folder + "/log").value();
}

TEST(HostileText, IsReadBackFromTheManifest) {
    for (const auto& [name, text] : hostile) {
        for (const Field& field : fields) {
            sample::Built built = sample::lit();
            field.fill(built, text);
            const auto manifest = nlohmann::json::parse(emit_manifest(built.input()), nullptr, false);
            ASSERT_FALSE(manifest.is_discarded()) << name << " as " << field.name;
            EXPECT_EQ(manifest.size(), 8U) << name << " as " << field.name;
        }
        if (std::string_view(name) == "no_utf8") continue;
        sample::Built built = sample::lit();
        built.family.name = text;
        EXPECT_EQ(nlohmann::json::parse(emit_manifest(built.input()))["family"], text) << name;
    }
}

TEST(HostileText, StaysWithinItsRuleOfTheDepfile) {
    for (const auto& [name, text] : hostile) {
        const std::string depfile = emit_depfile({text}, {text, "b"});
        EXPECT_EQ(depfile.find('\r'), std::string::npos) << name;
        for (std::size_t at = depfile.find('\n'); at + 1 < depfile.size(); at = depfile.find('\n', at + 1)) {
            EXPECT_EQ(depfile.substr(at - 2, 2), " \\") << name << " in " << depfile;
        }
    }
    EXPECT_EQ(emit_depfile({"a\nall: ; pwned"}, {"$(pwned) #"}),
              "a_all\\:\\ ;\\ pwned: \\\n  $$(pwned)\\ \\#\n");
}

TEST(HostileText, StaysWithinCommentsOfCpp) {
    for (const auto& [name, text] : hostile) {
        const std::string comment = cpp_comment(text);
        EXPECT_EQ(comment.size(), text.size()) << name;
        for (const char character : comment)
            EXPECT_TRUE(character == '\t' ||
                        (character >= ' ' && character <= '~' && character != '\\' && character != '?'))
                << name;
    }
}

TEST(HostileText, DoesNotReachTheTerminal) {
    for (const auto& [name, text] : hostile) {
        const Diagnostic diagnostic{Severity::error, Fault::input, {text, 1, 1}, text, text, text, text};
        const std::string printed = to_text(diagnostic);
        for (const char character : printed)
            EXPECT_TRUE(static_cast<unsigned char>(character) >= ' ' || character == '\n' ||
                        character == '\t')
                << name;
        EXPECT_EQ(printed.find("\xC2\x85"), std::string::npos) << name;
        EXPECT_EQ(one_line(text).find_first_of("\n\r"), std::string::npos) << name;
    }
    EXPECT_EQ(printable("\x1b[1mna\xC3\xAFve\t\x7F\n"), "?[1mna\xC3\xAFve\t?\n");
}

}  // namespace
}  // namespace gobo
