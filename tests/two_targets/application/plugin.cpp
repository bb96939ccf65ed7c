#include "lit.hpp"
#include "report.hpp"

void plugin() {
    lit::Key key;
    key.fog = lit::Fog::linear;
    report("plugin", lit::permutations, lit::find(key));
}
