#include "lit.hpp"
#include "report.hpp"

void parts() {
    lit::Key key;
    key.fog = lit::Fog::exponential;
    report("parts", lit::permutations, lit::find(key));
}
