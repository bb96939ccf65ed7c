// The data model of a family: a set of shaders that share templates. Read from a TOML file by read_family().
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/stage.hpp"
#include "family/expression.hpp"

namespace gobo {

enum class Role {
    effect,    ///< called for by a scene: fog, spot lights
    quality,   ///< accuracy bought with time; the values are listed most accurate first
    pipeline,  ///< a choice of the application's pipeline: the depth qualifier
};

enum class FeatureKind {
    choice,  ///< one value of a list, each a piece FEATURE/VALUE.glsl or the text of a macro
    count,   ///< a whole number, a constant in the prologue
    define,  ///< off or on: a macro that is defined or not, for shaders that have their own #ifdef
};

/// One axis of a family.
struct Feature {
    std::string name;
    Role role = Role::effect;
    FeatureKind kind = FeatureKind::choice;
    std::vector<std::string>
        values;             ///< the default, then the others as the family lists them. Counts: "0", ...
    int default_place = 0;  ///< where the family's list has the default: 0 unless it names another
    int lowest = 0;         ///< of a count: its first value
    std::vector<std::string> excluded;  ///< values that only keys which name them have
    std::string macro;        ///< the constant of a count, the macro of a define or a choice; may be empty
    std::string substituted;  ///< what the shaders write where the text of the value belongs: "@fog@"
    std::map<std::string, std::optional<std::string>> texts;  ///< what the family states for text_of()
    std::vector<std::string> stages;  ///< those whose prologue has the macro; empty: all
    Place place;                      ///< where the family declares it
    std::string enum_name;            ///< of a choice in generated headers; empty: its own in PascalCase
    bool is_specialized = false;      ///< of a count: one SPIR-V module serves all that are above 0

    std::vector<std::string> old_names;             ///< by which it went before
    std::map<std::string, std::string> old_values;  ///< a name by which a value went before: its name now

    /// The index of a value; nothing where there is no such value.
    [[nodiscard]] std::optional<int> index_of(std::string_view value) const;
    /// What to write where there is no such value.
    [[nodiscard]] std::string help_for(std::string_view value) const;
    /// What the macro is defined as for the value of that index; nothing where it is not defined.
    [[nodiscard]] std::optional<std::string> text_of(int index) const;
};

[[nodiscard]] std::optional<int> index_of(const std::vector<Feature>& features, std::string_view name);
/// What to write where there is no such feature.
[[nodiscard]] std::string help_for(const std::vector<Feature>& features, std::string_view name);

/// What the family demands of its keys.
struct Rule {
    enum class Kind {
        defaults,  ///< where `when` holds, the features of `defaults` cannot matter and stand at their
                   ///< defaults
        forbid,    ///< keys for which `when` holds are refused, for `reason`
    };
    Kind kind = Kind::defaults;
    Expression when;
    std::vector<int> defaults;  ///< indices of features
    std::string reason;
    std::vector<std::string> dialects;  ///< the dialects it holds in; empty: all
    Place place;
};

/// An interpolated value between the stages. The vertex stage writes it only where the fragment stage reads
/// it.
struct Varying {
    std::string name;  ///< the GLSL identifier
    std::string type;  ///< the GLSL type
    int location = 0;  ///< of a single varying
    /// Of a counted one, an array, the counts whose sum is how many values it holds; it lies behind all
    /// single ones that are read, and `location` is 0. Empty: it is single.
    std::vector<int> counts;
    int values_per_element = 1;  ///< of a counted one: a vec4 may hold the values of four
    std::string interpolation;   ///< "flat", "noperspective", "smooth", or empty
    std::string piece;           ///< the piece that the vertex stage includes for it
    std::string value;           ///< the GLSL expression that the vertex stage writes
    Place place;
};

/// The range that an input or a uniform may hold, by its reflected name ("Fog.near").
/// Each component, or the length where `of_length`, lies within [low, high], or is exactly one of `also`.
struct Domain {
    std::string name;
    double low = 0;
    double high = 0;
    bool of_length = false;  ///< the range is of the vector's length
    /// Where not empty, the low and high end of the vector's last component, a quantity of its own; the range
    /// above is then of the others.
    std::vector<double> last;
    std::vector<double> also;  ///< values allowed besides the range (0 for an attenuation coefficient)
    Place place;
};

/// What `gobo render` feeds a family: attributes and uniforms by name, in TOML as written under [render].
struct RenderValue {
    std::string name = {};    ///< reflected, of an attribute or uniform ("PointLights.lights[0].position")
    std::string source = {};  ///< a value the renderer supplies ("normal", "model_view"); empty: `numbers`
    std::vector<double> numbers = {};
    Place place = {};
};

/// What holds of a family's permutations whatever they compute, and needs no oracle to be tried.
struct Relation {
    enum class Kind {
        any_order,  ///< the elements of an array may stand in any order
        adds,       ///< elements add up in proportion to a member: none of it is no element
        turn,       ///< vectors and matrices turned together change nothing
        off,        ///< an effect turned off by its uniforms is the effect's absence
        finer,      ///< on finer meshes the feature's values approach its default
    };
    Kind kind = Kind::any_order;
    std::vector<std::string> names;        ///< any_order: the array; adds: "ARRAY[].MEMBER"; turn: what turns
    std::vector<std::string> turned_back;  ///< turn: matrices that lead out of the space that turns
    int feature = -1;                      ///< off, finer: its index
    std::vector<RenderValue> at;           ///< off: where it is off
    std::optional<Expression> when;        ///< the keys of which it holds; all where there is none
    std::string text;  ///< as the family file states it: `any_order = "uLights"`, `off = "fog"`, `turn`
    Place place;
};

/// What Vulkan binds together: its number is its place among the family's sets.
struct DescriptorSet {
    std::string name;                ///< such as "frame": what it changes with
    std::vector<std::string> holds;  ///< blocks and samplers; the binding of each is its place here
    Place place;
    Place holds_place;
};

/// Text that the family puts in front of its stages.
struct PrologueText {
    std::string stage;  ///< "vertex", "fragment"; empty: all
    std::string text;
    Place place;  ///< of its first line
};

/// How the shaders write an include: `#pragma import "*"`, and the path that it means: "lib/*.glsl".
struct IncludeRule {
    std::string line;  ///< one `*` stands for the name
    std::string path;
    Place place;
};

/// Key text and where it stands: a file and line, or nowhere for one of the command line.
struct NamedKey {
    std::string text;
    Place place = {};
};

/// Which keys are meant. The parts unite; `where` restricts what `all` and `cover` range over, and filters
/// the named keys.
struct Selection {
    std::vector<NamedKey> keys = {};
    bool all = false;
    int cover = 0;                       ///< strength; 0: no cover
    std::vector<std::string> over = {};  ///< features that `all` and `cover` range over; empty: all of them
    std::string where = {};
    bool excluded = false;  ///< `all` and `cover` take excluded values too

