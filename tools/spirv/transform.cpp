#include "spirv/transform.hpp"

#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <spirv-tools/optimizer.hpp>

#include "spirv/module.hpp"

namespace gobo::spirv {
namespace {

Result<Words> run(spvtools::Optimizer& optimizer, const Words& words) {
    std::string problem;
    optimizer.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t&, const char* message) {
            if (level <= SPV_MSG_ERROR) problem = message;
        });
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // gobo asks it by itself
    Words result;
    if (optimizer.Run(words.data(), words.size(), &result, options)) return result;
    return fail(Fault::internal, fmt::format("SPIRV-Tools' optimizer refuses a module: {}", problem));
}

}  // namespace

Result<Words> with_largest_arrays(std::span<const std::uint32_t> words) {
    GOBO_TRY(const Module module, read_module(words));
    constexpr std::size_t kHeader = 5;
    constexpr std::size_t kBound = 3;
    Words result(words.begin(), words.begin() + kHeader);
    std::map<std::pair<Id, std::int64_t>, std::uint32_t> sizes;  // new constants by type and value
    for (const Instruction& instruction : module.instructions) {
        const Instruction* size =
            instruction.opcode == spv::OpTypeArray ? module.definition(instruction.id(3)) : nullptr;
        const bool is_chosen =
            size != nullptr && (size->opcode == spv::OpSpecConstant || size->opcode == spv::OpSpecConstantOp);
        std::uint32_t constant = 0;
        if (is_chosen) {
            const std::int64_t value = module.integers.at(size->result);
            const auto [place, is_new] = sizes.try_emplace({size->type, value}, result[kBound]);
            constant = place->second;
            if (is_new) {
                ++result[kBound];
                result.insert(result.end(), {4U << spv::WordCountShift | spv::OpConstant,
                                             static_cast<std::uint32_t>(size->type), constant,
                                             static_cast<std::uint32_t>(value)});
            }
        }
        const std::size_t at = result.size();
        result.insert(result.end(), instruction.words.begin(), instruction.words.end());
        if (is_chosen) result[at + 3] = constant;
    }
    return result;
}

Result<Words> specialized(const Words& words, const std::map<int, std::uint32_t>& values) {
    std::unordered_map<std::uint32_t, std::string> texts;
    for (const auto& [id, value] : values) texts[static_cast<std::uint32_t>(id)] = std::to_string(value);
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_0);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(texts))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    return run(optimizer, words);
}

Result<Words> optimized(const Words& words, spv_target_env environment) {
    spvtools::Optimizer optimizer(environment);
    optimizer.RegisterPerformancePasses();
    return run(optimizer, words);
}

Result<Words> without_names(const Words& words) {
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_0);
    optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
    return run(optimizer, words);
}

}  // namespace gobo::spirv
