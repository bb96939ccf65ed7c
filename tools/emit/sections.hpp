// The sections of a generated header. Each adds the values of those placeholders of the template that it
// knows about.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emit/cpp_text.hpp"
#include "emit/emit.hpp"

namespace gobo {

/// A feature in the generated header.
struct CppFeature {
    const Feature* feature;
    std::string member;                    ///< of Key
    std::string type;                      ///< of the member: an enum, `int`, or `bool`
    std::vector<std::string> enumerators;  ///< of a choice, in the order of its values
    int word = 0;                          ///< where it stands in the packed key: the word,
    int shift = 0;                         ///< the bits below it there,
    int bits = 0;                          ///< and its own; 0 where there is but one value

    /// The C++ of a value: `Fog::linear`, `3`, `true`.
    [[nodiscard]] std::string value(int number) const;
};

/// The features of a family in the generated header, in the order of Family::features.
struct CppKey {
    std::vector<CppFeature> features;
    int words = 1;  ///< 64-bit words of a packed key

    [[nodiscard]] const CppFeature& operator[](int feature) const {
        return features[static_cast<std::size_t>(feature)];
    }
};

/// Names and packs the features. The enums' names are claimed in `scope`, that of the header's namespace.
[[nodiscard]] CppKey name_key(const Family& family, CppScope& scope);

/// "effect", "count": as family files spell them.
[[nodiscard]] std::string_view name_of(Role role);
[[nodiscard]] std::string_view name_of(FeatureKind kind);

/// Enums, Key, rules, packing and what select() takes from a state. `rules` are those of the dialect.
[[nodiscard]] Result<void> key_section(const std::vector<Rule>& rules, const CppKey& key,
                                       const HeaderTemplates& templates, TemplateValues& values);

/// What permutations declare differently: which declaration each has, and where the header says so.
class Declarations {
  public:
    explicit Declarations(const EmitInput& input);

    [[nodiscard]] const std::vector<Differing>& differing() const { return differing_; }
    /// The distinct combinations of declarations, a number for each of differing(), and which a permutation
    /// of the composition has.
    [[nodiscard]] const std::vector<std::vector<int>>& combinations() const { return combinations_; }
    [[nodiscard]] int combination_of(std::size_t permutation) const { return combination_of_[permutation]; }
    /// The index in differing(); nothing where all permutations declare the name alike.
    [[nodiscard]] std::optional<std::size_t> find(std::string_view kind, std::string_view name) const;
    /// ", such as 'fog=linear'": one permutation that has the declaration with that number, from 1.
    [[nodiscard]] std::string example(std::size_t differing, int number) const;

  private:
    const EmitInput& input_;
    std::vector<Differing> differing_;
    std::vector<std::vector<int>> combinations_;
    std::vector<int> combination_of_;
};

/// The comment that names what differs, the tables of who has what, and a function for each name.
void declaration_section(const Declarations& declarations, const Interface& interface,
                         TemplateValues& values);

/// Packed keys, stages as lists of pieces, texts. Only stages and pieces that a permutation uses are written,
/// in the order of the composition; permutations are sorted by packed key.
/// Instead of texts each distinct module once where the input has them.
[[nodiscard]] Result<void> permutation_section(const EmitInput& input, const CppKey& key,
                                               const Declarations& declarations,
                                               const HeaderTemplates& templates, TemplateValues& values);

/// What pipelines are made with, for dialects of SPIR-V; nothing for others. Two resources of different
/// permutations at one place of a descriptor set are an error (Fault::input).
[[nodiscard]] Result<void> spirv_section(const EmitInput& input, const Interface& interface,
                                         const CppKey& key, const Declarations& declarations,
                                         const HeaderTemplates& templates, TemplateValues& values);

/// ", {2, 1}" where an entry is that declaration, from 1, of a name that permutations declare differently.
[[nodiscard]] std::string only_text(std::string_view kind, std::string_view name, int number,
                                    const Declarations& declarations);

/// A copy in which every block, sampler and attribute has a place: where the source states none, the lowest
/// that is free, in the order of names, the same for all declarations of a name; a single output stands at 0.
/// Names that OpenGL itself supplies (gl_*) are left out.
[[nodiscard]] Interface with_places(Interface interface);

/// Where attributes, outputs, samplers, uniforms and blocks are bound. `interface` has places.
void interface_section(const Interface& interface, const std::vector<Domain>& domains,
                       const Declarations& declarations, Dialect dialect, TemplateValues& values);

/// A member of a block's struct as C++ names it, and its members where it is a struct itself.
struct CppMember {
    Member member;
    std::string identifier;
    std::vector<CppMember> members;
};

/// A layout of a block as a C++ struct.
struct CppBlock {
    std::string name;                ///< the block's, without the indices of an array of blocks
    std::string type;                ///< the struct's
    std::vector<CppMember> members;  ///< without an array that has no size
    std::string counted;  ///< the array that ends it, of which a buffer may hold fewer elements; else empty
};

/// A struct for every layout of a block and for every struct within one, inner ones first, each name claimed
/// in `scope`. A layout that no C++ struct can mirror is an error (Fault::input).
[[nodiscard]] Result<std::vector<CppBlock>> block_section(const Interface& interface,
                                                          const std::vector<Domain>& domains,
                                                          const Declarations& declarations,
                                                          const HeaderTemplates& templates, CppScope& scope,
                                                          TemplateValues& values);

/// For each block `check(block)`: what of it lies outside the ranges that the family declares, or breaks a
/// constraint; and `check(block, other)` for each two that a constraint names. Where a block ends in an
/// array, `check(block, count)` looks at no more elements of it. A comment names the constraints that neither
/// sees.
[[nodiscard]] Result<void> check_section(const std::vector<CppBlock>& blocks, const Interface& interface,
                                         const std::vector<Domain>& domains, const HeaderTemplates& templates,
                                         TemplateValues& values);

/// A C++ type of known size, to be declared as `TYPE NAME EXTENTS`.
struct CppMemberType {
    std::string type;     ///< "std140::vec3"
    std::string extents;  ///< "[3][2]", or empty
    int size = 0;         ///< bytes, all elements together
};

/// The C++ of a GLSL scalar, vector or matrix with the strides it was reflected with. Nothing where the type
/// is none of these (a struct) or no C++ type has that layout.
[[nodiscard]] std::optional<CppMemberType> cpp_type_of(const Member& member);

/// The range of an input or uniform as a comment: "[0, 1000], or 0"; empty where the family declares none.
/// Array indices in either name do not matter.
[[nodiscard]] std::string domain_text(const std::vector<Domain>& domains, const std::string& path);

/// The values NAME_count and NAMEs: how many rows a table has, and the rows.
void add_table(TemplateValues& values, const std::string& name, const std::vector<std::string>& rows);

}  // namespace gobo
