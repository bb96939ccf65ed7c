#include "validate/depth_layouts.hpp"

#include <algorithm>
#include <array>

#include <spirv/unified1/spirv.hpp>

#include "compose/dialect.hpp"
#include "compose/tokens.hpp"

namespace gobo {
namespace {

struct Layout {
    std::string_view name;
    std::uint32_t mode;
};

constexpr std::array<Layout, 4> kLayouts = {{{"depth_any", 0},
                                             {"depth_greater", spv::ExecutionModeDepthGreater},
                                             {"depth_less", spv::ExecutionModeDepthLess},
                                             {"depth_unchanged", spv::ExecutionModeDepthUnchanged}}};

/// Tokens of `layout(depth_less) out float gl_FragDepth;`, or of DEPTH(...), which stands for it.
constexpr std::size_t kTokens = 8;

/// The layout of such a declaration that begins there, whose texts `at` gives.
const Layout* layout_at(const auto& at) {
    if ((at(0) != "layout" && at(0) != "DEPTH") || at(1) != "(" || at(3) != ")" || at(4) != "out" ||
        at(5) != "float" || at(6) != "gl_FragDepth" || at(7) != ";")
        return nullptr;
    const auto* const found = std::ranges::find(kLayouts, at(2), &Layout::name);
    return found == kLayouts.end() ? nullptr : found;
}

}  // namespace

bool takes_depth_layouts(std::string_view prologue) {
    const GlslVersion version = version_of(prologue);
    return !version.es && version.number >= 130 && version.number < 420 &&
           (prologue.find("GL_ARB_conservative_depth :") != std::string_view::npos ||
            prologue.find("GL_AMD_conservative_depth :") != std::string_view::npos);
}

std::string without_depth_layouts(std::string text) {
    if (text.find("gl_FragDepth") == std::string::npos) return text;
    const std::vector<std::string_view> tokens = tokens_of(text);
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
    for (std::size_t i = 0; i + kTokens <= tokens.size(); ++i) {
        if (layout_at([&](std::size_t offset) { return tokens[i + offset]; }) == nullptr) continue;
        const auto place = [&](std::string_view token) {
            return static_cast<std::size_t>(token.data() - text.data());
        };
        ranges.emplace_back(place(tokens[i]), place(tokens[i + kTokens - 1]) + 1);
    }
    for (const auto& [begin, end] : ranges)
        for (std::size_t i = begin; i < end; ++i)
            if (text[i] != '\n') text[i] = ' ';
    return text;
}

std::optional<std::uint32_t> depth_mode(const ActiveText& text) {
    for (std::size_t i = 0; i < text.tokens.size(); ++i)
        if (const Layout* const layout = layout_at([&](std::size_t offset) { return text.at(i + offset); }))
            return layout->mode == 0 ? std::nullopt : std::optional(layout->mode);
    return std::nullopt;
}

SpirvModule with_depth_mode(SpirvModule module, std::uint32_t mode) {
    constexpr std::size_t kHeader = 5;
    for (std::size_t at = kHeader; at + 1 < module.size();
         at += std::max(module[at] >> spv::WordCountShift, 1U)) {
        if ((module[at] & spv::OpCodeMask) != spv::OpExecutionMode) continue;
        const std::array<std::uint32_t, 3> words = {3U << spv::WordCountShift | spv::OpExecutionMode,
                                                    module[at + 1], mode};
        module.insert(module.begin() + static_cast<std::ptrdiff_t>(at), words.begin(), words.end());
        break;
    }
    return module;
}

}  // namespace gobo
