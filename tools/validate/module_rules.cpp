#include "validate/module_rules.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <spirv/unified1/spirv.hpp>

#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/declaration.hpp"

namespace gobo {
namespace {

/// What the validator says first, with the instruction that it is about; nothing of a valid module.
std::optional<std::string> refusal_of(const std::vector<std::uint32_t>& module, spv_target_env environment) {
    std::string said;
    spvtools::SpirvTools tools(environment);
    tools.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
            if (level <= SPV_MSG_ERROR && said.empty()) said = message;
        });
    if (tools.Validate(module)) return std::nullopt;
    return said.empty() ? "it does not say why" : said;
}

/// A name of the source among those that the validator writes as "%name".
Declaration declaration_in(std::string_view said, const std::vector<const Piece*>& pieces) {
    for (auto at = said.find('%'); at != std::string_view::npos; at = said.find('%', at + 1)) {
        std::size_t end = at + 1;
        while (end < said.size() && is_identifier_part(said[end])) ++end;
        const std::string_view name = said.substr(at + 1, end - at - 1);
        if (name.empty() || name == "main") continue;
        if (Declaration found = declaration_of(name, "", pieces); found.place.line > 0) return found;
    }
    return {{pieces.back()->path, 0, 0}, "", false};
}

/// The first line that has a word which begins as one of these.
Declaration first_use(std::initializer_list<std::string_view> beginnings,
                      const std::vector<const Piece*>& pieces) {
    for (const Piece* const piece : pieces)
        for (const std::string_view token : tokens_of(piece->text))
            if (std::ranges::any_of(beginnings, [&](auto begins) { return token.starts_with(begins); }))
                return declaration_of(token, "", pieces);
    return {{pieces.back()->path, 0, 0}, "", false};
}

}  // namespace

Diagnostics check_module(const std::vector<std::uint32_t>& module, spv_target_env environment,
                         const std::vector<const Piece*>& pieces) {
    const std::optional<std::string> said = refusal_of(module, environment);
    if (!said) return {};
    const bool is_vulkan = environment == SPV_ENV_VULKAN_1_0;
    const char* const api = is_vulkan ? "Vulkan 1.0" : "OpenGL's SPIR-V";
    const auto says = [&](std::string_view text) { return said->find(text) != std::string::npos; };
    if (const Declaration scalar = use_of("scalar", pieces); says("layout rules") && scalar.place.line > 0)
        return {diagnostic_at(scalar, Severity::error, fmt::format("{} has no layout(scalar)", api),
                              "declare the block layout(std140), or a buffer layout(std430)")};
    const std::string first = said->substr(0, said->find('\n'));
    return {diagnostic_at(
        declaration_in(*said, pieces), Severity::error,
        fmt::format("SPIRV-Tools' validator refuses the stage for {}: {}", api, trim(first)),
        fmt::format("{} does not have what this asks for, or glslang made a mistake: write it another way",
                    api))};
}

Result<void> refuse_optimized(const std::vector<std::uint32_t>& module, spv_target_env environment) {
    if (const std::optional<std::string> said = refusal_of(module, environment))
        return fail(
            Fault::internal,
            fmt::format("SPIRV-Tools' optimizer makes a module that its validator refuses: {}", *said),
            "build without --optimize");
    return {};
}

spv_target_env environment_of(Dialect dialect) {
    return dialect == Dialect::vulkan ? SPV_ENV_VULKAN_1_0 : SPV_ENV_OPENGL_4_5;
}

Result<void> refuse_capabilities(std::span<const std::uint32_t> module,
                                 const std::vector<const Piece*>& pieces, Dialect dialect) {
    constexpr std::size_t kHeader = 5;
    for (std::size_t at = kHeader; at + 1 < module.size() && module[at] >> spv::WordCountShift != 0;
         at += module[at] >> spv::WordCountShift) {
        if ((module[at] & spv::OpCodeMask) != spv::OpCapability) break;  // they stand first
        const std::uint32_t capability = module[at + 1];
        if (dialect != Dialect::vulkan && capability == spv::CapabilityRayQueryKHR)
            return fail(diagnostic_at(first_use({"rayQuery", "accelerationStructure"}, pieces),
                                      Severity::error, "OpenGL has no ray queries",
                                      "build it with --dialect vulkan"));
        if (dialect != Dialect::vulkan && capability == spv::CapabilityCooperativeMatrixNV)
            return fail(diagnostic_at(first_use({"fcoopmat", "icoopmat", "ucoopmat"}, pieces),
                                      Severity::error, "OpenGL has no cooperative matrices",
                                      "build it with --dialect vulkan"));
        if (!is_spirv(dialect)) continue;
        if (capability == spv::CapabilityPhysicalStorageBufferAddresses)
            return fail(diagnostic_at(first_use({"buffer_reference"}, pieces), Severity::error,
                                      "Vulkan 1.0 has no buffer_reference",
                                      "bind the buffer as a block, and index it by numbers"));
        if (capability >= spv::CapabilityGroupNonUniform && capability <= spv::CapabilityGroupNonUniformQuad)
            return fail(diagnostic_at(first_use({"gl_Subgroup"}, pieces), Severity::error,
                                      "the SPIR-V of Vulkan 1.0 and OpenGL has no subgroups",
                                      "do it without GL_KHR_shader_subgroup_..."));
    }
    return {};
}

}  // namespace gobo
