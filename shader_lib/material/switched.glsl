// One material for the whole draw or a table of them, as a switch has it (L8, S9, S10).
//
// Model:  the table's first row serves a whole draw.
// Source: as the table's. Edges: as the table's; an unknown number is one material.
// Range:  as the materials'.
#include "material/array.glsl" with chooseMaterial as chooseRow
#include "uber/switches.glsl"

/// Makes `material` that of the surface point. To be called first.
void chooseMaterial() {
    if (switches.material == 1) {
        chooseRow();
    } else {
        material = materials.rows[0];
    }
}
