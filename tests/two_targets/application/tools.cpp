#include "report.hpp"
#include "tools_lit.hpp"

void tools_() {
    tools::Key key;
    key.spot = 1;
    report("tools", tools::permutations, tools::find(key));
}
