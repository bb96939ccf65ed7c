#include "lit.hpp"

int main() {
    game::foggy::Key key;
    key.fog = game::foggy::Fog::linear;
    key.point = 1;
    return game::foggy::find(key) != nullptr && game::foggy::permutations.size() == 2 ? 0 : 1;
}
