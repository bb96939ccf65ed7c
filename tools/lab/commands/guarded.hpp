// Commands that load a graphics driver, in processes of their own: one that crashes or hangs becomes a
// message.
#pragma once

#include <functional>
#include <string_view>

#include "gobo/input.hpp"

namespace gobo {

/// Tells what is done next, or is done: what a message names where the driver ends the process.
using Progress = std::function<void(std::string_view)>;

/// So long may a driver take from one thing told to the next.
inline constexpr int kDriverSeconds = 300;

/// What `run` leaves, which is called in a child process. Where that crashes, runs out of memory or tells
/// nothing for kDriverSeconds, an error (Fault::file) says so and what was told last; `what` the driver is:
/// "the renderer of --backend osmesa".
[[nodiscard]] Result<Outcome> run_guarded(const std::string& what,
                                          const std::function<Result<Outcome>(const Progress&)>& run,
                                          int seconds = kDriverSeconds);

/// Files that tell what has been written.
class ToldFiles final : public FileSystem {
  public:
    ToldFiles(FileSystem& files, Progress progress) : files_(files), progress_(std::move(progress)) {}

    [[nodiscard]] bool is_file(const std::string& path) const override { return files_.is_file(path); }
    [[nodiscard]] Result<std::string> read(const std::string& path) const override {
        return files_.read(path);
    }
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override {
        return files_.files_below(folder);
    }
    Result<bool> write(const std::string& path, std::string_view content) override {
        auto written = files_.write(path, content);
        progress_("it has written " + path);
        return written;
    }
    [[nodiscard]] std::string real_path(const std::string& path) const override {
        return files_.real_path(path);
    }

  private:
    FileSystem& files_;
    Progress progress_;
};

}  // namespace gobo
