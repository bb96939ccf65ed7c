// Whole numbers of any size, as far as counting asks for them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace gobo {

class WholeNumber {
  public:
    WholeNumber(std::uint64_t value = 0) : digits_{value % kBase, value / kBase} {}

    WholeNumber& operator+=(const WholeNumber& other) {
        digits_.resize(std::max(digits_.size(), other.digits_.size()) + 1);
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < digits_.size(); ++i) {
            const std::uint64_t sum = digits_[i] + (i < other.digits_.size() ? other.digits_[i] : 0) + carry;
            digits_[i] = sum % kBase;
            carry = sum / kBase;
        }
        while (digits_.size() > 2 && digits_.back() == 0) digits_.pop_back();
        return *this;
    }

    /// By doubling: factors are small.
    WholeNumber& operator*=(std::uint64_t factor) {
        WholeNumber product;
        for (; factor > 0; factor /= 2) {
            if (factor % 2 == 1) product += *this;
            *this += *this;
        }
        return *this = product;
    }

    friend bool operator==(const WholeNumber&, const WholeNumber&) = default;

    /// The largest 64-bit number where it is more.
    [[nodiscard]] std::uint64_t saturated() const {
        constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
        const bool is_more =
            digits_.size() > 2 || std::pair(digits_[1], digits_[0]) > std::pair(most / kBase, most % kBase);
        return is_more ? most : digits_[1] * kBase + digits_[0];
    }

    /// In decimal.
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const std::uint64_t digit : digits_) text.insert(0, fmt::format("{:018}", digit));
        return text.substr(std::min(text.find_first_not_of('0'), text.size() - 1));
    }

  private:
    static constexpr std::uint64_t kBase = 1'000'000'000'000'000'000;
    std::vector<std::uint64_t>
        digits_;  ///< to the base, at least two, the least first; none needless above them
};

}  // namespace gobo
