// One material for the whole draw, the table's first row, or the table, as a switch has it.
//
// A stage holds several values of the feature: the preprocessor renames what each defines for as long as its piece lasts.

#piece as_array
#define chooseMaterial chooseRow

#piece as_itself
#undef chooseMaterial

#piece switched
#include "material/as_array.glsl"
#include "material/array.glsl"
#include "material/as_itself.glsl"
#include "uber/switches.glsl"

/// Makes `material` that of the surface point. To be called first.
void chooseMaterial() {
    if (switches.material == 1) {
        chooseRow();
    } else {
        material = materials.rows[0];
    }
}
