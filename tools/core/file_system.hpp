// All access to files goes through this interface, so that every stage can be tested in memory.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// Files by path. Paths use '/'; relative ones are relative to the current folder.
class FileSystem {
  public:
    FileSystem() = default;
    FileSystem(const FileSystem&) = delete;
    FileSystem& operator=(const FileSystem&) = delete;
    virtual ~FileSystem() = default;

    /// Also where a folder does not let itself be looked into: reading tells then.
    [[nodiscard]] virtual bool is_file(const std::string& path) const = 0;
    /// The whole content. Fault::file where it cannot be read.
    [[nodiscard]] virtual Result<std::string> read(const std::string& path) const = 0;
    /// The paths, relative to `folder`, of all files below it, sorted. Empty where there is no such folder.
    [[nodiscard]] virtual std::vector<std::string> files_below(const std::string& folder) const = 0;
    /// Puts `content` in place of the file in one step (a temporary file, then a rename), making its folder.
    /// A file that already holds it is left untouched: false. Fault::file where it cannot be written.
    virtual Result<bool> write(const std::string& path, std::string_view content) = 0;
    /// `path` with symbolic links followed, so that a link out of a root is seen; as it is where nothing is
    /// there.
    [[nodiscard]] virtual std::string real_path(const std::string& path) const { return path; }
};

/// The machine's own files.
class DiskFileSystem final : public FileSystem {
  public:
    [[nodiscard]] bool is_file(const std::string& path) const override;
    [[nodiscard]] Result<std::string> read(const std::string& path) const override;
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override;
    Result<bool> write(const std::string& path, std::string_view content) override;
    [[nodiscard]] std::string real_path(const std::string& path) const override;
};

/// Adds `content` to the end of a file on disk, making it and its folder; what is there stays, whatever
/// happens. Fault::file where it cannot be written.
[[nodiscard]] Result<void> append_to_disk(const std::string& path, std::string_view content);

/// Files in memory: the tests', and the library that is embedded in the executable.
class MemoryFileSystem final : public FileSystem {
  public:
    MemoryFileSystem() = default;
    explicit MemoryFileSystem(std::map<std::string, std::string, std::less<>> content)
        : content_(std::move(content)) {}

    [[nodiscard]] bool is_file(const std::string& path) const override;
    [[nodiscard]] Result<std::string> read(const std::string& path) const override;
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override;
    Result<bool> write(const std::string& path, std::string_view content) override;

  private:
    std::map<std::string, std::string, std::less<>> content_;
};

}  // namespace gobo
