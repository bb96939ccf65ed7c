// One target for libFuzzer, by its name.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto* const target =
        std::ranges::find(gobo::fuzz::kTargets, GOBO_FUZZ_TARGET, &gobo::fuzz::Target::name);
    target->run({reinterpret_cast<const char*>(data), size});
    return 0;
}
