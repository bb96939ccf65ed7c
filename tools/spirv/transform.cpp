#include "spirv/transform.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <spirv-tools/optimizer.hpp>

#include "spirv/constants.hpp"
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

/// Finds how large arrays get.
class Sizes {
  public:
    Sizes(const Module& module, const std::set<std::uint32_t>& counts) : module_(module), counts_(counts) {
        for (const Instruction& instruction : module.instructions) {
            std::set<std::uint32_t>& own = hang_on_[instruction.result];
            if (const auto id = module.decoration(instruction.result, spv::DecorationSpecId))
                own.insert(*id);
            else if (instruction.opcode == spv::OpSpecConstantComposite ||
                     instruction.opcode == spv::OpSpecConstantOp)
                for (const std::uint32_t word : instruction.words.subspan(3))
                    if (const auto part = hang_on_.find(Id{word}); part != hang_on_.end())
                        own.insert(part->second.begin(), part->second.end());
        }
    }

    /// The largest size for any of the counts' values; 0 where it hangs on others, or on more than are tried.
    [[nodiscard]] std::int64_t largest(const Instruction& size) const {
        constexpr std::uint64_t kMostTried = 4096;
        const std::set<std::uint32_t>& ids = hang_on_.at(size.result);
        std::map<std::uint32_t, std::uint32_t> last;
        std::uint64_t tried = 1;
        for (const auto& [place, id] : module_.decorations)
            if (std::get<spv::Decoration>(place) == spv::DecorationSpecId && ids.contains(id)) {
                const auto value = module_.integers.find(std::get<Id>(place));
                if (!counts_.contains(id) || value == module_.integers.end() || value->second < 1) return 0;
                last[id] = static_cast<std::uint32_t>(value->second);
                tried = std::min(tried * last[id], kMostTried + 1);
            }
        if (last.size() != ids.size() || tried > kMostTried) return 0;
        std::map<std::uint32_t, std::uint32_t> chosen;
        for (const std::uint32_t id : ids) chosen[id] = 1;
        std::int64_t most = 0;
        while (true) {
            Constants constants(module_, chosen);
            for (const Instruction& instruction : module_.instructions) constants.add(instruction);
            most = std::max(most, constants.integer(size).value_or(0));
            auto next = chosen.begin();
            while (next != chosen.end() && next->second == last[next->first]) (next++)->second = 1;
            if (next == chosen.end()) return most <= std::numeric_limits<std::int32_t>::max() ? most : 0;
            ++next->second;
        }
    }

  private:
    const Module& module_;
    const std::set<std::uint32_t>& counts_;
    std::map<Id, std::set<std::uint32_t>> hang_on_;  ///< by constant: the constant_ids
};

constexpr std::size_t kHeader = 5;
constexpr std::size_t kBound = 3;

/// With constants instead of divisions of constants. SPIRV-Tools divides the least integer by -1, too, which
/// ends the process.
Result<Words> with_divisions_done(const Words& words, std::map<std::uint32_t, std::uint32_t> chosen) {
    GOBO_TRY(const Module module, read_module(words));
    Constants constants(module, std::move(chosen));
    Words result(words.begin(), words.begin() + kHeader);
    const auto add = [&](spv::Op opcode, std::initializer_list<std::uint32_t> head, const Words& rest) {
        const auto count = static_cast<std::uint32_t>(1 + head.size() + rest.size());
        result.push_back(count << spv::WordCountShift | static_cast<std::uint32_t>(opcode));
        result.insert(result.end(), head);
        result.insert(result.end(), rest.begin(), rest.end());
    };
    for (const Instruction& instruction : module.instructions) {
        constants.add(instruction);
        const bool divides = instruction.opcode == spv::OpSpecConstantOp &&
                             (instruction.words[3] == spv::OpSDiv || instruction.words[3] == spv::OpSRem ||
                              instruction.words[3] == spv::OpSMod);
        const std::optional<Constant> value =
            divides ? constants.value(instruction.result) : std::optional<Constant>();
        if (!value || value->width != 32) {
            result.insert(result.end(), instruction.words.begin(), instruction.words.end());
            continue;
        }
        const auto type = static_cast<std::uint32_t>(instruction.type);
        const auto id = static_cast<std::uint32_t>(instruction.result);
        if (value->count == 1) {
            add(spv::OpConstant, {type, id}, {static_cast<std::uint32_t>(value->bits[0])});
            continue;
        }
        Words parts;
        const auto element = static_cast<std::uint32_t>(module.type(instruction.type).element);
        for (std::uint32_t i = 0; i < value->count; ++i) {
            parts.push_back(result[kBound]++);
            add(spv::OpConstant, {element, parts.back()}, {static_cast<std::uint32_t>(value->bits[i])});
        }
        add(spv::OpConstantComposite, {type, id}, parts);
    }
    return result;
}

