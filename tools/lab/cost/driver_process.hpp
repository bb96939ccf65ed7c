// A driver in a process of its own, started for one chip: drivers learn from their environment which chip
// they are, and one that aborts or hangs takes nothing else along.
#pragma once

#include <memory>
#include <string>

#include "lab/cost/chips.hpp"
#include "lab/cost/driver.hpp"
#include "lab/cost/driver_place.hpp"

namespace gobo::cost {

/// The stages of a pipeline, or in words why there are none: what the driver answered, or how it ended.
using CompiledPipeline = tl::expected<std::vector<CompiledStage>, std::string>;

/// The name of the command of gobo-lab that such a process runs, followed by the driver's library.
inline constexpr const char* kServeCommand = "compile-pipelines";

/// Answers a DriverProcess: opens the driver and compiles what standard input asks for, until it ends.
void serve_pipelines(const std::string& library);

class DriverProcess {
  public:
    /// Starts `program`, a gobo-lab, as that chip's driver; each answer may take `time_limit` seconds.
    DriverProcess(const DriverPlace& place, const Chip& chip, const std::string& program, int time_limit);
    DriverProcess(const DriverProcess&) = delete;
    DriverProcess& operator=(const DriverProcess&) = delete;
    ~DriverProcess();

    /// The driver and its version: "radv Mesa 22.3.6"; or why it cannot be asked (Fault::file where it is
    /// missing or does not know the chip).
    [[nodiscard]] const Result<std::string>& name() const { return name_; }
    [[nodiscard]] CompiledPipeline compile(const Pipeline& pipeline);
    /// False once it has died or was ended: a new one goes on.
    [[nodiscard]] bool is_alive() const { return process_ > 0; }

  private:
    struct Answer;
    [[nodiscard]] Result<std::string> open(const DriverPlace& place, const Chip& chip,
                                           const std::string& program);
    [[nodiscard]] Answer exchange(std::string request);
    std::string end(bool timed_out);

    int time_limit_;
    int process_ = 0;
    int requests_ = -1;
    int answers_ = -1;
    int errors_ = -1;      ///< whatever the driver prints
    std::string printed_;  ///< the end of it
    std::string received_;
    Result<std::string> name_;
};

}  // namespace gobo::cost
