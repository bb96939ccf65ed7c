#include "core/file_watch.hpp"

#include <array>
#include <filesystem>
#include <set>

#include <sys/inotify.h>
#include <unistd.h>

#include "core/text.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kChanges = IN_CLOSE_WRITE | IN_MODIFY | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE |
                                   IN_DELETE | IN_ATTRIB | IN_DELETE_SELF | IN_MOVE_SELF;

/// The folder, or the nearest above it that there is.
fs::path present(fs::path folder) {
    std::error_code error;
    while (!folder.empty() && !fs::is_directory(folder, error)) {
        if (folder == folder.parent_path()) break;
        folder = folder.parent_path();
    }
    return folder.empty() ? fs::path(".") : folder;
}

}  // namespace

FileWatch::FileWatch() : descriptor_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

FileWatch::~FileWatch() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void FileWatch::add(const std::string& folder) const {
    ::inotify_add_watch(descriptor_, folder.c_str(), kChanges | IN_ONLYDIR);
}

void FileWatch::follow(const std::vector<FileQuestion>& questions) {
    if (descriptor_ < 0) return;
    std::set<std::string> asked;  // hundreds of files in a few folders
    std::set<std::string> paths;
    std::error_code error;
    for (const FileQuestion& question : questions) {
        if (question.kind == FileQuestion::Kind::files_below) {
            asked.insert(question.path);
            fs::recursive_directory_iterator at(question.path, fs::directory_options::skip_permission_denied,
                                                error);
            for (; !error && at != fs::recursive_directory_iterator(); at.increment(error))
                if (at->is_directory(error)) asked.insert(at->path().string());
        } else if (paths.insert(question.path).second) {
            asked.insert(folder_of(question.path));
            // A link's file changes elsewhere.
            if (!fs::is_symlink(fs::symlink_status(question.path, error))) continue;
            const fs::path real = fs::weakly_canonical(question.path, error);
            if (!error) asked.insert(real.parent_path().string());
        }
    }
    std::set<std::string> folders;
    for (const std::string& folder : asked) folders.insert(present(folder).string());
    for (const std::string& folder : folders) add(folder);
}

void FileWatch::take_news() const {
    alignas(inotify_event) std::array<char, 8192> news;
    while (::read(descriptor_, news.data(), news.size()) > 0) {
    }
}

}  // namespace gobo
