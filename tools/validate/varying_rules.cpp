// What one stage hands to the next: matched by location or by name, and of one type, interpolated alike.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/rewrite.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/link_rules.hpp"

namespace gobo {
namespace {

bool states(const Variable& variable, std::string_view word) {
    return variable.usage.stated.find(word) != std::string::npos;
}

/// "flat", "noperspective" or "smooth".
std::string_view shading_of(const Interpolation& interpolation) {
    return interpolation.flat ? "flat" : interpolation.noperspective ? "noperspective" : "smooth";
}

/// That of two variables which differ in it alone: whether they state "smooth".
std::string_view shading_of(const Variable& variable, const Variable& other) {
    const std::string_view shading = shading_of(variable.interpolation);
    return shading != shading_of(other.interpolation) || states(variable, "smooth") ? shading
                                                                                    : "smooth by default";
}

std::string_view sampling_of(const Interpolation& interpolation) {
    return interpolation.sample ? "sample" : interpolation.centroid ? "centroid" : "neither";
}

/// "flat" or "smooth centroid".
std::string interpolation_text(const Interpolation& interpolation) {
    std::string text(shading_of(interpolation));
    if (sampling_of(interpolation) != "neither") text += fmt::format(" {}", sampling_of(interpolation));
    return text;
}

/// The extents as linkers have them: an array without a size that nothing indexes has none.
std::vector<int> extents_of(const Variable& variable) {
    std::vector<int> extents = variable.array;
    const bool is_open = states(variable, "[]") && !variable.per_vertex;  // of which [] counts the vertices
    if (is_open && variable.usage.unused && !extents.empty()) extents.front() = 0;
    return extents;
}

/// Of an array of blocks the members' qualifiers belong to its type.
bool is_of_array_of_blocks(const Variable& variable) {
    return variable.whole == Whole::block && variable.name[root_of(variable.name).size()] == '[';
}

/// That of a struct's member, where it makes two types of the struct, and of a member of an array of blocks.
std::string_view precision_of(const Variable& variable) {
    if (is_of_array_of_blocks(variable))
        for (const std::string_view precision : {"highp", "mediump", "lowp"})
            if (states(variable, precision)) return precision;
    const bool is_array = variable.name[root_of(variable.name).size()] == '[';
    return variable.whole == Whole::block || is_array ? variable.usage.precision : std::string_view();
}

/// The struct that an array of them is of, in OpenGL; empty of others, and where each vertex has one.
std::string_view struct_of(const Variable& variable) {
    constexpr std::string_view begin = "struct:";
    const std::string_view words = variable.usage.stated;
    const std::size_t at = words.find(begin);
    const bool is_array = variable.name[root_of(variable.name).size()] == '[';
    if (at == std::string_view::npos || !is_array) return {};
    return words.substr(at + begin.size(), words.find(' ', at) - at - begin.size());
}

/// ".normal" of "surfaces[0].normal", or with the indices "[0].normal".
std::string member_path(const Variable& variable, bool with_indices) {
    std::string path = variable.name.substr(root_of(variable.name).size());
    while (!with_indices && path.find('[') != std::string::npos)
        path.erase(path.find('['), path.find(']') + 1 - path.find('['));
    return path;
}

/// Whether the members of a block that states one location leave others free between them.
bool has_gaps(const std::vector<Variable>& list, std::string_view block) {
    std::map<int, int> ends;  // by where they begin
    for (const Variable& member : list)
        if (root_of(member.name) == block) {
            int& end = ends[member.location];
            end = std::max(end, member.location + location_count(member.type, member.array));
        }
    int expected = ends.empty() ? 0 : ends.begin()->first;
    for (const auto& [begin, end] : ends) {
        if (begin > expected) return true;
        expected = std::max(expected, end);
    }
    return false;
}

/// The members of a block.
std::vector<std::string_view> members_of(const std::vector<Variable>& list, std::string_view block) {
    std::vector<std::string_view> members;
    for (const Variable& one : list)
        if (root_of(one.name) == block) members.push_back(std::string_view(one.name).substr(block.size()));
    return members;
}

class VaryingCheck {
  public:
    VaryingCheck(const std::vector<StageView>& stages, Api api)
        : stages_(stages), api_(api), version_(version_of(stages.front().pieces.front()->text)) {}

