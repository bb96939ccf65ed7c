// What has to hold of whatever is read.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::fuzz {

/// libFuzzer keeps what leads to the end of its program.
inline void require(bool is_so) {
    if (!is_so) std::abort();
}

/// Errors have to say something.
template <class T>
bool is_value(const Result<T>& result) {
    if (result) return true;
    require(!result.error().empty());
    for (const Diagnostic& error : result.error()) require(!error.message.empty() && !to_text(error).empty());
    return false;
}

/// As many whole words as the input has.
inline std::vector<std::uint32_t> words_of(std::string_view input) {
    std::vector<std::uint32_t> words(input.size() / sizeof(std::uint32_t));
    if (!words.empty()) std::memcpy(words.data(), input.data(), words.size() * sizeof words[0]);
    return words;
}

}  // namespace gobo::fuzz
