// Finished measurements, kept in a file that only grows: an interrupted study loses nothing it has measured.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/file_system.hpp"

namespace gobo::study {

/// Adds text to the end of a file.
using Append = std::function<Result<void>(const std::string& path, std::string_view text)>;

/// Measurements by the identity of everything that determines them. Used by many threads. What is kept is a
/// Measurement, CurveErrors, a TimedGroup, a double or any JSON.
class Journal {
  public:
    /// Keeps nothing on disk.
    Journal() = default;
    /// Reads what the file holds, where there is one; a last line that was cut off is left out.
    Journal(const FileSystem& files, std::string path, Append append);

    /// Nothing where it has not been measured, or was written by another gobo.
    template <class Measured>
    [[nodiscard]] std::optional<Measured> find(const std::string& identity) const;
    /// Keeps a measurement, on disk before it returns.
    template <class Measured>
    Result<void> add(const std::string& identity, const Measured& measured);

  private:
    std::string path_;
    Append append_;
    bool ends_in_the_middle_ = false;
    std::map<std::string, std::string, std::less<>> known_;  ///< JSON text by identity
    mutable std::mutex mutex_;
};

/// A short name for a text of any length.
[[nodiscard]] std::string identity_of_text(std::string_view text);

}  // namespace gobo::study
