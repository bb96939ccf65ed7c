// The part of a generated header that holds the permutations: packed keys, stages as lists of pieces, texts.
#pragma once

#include "compose/composition.hpp"
#include "emit/header_templates.hpp"
#include "emit/key_names.hpp"

namespace gobo {

/// Adds the values of the templates' placeholders about permutations. Only stages and pieces that a
/// permutation uses are written, in the order of the composition; permutations are sorted by packed key.
void describe_permutations(const Composition& composition, const CppKey& key, TemplateValues& values);

}  // namespace gobo
