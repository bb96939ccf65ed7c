// What single effects add to a sample: sides, colours, ambient light, environments, lights that are
// interpolated from vertices, shadows. Each draws only what its model asks for, so that the numbers of other
// keys stay.
#pragma once

#include "lab/raster/random.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// Chooses which side is seen, and mirrors the model of a vertex stage.
void choose_side(const oracle::Model& model, StageKind stage, Random& random, Sample& sample);

/// Fills what the surface itself brings but its materials: colour, texture, the index of its material.
void fill_surface(const oracle::Model& model, StageKind stage, Random& random, Sample& sample);

/// Fills the material of a physically based surface: metallic 0, 1 or between, roughness from 0 to 1.
void fill_metallic_roughness(Random& random, Sample& sample);

/// Gives a vertex of a draw colours, texture coordinates and a material of its own.
void vary_surface(std::size_t vertex, Sample& sample);

/// The scene with local lights that are white and 1 bright: what arrives of them is their attenuation. Lights
/// that arrive refer to those of their scene.
[[nodiscard]] oracle::Scene with_white_lights(oracle::Scene scene);

/// Gives the point what interpolation makes of its lights': with hybrid shading rays and half vectors,
/// shorter than 1, attenuations a little off, now and then below 0; cosines nearer to 0 where the vertices
/// find them.
void interpolate_lights(const oracle::Model& model, const oracle::Scene& scene, Random& random,
                        oracle::SurfacePoint& point);

/// Gives the sample what few models ask for. The shadows that the model counts, and maps for them: of 1 to 8
/// texels a side, the point on the map or a little beside it, before or behind the light, and texels around
/// that are nearer to the light than the point by up to 0.3, or further. The light that belongs to no
/// direction: of a hemisphere, of harmonics, the lights' own ambient terms, environments to look up, bright
/// in the mean and brighter to one side, turned any way. The thresholds of tones.
void fill_effects(const oracle::Model& model, Random& random, Sample& sample);

}  // namespace gobo::verify
