// Results kept for later runs, found by the digest of all that they were computed from.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/diagnostic.hpp"
#include "core/digest.hpp"

namespace gobo {

class ResultCache {
  public:
    ResultCache() = default;
    ResultCache(const ResultCache&) = delete;
    ResultCache& operator=(const ResultCache&) = delete;
    virtual ~ResultCache() = default;

    [[nodiscard]] virtual std::optional<std::string> find(const Digest& key) = 0;
    virtual void keep(const Digest& key, std::string_view result) = 0;
    /// Once all is kept: makes room. A warning where a result could not be kept.
    [[nodiscard]] virtual Diagnostics tidy() { return {}; }
};

/// The result behind a head with a version, its size and a checksum of it and its key.
[[nodiscard]] std::string sealed(const Digest& key, std::string_view result);
/// The result of what sealed() gave for the key; nothing where anything of it differs.
[[nodiscard]] std::optional<std::string> unsealed(const Digest& key, std::string_view content);

/// For as long as the process lives.
class MemoryCache final : public ResultCache {
  public:
    [[nodiscard]] std::optional<std::string> find(const Digest& key) override;
    void keep(const Digest& key, std::string_view result) override;

  private:
    std::map<Digest, std::string> results_;
};

/// A folder with a file for each result, which several processes may use at once. A file is written under
/// another name and renamed; one that is not whole counts as none and is removed, as is an empty folder or a
/// link in its place.
class DiskCache final : public ResultCache {
  public:
    /// The folder is made when the first result is kept.
    explicit DiskCache(std::string folder, std::uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    [[nodiscard]] std::optional<std::string> find(const Digest& key) override;
    void keep(const Digest& key, std::string_view result) override;

    /// Removes the results that were used longest ago from the sixteen parts of the folder to which something
    /// was added, until each holds no more than its sixteenth of `most_bytes`.
    [[nodiscard]] Diagnostics tidy() override;

    struct Size {
        std::uint64_t results = 0;
        std::uint64_t bytes = 0;
        /// Errors, Fault::file, where there may be more; warnings of what is in a part's place and no folder.
        Diagnostics diagnostics = {};
    };
    [[nodiscard]] Size size() const;
    /// Removes every result that can be, and nothing else; what that was.
    [[nodiscard]] Size clear();

  private:
    /// Calls `use(file)` for every file of the results, and `leave(part)` after those of a part.
    [[nodiscard]] Diagnostics for_each(const auto& use, const auto& leave) const;
    [[nodiscard]] std::string path_of(const Digest& key) const;

    std::string folder_;
    std::uint64_t most_bytes_;
    std::set<char> grown_;  ///< parts, by their names' digit
    int error_ = 0;         ///< errno of the last result that could not be kept
    std::string error_place_;
    std::uint64_t written_ = 0;
};

}  // namespace gobo
