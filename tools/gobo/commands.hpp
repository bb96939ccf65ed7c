// The commands of gobo, and the titles of those that gobo-lab holds.
#pragma once

#include "gobo/input.hpp"

namespace gobo {

[[nodiscard]] Command list_command();
[[nodiscard]] Command show_command();
[[nodiscard]] Command check_command();
[[nodiscard]] Command build_command();
[[nodiscard]] Command reflect_command();
[[nodiscard]] Command scene_command();
[[nodiscard]] Command library_command();
[[nodiscard]] Command cache_command();
[[nodiscard]] Command watch_command();
[[nodiscard]] Command merge_command();

namespace titles {
inline const Title kEval = {"eval", "Evaluate one invocation of a stage, in fp32 and fp64"};
inline const Title kTest = {"test", "Evaluate every permutation and compare it with the oracle"};
inline const Title kSanitize = {"sanitize",
                                "Watch every operation on hard inputs for what GLSL leaves undefined"};
inline const Title kProve = {"prove", "Prove over the whole domain that no operation is undefined"};
inline const Title kProbe = {"probe", "Light-probe maps and harmonics from an HDR map of an environment"};
inline const Title kRender = {"render", "A picture of every key of a selection, or of scenes"};
inline const Title kLink = {"link", "Whether OpenGL's driver links what gobo takes, key by key"};
inline const Title kCost = {"cost",
                            "What permutations cost on GPUs, as their drivers' compilers estimate it"};
inline const Title kStudy = {"study", "Error against cost of every quality: tables and a report"};
}  // namespace titles

}  // namespace gobo
