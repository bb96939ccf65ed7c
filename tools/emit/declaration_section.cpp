// What permutations of a family declare differently.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "emit/sections.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// The types of the declarations of a name, in their order: "sampler2D, sampler2DShadow"; empty for blocks,
/// which have none.
template <class Entry>
void add_types(const std::vector<Entry>& entries, std::string_view name, std::vector<std::string>& types) {
    for (const Entry& entry : entries) {
        if (entry.name != name) continue;
        std::string extents;
        for (const int extent : entry.array) extents += fmt::format("[{}]", extent);
        const std::string place = place_of(entry) < 0 ? "" : fmt::format(" at {}", place_of(entry));
        types.push_back(entry.type + extents + place);
    }
}

std::vector<std::string> types_of(const Differing& differing, const Interface& interface) {
    std::vector<std::string> types;
    if (differing.kind == "uniform") add_types(interface.uniforms, differing.name, types);
    if (differing.kind == "sampler") add_types(interface.samplers, differing.name, types);
    if (differing.kind == "input") add_types(interface.inputs, differing.name, types);
    if (differing.kind == "output") add_types(interface.outputs, differing.name, types);
    return types;
}

}  // namespace

Declarations::Declarations(const EmitInput& input) : input_(input), differing_(input.differing) {
    std::map<std::vector<int>, int> numbers;
    for (std::size_t permutation = 0; permutation < input.composition.permutations.size(); ++permutation) {
        std::vector<int> combination;
        for (const Differing& differing : differing_) combination.push_back(differing.declared[permutation]);
        const auto [place, is_new] = numbers.try_emplace(combination, static_cast<int>(combinations_.size()));
        if (is_new) combinations_.push_back(std::move(combination));
        combination_of_.push_back(place->second);
    }
}

std::optional<std::size_t> Declarations::find(std::string_view kind, std::string_view name) const {
    for (std::size_t index = 0; index < differing_.size(); ++index)
        if (differing_[index].kind == kind && differing_[index].name == name) return index;
    return std::nullopt;
}

std::string Declarations::example(std::size_t differing, int number) const {
    const std::vector<int>& declared = differing_[differing].declared;
    const auto first = std::ranges::find(declared, number) - declared.begin();
    return fmt::format(
        "{} of {} permutations, such as '{}'", std::ranges::count(declared, number), declared.size(),
        key_text(input_.family, input_.composition.permutations[static_cast<std::size_t>(first)].key));
}

void declaration_section(const Declarations& declarations, const Interface& interface,
                         TemplateValues& values) {
    const std::vector<Differing>& all = declarations.differing();
    std::string& notes = values["differing_notes"] = "";
    std::string& functions = values["declared_functions"] = "";
    values["declared"] = "0";
    values["combination_member"] = "";
    values["combination_table"] = "";
    if (all.empty()) return;

    notes =
        "//\n// Not all permutations declare the same; `declared::NAME(permutation)` says which declaration "
        "one has:\n";
    functions =
        "\n/// Which of a name's declarations a permutation has, from 1; 0 where it has none.\nnamespace "
        "declared {\n";
    CppScope scope;
    for (std::size_t index = 0; index < all.size(); ++index) {
        const Differing& differing = all[index];
        const std::vector<std::string> types = types_of(differing, interface);
        const int count = *std::ranges::max_element(differing.declared);
        notes += fmt::format("// - {} {}: {}\n", differing.kind, cpp_comment(differing.name),
                             types.empty() ? fmt::format("{} layouts", count) : join(types, ", "));
        for (int number = 1; number <= count; ++number) {
            const std::string type = types.empty() ? "" : types[static_cast<std::size_t>(number - 1)] + ", ";
            functions += fmt::format("/// {} {}: {}{}.\n", number, differing.kind, type,
                                     cpp_comment(declarations.example(index, number)));
        }
        functions += fmt::format(
            "[[nodiscard]] constexpr int {}(const Permutation& permutation) {{ return "
            "permutation.declared({}); }}\n",
            scope.claim(cpp_function_name(differing.name)), index);
    }
    functions += "}  // namespace declared\n";

    std::vector<std::string> numbers;
    for (const std::vector<int>& combination : declarations.combinations())
        for (const int number : combination) numbers.push_back(std::to_string(number));
    values["combination_table"] = fmt::format(
        "    // For each combination of declarations that a permutation has, the number of each name's.\n"
        "    static constexpr std::array<std::uint16_t, {}> combinations{{ {} }};\n\n",
        numbers.size(), cpp_list(numbers));
    values["combination_member"] = "    std::uint32_t combination;\n";
    values["declared"] = fmt::format(
        "detail::Tables::combinations[combination * std::size_t{{{}}} + static_cast<std::size_t>(differing)]",
        all.size());
}

}  // namespace gobo
