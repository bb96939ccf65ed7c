// Holes cut by alpha, where a switch has it so (L8, S16).
//
// Model:  that of the threshold, or the whole surface.
// Source, ranges, edges: as the threshold's.
#include "cutout/threshold.glsl" with cutOut as cutOutHoles
#include "uber/switches.glsl"

/// Discards the fragment where the surface has a hole.
void cutOut() {
    if (switches.cutout == 1) cutOutHoles();
}
