#include "lab/oracle/output_range.hpp"

#include <glm/common.hpp>

namespace gobo::oracle {

glm::dvec3 within_range(OutputRange range, const glm::dvec3& radiance) {
    switch (range) {
        case OutputRange::half_float:
            return glm::min(radiance, glm::dvec3((2 - 0x1p-10) * 0x1p15));
        case OutputRange::display:
            return glm::min(radiance, glm::dvec3(1));
        case OutputRange::unbounded:
            break;
    }
    return radiance;
}

}  // namespace gobo::oracle