    Diagnostics run() {
        for (const StageView& stage : stages_) {
            if (stage.kind != StageKind::fragment) check_components(stage, stage.interface.outputs);
            if (stage.kind != StageKind::vertex) check_components(stage, stage.interface.inputs);
            if (stage.kind == StageKind::fragment) check_integers(stage);
            if (stage.kind != StageKind::fragment) check_booleans(stage, stage.interface.outputs);
            if (stage.kind != StageKind::vertex) check_booleans(stage, stage.interface.inputs);
        }
        for (later_ = stages_.begin() + 1; later_ != stages_.end(); ++later_) {
            earlier_ = later_ - 1;
            check_pair();
        }
        return std::move(found_);
    }

  private:
    void add(const Declaration& at, Severity severity, std::string message, std::string help) {
        found_.push_back(diagnostic_at(at, severity, std::move(message), std::move(help)));
    }

    /// What shares a location by its components has one numerical type and is interpolated alike (GLSL 4.60,
    /// 4.4.1).
    void check_components(const StageView& stage, const std::vector<Variable>& list) {
        const auto end_of = [](const Variable& variable) {
            return variable.location + location_count(variable.type, variable.array);
        };
        for (const Variable& one : list)
            for (const Variable& other : list) {
                if (&one >= &other || one.location < 0 || other.location < 0 ||
                    one.location >= end_of(other) || other.location >= end_of(one) ||
                    one.component == other.component)
                    continue;
                const auto type = glsl_type(one.type);
                const auto other_type = glsl_type(other.type);
                const auto how = interpolation_text(one.interpolation);
                const auto other_how = interpolation_text(other.interpolation);
                const auto differ = [&](std::string_view what) {
                    add(declaration_of(other.name, other.type, stage.pieces), Severity::error,
                        fmt::format("'{} {}' and '{} {}' share location {} and {}", one.type, one.name,
                                    other.type, other.name, std::max(one.location, other.location), what),
                        "give each a location of its own");
                };
                if (type && other_type && numerical(type->scalar) != numerical(other_type->scalar))
                    differ("have not one numerical type");
                else if (one.whole == Whole::structure || other.whole == Whole::structure)
                    differ("one is a member of a struct, which drivers let share with nothing");
                else if (one.patch != other.patch)
                    differ("one is of the whole patch");
                else if (how != other_how)
                    differ(fmt::format("are {} and {}", how, other_how));
                else if (states(one, "smooth") != states(other, "smooth"))
                    differ(fmt::format("are {} and {}", shading_of(one, other), shading_of(other, one)));
            }
    }

    /// What is no float is not interpolated (GLSL 4.60, 4.5): glslang looks at no member of a block.
    /// Integers are one type to a location, with a sign or without.
    [[nodiscard]] static Scalar numerical(Scalar scalar) {
        return scalar == Scalar::uint32 ? Scalar::int32 : scalar;
    }

    /// glslang sees those outside of structs.
    void check_booleans(const StageView& stage, const std::vector<Variable>& list) {
        std::set<std::string_view> told;
        for (const Variable& variable : list) {
            const auto type = glsl_type(variable.type);
            if (variable.whole == Whole::structure && type && type->scalar == Scalar::boolean &&
                told.insert(root_of(variable.name)).second)
                add(declaration_of(root_of(variable.name), "", stage.pieces), Severity::error,
                    fmt::format("'{} {}' is passed between stages, which no boolean is", variable.type,
                                variable.name),
                    "make it an int, and the variable flat");
        }
    }

    void check_integers(const StageView& stage) {
        std::set<std::string_view> told;
        for (const Variable& input : stage.interface.inputs) {
            const auto type = glsl_type(input.type);
            if (input.whole != Whole::block || input.interpolation.flat || !type ||
                type->scalar == Scalar::float32 || !told.insert(root_of(input.name)).second)
                continue;
            add(declaration_of(root_of(input.name), "", stage.pieces), Severity::error,
                fmt::format("'{} {}' is an input that is not flat", input.type, input.name),
                "write flat before it: only floats are interpolated");
        }
    }

