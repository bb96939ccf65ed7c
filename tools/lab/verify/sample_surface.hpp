// The part of a sample that the surface models ask for: colours, sides, holes, tables of materials, and the
// light that comes from all around.
#pragma once

#include "lab/verify/random.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// Chooses which side is seen, and mirrors the model of a vertex stage. Draws only what the model asks for,
/// here and below, so that the numbers of other keys stay what they are.
void choose_side(const oracle::Model& model, StageKind stage, Random& random, Sample& sample);

/// Fills what the surface itself brings but its materials: colour, texture, the index of its material.
void fill_surface(const oracle::Model& model, StageKind stage, Random& random, Sample& sample);

/// Gives a vertex of a draw colours, texture coordinates and a material of its own.
void vary_surface(std::size_t vertex, Sample& sample);

/// Fills the light that belongs to no direction: of a hemisphere, of harmonics, the lights' own ambient
/// terms; and the thresholds of tones.
void fill_environment(const oracle::Model& model, Random& random, oracle::Scene& scene);

/// Rounds every number of those to a float.
void round_surface(Sample& sample);

}  // namespace gobo::verify
