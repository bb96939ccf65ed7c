// Binds samples of `lit` to a stage's inputs, uniforms and textures, by the reflected names of what it reads.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/verify/sample.hpp"

namespace gobo::verify {

/// One number, vector or matrix of a sample, component by component, matrices column by column.
struct Field {
    std::function<std::vector<double>(const Sample&)> get;
    std::function<void(Sample&, const std::vector<double>&)> set;
};

/// An element of an array: "lights[2].color" is 2 of "lights", then ".color".
struct ElementName {
    std::string_view array;
    std::size_t index = 0;
    std::string_view rest;
};

/// Nothing for names without a subscript. Refers to the name.
[[nodiscard]] std::optional<ElementName> element_name(std::string_view name);

/// The field of that reflected name: "PointLights.lights[2].color". Nothing where samples have no such field.
[[nodiscard]] std::optional<Field> field_of(const std::string& name);

/// What a name means to a family over `lit` that the oracle's samples are to be tried on: asked for each
/// name, with what `lit` has by it. To be set before anything is read: tests do so for a family of theirs.
using FieldOfFamily = std::optional<Field> (*)(const std::string& name, std::optional<Field> of_lit);
void lay_fields_over_lit(FieldOfFamily field);

/// The samples as invocations of the stage, each with the textures of its own. An error for an input or
/// uniform that samples have no value for.
[[nodiscard]] Result<evaluate::Invocations> bind_inputs(const evaluate::Program& program,
                                                        std::span<const Sample> samples);

/// The sample that one invocation stands for; what is not given is 0. Nothing where the stage reads something
/// that samples do not have.
[[nodiscard]] std::optional<Sample> sample_of(const evaluate::Program& program,
                                              const evaluate::Invocations& invocations);

}  // namespace gobo::verify
