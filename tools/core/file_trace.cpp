#include "core/file_trace.hpp"

#include <algorithm>
#include <filesystem>

#include "core/text.hpp"

namespace gobo {
namespace {

using Kind = FileQuestion::Kind;

/// Bytes. Longer files are no shaders, and read once.
constexpr std::size_t kLongestKept = std::size_t{1} << 20;

/// Stands for what can be read only once.
constexpr Digest kReadOnce = {};

Digest answer(bool is_file) {
    return {0, is_file ? 1U : 0U};
}

Digest answer(const Result<std::string>& content) {
    return digest_of(content ? *content : "error\n" + to_text(content.error()));
}

Digest answer(const std::vector<std::string>& paths) {
    return digest_of(join(paths, "\n"));
}

Digest answer(const std::string& real_path) {
    return digest_of(real_path);
}

/// Whether it may be read again with the same result.
bool is_lasting(const std::string& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

}  // namespace

bool TracedFiles::is_file(const std::string& path) const {
    const auto [known, is_new] = are_files_.try_emplace(path, false);
    if (!is_new) return known->second;
    known->second = files_.is_file(path);
    note(Kind::is_file, path, answer(known->second));
    return known->second;
}

Result<std::string> TracedFiles::read(const std::string& path) const {
    if (const auto known = contents_.find(path); known != contents_.end()) return known->second;
    Result<std::string> content = files_.read(path);
    const bool can_be_read_again = is_lasting(path);
    if (!can_be_read_again && read_once_.empty()) read_once_ = path;
    note(Kind::read, path, can_be_read_again ? answer(content) : kReadOnce);
    // An error, too: a pipe's writer is waited for once.
    if (!content || (can_be_read_again && content->size() <= kLongestKept))
        contents_.try_emplace(path, content);
    return content;
}

std::vector<std::string> TracedFiles::files_below(const std::string& folder) const {
    std::vector<std::string> paths = files_.files_below(folder);
    note(Kind::files_below, folder, answer(paths));
    return paths;
}

Result<bool> TracedFiles::write(const std::string& path, std::string_view content) {
    has_written_ = true;
    are_files_.clear();
    contents_.clear();
    real_paths_.clear();
    return files_.write(path, content);
}

std::string TracedFiles::real_path(const std::string& path) const {
    const auto [known, is_new] = real_paths_.try_emplace(path);
    if (!is_new) return known->second;
    known->second = files_.real_path(path);
    note(Kind::real_path, path, answer(known->second));
    return known->second;
}

std::vector<FileQuestion> TracedFiles::questions() const {
    std::vector<FileQuestion> questions;
    for (const auto& [question, answer] : answers_)
        questions.push_back({question.first, question.second, answer});
    return questions;
}

bool are_answered_alike(const std::vector<FileQuestion>& questions, const FileSystem& files) {
    return std::ranges::all_of(questions, [&](const FileQuestion& question) {
        const std::string& path = question.path;
        switch (question.kind) {
            case Kind::is_file:
                return answer(files.is_file(path)) == question.answer;
            case Kind::read:
                return (is_lasting(path) ? answer(files.read(path)) : kReadOnce) == question.answer;
            case Kind::files_below:
                return answer(files.files_below(path)) == question.answer;
            case Kind::real_path:
                return answer(files.real_path(path)) == question.answer;
        }
        return false;
    });
}

}  // namespace gobo
