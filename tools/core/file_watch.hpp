// Waiting until a file changes.
#pragma once

#include <vector>

#include "core/file_trace.hpp"

namespace gobo {

/// Hears of changes by inotify. It hears of more than what is asked about, and on some file systems (of a
/// network, of a host computer) of nothing: whether an answer changed is for are_answered_alike() to say.
class FileWatch {
  public:
    FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;
    ~FileWatch();

    /// Listens to the folders in which the answers lie: those that are not there, to the one that would hold
    /// them.
    void follow(const std::vector<FileQuestion>& questions);

    /// Readable when there is news; below 0 where the system has no inotify.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Forgets the news.
    void take_news() const;

  private:
    void add(const std::string& folder) const;

    int descriptor_ = -1;
};

}  // namespace gobo