    [[nodiscard]] Declaration in_earlier(std::string_view name, std::string_view type) const {
        return declaration_of(name, type, earlier_->pieces);
    }
    [[nodiscard]] Declaration in_later(std::string_view name, std::string_view type) const {
        return declaration_of(name, type, later_->pieces);
    }

    [[nodiscard]] bool is_before(int desktop, int es) const {
        return version_.number < (version_.es ? es : desktop);
    }

    /// By location where both state one, by name where neither does (GLSL 4.50, 4.4.1).
    [[nodiscard]] static bool match(const Variable& input, const Variable& output) {
        if (input.location < 0 || output.location < 0)
            return input.location < 0 && output.location < 0 && input.name == output.name;
        return input.location == output.location && input.component == output.component;
    }

    void check_pair() {
        std::set<std::string_view> refused;  // of a struct or block one member will do
        std::set<std::string_view> warned;
        for (const Variable& input : later_->interface.inputs) {
            if (refused.contains(root_of(input.name))) continue;
            const auto output = std::ranges::find_if(earlier_->interface.outputs,
                                                     [&](const Variable& one) { return match(input, one); });
            const std::size_t before = found_.size();
            if (output != earlier_->interface.outputs.end())
                check_varying(input, *output);
            else if (!input.usage.unused || is_mentioned(input))
                check_missing(input);
            if (found_.size() == before) continue;
            if (found_.back().severity == Severity::error)
                refused.insert(root_of(input.name));
            else if (!warned.insert(root_of(input.name)).second)
                found_.resize(before);
        }
    }

    /// Whether the text reads it where SPIR-V keeps no trace, as in a function that nothing calls.
    [[nodiscard]] bool is_mentioned(const Variable& input) const {
        return !is_before(420, 300) && states(input, "read");
    }

    void check_missing(const Variable& input) {
        const std::string_view root = root_of(input.name);
        const std::string old = name_in_files(root);
        const bool is_old = old != root;  // of a family with `compatibility = true`
        std::string message =
            fmt::format("the {} stage reads '{}', which the {} stage does not write", name_of(later_->kind),
                        with_extents(input.type + " " + (is_old ? old : input.name), input.array),
                        name_of(earlier_->kind));
        std::string help = is_old ? fmt::format("write {} in the {} stage", old, name_of(earlier_->kind))
                                  : fmt::format("declare and write it as an output of the {} stage",
                                                name_of(earlier_->kind));
        for (const Variable& output : earlier_->interface.outputs) {
            if (output.name != input.name) continue;
            const auto located = [](int location) {
                return location < 0 ? std::string("no location") : fmt::format("location {}", location);
            };
            message += fmt::format(": it has {} here, and {} in {}", located(input.location),
                                   located(output.location), in_earlier(output.name, output.type).text());
            help = "state the same location in both stages, or none in both";
        }
        add(in_later(input.name, input.type), Severity::error, message, help);
    }

