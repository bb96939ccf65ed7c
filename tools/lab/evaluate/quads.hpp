// Neighbours of a lane in its quad. Internal to evaluation.
#pragma once

#include <cstddef>

namespace gobo::evaluate {

/// The change of a row from the left to the right pixel in the lane's line of its quad.
template <class T>
[[nodiscard]] inline T difference_x(const T* row, std::size_t lane) {
    const std::size_t left = lane & ~std::size_t{1};
    return row[left + 1] - row[left];
}

/// The change in +y in the lane's column of its quad.
template <class T>
[[nodiscard]] inline T difference_y(const T* row, std::size_t lane) {
    const std::size_t first = lane & ~std::size_t{2};
    return row[first + 2] - row[first];
}

}  // namespace gobo::evaluate
