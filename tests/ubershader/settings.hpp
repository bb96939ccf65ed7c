// The family `uber`, and what it may be asked to do: the settings of the switches that it reads at run time.
#pragma once

#include <vector>

#include "compose/search_path.hpp"
#include "family/family.hpp"
#include "lab/oracle/model.hpp"

namespace gobo::uber {

/// The family as it stands in the source tree, and where its pieces and those of `lit` are.
[[nodiscard]] Family family();
void add_pieces(SearchPath& search);

/// The key that leaves every effect to a switch, its lights found as `lighting` says: "switched" or "looped".
[[nodiscard]] Key switched_key(const Family& family, const char* lighting);

/// Whether some feature of the key is left to a switch: `diffuse=switched`, `lighting=looped`.
[[nodiscard]] bool has_switches(const Family& family, const Key& key);

/// How many lights the array of switched lights holds, as lighting.glsl has it.
inline constexpr int kSwitchedLights = 10;

/// Keys that say at build time what switches say at run time, every pair of settings among them: each feature
/// that the key leaves to a switch, and how many lights there are of each kind and cast shadows. They are in
/// the rules' canonical form; quality and pipeline are the key's. The key itself where it has no switches.
[[nodiscard]] Result<std::vector<Key>> settings_of(const Family& family, const Key& key);

/// What a key stands for: one model, or one for each of the settings of its switches.
[[nodiscard]] std::vector<oracle::Model> models_of(const Family& family, const Key& key);

}  // namespace gobo::uber
