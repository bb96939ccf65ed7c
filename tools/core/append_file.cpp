#include "core/append_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace gobo {
namespace {

/// 0, or errno.
int write_all(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

}  // namespace

Result<void> append_to_disk(const std::string& path, std::string_view content) {
    std::error_code ignored;  // opening tells
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    int error = descriptor < 0 ? errno : write_all(descriptor, content);
    if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) return {};
    Diagnostic diagnostic;
    diagnostic.fault = Fault::file;
    diagnostic.place.file = path;
    diagnostic.message = fmt::format("cannot be written: {}", std::strerror(error));
    return fail(std::move(diagnostic));
}

}  // namespace gobo
