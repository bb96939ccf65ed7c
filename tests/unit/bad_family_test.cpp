// Family files that are refused, each with the message it earns.
#include <gtest/gtest.h>

#include "family/read_family.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

/// What stands behind the three lines of the head, and the message it earns.
struct BadRow {
    const char* name;
    const char* body;
    const char* message;
};

const BadRow bad_rows[] = {
    {"feature_that_is_no_table",
     "[features]\n"
     "fog = 3\n",
     "tiny.toml:5:7: error: feature 'fog' must be an identifier with a table\n"
     "    fog = 3\n"
     "          ^\n"
     "  help: write [features.NAME] with values, count or define\n"},
    {"feature_with_a_bad_name",
     "[features.\"2d\"]\n"
     "define = \"A\"\n",
     "tiny.toml:4:1: error: feature '2d' must be an identifier with a table\n"
     "    [features.\"2d\"]\n"
     "    ^\n"
     "  help: write [features.NAME] with values, count or define\n"},
    {"feature_of_no_kind",
     "[features.fog]\n"
     "role = \"effect\"\n",
     "tiny.toml:4:1: error: feature 'fog' must be one of a choice, a count and a define\n"
     "    [features.fog]\n"
     "    ^\n"
     "  help: give it exactly one of values, count and define\n"},
    {"unknown_role",
     "[features.fog]\n"
     "role = \"efect\"\n"
     "define = \"A\"\n",
     "tiny.toml:5:8: error: feature 'fog' has no role 'efect'\n"
     "    role = \"efect\"\n"
     "           ^\n"
     "  help: did you mean 'effect'?\n"},
    {"unknown_name_in_a_feature",
     "[features.fog]\n"
     "value = [\"a\"]\n",
     "tiny.toml:5:1: error: unknown name 'value' in feature 'fog'\n"
     "    value = [\"a\"]\n"
     "    ^\n"
     "  help: did you mean 'values'?\n"},
    {"choice_without_values",
     "[features.fog]\n"
     "values = []\n",
     "tiny.toml:5:10: error: feature 'fog' has no values\n"
     "    values = []\n"
     "             ^\n"
     "  help: list at least one; the first is the default\n"},
    {"value_of_wrong_type",
     "[features.fog]\n"
     "values = [\"a\", 2]\n",
     "tiny.toml:5:16: error: 'values' must be an array of strings\n"
     "    values = [\"a\", 2]\n"
     "                   ^\n"
     "  help: write values = [\"...\", \"...\"]\n"},
    {"value_with_a_bad_name",
     "[features.fog]\n"
     "values = [\"a b\"]\n",
     "tiny.toml:5:10: error: feature 'fog' cannot have the value 'a b'\n"
     "    values = [\"a b\"]\n"
     "             ^\n"
     "  help: use letters, digits and _: it names a file and a C++ enumerator\n"},
    {"value_twice",
     "[features.fog]\n"
     "values = [\"a\", \"b\", \"a\"]\n",
     "tiny.toml:5:10: error: feature 'fog' has the value 'a' twice\n"
     "    values = [\"a\", \"b\", \"a\"]\n"
     "             ^\n"
     "  help: list it once\n"},
    {"varying_counted_by_a_choice",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "[varyings.rays]\n"
     "count = \"fog\"\n"
     "type = \"vec3\"\n"
     "value = \"v\"\n",
     "tiny.toml:7:9: error: varying 'rays' is counted by 'fog', which is not a count\n"
     "    count = \"fog\"\n"
     "            ^\n"
     "  help: there are none\n"},
    {"varying_with_location_and_count",
     "[features.point]\n"
     "count = [0, 4]\n"
     "constant = \"N\"\n"
     "[varyings.rays]\n"
     "count = \"point\"\n"
     "location = 1\n"
     "type = \"vec3\"\n"
     "value = \"v\"\n",
     "tiny.toml:9:12: error: varying 'rays' has a location and a count\n"
     "    location = 1\n"
     "               ^\n"
     "  help: leave the location out: counted varyings lie behind the others\n"},
    {"varying_with_too_many_values_in_an_element",
     "[features.point]\n"
     "count = [0, 4]\n"
     "constant = \"N\"\n"
     "[varyings.rays]\n"
     "count = \"point\"\n"
     "values_per_element = 5\n"
     "type = \"vec4\"\n"
     "value = \"v\"\n",
     "tiny.toml:9:22: error: varying 'rays' has no valid values_per_element\n"
     "    values_per_element = 5\n"
     "                         ^\n"
     "  help: write a number from 1 to 4 beside a count\n"},
    {"domain_last_is_no_range",
     "[domain]\n"
     "\"rays[]\" = { length = [0, 1], last = [2] }\n",
     "tiny.toml:5:38: error: the domain of 'rays[]' is not a range\n"
     "    \"rays[]\" = { length = [0, 1], last = [2] }\n"
     "                                         ^\n"
     "  help: write last = [low, high]\n"},
    {"default_unknown",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "default = \"twoo\"\n",
     "tiny.toml:6:11: error: feature 'fog' has no value 'twoo' to default to\n"
     "    default = \"twoo\"\n"
     "              ^\n"
     "  help: did you mean 'two'?\n"},
    {"default_of_a_count",
     "[features.point]\n"
     "count = [0, 4]\n"
     "default = \"1\"\n"
     "constant = \"N\"\n",
     "tiny.toml:6:11: error: feature 'point' cannot name its default\n"
     "    default = \"1\"\n"
     "              ^\n"
     "  help: only a choice can: a count's is its least, a define's is off\n"},
    {"enum_of_a_define",
     "[features.bump]\n"
     "define = \"BUMP\"\n"
     "enum = \"Bump\"\n",
     "tiny.toml:6:8: error: feature 'bump' cannot name an enum\n"
     "    enum = \"Bump\"\n"
     "           ^\n"
     "  help: only a choice has one: a count is an int, a define a bool\n"},
    {"enum_that_is_no_type",
     "[features.fog]\n"
     "values = [\"a\", \"b\"]\n"
     "enum = \"Fog kind\"\n",
     "tiny.toml:6:8: error: feature 'fog' has 'Fog kind' for an enum\n"
     "    enum = \"Fog kind\"\n"
     "           ^\n"
     "  help: name it as C++ names a type, such as FogKind\n"},
    {"excluded_explicit_default",
     "[features.fog]\n"
     "values = [\"a\", \"b\"]\n"
     "default = \"b\"\n"
     "excluded = [\"b\"]\n",
     "tiny.toml:7:12: error: feature 'fog' cannot exclude 'b'\n"
     "    excluded = [\"b\"]\n"
     "               ^\n"
     "  help: the default cannot be excluded\n"},
    {"excluded_default",
     "[features.fog]\n"
     "values = [\"a\", \"b\"]\n"
     "excluded = [\"a\"]\n",
     "tiny.toml:6:12: error: feature 'fog' cannot exclude 'a'\n"
     "    excluded = [\"a\"]\n"
     "               ^\n"
     "  help: the default cannot be excluded\n"},
    {"excluded_unknown",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "excluded = [\"twoo\"]\n",
     "tiny.toml:6:12: error: feature 'fog' cannot exclude 'twoo'\n"
     "    excluded = [\"twoo\"]\n"
     "               ^\n"
     "  help: did you mean 'two'?\n"},
    {"retired",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "retired = [\"two\"]\n",
     "tiny.toml:6:11: error: feature 'fog' has retired values\n"
     "    retired = [\"two\"]\n"
     "              ^\n"
     "  help: 'retired' is now 'excluded'\n"},
    {"renamed_to_nothing",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "[renamed]\n"
     "mist = \"foggy\"\n",
     "tiny.toml:7:8: error: 'mist' cannot have been renamed to 'foggy'\n"
     "    mist = \"foggy\"\n"
     "           ^\n"
     "  help: write OLD = \"FEATURE\" or \"FEATURE=OLD\" = \"FEATURE=VALUE\", of which only the new one "
     "exists\n"},
    {"renamed_though_it_is_there",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "[renamed]\n"
     "\"fog=one\" = \"fog=two\"\n",
     "tiny.toml:7:13: error: 'fog=one' cannot have been renamed to 'fog=two'\n"
     "    \"fog=one\" = \"fog=two\"\n"
     "                ^\n"
     "  help: write OLD = \"FEATURE\" or \"FEATURE=OLD\" = \"FEATURE=VALUE\", of which only the new one "
     "exists\n"},
    {"renamed_without_its_value",
     "[features.fog]\n"
     "values = [\"one\", \"two\"]\n"
     "[renamed]\n"
     "\"fog=1\" = \"one\"\n",
     "tiny.toml:7:11: error: 'fog=1' cannot have been renamed to 'one'\n"
     "    \"fog=1\" = \"one\"\n"
     "              ^\n"
     "  help: write OLD = \"FEATURE\" or \"FEATURE=OLD\" = \"FEATURE=VALUE\", of which only the new one "
     "exists\n"},
    {"count_that_falls",
     "[features.point]\n"
     "count = [4, 3]\n"
     "constant = \"N\"\n",
     "tiny.toml:5:9: error: feature 'point' has no valid count\n"
     "    count = [4, 3]\n"
     "            ^\n"
     "  help: write count = [LEAST, MOST], whole numbers from 0 to 4096, MOST not below LEAST\n"},
    {"version_unknown", "version = \"335 core\"\n",
     "tiny.toml:4:11: error: GLSL has no version '335 core'\n"
     "    version = \"335 core\"\n"
     "              ^\n"
     "  help: write a number that GLSL has and the profile: 330 core, 450, 300 es\n"},
    {"prologue_of_an_unknown_stage",
     "[prologue]\n"
     "fragmnet = \"\"\n",
     "tiny.toml:5:1: error: unknown name 'fragmnet' in [prologue]\n"
     "    fragmnet = \"\"\n"
     "    ^\n"
     "  help: did you mean 'fragment'?\n"},
    {"include_rule_without_name",
     "[includes]\n"
     "'#pragma import' = '*'\n",
     "tiny.toml:5:20: error: '*' does not say where the name stands\n"
     "    '#pragma import' = '*'\n"
     "                       ^\n"
     "  help: write one * in the line and one in the path: '#pragma import \"*\"' = 'lib/*.glsl'; or none in "
     "both\n"},
    {"substitute_of_a_comment",
     "[substitute]\n"
     "'//' = 'a'\n",
     "tiny.toml:5:8: error: cannot replace '//' by 'a'\n"
     "    '//' = 'a'\n"
     "           ^\n"
     "  help: write a name, perhaps between signs, and one line without comments\n"},
    {"substitute_with_blanks",
     "[features.a]\n"
     "substitute = \"@ a @\"\n",
     "tiny.toml:5:14: error: feature 'a' cannot replace '@ a @'\n"
     "    substitute = \"@ a @\"\n"
     "                 ^\n"
     "  help: write a name, best with a sign that GLSL has no use for: \"@name@\" or \"$name\"\n"},
    {"text_of_no_value",
     "[features.a]\n"
     "define = \"A\"\n"
     "values = [\"soft\", \"hard\"]\n"
     "text = { sotf = \"1\" }\n",
     "tiny.toml:7:8: error: feature 'a' has no value 'sotf'\n"
     "    text = { sotf = \"1\" }\n"
     "           ^\n"
     "  help: did you mean 'soft'?\n"},
    {"text_of_two_lines",
     "[features.a]\n"
     "define = \"A\"\n"
     "text = \"1\\n#define B\"\n",
     "tiny.toml:6:8: error: the text of 'on' is no macro's\n"
     "    text = \"1\\n#define B\"\n"
     "           ^\n"
     "  help: write it on one line, without comments and backslashes\n"},
    {"text_with_a_comment",
     "[features.a]\n"
     "define = \"A\"\n"
     "text = { on = \"1 // one\" }\n",
     "tiny.toml:6:15: error: the text of 'on' is no macro's\n"
     "    text = { on = \"1 // one\" }\n"
     "                  ^\n"
     "  help: write it on one line, without comments and backslashes\n"},
    {"text_true",
     "[features.a]\n"
     "define = \"A\"\n"
     "text = { on = true }\n",
     "tiny.toml:6:15: error: the text of 'on' must be a string or false\n"
     "    text = { on = true }\n"
     "                  ^\n"
     "  help: write the text of the macro, or false to leave it undefined\n"},
    {"text_for_all_values",
     "[features.a]\n"
     "define = \"A\"\n"
     "values = [\"soft\", \"hard\"]\n"
     "text = \"1\"\n",
     "tiny.toml:7:8: error: feature 'a' has one text for all values\n"
     "    text = \"1\"\n"
     "           ^\n"
     "  help: write text = { VALUE = \"TEXT\" }\n"},
    {"text_without_macro",
     "[features.a]\n"
     "values = [\"soft\", \"hard\"]\n"
     "text = { soft = \"1\" }\n",
     "tiny.toml:6:8: error: feature 'a' has text, but no macro\n"
     "    text = { soft = \"1\" }\n"
     "           ^\n"
     "  help: add define = \"MACRO\"\n"},
    {"macro_of_an_unknown_stage",
     "[features.a]\n"
     "define = \"A\"\n"
     "stages = [\"pixel\"]\n",
     "tiny.toml:6:10: error: feature 'a' names an unknown stage 'pixel'\n"
     "    stages = [\"pixel\"]\n"
     "             ^\n"
     "  help: known: vertex, tess_control, tess_evaluation, geometry, fragment, compute\n"},
    {"count_of_wrong_type",
     "[features.point]\n"
     "count = 4\n"
     "constant = \"N\"\n",
     "tiny.toml:5:9: error: feature 'point' has no valid count\n"
     "    count = 4\n"
     "            ^\n"
     "  help: write count = [LEAST, MOST], whole numbers from 0 to 4096, MOST not below LEAST\n"},
    {"count_without_constant",
     "[features.point]\n"
     "count = [0, 4]\n",
     "tiny.toml:4:1: error: feature 'point' lacks 'constant'\n"
     "    [features.point]\n"
     "    ^\n"
     "  help: add constant = \"...\"\n"},
    {"constant_with_a_bad_name",
     "[features.point]\n"
     "count = [0, 4]\n"
     "constant = \"N-1\"\n",
     "tiny.toml:4:1: error: feature 'point' has 'N-1' for a macro\n"
     "    [features.point]\n"
     "    ^\n"
     "  help: a macro is an identifier\n"},
    {"macro_shared",
     "[features]\n"
     "a = { define = \"USE_IT\" }\n"
     "b = { define = \"USE_IT\" }\n",
     "tiny.toml:6:5: error: feature 'b' shares the macro 'USE_IT' with another feature\n"
     "    b = { define = \"USE_IT\" }\n"
     "        ^\n"
     "  help: give each count and define a macro of its own\n"},
    {"define_of_wrong_type",
     "[features.a]\n"
     "define = true\n",
     "tiny.toml:5:10: error: 'define' must be a string\n"
     "    define = true\n"
     "             ^\n"
     "  help: write define = \"...\"\n"},
    {"rules_that_are_no_tables", "rules = [\"fog\"]\n",
     "tiny.toml:4:9: error: 'rules' must be an array of tables\n"
     "    rules = [\"fog\"]\n"
     "            ^\n"
     "  help: write each rule under [[rules]]\n"},
    {"rule_of_no_kind",
     "[features.a]\n"
     "define = \"A\"\n"
     "[[rules]]\n"
     "when = \"a == on\"\n",
     "tiny.toml:6:1: error: a rule must be one of default and forbid\n"
     "    [[rules]]\n"
     "    ^\n"
     "  help: write when = \"CONDITION\" with default = [FEATURES], or forbid = \"CONDITION\" with reason "
     "= \"...\"\n"},
    {"rule_of_both_kinds",
     "[features.a]\n"
     "define = \"A\"\n"
     "[[rules]]\n"
     "when = \"a == on\"\n"
     "default = [\"a\"]\n"
     "forbid = \"a == on\"\n",
     "tiny.toml:6:1: error: a rule must be one of default and forbid\n"
     "    [[rules]]\n"
     "    ^\n"
     "  help: write when = \"CONDITION\" with default = [FEATURES], or forbid = \"CONDITION\" with reason "
     "= \"...\"\n"},
    {"rule_unknown_name",
     "[features.a]\n"
     "define = \"A\"\n"
     "[[rules]]\n"
     "forbid = \"a == on\"\n"
     "reasn = \"x\"\n",
     "tiny.toml:8:1: error: unknown name 'reasn' in a rule\n"
     "    reasn = \"x\"\n"
     "    ^\n"
     "  help: did you mean 'reason'?\n"},
    {"rule_unknown_dialect",
     "[features.a]\n"
     "define = \"A\"\n"
     "[[rules]]\n"
     "forbid = \"a == on\"\n"
     "reason = \"x\"\n"
     "dialects = [\"es30\"]\n",
     "tiny.toml:9:12: error: unknown dialect 'es30'\n"
     "    dialects = [\"es30\"]\n"
     "               ^\n"
     "  help: did you mean 'es300'?\n"},
    {"rule_condition_of_wrong_type",
     "[features.a]\n"
     "define = \"A\"\n"
     "[[rules]]\n"
     "forbid = 1\n"
     "reason = \"x\"\n",
     "tiny.toml:7:10: error: 'forbid' must be a string\n"
     "    forbid = 1\n"
     "             ^\n"
     "  help: write forbid = \"...\"\n"},
    {"varying_that_is_no_table",
     "[varyings]\n"
     "normal = 1\n",
     "tiny.toml:5:10: error: varying 'normal' must be a GLSL identifier with a table\n"
     "    normal = 1\n"
     "             ^\n"
     "  help: write [varyings.NAME] with location, type, piece and value\n"},
    {"varying_with_a_bad_name",
     "[varyings.\"a.b\"]\n"
     "location = 0\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n",
     "tiny.toml:4:1: error: varying 'a.b' must be a GLSL identifier with a table\n"
     "    [varyings.\"a.b\"]\n"
     "    ^\n"
     "  help: write [varyings.NAME] with location, type, piece and value\n"},
    {"varying_without_type",
     "[varyings.normal]\n"
     "location = 0\n"
     "value = \"x\"\n",
     "tiny.toml:4:1: error: varying 'normal' lacks 'type'\n"
     "    [varyings.normal]\n"
     "    ^\n"
     "  help: add type = \"...\"\n"},
    {"varying_without_value",
     "[varyings.normal]\n"
     "location = 0\n"
     "type = \"vec3\"\n",
     "tiny.toml:4:1: error: varying 'normal' lacks 'value'\n"
     "    [varyings.normal]\n"
     "    ^\n"
     "  help: add value = \"...\"\n"},
    {"varying_unknown_name",
     "[varyings.normal]\n"
     "locaton = 0\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n",
     "tiny.toml:5:1: error: unknown name 'locaton' in varying 'normal'\n"
     "    locaton = 0\n"
     "    ^\n"
     "  help: did you mean 'location'?\n"},
    {"varying_location_negative",
     "[varyings.normal]\n"
     "location = -1\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n",
     "tiny.toml:5:12: error: varying 'normal' has no valid location\n"
     "    location = -1\n"
     "               ^\n"
     "  help: write location = N with N from 0 to 255\n"},
    {"varying_location_beyond_limits",
     "[varyings.normal]\n"
     "location = 4294967296\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n",
     "tiny.toml:5:12: error: varying 'normal' has no valid location\n"
     "    location = 4294967296\n"
     "               ^\n"
     "  help: write location = N with N from 0 to 255\n"},
    {"varying_location_taken",
     "[varyings.a]\n"
     "location = 1\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n"
     "[varyings.b]\n"
     "location = 1\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n",
     "tiny.toml:8:1: error: varying 'b' shares location 1 with 'a'\n"
     "    [varyings.b]\n"
     "    ^\n"
     "  help: give each varying a location of its own\n"},
    {"varying_unknown_interpolation",
     "[varyings.a]\n"
     "location = 1\n"
     "type = \"vec3\"\n"
     "value = \"x\"\n"
     "interpolation = \"flatt\"\n",
     "tiny.toml:8:17: error: varying 'a' has no interpolation 'flatt'\n"
     "    interpolation = \"flatt\"\n"
     "                    ^\n"
     "  help: did you mean 'flat'?\n"},
    {"domain_of_three",
     "[domain]\n"
     "\"a\" = [1, 2, 3]\n",
     "tiny.toml:5:7: error: the domain of 'a' is not a range\n"
     "    \"a\" = [1, 2, 3]\n"
     "          ^\n"
     "  help: write [low, high]\n"},
    {"domain_infinite",
     "[domain]\n"
     "\"a\" = [0, inf]\n",
     "tiny.toml:5:11: error: 'a' must be finite numbers\n"
     "    \"a\" = [0, inf]\n"
     "              ^\n"
     "  help: write a = 0.5, or [0, 1]\n"},
    {"domain_unknown_name",
     "[domain]\n"
     "\"a\" = { rnage = [0, 1] }\n",
     "tiny.toml:5:9: error: unknown name 'rnage' in the domain of 'a'\n"
     "    \"a\" = { rnage = [0, 1] }\n"
     "            ^\n"
     "  help: did you mean 'range'?\n"},
    {"render_of_wrong_type",
     "[render]\n"
     "a = true\n",
     "tiny.toml:5:5: error: 'a' must be finite numbers\n"
     "    a = true\n"
     "        ^\n"
     "  help: write a = 0.5, or [0, 1]\n"},
    {"render_without_source",
     "[render]\n"
     "a = { numbers = [1] }\n",
     "tiny.toml:5:5: error: the render value of 'a' lacks 'source'\n"
     "    a = { numbers = [1] }\n"
     "        ^\n"
     "  help: add source = \"...\"\n"},
    {"default_set_of_nothing",
     "[features.a]\n"
     "define = \"A\"\n"
     "[default_set]\n"
     "where = \"a == on\"\n",
     "tiny.toml:6:1: error: [default_set] selects nothing\n"
     "    [default_set]\n"
     "    ^\n"
     "  help: add keys = [...], all = true or cover = 2\n"},
    {"default_set_unknown_feature",
     "[features.fog]\n"
     "define = \"A\"\n"
     "[default_set]\n"
     "all = true\n"
     "over = [\"fogg\"]\n",
     "tiny.toml:8:8: error: [default_set] names an unknown feature 'fogg'\n"
     "    over = [\"fogg\"]\n"
     "           ^\n"
     "  help: did you mean 'fog'?\n"},
    {"default_set_negative_cover",
     "[default_set]\n"
     "cover = -2\n",
     "tiny.toml:5:9: error: [default_set] has no valid cover\n"
     "    cover = -2\n"
     "            ^\n"
     "  help: write cover = T, a whole number from 0, for none, to 8\n"},
    {"default_set_of_wrong_type",
     "[default_set]\n"
     "all = 1\n",
     "tiny.toml:5:7: error: 'all' must be true or false\n"
     "    all = 1\n"
     "          ^\n"
     "  help: write all = true or false\n"},
    {"unknown_table",
     "[feature.fog]\n"
     "define = \"A\"\n",
     "tiny.toml:4:2: error: unknown name 'feature' in the family\n"
     "    [feature.fog]\n"
     "     ^\n"
     "  help: did you mean 'features'?\n"},
    {"any_order_of_nothing",
     "[[relations]]\n"
     "any_order = \"\"\n",
     "tiny.toml:5:13: error: '' is not the name of an array\n"
     "    any_order = \"\"\n"
     "                ^\n"
     "  help: write any_order = \"ARRAY\"\n"},
    {"any_order_of_elements",
     "[[relations]]\n"
     "any_order = \"lights[]\"\n",
     "tiny.toml:5:13: error: 'lights[]' is not the name of an array\n"
     "    any_order = \"lights[]\"\n"
     "                ^\n"
     "  help: write any_order = \"lights\"\n"},
    {"any_order_of_an_element",
     "[[relations]]\n"
     "any_order = \"Lights.lights[7]\"\n",
     "tiny.toml:5:13: error: 'Lights.lights[7]' is not the name of an array\n"
     "    any_order = \"Lights.lights[7]\"\n"
     "                ^\n"
     "  help: write any_order = \"Lights.lights\"\n"},
    {"sum_over_one_element",
     "[[relations]]\n"
     "adds = \"lights[2].color\"\n",
     "tiny.toml:5:8: error: 'lights[2].color' is not a member of an array's elements\n"
     "    adds = \"lights[2].color\"\n"
     "           ^\n"
     "  help: write adds = \"ARRAY[].MEMBER\"\n"},
    {"sum_of_several_numbers",
     "[[relations]]\n"
     "adds = \"lights[].weights[]\"\n",
     "tiny.toml:5:8: error: 'lights[].weights[]' is more than one number or vector of an element\n"
     "    adds = \"lights[].weights[]\"\n"
     "           ^\n"
     "  help: write a relation for each: adds = \"lights[].weights[0]\"\n"},
    {"turn_of_nothing",
     "[[relations]]\n"
     "turn = []\n",
     "tiny.toml:5:8: error: the relation turns nothing\n"
     "    turn = []\n"
     "           ^\n"
     "  help: name the vectors and matrices that turn together\n"},
};

class BadFamily : public testing::TestWithParam<BadRow> {};

TEST_P(BadFamily, IsRefusedExactly) {
    const std::string head = "name = \"tiny\"\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n";
    const Result<Family> family = read_family(head + GetParam().body, "tiny.toml", {});
    ASSERT_FALSE(family);
    EXPECT_EQ(family.error().size(), 1u);
    EXPECT_EQ(exit_status(family.error()), 1);
    EXPECT_EQ(first_text(family.error()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Rows, BadFamily, testing::ValuesIn(bad_rows),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace gobo
