// An application written before the family grew: it must compile unchanged, and find the same texts.
#include <cstdio>
#include <string>
#include <string_view>

#include "lit.hpp"

namespace {

bool finds(const lit::Key& key, std::string_view expected_key) {
    const lit::Permutation* found = lit::find(key);
    if (found == nullptr) {
        std::printf("%s\n", lit::describe_missing(key).c_str());
        return false;
    }
    const std::string source = found->fragment.source();
    const bool same = source.find("// " + std::string(expected_key) + "\n") != std::string::npos &&
                      lit::key_text(found->key()) == expected_key;
    if (!same) std::printf("not %s but:\n%s", std::string(expected_key).c_str(), source.c_str());
    return same;
}

}  // namespace

int main() {
    lit::Key key;
    bool fine = finds(key, "default");
    key.point = 3;
    fine = finds(key, "point=3") && fine;
    key.shading = lit::Shading::vertex;
    key.fog = lit::Fog::linear;
    fine = finds(key, "fog=linear point=3 shading=vertex") && fine;
#if __cplusplus >= 202002L
    fine = finds({.directional = 2}, "directional=2") && fine;
#endif
    lit::PointLights lights{};
    lights.lights[0].color = glm::vec3(1.0F);
    fine = lit::PointLights::bytes(3) == 160 && lights.lights[0].color.x == 1.0F && fine;
    return fine ? 0 : 1;
}
