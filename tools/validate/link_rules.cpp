#include "validate/link_rules.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"

namespace gobo {
namespace {

std::string with_extents(std::string text, const std::vector<int>& array) {
    for (const int extent : array) text += extent == 0 ? "[]" : fmt::format("[{}]", extent);
    return text;
}

/// "flat", "noperspective" or "smooth".
std::string_view shading_of(const Interpolation& interpolation) {
    return interpolation.flat ? "flat" : interpolation.noperspective ? "noperspective" : "smooth";
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

/// A name of the program's one name space for uniforms, as one stage declares it.
struct GlobalName {
    std::string name;
    std::string type;   ///< what OpenGL compares
    std::string block;  ///< that it is a member of, or empty
    std::string kind;   ///< "a uniform", "a sampler", "a member of block 'Frame'"
    const Usage* usage = nullptr;
    int location = -1;
    int binding = -1;
    int counter_offset = -1;
};

std::string format_text(const std::string& format) {
    return format.empty() ? "of no format" : fmt::format("of format {}", format);
}

/// In OpenGL ES the precision of a struct's members belongs to its type.
std::string type_text(const std::string& type, const std::vector<int>& array,
                      const std::vector<Member>& members) {
    std::vector<std::string> parts;
    for (const Member& member : members)
        parts.push_back(member.usage.precision + (member.usage.precision.empty() ? "" : " ") +
                        type_text(member.type, member.array, member.members) + " " + member.name);
    const std::string inner = parts.empty() ? "" : fmt::format(" {{ {} }}", join(parts, "; "));
    return with_extents(type, array) + inner;
}

std::vector<GlobalName> global_names(const Interface& interface) {
    std::vector<GlobalName> names;
    for (const Uniform& uniform : interface.uniforms)
        names.push_back({uniform.name, type_text(uniform.type, uniform.array, uniform.members), "",
                         "a uniform", &uniform.usage, uniform.location, uniform.counter_binding,
                         uniform.counter_offset});
    for (const Sampler& sampler : interface.samplers)
        names.push_back({sampler.name, with_extents(sampler.type, sampler.array), "", "a sampler",
                         &sampler.usage, sampler.location, sampler.binding});
    for (const auto* const blocks : {&interface.blocks, &interface.storage_blocks})
        for (const Block& block : *blocks) {
            if (!block.usage.anonymous) continue;
            for (const Member& member : block.members)
                names.push_back({member.name, type_text(member.type, member.array, member.members),
                                 block.name, fmt::format("a member of the block '{}'", block.name),
                                 &block.usage});
        }
    return names;
}

const std::string& access_of(const Member& member) {
    return member.usage.access;
}

class LinkCheck {
  public:
    explicit LinkCheck(const std::vector<StageView>& stages)
        : stages_(stages), version_(version_of(stages.front().pieces.front()->text)) {}

    Diagnostics run() {
        if (version_.es && stages_.size() == 1 && stages_.front().kind == StageKind::vertex)
            add({{stages_.front().pieces.back()->path, 0, 0}, ""}, Severity::error,
                "a program of OpenGL ES needs a fragment stage", "add one whose main() is empty");
        const auto has = [&](StageKind kind) {
            return std::ranges::any_of(stages_, [&](const StageView& stage) { return stage.kind == kind; });
        };
        if (version_.es && has(StageKind::tess_evaluation) && !has(StageKind::tess_control))
            add({{stages_.back().pieces.back()->path, 0, 0}, ""}, Severity::error,
                "a program of OpenGL ES with a tess_evaluation stage needs a tess_control stage",
                "add one that sets the levels");
        for (const StageView& stage : stages_) {
            if (stage.kind != StageKind::fragment) check_components(stage, stage.interface.outputs);
            if (stage.kind != StageKind::vertex) check_components(stage, stage.interface.inputs);
        }
        check_block_names();
        for (later_ = stages_.begin(); later_ != stages_.end(); ++later_) {
            earlier_ = stages_.begin();
            if (later_ != earlier_) check_versions();
            for (; earlier_ != later_; ++earlier_) {
                if (earlier_ + 1 == later_) check_varyings();
                check_names();
                check_blocks();
            }
        }
        const Diagnostics shared = check_shared_places(stages_);
        found_.insert(found_.end(), shared.begin(), shared.end());
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
                if (type && other_type && type->scalar != other_type->scalar)
                    differ("have not one numerical type");
                else if (how != other_how)
                    differ(fmt::format("are {} and {}", how, other_how));
            }
    }

    /// A program is of OpenGL or of OpenGL ES, and there of one version (GLSL ES 3.00, 3.3).
    void check_versions() {
        const GlslVersion here = version_of(later_->pieces.front()->text);
        if (here.es == version_.es && (!here.es || here.number == version_.number)) return;
        const auto text = [](const GlslVersion& version) {
            return fmt::format("GLSL {}{}", version.es ? "ES " : "", version.number);
        };
        add({{later_->pieces.back()->path, 0, 0}, ""}, Severity::error,
            fmt::format("this stage is {}, but {} is {}: they make no program", text(here),
                        earlier_->pieces.back()->path, text(version_)),
            "state the same #version in both");
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

    // ---- from one stage to the next

    /// By location where both state one, by name where neither does (GLSL 4.50, 4.4.1).
    [[nodiscard]] static bool match(const Variable& input, const Variable& output) {
        if (input.location < 0 || output.location < 0)
            return input.location < 0 && output.location < 0 && input.name == output.name;
        return input.location == output.location && input.component == output.component;
    }

    void check_varyings() {
        std::set<std::string_view> told;  // of a struct or block one member will do
        for (const Variable& input : later_->interface.inputs) {
            const auto output = std::ranges::find_if(earlier_->interface.outputs,
                                                     [&](const Variable& one) { return match(input, one); });
            const std::size_t before = found_.size();
            if (told.contains(root_of(input.name))) continue;
            if (output != earlier_->interface.outputs.end())
                check_varying(input, *output);
            else if (!input.usage.unused)
                check_missing(input);
            if (found_.size() > before) told.insert(root_of(input.name));
        }
    }

    void check_missing(const Variable& input) {
        std::string message =
            fmt::format("the {} stage reads '{}', which the {} stage does not write", name_of(later_->kind),
                        with_extents(input.type + " " + input.name, input.array), name_of(earlier_->kind));
        std::string help =
            fmt::format("declare and write it as an output of the {} stage", name_of(earlier_->kind));
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
        if (input.type != output.type || input.array != output.array)
            return differ(Severity::error, with_extents(input.type, input.array),
                          with_extents(output.type, output.array), "", "declare it alike in both stages");
        const bool is_of_block = input.whole == Whole::block;
        if (input.patch != output.patch)
            return differ(Severity::error, input.patch ? "patch" : "not patch",
                          output.patch ? "patch" : "not", "", "write patch in both stages, or in neither");
        if (interpolation_differs(input, output))
            return differ(Severity::error, shading_of(input.interpolation), shading_of(output.interpolation),
                          version_.es ? ": OpenGL ES wants the same interpolation in both stages"
                                      : ": before GLSL 4.40 both stages must interpolate alike",
                          "write the same qualifier in both stages");
        if (input.interpolation.sample != output.interpolation.sample)
            return differ(Severity::error, sampling_of(input.interpolation),
                          sampling_of(output.interpolation), "", "write sample in both stages");
        if (invariance_differs(input, output))
            return differ(Severity::error, input.interpolation.invariant ? "invariant" : "not invariant",
                          output.interpolation.invariant ? "invariant" : "not",
                          ": before GLSL 4.20 both stages must agree", "write invariant in both stages");
        if (centroid_differs(input, output))
            return differ(
                is_of_block ? Severity::error : Severity::warning,
                input.interpolation.centroid ? "centroid" : "not centroid",
                output.interpolation.centroid ? "centroid" : "not",
                is_of_block ? ": the members of a block must agree" : ": some drivers refuse to link it",
                "write centroid in both stages");
        if (!input.usage.unused && output.usage.unused)
            add(in_later(input.name, input.type), Severity::warning,
                fmt::format("the {} stage reads {}, which the {} stage declares in {} and never writes",
                            name_of(later_->kind), what, name_of(earlier_->kind),
                            in_earlier(output.name, output.type).text()),
                fmt::format("write it in the {} stage: its value is undefined", name_of(earlier_->kind)));
    }

    [[nodiscard]] bool interpolation_differs(const Variable& input, const Variable& output) const {
        return (version_.es || version_.number < 440) &&
               shading_of(input.interpolation) != shading_of(output.interpolation);
    }
    [[nodiscard]] bool invariance_differs(const Variable& input, const Variable& output) const {
        return is_before(420, 300) && input.whole != Whole::block &&
               input.interpolation.invariant != output.interpolation.invariant;
    }
    [[nodiscard]] bool centroid_differs(const Variable& input, const Variable& output) const {
        return (is_before(430, 310) || (!version_.es && input.whole == Whole::block)) &&
               input.interpolation.centroid != output.interpolation.centroid;
    }

    // ---- names that both stages declare

    void check_names() {
        std::map<std::string_view, const GlobalName*> of_earlier;
        const std::vector<GlobalName> earlier = global_names(earlier_->interface);
        for (const GlobalName& name : earlier) of_earlier.emplace(name.name, &name);
        for (const GlobalName& name : global_names(later_->interface))
            if (const auto other = of_earlier.find(name.name); other != of_earlier.end())
                check_name(name, *other->second);
    }

    void check_name(const GlobalName& here, const GlobalName& there) {
        if (!here.block.empty() && here.block == there.block) return;  // check_blocks() compares them
        const auto declared = [](const GlobalName& name, const std::vector<const Piece*>& pieces) {
            const std::string type = name.type.substr(0, name.type.find_first_of("[ "));
            return name.block.empty() ? declaration_of(name.name, type, pieces)
                                      : declaration_of_member(name.block, name.name, pieces);
        };
        const auto differ = [&](const std::string& mine, const std::string& theirs, std::string help) {
            add(declared(here, later_->pieces), Severity::error,
                fmt::format("'{}' is {} here, but {} in {}", here.name, mine, theirs,
                            declared(there, earlier_->pieces).text()),
                std::move(help));
        };
        if (!here.block.empty() || !there.block.empty())
            differ(here.kind, there.kind, "rename one of them, or give the block an instance name");
        else if (here.type != there.type)
            differ(here.type, there.type, "declare it alike in both stages, or give it two names");
        else if (here.location >= 0 && there.location >= 0 && here.location != there.location)
            differ(fmt::format("at location {}", here.location), fmt::format("at {}", there.location),
                   "state one location in both stages");
        else if (here.binding >= 0 && there.binding >= 0 && here.binding != there.binding)
            differ(fmt::format("at binding {}", here.binding), fmt::format("at {}", there.binding),
                   "state one binding in both stages");
        else if (here.counter_offset != there.counter_offset)
            differ(fmt::format("at offset {}", here.counter_offset),
                   fmt::format("at {}", there.counter_offset), "state one offset in both stages");
        else if (here.usage->access != there.usage->access)
            differ(format_text(here.usage->access), format_text(there.usage->access),
                   "state one format in both stages");
        else if (here.usage->precision != there.usage->precision &&
                 (version_.number >= 300 || (!here.usage->unused && !there.usage->unused)))
            differ(here.usage->precision, there.usage->precision,
                   "write its precision in both stages: OpenGL ES wants the same");
    }

    // ---- blocks

    void check_blocks() {
        std::set<std::string_view> told;  // of an array of blocks one will do
        for (const auto lists : {&Interface::blocks, &Interface::storage_blocks})
            for (const Block& here : later_->interface.*lists)
                for (const auto others : {&Interface::blocks, &Interface::storage_blocks}) {
                    const auto& of_earlier = earlier_->interface.*others;
                    const auto there = std::ranges::find(of_earlier, here.name, &Block::name);
                    if (there == of_earlier.end() || told.contains(root_of(here.name))) continue;
                    const std::size_t before = found_.size();
                    check_block(here, *there);
                    if (found_.size() > before) told.insert(root_of(here.name));
                }
    }

    /// By the specification a uniform may be called as a block of another stage; Mesa 22.3 crashes.
    void check_block_names() {
        for (const StageView& stage : stages_)
            for (const auto lists : {&Interface::blocks, &Interface::storage_blocks})
                for (const Block& block : stage.interface.*lists)
                    for (const StageView& other : stages_)
                        for (const GlobalName& name : global_names(other.interface))
                            if (name.block.empty() && name.name == root_of(block.name) &&
                                !block.usage.anonymous)
                                add(declaration_of(name.name, "", other.pieces), Severity::error,
                                    fmt::format("'{}' is {} here, and a block in {}", name.name, name.kind,
                                                declaration_of(block.name, "", stage.pieces).text()),
                                    "rename one of them: some drivers take them for one");
    }

    void check_block(const Block& here, const Block& there) {
        const auto differ = [&](const std::string& mine, const std::string& theirs, std::string help) {
            add(in_later(here.name, ""), Severity::error,
                fmt::format("the block '{}' has {} here, but {} in {}", root_of(here.name), mine, theirs,
                            in_earlier(there.name, "").text()),
                std::move(help));
        };
        const std::string once = "declare the block once, in a piece that both stages include";
        const auto [mine, theirs] = std::ranges::mismatch(here.members, there.members);
        const auto member_text = [](const std::vector<Member>& members, auto at) {
            return at == members.end() ? std::string("no such member")
                                       : fmt::format("'{} {}' at offset {}", at->type,
                                                     with_extents(at->name, at->array), at->offset);
        };
        if (mine != here.members.end() || theirs != there.members.end()) {
            std::string text = member_text(here.members, mine);
            std::string other = member_text(there.members, theirs);
            if (text == other) text += " (of other members or strides)";
            differ(text, other, once);
        } else if (const auto [own, other] =
                       std::ranges::mismatch(here.members, there.members, {}, access_of, access_of);
                   own != here.members.end()) {
            const auto access_text = [](const Member& member) {
                return fmt::format(
                    "'{}' {}", member.name,
                    member.usage.access.empty() ? "without qualifiers of memory" : member.usage.access);
            };
            differ(access_text(*own), access_text(*other), once);
        } else if (here.usage.anonymous != there.usage.anonymous) {
            differ(here.usage.anonymous ? "no instance name" : "an instance name",
                   there.usage.anonymous ? "none" : "one", once);
        } else if (std::max(here.binding, 0) != std::max(there.binding, 0)) {  // unstated is 0
            const auto binding_text = [](const Block& block) {
                return block.binding < 0 ? std::string("no binding")
                                         : fmt::format("binding {}", block.binding);
            };
            differ(binding_text(here), binding_text(there), once);
        }
    }

    const std::vector<StageView>& stages_;
    std::vector<StageView>::const_iterator earlier_ = {};  ///< of the two that are compared
    std::vector<StageView>::const_iterator later_ = {};
    GlslVersion version_;
    Diagnostics found_;
};

}  // namespace

Diagnostics check_link(const std::vector<StageView>& stages) {
    return LinkCheck(stages).run();
}

}  // namespace gobo