    void check_varying(const Variable& input, const Variable& output) {
        const std::string what = input.name == output.name
                                     ? fmt::format("'{}'", input.name)
                                     : fmt::format("'{}' (location {}, '{}' in the {} stage)", input.name,
                                                   input.location, output.name, name_of(earlier_->kind));
        const auto differ = [&](Severity severity, std::string_view mine, std::string_view theirs,
                                std::string_view rule, std::string help) {
            add(in_later(input.name, input.type), severity,
                fmt::format("{} is {} here, but {} in {}{}", what, mine, theirs,
                            in_earlier(output.name, output.type).text(), rule),
                std::move(help));
        };
        const auto whole = [](const Variable& variable) {
            return variable.whole == Whole::block       ? "a member of a block"
                   : variable.whole == Whole::structure ? "a member of a struct"
                                                        : "no member of a block";
        };
        if (input.whole != output.whole)
            return differ(Severity::error, whole(input), whole(output), "",
                          "declare it alike in both stages");
        const std::vector<int> extents = extents_of(input);
        const std::vector<int> other_extents = extents_of(output);
        if (input.type != output.type || extents != other_extents)
            return differ(Severity::error, with_extents(input.type, extents),
                          with_extents(output.type, other_extents), "", "declare it alike in both stages");
        const std::string_view type = struct_of(input);
        const std::string_view other_type = struct_of(output);
        if (type != other_type && !type.empty() && !other_type.empty())
            return differ(Severity::error, fmt::format("of the struct '{}'", type),
                          fmt::format("of '{}'", other_type), ": an array's must have one name",
                          "declare the struct once, in a piece that both stages include");
        // Two that match by their locations may be of two structs. Of one name glslang tells other extents.
        const bool has_two_names = root_of(input.name) != root_of(output.name);
        const std::string member = member_path(input, has_two_names);
        const std::string other_member = member_path(output, has_two_names);
        if (api_ == Api::opengl && input.whole == Whole::structure && member != other_member)
            return differ(Severity::error, fmt::format("of a struct with '{}'", member),
                          fmt::format("of one with '{}'", other_member), "",
                          "declare the struct once, in a piece that both stages include");
        const std::string_view precision = precision_of(input);
        const std::string_view other_precision = precision_of(output);
        const bool is_known = !version_.es || (!precision.empty() && !other_precision.empty());
        if (is_known && precision != other_precision) {
            const auto text = [](std::string_view stated) {
                return stated.empty() ? "without precision" : stated;
            };
            return differ(Severity::error, text(precision), text(other_precision),
                          ": it belongs to the type of what holds it",
                          "declare that once, in a piece that both stages include");
        }
        const bool is_of_block = input.whole == Whole::block;
        if (input.patch != output.patch)
            return differ(Severity::error, input.patch ? "patch" : "not patch",
                          output.patch ? "patch" : "not", "", "write patch in both stages, or in neither");
        if (interpolation_differs(input, output))
            return differ(Severity::error, shading_of(input, output), shading_of(output, input),
                          version_.es         ? ": OpenGL ES wants the same interpolation in both stages"
                          : is_before(440, 0) ? ": before GLSL 4.40 both stages must interpolate alike"
                                              : ": the members of an array of blocks must agree",
                          "write the same qualifier in both stages");
        // GLSL ES 3.20, 9.2.1, wants no agreement; drivers do outside blocks and in arrays of them.
        const bool may_differ = version_.es && is_of_block && !is_of_array_of_blocks(input);
        if (input.interpolation.sample != output.interpolation.sample && !may_differ)
            return differ(Severity::error, sampling_of(input.interpolation),
                          sampling_of(output.interpolation), "", "write sample in both stages");
        if (invariance_differs(input, output))
            return differ(Severity::error, input.interpolation.invariant ? "invariant" : "not invariant",
                          output.interpolation.invariant ? "invariant" : "not",
                          ": before GLSL 4.20 both stages must agree", "write invariant in both stages");
        if (is_of_block && input.location >= 0 && input.usage.anonymous != output.usage.anonymous &&
            (states(input, "located") ||
             (input.usage.anonymous && states(input, "apart") && states(output, "apart")) ||
             !is_only_member(output)))
            return differ(Severity::error, input.usage.anonymous ? "of no instance" : "of an instance",
                          output.usage.anonymous ? "of none" : "of one", ", and their block states locations",
                          "name an instance in both stages, or in neither");
        if (is_of_block && states(input, "located") && root_of(input.name) != root_of(output.name))
            return differ(Severity::error, fmt::format("a member of '{}'", root_of(input.name)),
                          fmt::format("one of '{}'", root_of(output.name)), "",
                          "give the block one name in both stages, or a location to the block itself");
        const std::string_view block = root_of(input.name);
        const std::string_view other_block = root_of(output.name);
        if (is_of_block && input.location >= 0 && block != other_block &&
            members_of(later_->interface.inputs, block) !=
                members_of(earlier_->interface.outputs, other_block))
            return add(in_later(block, ""), Severity::error,
                       fmt::format("the block '{}' has other members than '{}' in {} at its location", block,
                                   other_block, in_earlier(other_block, "").text()),
                       "declare the block once, in a piece that both stages include");
        const bool is_read = std::ranges::any_of(later_->interface.inputs, [&](const Variable& one) {
            return root_of(one.name) == block && !one.usage.unused;
        });
        if (!input.usage.anonymous && (states(input, "apart") || states(output, "apart")) &&
            (is_read || !states(input, "apart")))
            add(in_later(root_of(input.name), ""), Severity::error,
                fmt::format("the block of '{}' states one location, and its first member another",
                            input.name),
                "state the members' locations alone");
        else if (is_of_block && input.location >= 0 && !input.usage.anonymous && is_read &&
                 !input.per_vertex && !states(input, "located") &&
                 has_gaps(later_->interface.inputs, root_of(input.name)))
            add(in_later(root_of(input.name), ""), Severity::error,
                fmt::format("the block '{}' states a location, and its members leave some free between them",
                            root_of(input.name)),
                "state the members' locations alone, some drivers take no others");
        if (!input.usage.unused && !output.usage.access.empty())
            return add(in_later(input.name, input.type), Severity::error,
                       fmt::format("the {} stage reads {}, which belongs to {} of the {} stage",
                                   name_of(later_->kind), what, output.usage.access, name_of(earlier_->kind)),
                       "read what is emitted to stream 0: no other is drawn");
        const bool must_be_written = !version_.es && version_.number <= 120;
        const bool is_undefined = !input.usage.unused && output.usage.unused;
        if (centroid_differs(input, output) && !(is_undefined && must_be_written))
            return differ(
                is_of_block ? Severity::error : Severity::warning,
                input.interpolation.centroid ? "centroid" : "not centroid",
                output.interpolation.centroid ? "centroid" : "not",
                is_of_block ? ": the members of a block must agree" : ": some drivers refuse to link it",
                "write centroid in both stages");
        if (is_undefined)
            add(in_later(input.name, input.type), must_be_written ? Severity::error : Severity::warning,
                fmt::format("the {} stage reads {}, which the {} stage declares in {} and never writes",
                            name_of(later_->kind), what, name_of(earlier_->kind),
                            in_earlier(output.name, output.type).text()),
                fmt::format("write it in the {} stage: its value is undefined", name_of(earlier_->kind)));
    }

