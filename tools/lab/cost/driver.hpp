// A Vulkan driver that compiles and never draws: what it says of each stage of a pipeline. The driver is
// loaded at run time and entered without Vulkan's loader.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/cost/pipeline.hpp"

namespace gobo::cost {

/// A stage as the driver compiled it.
struct CompiledStage {
    std::string stage;                                ///< "vertex", "fragment" or "compute"
    std::uint32_t invocations = 64;                   ///< of a wave
    std::map<std::string, std::uint64_t> statistics;  ///< by the driver's names: "Instructions"
    std::string assembly;
};

/// The one device of a driver. An unknown RADV_FORCE_FAMILY and some shaders end the process: it belongs in
/// one of its own, with which it goes.
class Driver {
  public:
    /// A shared library by its name or path. Fault::file where it cannot be loaded or has no device.
    [[nodiscard]] static Result<Driver> open(const std::string& library);

    /// The driver and its version: "radv Mesa 22.3.6".
    [[nodiscard]] const std::string& name() const;
    [[nodiscard]] Result<std::vector<CompiledStage>> compile(const Pipeline& pipeline) const;

  private:
    struct Device;
    explicit Driver(std::shared_ptr<const Device> device) : device_(std::move(device)) {}
    std::shared_ptr<const Device> device_;
};

}  // namespace gobo::cost
