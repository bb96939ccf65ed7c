// Inputs where the qualities of `lit` err most: what a search over the domain draws and varies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "family/constraint.hpp"
#include "family/family.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/oracle/model.hpp"
#include "lab/raster/random_numbers.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::study {

using SearchRandom = RandomNumbers<Xoshiro256>;

/// A number, vector or matrix that the stage reads.
struct SearchedField {
    verify::Field field;
    std::string name;  ///< reflected
    std::optional<Domain> domain;
    std::vector<std::pair<std::size_t, Domain>> parts;  ///< components with a range of their own

    [[nodiscard]] bool is_of_length() const { return domain && domain->of_length; }
};
[[nodiscard]] std::vector<SearchedField> searched_fields(const evaluate::Program& program,
                                                         const std::vector<Domain>& domains);

/// Two fields that [domain] has in an order, by their places among the fields.
struct SearchedOrder {
    std::size_t less = 0;
    std::size_t more = 0;
    Constraint::Kind kind = Constraint::Kind::less;
};
[[nodiscard]] std::vector<SearchedOrder> searched_orders(const std::vector<SearchedField>& fields,
                                                         const std::vector<Domain>& domains);

/// Puts two fields, each within its domain, into their order; whether that could be done.
[[nodiscard]] bool bring_into_order(const SearchedOrder& order, const std::vector<SearchedField>& fields,
                                    verify::Sample& sample);

/// Puts the sample where models have their edges: any shininess, narrow cones with the point beside their
/// edge, and the point anywhere from the middle of the view, 1e-3 radians from it, to straight aside.
void bring_to_edges(verify::Sample& sample, SearchRandom& random);

/// Puts the point at the viewer or 1e-20 to 1e-3 from it, and every other lamp as near to the point.
void bring_near(verify::Sample& sample, SearchRandom& random);

/// Puts out all light but that of one lamp, and fog that thins to nothing: alone a light's error shows whole.
void leave_one_light(oracle::Scene& scene, SearchRandom& random);

/// Whether the field is of a light that is out: varying it changes nothing.
[[nodiscard]] bool is_of_dark_light(const SearchedField& field, const oracle::Scene& scene);

/// The nearest that the field's domain allows.
void bring_into_domain(const SearchedField& field, verify::Sample& sample);

/// Puts one of the numbers at an end of its domain, or makes it one of those allowed besides.
void bring_to_end(const SearchedField& field, verify::Sample& sample, SearchRandom& random);

/// Gives the sample what the table of the environment BRDF holds at its roughness and n.v, as an application
/// makes it (gobo/environment_brdf.hpp): any other table would be another model.
void look_up_table(const oracle::Model& model, verify::Sample& sample);

}  // namespace gobo::study
