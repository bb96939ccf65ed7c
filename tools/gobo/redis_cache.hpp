// Results kept in Redis, for builds on several computers.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/result_cache.hpp"

struct redisContext;

namespace gobo {

/// "redis://" begins the name of such a cache.
[[nodiscard]] bool names_redis(std::string_view cache);
/// An error where it names a cache in another way, such as `http://`.
[[nodiscard]] Result<void> refuse_other_caches(std::string_view cache);

/// A key for each result, "gobo:" and its digits. How much is kept is Redis's to say (maxmemory, and
/// maxmemory-policy allkeys-lru). Once it does not answer, nothing more is asked of it.
class RedisCache final : public ResultCache {
  public:
    /// At "redis://HOST" or "redis://HOST:PORT". Fault::usage for what is no such name, and where gobo was
    /// built without hiredis. One that cannot be reached keeps nothing, and tidy() warns of it.
    [[nodiscard]] static Result<std::unique_ptr<RedisCache>> open(const std::string& name);
    ~RedisCache() override;
    RedisCache(const RedisCache&) = delete;
    RedisCache& operator=(const RedisCache&) = delete;

    [[nodiscard]] std::optional<std::string> find(const Digest& key) override;
    void keep(const Digest& key, std::string_view result) override;
    [[nodiscard]] Diagnostics tidy() override;

  private:
    explicit RedisCache(std::string name) : name_(std::move(name)) {}
    void stop(std::string_view why);

    std::string name_;
    redisContext* redis_ = nullptr;  ///< null once it does not answer
    Diagnostics warnings_;
};

}  // namespace gobo
