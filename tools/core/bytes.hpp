// Values as bytes, for child processes and for the cache: of this computer and this build alone.
//
// What a struct holds is said by GOBO_FIELDS beside it, which names each field, so that one that is added to
// the struct does not compile until it is added there.
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/diagnostic.hpp"

namespace gobo {

/// One of the types, constant or not: a fields() serves the writer and the reader.
template <class T, class... Others>
concept OneOf = (std::same_as<std::remove_const_t<T>, Others> || ...);

/// fields() of a struct of this namespace, which writer and reader call.
#define GOBO_FIELDS(Struct, ...)                            \
    void fields(auto& archive, OneOf<Struct> auto& value) { \
        auto& [__VA_ARGS__] = value;                        \
        archive(__VA_ARGS__);                               \
    }

GOBO_FIELDS(Place, file, line, column)
GOBO_FIELDS(Diagnostic, severity, fault, place, message, quoted_line, help, subject, more_keys)

namespace detail {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Strings and vectors.
template <class T>
concept List = requires(T& value) {
    value.resize(1);
};

template <class T>
concept Map = requires {
    typename T::mapped_type;
};

/// std::optional, and Result, which holds errors where there is no value.
template <class T>
concept Maybe = requires(T& value) {
    value.has_value();
};
template <class T>
concept ValueOrErrors = requires(T& value) {
    value.error();
};

template <class T>
concept Pair = requires(T& value) {
    value.first;
    value.second;
};

class ByteWriter {
  public:
    void operator()(const auto&... values) { (put(values), ...); }
    [[nodiscard]] std::string result() && { return std::move(bytes_); }

  private:
    /// Not by append(), of which g++ 12 warns without reason once it is inlined.
    void put_raw(const void* data, std::size_t size) {
        const std::size_t before = bytes_.size();
        bytes_.resize(before + size);
        if (size > 0) std::memcpy(bytes_.data() + before, data, size);
    }

    template <class T>
    void put(const T& value) {
        if constexpr (Plain<T>) {
            put_raw(&value, sizeof value);
        } else if constexpr (List<T>) {
            put(std::uint64_t{value.size()});
            if constexpr (Plain<typename T::value_type>)
                put_raw(value.data(), value.size() * sizeof(typename T::value_type));
            else
                for (const auto& element : value) put(element);
        } else if constexpr (Map<T>) {
            put(std::uint64_t{value.size()});
            for (const auto& [key, element] : value) (*this)(key, element);
        } else if constexpr (Pair<T>) {
            (*this)(value.first, value.second);
        } else if constexpr (Maybe<T>) {
            put(value.has_value());
            if (value) return put(*value);
            if constexpr (ValueOrErrors<T>) put(value.error());
        } else {
            fields(*this, value);
        }
    }

    std::string bytes_;
};

class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    void operator()(auto&... values) { (take(values), ...); }
    [[nodiscard]] bool is_fine() const { return is_fine_ && bytes_.empty(); }

  private:
    void take_raw(void* data, std::size_t size) {
        is_fine_ = is_fine_ && size <= bytes_.size();
        if (!is_fine_ || size == 0) return;
        std::memcpy(data, bytes_.data(), size);
        bytes_.remove_prefix(size);
    }

    template <class T>
    void take(T& value) {
        if constexpr (Plain<T>) {
            take_raw(&value, sizeof value);
        } else if constexpr (List<T>) {
            using Element = typename T::value_type;
            std::uint64_t size = 0;
            take(size);
            is_fine_ = is_fine_ && size <= bytes_.size();  // each element takes a byte at least
            if (!is_fine_) return;
            if constexpr (Plain<Element>) {
                is_fine_ = size * sizeof(Element) <= bytes_.size();
                if (is_fine_) value.resize(size);
                take_raw(value.data(), is_fine_ ? size * sizeof(Element) : 0);
            } else {
                for (; size > 0 && is_fine_; --size) take(value.emplace_back());
            }
        } else if constexpr (Map<T>) {
            std::uint64_t size = 0;
            take(size);
            for (; size > 0 && is_fine_; --size) {
                typename T::key_type key{};
                take(key);
                take(value[key]);
            }
        } else if constexpr (Pair<T>) {
            (*this)(value.first, value.second);
        } else if constexpr (Maybe<T>) {
            bool has_value = false;
            take(has_value);
            if (has_value) {
                if (!value) value.emplace();
                take(*value);
            } else if constexpr (ValueOrErrors<T>) {
                value = tl::unexpected(Diagnostics{});
                take(value.error());
            }
        } else {
            fields(*this, value);
        }
    }

    std::string_view bytes_;
    bool is_fine_ = true;
};

}  // namespace detail

/// The values, one after the other.
template <class... Values>
[[nodiscard]] std::string to_bytes(const Values&... values) {
    detail::ByteWriter writer;
    writer(values...);
    return std::move(writer).result();
}

/// The value that to_bytes() was given; nothing where the bytes are damaged.
template <class Value>
[[nodiscard]] std::optional<Value> from_bytes(std::string_view bytes) {
    std::optional<Value> value(std::in_place);
    detail::ByteReader reader(bytes);
    reader(*value);
    if (!reader.is_fine()) value.reset();
    return value;
}

}  // namespace gobo
