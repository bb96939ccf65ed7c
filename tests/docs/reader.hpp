// A reader who does what a page of the documentation says, in a folder of their own.
#pragma once

#include <filesystem>
#include <string>

#include "page.hpp"

namespace gobo {

/// What commands printed, on either stream, and how they ended.
struct CommandResult {
    int status = 0;
    std::string printed;
};

/// Works in a new temporary folder, which goes with the object. The commands find `gobo` in their PATH.
class Reader {
  public:
    /// `gobo` is the executable.
    explicit Reader(const std::filesystem::path& gobo);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// Writes the block's file below the current folder.
    void write(const PageBlock& block);
    /// Changes a file as a diff says: its old lines are found once, and replaced. What hinders it, or
    /// nothing.
    [[nodiscard]] std::string edit(const PageBlock& block);
    /// Runs commands in the current folder, which the next ones inherit; the first that fails ends them.
    [[nodiscard]] CommandResult run(const std::string& commands);

  private:
    std::filesystem::path own_;      ///< of this object: scripts and what they print
    std::filesystem::path current_;  ///< below it, what the page sees
    std::string gobo_folder_;
};

}  // namespace gobo
