#include "core/result_cache.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <tuple>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file_error.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kParts = "0123456789abcdef";
constexpr std::string_view kInTheWay = "remove what is in their place";
constexpr std::string_view kEnd = ".result";
/// Between the name of a file that is being written and a number that no other writer has.
constexpr std::string_view kUnfinished = ".new.";
/// Seconds. A file that is read is marked as used where its mark is older.
constexpr std::time_t kFreshMark = 600;
/// Seconds, after which whoever was writing a file is taken for dead.
constexpr std::time_t kLongestWrite = 3600;

/// More than so many seconds ago; or as far in the future, by a clock that was wrong.
bool is_far_from_now(const ::timespec& time, std::time_t seconds) {
    const std::time_t now = std::time(nullptr);
    return time.tv_sec < now - seconds || time.tv_sec > now + seconds;
}

/// Stands before a result.
struct Head {
    std::array<char, 8> magic = {'g', 'o', 'b', 'o', ' ', 'r', 'e', 's'};
    std::uint64_t version = 1;
    std::uint64_t size = 0;
    Digest check;  ///< of the file's name and the result

    friend bool operator==(const Head&, const Head&) = default;
};
static_assert(sizeof(Head) == 40);

Head head_of(const Digest& key, std::string_view result) {
    std::string text = hex(key);
    text += result;
    Head head;
    head.size = result.size();
    head.check = digest_of(text);
    return head;
}

/// The whole file, and when it was last marked as used. Nothing where there is none.
std::optional<std::string> content_of(const std::string& path, struct stat& status) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return std::nullopt;
    std::optional<std::string> content;
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) {
        content.emplace(static_cast<std::size_t>(status.st_size), '\0');
        std::size_t done = 0;
        while (done < content->size()) {
            const ::ssize_t count = ::read(file, content->data() + done, content->size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) break;
            done += static_cast<std::size_t>(count);
        }
        content->resize(done);
    }
    ::close(file);
    return content;
}

/// 0, or errno.
int write_new(const std::string& path, std::string_view content) {
    const int descriptor = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) return errno;
    return write_and_close(::fdopen(descriptor, "w"), content);
}

struct File {
    std::string path;
    std::uint64_t bytes = 0;
    ::timespec used = {};
    bool is_result = false;  ///< else it is being written, or no file
};

/// What is in a part by the names of results and of what is being written. `error` where it is there and
/// cannot be read.
std::vector<File> files_in(const std::string& part, std::error_code& error) {
    std::vector<File> files;
    fs::directory_iterator at(part, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error)) {
        const std::string name = at->path().filename().string();
        const bool is_finished = name.ends_with(kEnd);
        struct stat status {};
        if (!is_finished && name.find(kUnfinished) == std::string::npos) continue;
        if (::lstat(at->path().c_str(), &status) != 0) continue;
        const bool is_file = S_ISREG(status.st_mode);
        if (!is_finished && !is_file) continue;
        files.push_back({at->path().string(), is_file ? static_cast<std::uint64_t>(status.st_size) : 0,
                         status.st_mtim, is_finished && is_file});
    }
    if (error == std::errc::no_such_file_or_directory) error.clear();
    return files;
}

}  // namespace

std::optional<std::string> MemoryCache::find(const Digest& key) {
    const auto found = results_.find(key);
    return found == results_.end() ? std::nullopt : std::optional(found->second);
}

void MemoryCache::keep(const Digest& key, std::string_view result) {
    results_.insert_or_assign(key, std::string(result));
}

std::string sealed(const Digest& key, std::string_view result) {
    const Head head = head_of(key, result);
    std::string content(reinterpret_cast<const char*>(&head), sizeof head);
    content += result;
    return content;
}

std::optional<std::string> unsealed(const Digest& key, std::string_view content) {
    Head head;
    if (content.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, content.data(), sizeof head);
    content.remove_prefix(sizeof head);
    return head == head_of(key, content) ? std::optional<std::string>(content) : std::nullopt;
}

std::string DiskCache::path_of(const Digest& key) const {
    const std::string name = hex(key);
    return fmt::format("{}/{}/{}{}", folder_, name.front(), name, kEnd);
}

std::optional<std::string> DiskCache::find(const Digest& key) {
    const std::string path = path_of(key);
    struct stat status {};
    std::optional<std::string> content = content_of(path, status);
    if (!content) return std::nullopt;
    std::optional<std::string> result = unsealed(key, *content);
    if (!result) {
        ::unlink(path.c_str());
        return std::nullopt;
    }
    // What was used longest ago goes first.
    if (is_far_from_now(status.st_mtim, kFreshMark)) ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
    return result;
}

