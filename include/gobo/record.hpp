// Keeps the keys that a running application asked for, in a file that `gobo build --keys-from` takes: play
// the game once, build what it needed.
#pragma once

#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace gobo {

/// The keys asked for so far: those that the file held before, and each one noted since. Safe to use from
/// several threads.
///
///     gobo::KeyRecord record("game.keys");
///     record.note(lit::key_text(key));                 // wherever the application calls find()
///     record.save();                                   // once a level, at exit: whenever it suits
class KeyRecord {
  public:
    /// Takes over the keys of the file, if it is there: one a line, `#` begins a comment.
    explicit KeyRecord(std::string path) : path_(std::move(path)) {
        std::ifstream file(path_);
        for (std::string line; std::getline(file, line);) {
            const std::string key = trimmed(std::string_view(line).substr(0, line.find('#')));
            if (!key.empty()) keys_.insert(key);
        }
    }
    KeyRecord(const KeyRecord&) = delete;
    KeyRecord& operator=(const KeyRecord&) = delete;
    /// Saves what is not saved yet; a failure goes unnoticed: call save() to know.
    ~KeyRecord() {
        if (is_changed_) (void)save();
    }

    /// Notes a canonical key's text, as key_text() gives it. Whether it is a new one.
    bool note(const std::string& key_text) {
        const std::lock_guard<std::mutex> lock(mutex_);
        const bool is_new = keys_.insert(key_text).second;
        is_changed_ = is_changed_ || is_new;
        return is_new;
    }

    /// Writes the file anew, sorted, in one step: a reader sees the old file or the new one. What went wrong;
    /// empty where nothing did.
    [[nodiscard]] std::string save() {
        const std::lock_guard<std::mutex> lock(mutex_);
        const std::string beside = path_ + ".new";
        std::ofstream file(beside, std::ios::binary | std::ios::trunc);
        for (const std::string& key : keys_) file << key << '\n';
        file.close();
        std::error_code error;
        if (file) std::filesystem::rename(beside, path_, error);
        if (!file || error) {
            std::error_code ignored;
            std::filesystem::remove(beside, ignored);
            return "cannot write " + path_ + (error ? ": " + error.message() : "");
        }
        is_changed_ = false;
        return {};
    }

  private:
    static std::string trimmed(std::string_view text) {
        const std::size_t first = text.find_first_not_of(" \t\r");
        if (first == std::string_view::npos) return {};
        return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
    }

    std::string path_;
    std::mutex mutex_;
    std::set<std::string> keys_;
    bool is_changed_ = false;
};

}  // namespace gobo