/// The text whose number that is; null where it is none's.
const TextOfFile* text_of_number(std::string_view number, const std::vector<TextOfFile>& texts) {
    std::size_t text = texts.size();
    const bool is_number = std::from_chars(number.data(), number.data() + number.size(), text).ptr ==
                           number.data() + number.size();
    return is_number && text < texts.size() ? &texts[text] : nullptr;
}

}  // namespace

Result<Words> with_largest_arrays(std::span<const std::uint32_t> words,
                                  const std::set<std::uint32_t>& counts) {
    if (counts.empty()) return Words(words.begin(), words.end());
    GOBO_TRY(const Module module, read_module(words));
    const Sizes all(module, counts);
    Words result(words.begin(), words.begin() + kHeader);
    std::map<std::pair<Id, std::int64_t>, std::uint32_t> sizes;  // new constants by type and value
    for (const Instruction& instruction : module.instructions) {
        const Instruction* size =
            instruction.opcode == spv::OpTypeArray ? module.definition(instruction.id(3)) : nullptr;
        const bool is_special =
            size != nullptr && (size->opcode == spv::OpSpecConstant || size->opcode == spv::OpSpecConstantOp);
        const std::int64_t value = is_special ? all.largest(*size) : 0;
        const bool is_chosen = value > 0;
        std::uint32_t constant = 0;
        if (is_chosen) {
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

Words with_lines_of_files(const Words& words, const std::vector<TextOfFile>& texts) {
    Words result(words.begin(), words.begin() + kHeader);
    std::map<std::uint32_t, const TextOfFile*> named;  // by the id of the text's number
    for (std::size_t at = kHeader; at < words.size();) {
        const std::uint32_t* const instruction = &words[at];
        const std::uint32_t count = instruction[0] >> spv::WordCountShift;
        const std::uint32_t opcode = instruction[0] & spv::OpCodeMask;
        at += count;
        const TextOfFile* const named_here =
            opcode == spv::OpString ? text_of_number(reinterpret_cast<const char*>(instruction + 2), texts)
                                    : nullptr;
        if (named_here != nullptr) {
            named[instruction[1]] = named_here;
            const std::string& path = named_here->path;
            const auto size = static_cast<std::uint32_t>(path.size() / 4 + 1);
            result.insert(result.end(), {(2 + size) << spv::WordCountShift | spv::OpString, instruction[1]});
            result.resize(result.size() + size);
            std::memcpy(&result[result.size() - size], path.data(), path.size());
            continue;
        }
        result.insert(result.end(), instruction, instruction + count);
        const auto text = opcode == spv::OpLine ? named.find(instruction[1]) : named.end();
        if (text != named.end())
            result[result.size() - count + 2] += static_cast<std::uint32_t>(text->second->first_line - 1);
    }
    return result;
}

Result<Words> specialized(const Words& words, const std::map<int, std::uint32_t>& values) {
    std::unordered_map<std::uint32_t, std::string> texts;
    std::map<std::uint32_t, std::uint32_t> chosen;
    for (const auto& [id, value] : values) {
        texts[static_cast<std::uint32_t>(id)] = std::to_string(value);
        chosen[static_cast<std::uint32_t>(id)] = value;
    }
    GOBO_TRY(const Words divided, with_divisions_done(words, std::move(chosen)));
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_0);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(texts))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    return run(optimizer, divided);
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
