#include "lit.hpp"
#include "report.hpp"

void engine() {
    lit::Key key;
    key.directional = 1;
    report("engine", lit::permutations, lit::find(key));
}
