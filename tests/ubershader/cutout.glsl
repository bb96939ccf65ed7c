// Holes cut by alpha, where a switch has it so.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_threshold
#define cutOut cutOutHoles

#piece as_itself
#undef cutOut

#piece switched
#include "cutout/as_threshold.glsl"
#include "cutout/threshold.glsl"
#include "cutout/as_itself.glsl"
#include "uber/switches.glsl"

/// Discards the fragment where the surface has a hole.
void cutOut() {
    if (switches.cutout == 1) cutOutHoles();
}
