// Extreme scale, measured: how far normals are off under a scale of 1 : 1e4, by how near they are to the long
// axis.
#pragma once

#include <vector>

namespace gobo {

/// The largest angles, in radians, by which normals are off over random models that are scaled by (1, 1, 1e4)
/// between two rotations.
struct NormalErrors {
    double away = 0;   ///< angle of the normal from the long axis, radians
    double plain = 0;  ///< by cofactors in single precision, as a shader would compute them
    double ours = 0;   ///< by gobo::normal_matrix() of the matrix in double precision
};

/// A row for each of a few angles, the largest first. The same each time.
[[nodiscard]] std::vector<NormalErrors> normal_errors();

}  // namespace gobo
