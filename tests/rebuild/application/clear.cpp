#include "lit.hpp"

int main() {
    lit::Key key;
    key.point = 1;
    key.spot = 1;
    return lit::find(key) != nullptr && lit::permutations.size() == 4 ? 0 : 1;
}
