#include "lab/sanitize/depth_promise.hpp"

#include <cstddef>

#include <spirv/unified1/spirv.hpp>

namespace gobo::sanitize {
namespace {

constexpr std::size_t kHeaderWords = 5;

DepthPromise promise_of(std::uint32_t mode) {
    switch (mode) {
        case spv::ExecutionModeDepthGreater:
            return DepthPromise::greater;
        case spv::ExecutionModeDepthLess:
            return DepthPromise::less;
        case spv::ExecutionModeDepthUnchanged:
            return DepthPromise::unchanged;
        default:
            return DepthPromise::none;
    }
}

}  // namespace

DepthPromise depth_promise_of(std::span<const std::uint32_t> spirv) {
    for (std::size_t at = kHeaderWords; at + 2 < spirv.size();) {
        const std::uint32_t length = spirv[at] >> spv::WordCountShift;
        const std::uint32_t opcode = spirv[at] & spv::OpCodeMask;
        if (length == 0 || opcode == spv::OpFunction) break;  // modes stand ahead of all functions
        if (opcode == spv::OpExecutionMode) {
            const DepthPromise promise = promise_of(spirv[at + 2]);
            if (promise != DepthPromise::none) return promise;
        }
        at += length;
    }
    return DepthPromise::none;
}

}  // namespace gobo::sanitize
