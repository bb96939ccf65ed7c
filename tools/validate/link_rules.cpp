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
    std::string element = {};  ///< of an array without a size that nothing indexes: the type of its elements
};

std::string format_text(const std::string& format) {
    return format.empty() ? "of no format" : fmt::format("of format {}", format);
}

/// The precision of a struct's members belongs to its type.
std::string type_text(const std::string& type, const std::vector<int>& array,
                      const std::vector<Member>& members) {
    std::vector<std::string> parts;
    for (const Member& member : members)
        parts.push_back(member.usage.precision + (member.usage.precision.empty() ? "" : " ") +
                        type_text(member.type, member.array, member.members) + " " + member.name);
    const std::string inner = parts.empty() ? "" : fmt::format(" {{ {} }}", join(parts, "; "));
    return with_extents(type, array) + inner;
}

bool is_open(const Usage& usage) {
    return usage.unused && usage.stated == "[]";
}

std::vector<GlobalName> global_names(const Interface& interface) {
    std::vector<GlobalName> names;
    const auto add = [&](GlobalName name, const std::string& type, const std::vector<int>& array,
                         const std::vector<Member>& members) {
        name.type = type_text(type, array, members);
        if (is_open(*name.usage) && !array.empty())
            name.element = type_text(type, {array.begin() + 1, array.end()}, members);
        names.push_back(std::move(name));
    };
    for (const Uniform& uniform : interface.uniforms)
        add({uniform.name, "", "", "a uniform", &uniform.usage, uniform.location, uniform.counter_binding,
             uniform.counter_offset},
            uniform.type, uniform.array, uniform.members);
    for (const Sampler& sampler : interface.samplers)
        add({sampler.name, "", "", "a sampler", &sampler.usage, sampler.location, sampler.binding},
            sampler.type, sampler.array, {});
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

/// Of an array that nothing indexes the linker takes the other's size.
bool is_same_type(const GlobalName& one, const GlobalName& other) {
    const auto fits = [](const GlobalName& open, const GlobalName& sized) {
        return !open.element.empty() && sized.type.starts_with(open.element + "[");
    };
    return one.type == other.type || fits(one, other) || fits(other, one);
}

const std::string& access_of(const Member& member) {
    return member.usage.access;
}
bool states_offset(const Member& member) {
    return member.usage.stated == "offset";
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
        append(check_varyings(stages_, Api::opengl));
        check_block_names();
        for (later_ = stages_.begin(); later_ != stages_.end(); ++later_) {
            earlier_ = stages_.begin();
            if (later_ != earlier_) check_versions();
            for (; earlier_ != later_; ++earlier_) {
                check_names();
                check_blocks();
            }
        }
        append(check_shared_places(stages_));
        return std::move(found_);
    }

  private:
    void append(const Diagnostics& more) { found_.insert(found_.end(), more.begin(), more.end()); }
    void add(const Declaration& at, Severity severity, std::string message, std::string help) {
        found_.push_back(diagnostic_at(at, severity, std::move(message), std::move(help)));
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
        else if (!is_same_type(here, there))
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
        else if (version_.es && here.usage->precision != there.usage->precision &&
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

    /// By the specification what is no block may be called as a block of another stage; Mesa 22.3 crashes.
    void check_block_names() {
        for (const StageView& stage : stages_)
            for (const auto lists : {&Interface::blocks, &Interface::storage_blocks})
                for (const Block& block : stage.interface.*lists)
                    for (const StageView& other : stages_)
                        for (const GlobalName& name : global_names(other.interface))
                            if (name.name == root_of(block.name) && name.block != block.name &&
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
        } else if (const auto [placed, other_placed] =
                       std::ranges::mismatch(here.members, there.members, {}, states_offset, states_offset);
                   placed != here.members.end()) {
            const auto offset_text = [](const Member& member) {
                return fmt::format("{} offset of '{}'", states_offset(member) ? "a stated" : "no stated",
                                   member.name);
            };
            differ(offset_text(*placed), offset_text(*other_placed), once);
        } else if (!here.usage.stated.empty() && !there.usage.stated.empty() &&
                   here.usage.stated != there.usage.stated) {
            differ(fmt::format("layout {}", here.usage.stated), there.usage.stated, once);
        } else if (here.usage.stated == "packed" && here.name != root_of(here.name) &&
                   here.usage.unused != there.usage.unused) {
            differ(here.usage.unused ? "layout packed and is not read" : "layout packed and is read",
                   there.usage.unused ? "is not" : "is", "write layout(std140) before it");
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
