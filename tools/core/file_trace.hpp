// What was asked of a file system and what it answered: where every answer is the same again, so is whatever
// was computed from them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/bytes.hpp"
#include "core/digest.hpp"
#include "core/file_system.hpp"

namespace gobo {

struct FileQuestion {
    enum class Kind { is_file, read, files_below, real_path };

    Kind kind = Kind::is_file;
    std::string path;
    Digest answer;
};

void fields(auto& archive, OneOf<FileQuestion> auto& value) {
    auto& [kind, path, answer] = value;
    archive(kind, path, answer.high, answer.low);
}

/// Passes on what is asked of another file system and keeps the questions. It asks once: a file is the same
/// whenever it is read, and a thousand includes of a few hundred files are quick. For one thread.
class TracedFiles final : public FileSystem {
  public:
    explicit TracedFiles(FileSystem& files) : files_(files) {}

    [[nodiscard]] bool is_file(const std::string& path) const override;
    [[nodiscard]] Result<std::string> read(const std::string& path) const override;
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override;
    Result<bool> write(const std::string& path, std::string_view content) override;
    [[nodiscard]] std::string real_path(const std::string& path) const override;

    /// Each question once, sorted.
    [[nodiscard]] std::vector<FileQuestion> questions() const;
    /// The first file that was read and can be read only once: a pipe, standard input. Empty: none was.
    [[nodiscard]] const std::string& read_once() const { return read_once_; }
    /// False where something was written, or read that can be read only once.
    [[nodiscard]] bool is_repeatable() const { return !has_written_ && read_once_.empty(); }

  private:
    void note(FileQuestion::Kind kind, const std::string& path, const Digest& answer) const {
        answers_.try_emplace({kind, path}, answer);
    }

    FileSystem& files_;
    mutable std::map<std::pair<FileQuestion::Kind, std::string>, Digest> answers_;
    mutable std::unordered_map<std::string, bool> are_files_;
    mutable std::unordered_map<std::string, Result<std::string>> contents_;
    mutable std::unordered_map<std::string, std::string> real_paths_;
    mutable std::string read_once_;
    bool has_written_ = false;
};

/// Whether the file system answers each question as before. What can be read only once is not read again: it
/// is as before for as long as it is such a file.
[[nodiscard]] bool are_answered_alike(const std::vector<FileQuestion>& questions, const FileSystem& files);

}  // namespace gobo
