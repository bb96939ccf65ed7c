#include "gobo/redis_cache.hpp"

#include <fmt/format.h>
#ifdef GOBO_HAS_HIREDIS
#include <fcntl.h>
#include <hiredis/hiredis.h>

#include "core/text.hpp"
#endif

namespace gobo {
namespace {

constexpr std::string_view kScheme = "redis://";

}  // namespace

bool names_redis(std::string_view cache) {
    return cache.starts_with(kScheme);
}

Result<void> refuse_other_caches(std::string_view cache) {
    if (names_redis(cache) || cache.find("://") == std::string_view::npos) return {};
    return fail(Fault::usage, fmt::format("'{}' is neither a folder nor a Redis", cache),
                "name a folder, or redis://HOST:PORT");
}

#ifdef GOBO_HAS_HIREDIS

namespace {

constexpr int kUsualPort = 6379;
/// How long Redis is waited for.
constexpr timeval kPatience{2, 0};

using Reply = std::unique_ptr<redisReply, void (*)(void*)>;

std::string name_of(const Digest& key) {
    return "gobo:" + hex(key);
}

}  // namespace

Result<std::unique_ptr<RedisCache>> RedisCache::open(const std::string& name) {
    const std::string place = name.substr(kScheme.size());
    const std::size_t colon = place.rfind(':');
    const std::string host = place.substr(0, colon);
    const int port =
        colon == std::string::npos ? kUsualPort : number_from<int>(place.substr(colon + 1)).value_or(0);
    if (host.empty() || port <= 0 || port >= 65536 || host.find('/') != std::string::npos)
        return fail(Fault::usage, fmt::format("'{}' names no Redis", name),
                    "write redis://HOST or redis://HOST:PORT");
    std::unique_ptr<RedisCache> cache(new RedisCache(name));
    cache->redis_ = redisConnectWithTimeout(host.c_str(), port, kPatience);
    if (cache->redis_ == nullptr || cache->redis_->err != 0) {
        cache->stop(cache->redis_ == nullptr ? "no memory" : cache->redis_->errstr);
        return cache;
    }
    redisSetTimeout(cache->redis_, kPatience);
    ::fcntl(cache->redis_->fd, F_SETFD, FD_CLOEXEC);
    return cache;
}

RedisCache::~RedisCache() {
    if (redis_ != nullptr) redisFree(redis_);
}

void RedisCache::stop(std::string_view why) {
    warnings_.push_back({.severity = Severity::warning,
                         .message = fmt::format("the cache {} does not answer: {}", name_, why),
                         .help = "what it would hold is computed again; name another cache, or none"});
    if (redis_ != nullptr) redisFree(redis_);
    redis_ = nullptr;
}

std::optional<std::string> RedisCache::find(const Digest& key) {
    if (redis_ == nullptr) return std::nullopt;
    const std::string name = name_of(key);
    const Reply reply(static_cast<redisReply*>(redisCommand(redis_, "GET %b", name.data(), name.size())),
                      freeReplyObject);
    if (reply == nullptr || reply->type == REDIS_REPLY_ERROR) {
        stop(reply == nullptr ? redis_->errstr : reply->str);
        return std::nullopt;
    }
    if (reply->type != REDIS_REPLY_STRING) return std::nullopt;
    return unsealed(key, {reply->str, reply->len});
}

void RedisCache::keep(const Digest& key, std::string_view result) {
    if (redis_ == nullptr) return;
    const std::string name = name_of(key);
    const std::string content = sealed(key, result);
    const Reply reply(static_cast<redisReply*>(redisCommand(redis_, "SET %b %b", name.data(), name.size(),
                                                            content.data(), content.size())),
                      freeReplyObject);
    if (reply == nullptr || reply->type == REDIS_REPLY_ERROR)
        stop(reply == nullptr ? redis_->errstr : reply->str);
}

#else

Result<std::unique_ptr<RedisCache>> RedisCache::open(const std::string& name) {
    return fail(Fault::usage, fmt::format("{} cannot be used: gobo was built without hiredis", name),
                "install libhiredis-dev and build gobo again, or name a folder");
}
RedisCache::~RedisCache() = default;
std::optional<std::string> RedisCache::find(const Digest&) {
    return std::nullopt;
}
void RedisCache::keep(const Digest&, std::string_view) {}

#endif

Diagnostics RedisCache::tidy() {
    return std::move(warnings_);
}

}  // namespace gobo
