#include "reflect/reflect.hpp"
#include "results.hpp"
#include "spirv/module.hpp"
#include "spirv/usage.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

bool read_spirv(std::string_view input) {
    const std::vector<std::uint32_t> words = words_of(input);
    const Result<spirv::Module> module = spirv::read_module(words);
    if (!is_value(module)) return false;
    return is_value(reflect_stage(*module, spirv::usage_of(*module)));
}

}  // namespace gobo::fuzz
