// The points of a scene that a picture shows, and the radiance that ought to be seen there; and the
// permutations that are evaluated at them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "compose/compose.hpp"
#include "lab/raster/shade.hpp"
#include "lab/study/plan.hpp"

namespace gobo::study {

/// What is studied, and by how many threads.
struct Subject {
    const FileSystem& shipped;  ///< holds the meshes
    const Family& family;
    const SearchPath& search;  ///< where its pieces are
    int jobs = 1;
};

/// A permutation ready to be evaluated.
struct Variant {
    Key key;
    raster::Pipeline program;
    Interface interface;
    std::uint64_t hash = 0;  ///< of both stages' SPIR-V
};

/// The permutations of some keys, with what they are made of.
struct Variants {
    Composition composition;
    std::vector<Variant> all;  ///< in the order of the composition's permutations
    std::map<Key, std::size_t> index;

    [[nodiscard]] const Variant& at(const Key& key) const { return all[index.at(key)]; }
    [[nodiscard]] std::vector<StageText> stages_of(const Key& key) const {
        return gobo::stages_of(composition, composition.permutations[index.at(key)]);
    }
};

/// Composes, validates and decodes; each key once. Errors of any of them.
[[nodiscard]] Result<Variants> load_variants(const Subject& subject, std::vector<Key> keys,
                                             Dialect dialect = Dialect::own);

using Color = std::array<double, 3>;

/// One object's visible fragments. Its mesh holds only the triangles that have some.
struct ObjectPoints {
    Object object;
    std::vector<glm::dvec4> positions;  ///< gl_Position of each vertex
    std::vector<raster::Fragment> fragments;
    std::vector<Color> reference;  ///< of each fragment
    std::vector<bool> at_edge;     ///< a question decided within a rounding: either answer is right
};

/// How much of a scene is measured.
struct PointCounts {
    bool from_oracle = false;  ///< otherwise the reference is the most accurate permutation in fp64
    std::size_t pixels = 0;    ///< that show a surface
    std::size_t edges = 0;     ///< of them, at a discontinuity
    std::size_t mesh_vertices = 0;
    std::size_t shown_vertices = 0;  ///< of the triangles that are seen
};

/// What a picture of a scene shows, drawn by the most accurate permutation of some effects.
struct ScenePoints : PointCounts {
    DrawnScene scene;
    std::vector<ObjectPoints> objects;
};

/// `accurate` is the most accurate permutation of the effects.
[[nodiscard]] Result<ScenePoints> find_points(const Family& family, const Variant& accurate,
                                              DrawnScene scene);

/// At most about `count` of the points, spread evenly.
[[nodiscard]] ScenePoints thinned(const ScenePoints& points, std::size_t count);

/// The object's points as a variant shades them.
[[nodiscard]] Result<raster::RasterObject> shaded_object(const Variant& variant, const DrawnScene& scene,
                                                         const ObjectPoints& points);

}  // namespace gobo::study
