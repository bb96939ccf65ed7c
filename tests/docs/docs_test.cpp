// The pages of the documentation, followed literally: files are written, commands run, outputs compared.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "page.hpp"
#include "reader.hpp"

namespace gobo {
namespace {

class Page : public testing::TestWithParam<std::string> {};

TEST_P(Page, DoesWhatItSays) {
    const std::vector<PageBlock> blocks =
        blocks_of(text_of_file(fmt::format("{}/{}", GOBO_SOURCE_DIR, GetParam())));
    Reader reader(GOBO_COMMAND);
    // Its figures are those of one version of a driver.
    if (GetParam() == "docs/costs.md" &&
        reader.run("gobo cost --gpu list").printed.find("radv Mesa 22.3.6") == std::string::npos)
        GTEST_SKIP() << "SKIPPED: no mesa-vulkan-drivers 22.3.6, whose figures the page shows";
    int commands_run = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const PageBlock& block = blocks[i];
        SCOPED_TRACE(fmt::format("{}:{}", GetParam(), block.line));
        if (block.language == "diff") {
            ASSERT_EQ(reader.edit(block), "");
        } else if (!block.file.empty()) {
            reader.write(block);
        } else if (block.language == "sh") {
            const CommandResult result = reader.run(block.text);
            ++commands_run;
            ASSERT_EQ(result.status, stated_status(block)) << block.text << result.printed;
            const bool shows_output = i + 1 < blocks.size() && blocks[i + 1].language == "text";
            const std::string shown = shows_output ? blocks[i + 1].text : "";
            ASSERT_TRUE(is_as_shown(shown, result.printed)) << block.text << "-- the page shows:\n"
                                                            << shown << "-- but this was printed:\n"
                                                            << result.printed;
        }
    }
    EXPECT_GT(commands_run, 0) << "a page without commands proves nothing";
}

INSTANTIATE_TEST_SUITE_P(Docs, Page,
                         testing::Values("README.md", "docs/adding_an_effect.md", "docs/command_line.md",
                                         "docs/costs.md", "docs/family_file.md", "docs/formats.md",
                                         "docs/pbr.md", "docs/porting.md", "docs/probes.md",
                                         "docs/scene_format.md", "docs/shadows.md", "docs/study.md",
                                         "docs/vulkan.md"),
                         [](const auto& page) { return std::filesystem::path(page.param).stem().string(); });

}  // namespace
}  // namespace gobo