    [[nodiscard]] bool is_only_member(const Variable& output) const {
        return std::ranges::count(earlier_->interface.outputs, root_of(output.name),
                                  [](const Variable& one) { return root_of(one.name); }) == 1;
    }
    [[nodiscard]] bool interpolation_differs(const Variable& input, const Variable& output) const {
        if (!version_.es && version_.number >= 440 && !is_of_array_of_blocks(input)) return false;
        // Outside blocks OpenGL ES takes what is not stated for smooth.
        const bool compares_words = !version_.es || input.whole == Whole::block;
        return shading_of(input.interpolation) != shading_of(output.interpolation) ||
               (compares_words && states(input, "smooth") != states(output, "smooth"));
    }
    [[nodiscard]] bool invariance_differs(const Variable& input, const Variable& output) const {
        return is_before(420, 300) && input.whole != Whole::block &&
               input.interpolation.invariant != output.interpolation.invariant;
    }
    [[nodiscard]] bool centroid_differs(const Variable& input, const Variable& output) const {
        return (is_before(430, 310) || (!version_.es && input.whole == Whole::block) ||
                is_of_array_of_blocks(input)) &&
               input.interpolation.centroid != output.interpolation.centroid;
    }

    const std::vector<StageView>& stages_;
    Api api_;
    std::vector<StageView>::const_iterator earlier_ = {};  ///< of the two that are compared
    std::vector<StageView>::const_iterator later_ = {};
    GlslVersion version_;
    Diagnostics found_;
};

}  // namespace

Diagnostics check_varyings(const std::vector<StageView>& stages, Api api) {
    return VaryingCheck(stages, api).run();
}

}  // namespace gobo
