// A draw with glTF's own material, as the family `pbr` takes it.
#pragma once

#include <array>
#include <optional>

#include "pbr.hpp"
#include "scene/effects.hpp"
#include "settings.hpp"

namespace viewer {

struct PhysicalDraw {
    pbr::SceneState state;
    pbr::Material material{};
    pbr::Iridescence_block iridescence{};
    pbr::TexturePlacements placements{};
    pbr::Cutout cutout{};
    float mirrored = 0;  ///< the environment's share in what it mirrors
    /// Of the scene's pictures, by the numbers of gobo::scene::MapKind.
    std::array<std::optional<gobo::scene::TextureUse>, gobo::scene::kMapFeatures.size()> maps;
    bool is_blended = false;
};

/// All but what its effects decide.
[[nodiscard]] PhysicalDraw physical_draw_of(const gobo::scene::Scene& scene, const gobo::scene::Draw& draw);

/// Whether this viewer draws the effect, which the state then calls for.
[[nodiscard]] bool call_for(const gobo::scene::Effect& effect, pbr::SceneState& state);

/// The state with the settings applied: what they turn off is not needed.
[[nodiscard]] pbr::SceneState under(const pbr::SceneState& state, const Settings& settings);

}  // namespace viewer
