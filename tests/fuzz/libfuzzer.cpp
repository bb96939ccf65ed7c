// One target for libFuzzer: the function of targets.hpp that GOBO_FUZZ_TARGET names.
#include <cstddef>
#include <cstdint>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gobo::fuzz::GOBO_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
