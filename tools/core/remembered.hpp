// What took long to find out, kept in a cache from one run to the next: an interrupted run, or one that is
// parted among computers, computes nothing twice.
#pragma once

#include <mutex>
#include <optional>
#include <utility>

#include "core/bytes.hpp"
#include "core/result_cache.hpp"

namespace gobo {

class Remembered {
  public:
    /// Null: nothing is kept.
    explicit Remembered(ResultCache* cache) : cache_(cache) {}

    /// What `make` gives, or gave an earlier run. `key` is of everything that it depends on. Threads may ask.
    template <class Value, class Make>
    [[nodiscard]] Value get(const Digest& key, const Make& make) {
        if (cache_ == nullptr) return make();
        if (const std::optional<std::string> bytes = find(key))
            if (std::optional<Value> value = from_bytes<Value>(*bytes)) return std::move(*value);
        Value value = make();
        const std::string bytes = to_bytes(value);
        const std::lock_guard lock(mutex_);
        cache_->keep(key, bytes);
        return value;
    }

  private:
    std::optional<std::string> find(const Digest& key) {
        const std::lock_guard lock(mutex_);
        return cache_->find(key);
    }

    ResultCache* cache_;
    std::mutex mutex_;
};

}  // namespace gobo
