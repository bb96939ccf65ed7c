#include "link_row.hpp"

#include <cstdio>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "lab/render/program.hpp"
#include "small_families.hpp"
#include "validate/validate.hpp"

namespace gobo {

using testing::HasSubstr;

void PrintTo(const LinkRow& row, std::ostream* stream) {
    *stream << row.name;
}

Diagnostics checked(const std::string& vertex, const std::string& fragment) {
    const std::map<std::string, std::string, std::less<>> files = {{"tiny.vert", vertex},
                                                                   {"tiny.frag", fragment}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("");
    const Composition composition = compose(family, {{}}, search, Dialect::own).value();
    return validate(family, composition, {}).diagnostics;
}

namespace {

/// Of a context of Mesa's: 22 of "4.5 (Core Profile) Mesa 22.3.6".
int mesa_version(const Context& context) {
    const auto* const text = reinterpret_cast<const char*>(context.gl().GetString(GL_VERSION));
    int version = 0;
    std::sscanf(std::strstr(text, "Mesa "), "Mesa %d", &version);
    return version;
}

}  // namespace

void expect_verdicts(const LinkRow& row) {
    const std::string head = std::string("#version ") + row.version + "\n";
    const bool is_es = head.ends_with("es\n") || head.ends_with(" 100\n");
    const std::string vertex = head + row.vertex;
    const std::string fragment = head + (is_es ? "precision highp float;\n" : "") + row.fragment;
    const Diagnostics found = checked(vertex, fragment);
    ASSERT_EQ(found.size(), row.messages.size()) << to_text(found);
    for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_THAT(to_text(found[i]), HasSubstr(row.messages[i])) << to_text(found);
    EXPECT_EQ(exit_status(found), row.mesa == Mesa::links ? 0 : 1) << to_text(found);

    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context.has_value());
    const Result<Program> program =
        link_program(*context, {stage_text(StageKind::vertex, "tiny.vert", vertex),
                                stage_text(StageKind::fragment, "tiny.frag", fragment)});
    const bool is_refused =
        row.mesa == Mesa::refuses || (row.mesa == Mesa::older_refuses && mesa_version(*context) < 25);
    EXPECT_EQ(program.has_value(), !is_refused) << (program ? "it links" : to_text(program.error().front()));
}

}  // namespace gobo
