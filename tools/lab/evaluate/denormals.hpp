// How the processor treats denormal numbers. Internal to evaluation.
#pragma once

#include <cstdint>

namespace gobo::evaluate {

/// While it lives, this thread takes denormal operands and results as 0 if `flush`, and keeps them otherwise.
class DenormalMode {
  public:
    explicit DenormalMode(bool flush);
    DenormalMode(const DenormalMode&) = delete;
    DenormalMode& operator=(const DenormalMode&) = delete;
    ~DenormalMode();

    /// Whether this machine can flush.
    [[nodiscard]] static bool is_supported();

  private:
    std::uint64_t saved_;
};

}  // namespace gobo::evaluate
