#include "lab/oracle/decisions.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::oracle {

bool Decisions::above(double quantity, double edge) {
    const double distance = std::abs(quantity - edge);
    nearest_ = std::min(nearest_, distance);
    const bool answer = quantity > edge;
    if (distance > kEdgeWidth) return answer;
    const bool is_flipped = open_ < 32 && (flipped_ >> open_ & 1U) != 0;
    ++open_;
    return answer != is_flipped;
}

}  // namespace gobo::oracle