    [[nodiscard]] bool names_nothing() const { return keys.empty() && !all && cover == 0; }
};

/// One value per feature of a family: the index of the value, in the order of Family::features.
using Key = std::vector<int>;

/// The templates of a program, by their include paths. The files of a stage are joined in order; a stage
/// without files is none of the program's.
using Templates = PerStage<std::vector<std::string>>;

/// A set of shaders that share features.
struct Family {
    std::string name;
    std::string path;                 ///< of the family file, as given
    std::vector<Templates> programs;  ///< one, or one for each value of the feature `program`
    std::string version;              ///< "330 core", of stages whose files state none; may be empty
    Place version_place;
    std::vector<PrologueText> prologue;                ///< of all stages first
    std::vector<IncludeRule> include_rules;            ///< longest line first
    std::map<std::string, std::string> substitutions;  ///< what is replaced in the files, and by what
    bool extends = false;                              ///< another family
    bool unrolls_loops = false;  ///< between `#pragma unroll_loop_start` and `#pragma unroll_loop_end`
    bool compatibility = false;  ///< what OpenGL had before 3.0 (`gl_Vertex`) is read as of gobo's own piece
    std::vector<Feature> features;  ///< sorted by name
    std::vector<Rule> rules;
    std::vector<Varying> varyings;  ///< single ones by location, then counted ones by name
    std::vector<Domain> domains;    ///< sorted by name
    std::vector<DescriptorSet> descriptor_sets;
    std::vector<RenderValue> render;
    std::vector<Relation> relations;             ///< in the order of the file
    std::optional<Selection> default_selection;  ///< where the command line names no keys

    [[nodiscard]] std::optional<int> index_of(std::string_view feature) const {
        return gobo::index_of(features, feature);
    }
    /// The templates of the program that a key chooses.
    [[nodiscard]] const Templates& templates_of(const Key& key) const;
};

}  // namespace gobo
