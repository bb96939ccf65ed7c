#include "core/write_together.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file_error.hpp"
#include "core/file_system.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// How long another writer of the same file is waited for.
constexpr milliseconds kPatience{10'000};
constexpr milliseconds kPause{5};

/// An open file that closes with the object.
class Descriptor {
  public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    [[nodiscard]] int number() const { return number_; }

  private:
    int number_;
};

/// Whether nobody else holds the file's lock: taken, or not to be had on this file system.
bool lock(const Descriptor& file) {
    return ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Whether the open file still bears the name.
bool is_named(const Descriptor& file, const std::string& name) {
    struct stat open {};
    struct stat named {};
    return ::fstat(file.number(), &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
           open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// One name for all writers of a file, so that the next one finds what a dead one left; a lock tells the dead
/// from the living. On an error the temporary file goes.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& path) : name_(path + ".gobo-new") {}
    TemporaryFile(TemporaryFile&&) = default;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile() {
        if (file_.number() >= 0) ::unlink(name_.c_str());
    }
    [[nodiscard]] const std::string& name() const { return name_; }

    /// Removes what a dead writer left. 0; EBUSY where a living one has it, or else errno.
    [[nodiscard]] int clear() const {
        const Descriptor left(::open(name_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
        if (left.number() < 0) return errno == ENOENT ? 0 : errno;
        if (!lock(left)) return EBUSY;
        // It may be in place by now, and the name another's.
        return !is_named(left, name_) || ::unlink(name_.c_str()) == 0 ? 0 : errno;
    }

    /// 0, or errno.
    [[nodiscard]] int open() {
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (true) {
            Descriptor made(::open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
            if (made.number() < 0 && errno != EEXIST) return errno;
            // Another writer may have taken it for a dead one's before it was locked.
            if (made.number() >= 0 && lock(made) && is_named(made, name_)) {
                file_ = std::move(made);
                return 0;
            }
            const int error = made.number() < 0 ? clear() : 0;
            if (error != 0 && error != EBUSY) return error;
            if (std::chrono::steady_clock::now() > end) return EBUSY;
            if (error != 0) std::this_thread::sleep_for(kPause);
        }
    }

    /// 0, or errno. The lock is held on: it belongs to what is duplicated.
    [[nodiscard]] int write(std::string_view content) const {
        return write_and_close(::fdopen(::fcntl(file_.number(), F_DUPFD_CLOEXEC, 0), "w"), content);
    }

    /// 0, or errno.
    [[nodiscard]] int rename(const std::string& path) {
        if (::rename(name_.c_str(), path.c_str()) != 0) return errno;
        file_ = Descriptor();
        return 0;
    }

  private:
    std::string name_;
    Descriptor file_;
};

/// Whether it already holds its text.
bool holds(const NewFile& file) {
    std::error_code error;
    return fs::is_regular_file(file.path, error) && DiskFileSystem().read(file.path) == file.content;
}

/// A device or a pipe: nothing is renamed onto it.
bool is_special(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Not to wait where nobody reads a pipe.
int write_special(const NewFile& file) {
    const int descriptor = ::open(file.path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return errno;
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    return write_and_close(::fdopen(descriptor, "w"), file.content);
}

tl::unexpected<Diagnostics> open_error(const std::string& path, const TemporaryFile& temporary, int error) {
    if (error == EBUSY)
        return fail({.fault = Fault::file,
                     .place = {path},
                     .message = "cannot be written: another gobo is still writing it",
                     .help = fmt::format("wait for it, or end it; it holds {}", temporary.name())});
    std::error_code ignored;
    const bool is_in_the_way = fs::exists(fs::symlink_status(temporary.name(), ignored));
    return file_error(is_in_the_way ? temporary.name() : path, "written", error);
}

/// Folders that were made for files. Without files they go again.
class MadeFolders {
  public:
    MadeFolders() = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders() {
        std::error_code ignored;  // of those that hold something
        for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, ignored);
    }

    /// Makes the folder of a file. Fault::file where it cannot be.
    Result<void> make_for(const std::string& path) {
        std::vector<fs::path> missing;
        std::error_code error;
        // A link to nowhere is there, and is not ours.
        const auto is_there = [&](const fs::path& folder) {
            return fs::exists(fs::symlink_status(folder, error));
        };
        for (fs::path folder = fs::path(path).parent_path(); !folder.empty() && !is_there(folder);
             folder = folder.parent_path())
            missing.push_back(folder);
        made_.insert(made_.end(), missing.rbegin(), missing.rend());
        error.clear();
        const fs::path folder = fs::path(path).parent_path();
        if (!folder.empty()) fs::create_directories(folder, error);
        if (error) return file_error(folder.generic_string(), "made", error.value());
        return {};
    }

  private:
    std::vector<fs::path> made_;
};

}  // namespace

Result<bool> write_together(const std::vector<NewFile>& files) {
    MadeFolders folders;  // outlives the temporary files
    std::vector<TemporaryFile> temporary;
    for (const NewFile& file : files) temporary.emplace_back(file.path);
    if (std::ranges::all_of(files, holds)) {
        // What cannot be removed is told where it is in the way.
        for (const TemporaryFile& left : temporary) static_cast<void>(left.clear());
        return false;
    }
    enum class Way { none, rename, write };
    std::vector<Way> ways(files.size(), Way::none);
    for (std::size_t i = files.size(); i-- > 0;) {
        const NewFile& file = files[i];
        // The last one's lock is that of all: who holds it sees no other writer change the others.
        const bool is_lock = i + 1 == files.size();
        if (is_special(file.path)) {
            ways[i] = Way::write;
            continue;
        }
        if (!is_lock && holds(file)) {
            static_cast<void>(temporary[i].clear());
            continue;
        }
        GOBO_TRY_DO(folders.make_for(file.path));
        // Told now: later others would be in place already.
        std::error_code ignored;
        if (fs::is_directory(file.path, ignored)) return file_error(file.path, "written", EISDIR);
        if (const int error = temporary[i].open(); error != 0)
            return open_error(file.path, temporary[i], error);
        if (is_lock && holds(file)) continue;
        if (const int error = temporary[i].write(file.content); error != 0)
            return file_error(file.path, "written", error);
        ways[i] = Way::rename;
    }
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string& path = files[i].path;
        const int error = ways[i] == Way::rename  ? temporary[i].rename(path)
                          : ways[i] == Way::write ? write_special(files[i])
                                                  : 0;
        if (error == ENXIO)
            return fail({.fault = Fault::file,
                         .place = {path},
                         .message = "cannot be written: it is a pipe that nobody reads"});
        if (error != 0) return file_error(path, "written", error);
    }
    return true;
}

}  // namespace gobo
