// The part of a generated header that maps an application's own state to a key.
#pragma once

#include "emit/header_templates.hpp"
#include "emit/key_names.hpp"
#include "family/family.hpp"

namespace gobo {

/// Adds the values of the templates' placeholders about SceneState and select().
void describe_state(const Family& family, const CppKey& key, TemplateValues& values);

}  // namespace gobo