void DiskCache::keep(const Digest& key, std::string_view result) {
    if (error_ == ENOSPC || error_ == EDQUOT) return;  // it will not be emptier for the next one
    const std::string path = path_of(key);
    const std::string beside = fmt::format("{}{}{}.{}", path, kUnfinished, ::getpid(), written_++);
    const std::string content = sealed(key, result);
    int error = write_new(beside, content);
    const std::string part = fs::path(path).parent_path().string();
    std::string place = folder_;
    std::error_code made;
    if (error == ENOENT) {
        fs::create_directories(part, made);
        error = made ? made.value() : write_new(beside, content);
    }
    if (error == ENOTDIR && fs::is_directory(folder_, made)) place = part;
    if (error == 0 && ::rename(beside.c_str(), path.c_str()) != 0) {
        place = path;
        error = errno;
        // An empty folder is damage as any other.
        if (error == EISDIR && ::rmdir(path.c_str()) == 0)
            error = ::rename(beside.c_str(), path.c_str()) == 0 ? 0 : errno;
    }
    if (error != 0) {
        ::unlink(beside.c_str());
        error_ = error;
        error_place_ = place;
    }
    grown_.insert(hex(key).front());
}

Diagnostics DiskCache::tidy() {
    for (const char part : grown_) {
        std::error_code ignored;
        std::vector<File> files = files_in(fmt::format("{}/{}", folder_, part), ignored);
        std::uint64_t bytes = 0;
        for (const File& file : files) {
            if (file.is_result) bytes += file.bytes;
            if (!file.is_result && is_far_from_now(file.used, kLongestWrite)) ::unlink(file.path.c_str());
        }
        if (bytes <= most_bytes_ / kParts.size()) continue;
        std::erase_if(files, [](const File& file) { return !file.is_result; });
        const std::time_t latest = std::time(nullptr) + kFreshMark;
        std::ranges::sort(files, {}, [&](const File& file) {
            return std::tuple(file.used.tv_sec <= latest, file.used.tv_sec, file.used.tv_nsec, file.path);
        });
        for (const File& file : files) {
            if (bytes <= most_bytes_ / kParts.size()) break;
            if (::unlink(file.path.c_str()) == 0) bytes -= file.bytes;
        }
    }
    grown_.clear();
    if (error_ == 0) return {};
    Diagnostic warning = file_error(error_place_, "written", error_).value().front();
    warning.severity = Severity::warning;
    warning.help = fmt::format("results of this run are computed again by the next; {}",
                               error_place_ == folder_ ? "name another folder, or none" : kInTheWay);
    error_ = 0;
    return {warning};
}

Diagnostics DiskCache::for_each(const auto& use, const auto& leave) const {
    Diagnostics diagnostics;
    for (const char part : kParts) {
        const std::string folder = fmt::format("{}/{}", folder_, part);
        std::error_code error;
        for (const File& file : files_in(folder, error)) append(diagnostics, use(file));
        leave(folder);
        if (!error) continue;
        Diagnostic diagnostic = file_error(folder, "read", error.value()).value().front();
        if (error == std::errc::not_a_directory) {
            diagnostic.severity = Severity::warning;
            diagnostic.help = fmt::format("no results are kept there; {}", kInTheWay);
        }
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

DiskCache::Size DiskCache::size() const {
    Size size;
    const auto add = [&](const File& file) {
        size.results += file.is_result ? 1 : 0;
        size.bytes += file.bytes;
        return Diagnostics();
    };
    size.diagnostics = for_each(add, [](const std::string&) {});
    return size;
}

DiskCache::Size DiskCache::clear() {
    Size removed;
    const auto remove = [&](const File& file) -> Diagnostics {
        std::error_code error;
        fs::remove(file.path, error);  // not what is in a folder
        if (error) return file_error(file.path, "removed", error.value()).value();
        removed.results += file.is_result ? 1 : 0;
        removed.bytes += file.bytes;
        return {};
    };
    // A part stays where it holds something else.
    removed.diagnostics = for_each(remove, [](const std::string& part) { ::rmdir(part.c_str()); });
    ::rmdir(folder_.c_str());
    return removed;
}

}  // namespace gobo
