// A permutation's picture without a renderer: how far the drawn one is from it, and what it costs.
#pragma once

#include "lab/gallery/drawing.hpp"
#include "lab/study/weights.hpp"
#include "validate/validate.hpp"
#include "lab/verify/compare_picture.hpp"

namespace gobo::gallery {

struct Evaluation {
    verify::PictureReport report;  ///< with its pictures
    double fragment_cost = 0;      ///< of a fragment on average, in the weights' unit
    double vertex_cost = 0;        ///< of a vertex
};

/// Evaluates the stages in fp32 for every pixel of the drawing. Errors of decoding and of the scene's values.
[[nodiscard]] Result<Evaluation> evaluate_drawing(const Drawing& drawing, const Scene& scene,
                                                  const SpirvModule& vertex, const SpirvModule& fragment,
                                                  const Interface& interface, const study::Weights& weights);

}  // namespace gobo::gallery
