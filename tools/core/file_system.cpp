#include "core/file_system.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gobo {
namespace {

namespace fs = std::filesystem;

/// Bytes. What is longer is no shader, family or scene, but a device that never ends.
constexpr std::size_t kLargestFile = std::size_t{1} << 30;

tl::unexpected<Diagnostics> file_error(const std::string& path, std::string_view action, int error) {
    Diagnostic diagnostic;
    diagnostic.fault = Fault::file;
    diagnostic.place.file = path;
    diagnostic.message = fmt::format("cannot be {}: {}", action, std::strerror(error));
    return fail(std::move(diagnostic));
}

/// A file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }
    /// 0, or errno. Some file systems report a full disk only here.
    int close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

  private:
    int number_;
};

/// Writes and closes: 0, or errno.
int write_all(Descriptor& file, std::string_view content) {
    int error = file.number() < 0 ? errno : 0;
    while (error == 0 && !content.empty()) {
        const ssize_t written = ::write(file.number(), content.data(), content.size());
        if (written >= 0)
            content.remove_prefix(static_cast<std::size_t>(written));
        else if (errno != EINTR)
            error = errno;
    }
    const int close_error = file.close();
    return error != 0 ? error : close_error;
}

/// Writes a new file beside `path` and renames it into place. 0, or errno; on an error nothing is left
/// behind.
int replace_file(const std::string& path, std::string_view content) {
    std::string temporary = path + ".XXXXXX";
    Descriptor file(::mkstemp(temporary.data()));
    if (file.number() < 0) return errno;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    int error = ::fchmod(file.number(), 0666 & ~mask) != 0 ? errno : 0;
    const int write_error = write_all(file, content);
    if (error == 0) error = write_error;
    if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
    if (error != 0) ::unlink(temporary.c_str());
    return error;
}

}  // namespace

bool DiskFileSystem::is_file(const std::string& path) const {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return !error && (fs::is_regular_file(status) || fs::is_fifo(status) || fs::is_character_file(status));
}

Result<std::string> DiskFileSystem::read(const std::string& path) const {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number() < 0) return file_error(path, "read", errno);
    std::string content;
    char buffer[1 << 16];
    while (true) {
        const ssize_t count = ::read(file.number(), buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return file_error(path, "read", errno);
        if (count == 0) return content;
        content.append(buffer, static_cast<std::size_t>(count));
        if (content.size() > kLargestFile) return file_error(path, "read", EFBIG);
    }
}

std::vector<std::string> DiskFileSystem::files_below(const std::string& folder) const {
    std::vector<std::string> found;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    const fs::recursive_directory_iterator end;
    for (; !error && at != end; at.increment(error)) {
        if (at->is_regular_file(error))
            found.push_back(at->path().lexically_relative(folder).generic_string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

Result<bool> DiskFileSystem::write(const std::string& path, std::string_view content) {
    std::error_code kind_error;
    const bool is_regular = fs::is_regular_file(path, kind_error);
    if (is_regular) {
        const Result<std::string> present = read(path);
        if (present && *present == content) return false;
    }
    const fs::path folder = fs::path(path).parent_path();
    std::error_code folder_error;
    if (!folder.empty()) fs::create_directories(folder, folder_error);
    if (folder_error) return file_error(folder.generic_string(), "made", folder_error.value());
    int error = 0;
    if (!is_regular && fs::exists(path, kind_error)) {  // /dev/full, a pipe: no renaming onto it
        Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        error = write_all(file, content);
    } else {
        error = replace_file(path, content);
    }
    if (error != 0) return file_error(path, "written", error);
    return true;
}

std::string DiskFileSystem::real_path(const std::string& path) const {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    return error ? path : real.generic_string();
}

Result<void> append_to_disk(const std::string& path, std::string_view content) {
    std::error_code ignored;  // opening tells
    fs::create_directories(fs::path(path).parent_path(), ignored);
    Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
    if (const int error = write_all(file, content); error != 0) return file_error(path, "written", error);
    return {};
}

bool MemoryFileSystem::is_file(const std::string& path) const {
    return content_.contains(path);
}

Result<std::string> MemoryFileSystem::read(const std::string& path) const {
    const auto found = content_.find(path);
    if (found == content_.end()) return file_error(path, "read", ENOENT);
    return found->second;
}

std::vector<std::string> MemoryFileSystem::files_below(const std::string& folder) const {
    const std::string prefix = folder.empty() ? "" : folder + "/";
    std::vector<std::string> found;
    for (const auto& [path, text] : content_) {
        if (path.starts_with(prefix)) found.push_back(path.substr(prefix.size()));
    }
    return found;
}

Result<bool> MemoryFileSystem::write(const std::string& path, std::string_view content) {
    const auto [at, is_new] = content_.try_emplace(path, content);
    if (is_new) return true;
    if (at->second == content) return false;
    at->second = content;
    return true;
}

}  // namespace gobo
