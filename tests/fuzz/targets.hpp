// What is given inputs of every kind: by libFuzzer (-D GOBO_FUZZ=ON), and by the normal tests those of
// corpus/. Every one of them either ends in a value or in errors with messages; anything else aborts.
// Whether it was a value.
#pragma once

#include <string_view>

namespace gobo::fuzz {

bool read_family(std::string_view input);
bool read_condition(std::string_view input);
bool read_selection(std::string_view input);
bool read_compose(std::string_view input);
bool read_header(std::string_view input);
bool read_names(std::string_view input);
bool read_spirv(std::string_view input);
bool read_evaluate(std::string_view input);
bool read_gltf(std::string_view input);
bool read_picture(std::string_view input);
bool read_exr(std::string_view input);
bool read_png(std::string_view input);
bool read_declarations(std::string_view input);
bool read_cache(std::string_view input);

struct Target {
    std::string_view name;  ///< of its folder in corpus/ too
    bool (*run)(std::string_view input);
};

inline constexpr Target kTargets[] = {
    {"family", &read_family},
    {"condition", &read_condition},
    {"selection", &read_selection},
    {"compose", &read_compose},
    {"header", &read_header},
    {"names", &read_names},
    {"spirv", &read_spirv},
    {"evaluate", &read_evaluate},
    {"gltf", &read_gltf},
    {"picture", &read_picture},
    {"exr", &read_exr},
    {"png", &read_png},
    {"declarations", &read_declarations},
    {"cache", &read_cache},
};

}  // namespace gobo::fuzz
