#include "core/file_system.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gobo {
namespace {

namespace fs = std::filesystem;

/// Bytes. What is longer is no shader, family or scene, but a device that never ends.
constexpr std::size_t kLargestFile = std::size_t{1} << 30;

tl::unexpected<Diagnostics> file_error(const std::string& path, std::string_view action, int error) {
    return fail({.fault = Fault::file,
                 .place = {path},
                 .message = fmt::format("cannot be {}: {}", action, std::strerror(error))});
}

/// Writes and closes: 0, or errno. Some file systems report a full disk only as the file is closed.
int write_all(std::FILE* file, std::string_view content) {
    if (file == nullptr) return errno;
    errno = 0;
    const bool is_written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
    const int error = is_written ? 0 : errno;
    return std::fclose(file) == 0 || error != 0 ? error : errno;
}

/// Writes a new file beside `path` and renames it into place. 0, or errno; on an error nothing is left
/// behind.
int replace_file(const std::string& path, std::string_view content) {
    std::string temporary = path + ".XXXXXX";
    const int descriptor = ::mkstemp(temporary.data());
    if (descriptor < 0) return errno;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    int error = ::fchmod(descriptor, 0666 & ~mask) == 0 ? 0 : errno;
    const int write_error = write_all(::fdopen(descriptor, "w"), content);
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
    std::FILE* const file = std::fopen(path.c_str(), "re");
    if (file == nullptr) return file_error(path, "read", errno);
    std::string content;
    std::array<char, 1 << 16> buffer;
    std::size_t count = 0;
    while (content.size() <= kLargestFile && (count = std::fread(buffer.data(), 1, buffer.size(), file)) > 0)
        content.append(buffer.data(), count);
    const int error = std::ferror(file) != 0 ? errno : content.size() > kLargestFile ? EFBIG : 0;
    std::fclose(file);
    if (error != 0) return file_error(path, "read", error);
    return content;
}

std::vector<std::string> DiskFileSystem::files_below(const std::string& folder) const {
    std::vector<std::string> found;
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    const fs::recursive_directory_iterator end;
    for (; !error && at != end; at.increment(error))
        if (at->is_regular_file(error))
            found.push_back(at->path().lexically_relative(folder).generic_string());
    std::sort(found.begin(), found.end());
    return found;
}

Result<bool> DiskFileSystem::write(const std::string& path, std::string_view content) {
    std::error_code kind_error;
    const bool is_regular = fs::is_regular_file(path, kind_error);
    if (is_regular && read(path) == content) return false;
    const fs::path folder = fs::path(path).parent_path();
    std::error_code folder_error;
    if (!folder.empty()) fs::create_directories(folder, folder_error);
    if (folder_error) return file_error(folder.generic_string(), "made", folder_error.value());
    // /dev/full, a pipe: no renaming onto it
    const bool is_device = !is_regular && fs::exists(path, kind_error);
    const int error =
        is_device ? write_all(std::fopen(path.c_str(), "we"), content) : replace_file(path, content);
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
    const int error = write_all(std::fopen(path.c_str(), "ae"), content);
    if (error != 0) return file_error(path, "written", error);
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
    for (const auto& [path, text] : content_)
        if (path.starts_with(prefix)) found.push_back(path.substr(prefix.size()));
    return found;
}

Result<bool> MemoryFileSystem::write(const std::string& path, std::string_view content) {
    const auto [at, is_new] = content_.try_emplace(path, content);
    return is_new || std::exchange(at->second, content) != content;
}

}  // namespace gobo
