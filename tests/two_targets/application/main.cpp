// An application linked with four libraries that have headers of the same family.
#include "effects/shaders.hpp"
#include "lit.hpp"
#include "report.hpp"
#include "tools_lit.hpp"

void engine();
void plugin();
void parts();
void tools_();

int main() {
    lit::Key key;
    key.point = 2;
    report("application", lit::permutations, lit::find(key));
    effects::Key effect;
    effect.spot = 2;
    report("effects", effects::permutations, effects::find(effect));
    tools::Key tool;
    tool.spot = 1;
    report("tools, seen from outside", tools::permutations, tools::find(tool));
    engine();
    plugin();
    parts();
    tools_();
}
