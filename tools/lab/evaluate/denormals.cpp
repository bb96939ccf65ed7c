#include "lab/evaluate/denormals.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace gobo::evaluate {
namespace {

#if defined(__SSE2__)
constexpr bool kSupported = true;
constexpr std::uint64_t kFlush = 0x8040;  // flush to zero, denormals are zero
std::uint64_t control() {
    return _mm_getcsr();
}
void set_control(std::uint64_t bits) {
    _mm_setcsr(static_cast<unsigned>(bits));
}
#elif defined(__aarch64__)
constexpr bool kSupported = true;
constexpr std::uint64_t kFlush = 1U << 24U;  // FPCR.FZ
std::uint64_t control() {
    std::uint64_t bits = 0;
    asm volatile("mrs %0, fpcr" : "=r"(bits));
    return bits;
}
void set_control(std::uint64_t bits) {
    asm volatile("msr fpcr, %0" : : "r"(bits));
}
#else
constexpr bool kSupported = false;
constexpr std::uint64_t kFlush = 0;
std::uint64_t control() {
    return 0;
}
void set_control(std::uint64_t /*bits*/) {}
#endif

}  // namespace

DenormalMode::DenormalMode(bool flush) : saved_(control()) {
    set_control(flush ? saved_ | kFlush : saved_ & ~kFlush);
}

DenormalMode::~DenormalMode() {
    set_control(saved_);
}

bool DenormalMode::is_supported() {
    return kSupported;
}

}  // namespace gobo::evaluate
