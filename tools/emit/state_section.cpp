#include "emit/state_section.hpp"

#include <fmt/format.h>

namespace gobo {
namespace {

std::string member_text(const Feature& feature, const CppFeature& named) {
    return fmt::format("    {} {} = {};\n", named.type, named.member, cpp_value(named, feature.kind, 0));
}

/// Takes a feature's value from a state that has a member of its name; one that has none is left alone.
std::string taker_text(const CppFeature& named) {
    return fmt::format(
        "template <class State>\n"
        "constexpr auto take_{0}(const State& state, Key& key, int) -> decltype(void(state.{0}), "
        "std::true_type{{}}) {{\n"
        "    key.{0} = gobo::runtime::value_from<{1}>(state.{0});\n"
        "    return {{}};\n"
        "}}\n"
        "template <class State>\n"
        "constexpr std::false_type take_{0}(const State&, Key&, long) {{\n"
        "    return {{}};\n"
        "}}\n",
        named.member, named.type);
}

}  // namespace

void describe_state(const Family& family, const CppKey& key, TemplateValues& values) {
    std::string& members = values["state_members"];
    std::string& takers = values["state_takers"];
    std::string& taken = values["state_taken"];
    std::string& takes_any = values["state_takes_any"];
    for (std::size_t index = 0; index < key.features.size(); ++index) {
        const CppFeature& named = key.features[index];
        if (family.features[index].role == Role::effect)
            members += member_text(family.features[index], named);
        takers += taker_text(named);
        taken += fmt::format("    take_{}(state, key, 0);\n", named.member);
        takes_any += fmt::format(" || decltype(take_{}(state, key, 0))::value", named.member);
    }
}

}  // namespace gobo
