// What `gobo study` measures of a family: a TOML file of its own.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "family/family.hpp"

namespace gobo::study {

/// An object on a floor, seen by a camera. World coordinates, as those of [render].
struct StudyScene {
    std::string name;
    std::string mesh = "teapot";  ///< teapot, sphere, torus or plane, sized to stand on the floor
    int detail = 64;              ///< of all but the teapot: slices around, or cells along a side
    int floor_cells = 96;         ///< quads along a side of the floor; 0: there is none
    std::array<double, 3> camera = {0, 1.5, 5};
    std::array<double, 3> target = {0, -0.05, 0};
    std::vector<RenderValue> values = {};  ///< over those of [render]
};

/// A quality feature's values, measured along a uniform.
struct StudyCurve {
    std::string feature;
    std::string over;  ///< reflected name of a uniform: "Material.shininess"
    std::vector<double> numbers;
    std::string effects;  ///< key text
};

/// Two values of an effect that texts take for one another, compared as models: no error of either.
struct StudyChange {
    std::string from;  ///< key text
    std::string to;
    std::vector<RenderValue> from_values;  ///< over those of [render]
    std::vector<RenderValue> to_values;
};

struct StudyPlan {
    std::vector<std::string> effects;  ///< key texts of combinations of effects
    std::vector<std::string> quick;    ///< those that are enough for a first look
    std::vector<std::string> rate;     ///< quality features that say where, not how, light is computed
    std::vector<StudyScene> scenes;
    std::vector<StudyCurve> curves;
    std::vector<StudyChange> changes;
};

/// The plan of a TOML text, what it leaves out filled in as by default_plan(). Errors: unknown names, keys
/// that the family does not have, at their places.
[[nodiscard]] Result<StudyPlan> read_plan(std::string_view text, const std::string& path,
                                          const Family& family);

/// Up to eight combinations of effects of the family's default set, on two scenes.
[[nodiscard]] StudyPlan default_plan(const Family& family);

}  // namespace gobo::study
