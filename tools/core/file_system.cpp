#include "core/file_system.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file_error.hpp"
#include "core/write_together.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

/// Bytes. What is longer is no shader, family or scene, but a device that never ends.
constexpr std::size_t kLargestFile = std::size_t{1} << 30;
constexpr std::size_t kLargestStream = std::size_t{1} << 28;  ///< of pipes and devices

/// How long somebody is waited for who writes to a pipe, in milliseconds.
constexpr int kPatience = 2000;

/// Whether a pipe in a folder has a writer, or had one that left something; its first byte then goes into
/// `content`. What waits for a writer without end would be a build that hangs.
bool has_writer(int pipe, std::string& content) {
    ::pollfd waited{pipe, POLLIN, 0};
    ::poll(&waited, 1, kPatience);
    char first = 0;
    const ::ssize_t count = ::read(pipe, &first, 1);
    if (count == 1) content += first;
    return count == 1 || (count < 0 && errno == EAGAIN);
}

}  // namespace

tl::unexpected<Diagnostics> file_error(const std::string& path, std::string_view action, int error) {
    return fail({.fault = Fault::file,
                 .place = {path},
                 .message = fmt::format("cannot be {}: {}", action, std::strerror(error))});
}

bool are_of_descriptors(const Diagnostics& errors) {
    return std::ranges::any_of(errors, [](const Diagnostic& error) {
        return error.fault == Fault::file && (error.message.ends_with(std::strerror(EMFILE)) ||
                                              error.message.ends_with(std::strerror(ENFILE)));
    });
}

int write_and_close(std::FILE* file, std::string_view content) {
    if (file == nullptr) return errno;
    errno = 0;
    const bool is_written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
    const int error = is_written ? 0 : errno;
    return std::fclose(file) == 0 || error != 0 ? error : errno;
}

bool DiskFileSystem::is_file(const std::string& path) const {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error == std::errc::permission_denied) return true;
    return !error && (fs::is_regular_file(status) || fs::is_fifo(status) || fs::is_character_file(status));
}

Result<std::string> DiskFileSystem::read(const std::string& path) const {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return file_error(path, "read", errno);
    std::string content;
    struct stat status {};
    // A pipe that a link of /dev leads to was opened by who started gobo, and has its writer.
    if (::lstat(path.c_str(), &status) == 0 && S_ISFIFO(status.st_mode) && !has_writer(descriptor, content)) {
        ::close(descriptor);
        return fail({.fault = Fault::file,
                     .place = {path},
                     .message = "cannot be read: it is a pipe that nobody writes to"});
    }
    const bool is_regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    const std::size_t largest = is_regular ? kLargestFile : kLargestStream;
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    std::FILE* const file = ::fdopen(descriptor, "r");
    std::array<char, 1 << 16> buffer;
    std::size_t count = 0;
    while (content.size() <= largest && (count = std::fread(buffer.data(), 1, buffer.size(), file)) > 0)
        content.append(buffer.data(), count);
    const int error = std::ferror(file) != 0 ? errno : content.size() > largest ? EFBIG : 0;
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
    return write_together({{path, content}});
}

std::string DiskFileSystem::real_path(const std::string& path) const {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    return error ? path : real.generic_string();
}

Result<void> append_to_disk(const std::string& path, std::string_view content) {
    std::error_code ignored;  // opening tells
    fs::create_directories(fs::path(path).parent_path(), ignored);
    const int error = write_and_close(std::fopen(path.c_str(), "ae"), content);
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
