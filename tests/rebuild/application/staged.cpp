#include "lit.hpp"

int main() {
    lit::Key teapot;
    teapot.directional = 2;
    teapot.point = 2;
    teapot.spot = 2;
    teapot.fog = lit::Fog::linear;
    teapot.specular = lit::Specular::blinn;
    return lit::find(teapot) != nullptr && lit::permutations.size() == 2 ? 0 : 1;
}
