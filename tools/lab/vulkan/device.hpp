// A headless Vulkan device: whatever driver is there, loaded at run time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::vulkan {

/// A device with a queue that draws. Copies share it; it is destroyed with the last of them. Used by one
/// thread at a time.
class Device {
  public:
    struct State;

    /// The device and its driver: every figure measured here is to be labelled with it.
    [[nodiscard]] const std::string& name() const;
    /// Texels along a side of the largest texture.
    [[nodiscard]] int largest_texture() const;
    /// What validation layers have said since this was last asked, each an error. Whoever wants them sets
    /// VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation, as for any program.
    [[nodiscard]] Diagnostics messages() const;
    [[nodiscard]] const State& state() const { return *state_; }

  private:
    friend Result<Device> open_device();
    explicit Device(std::shared_ptr<const State> state) : state_(std::move(state)) {}

    std::shared_ptr<const State> state_;
};

/// The first device that is a GPU, else the first. Fault::file where there is no loader, no driver or no
/// device; the help names what to install.
[[nodiscard]] Result<Device> open_device();

}  // namespace gobo::vulkan
