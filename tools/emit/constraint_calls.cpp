#include "emit/constraint_calls.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reflect/interface.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// A side of a constraint: a member of a block, or a component of one.
struct Side {
    std::string path;        ///< "PointLights.lights[].color.x"
    std::string expression;  ///< "block.lights[{}].color", with {} for each index
    /// For each index what it stays below: the array's extent, and `count` of the array that ends the block.
    std::vector<std::vector<std::string>> bounds;
    GlslType type;
    std::optional<std::size_t> component;
};

class SideFinder {
  public:
    SideFinder(const CppBlock& block, std::string_view root, std::string_view name)
        : block_(block), root_(root), name_(without_indices(name)), part_(component_name(name_)) {}

    [[nodiscard]] std::optional<Side> found() const {
        return within(block_.members, {block_.name, std::string(root_), {}, {}, {}});
    }

  private:
    [[nodiscard]] std::optional<Side> within(const std::vector<CppMember>& members,
                                             const Side& parent) const {
        for (const CppMember& member : members) {
            Side side = parent;
            side.path += "." + member.member.name;
            side.expression += "." + member.identifier;
            for (const int extent : member.member.array) {
                side.path += "[]";
                side.expression += "[{}]";
                side.bounds.push_back({std::to_string(extent)});
            }
            if (&members == &block_.members && member.member.name == block_.counted)
                side.bounds.front().insert(side.bounds.front().begin(), "count");
            if (!member.members.empty()) {
                if (auto inner = within(member.members, side)) return inner;
                continue;
            }
            const std::string path = without_indices(side.path);
            const auto type = glsl_type(member.member.type);
            if (!type || type->scalar == Scalar::float16) continue;
            side.type = *type;
            if (path == name_) return side;
            if (!part_ || part_->of != path || type->is_matrix() ||
                static_cast<int>(part_->component) >= type->rows)
                continue;
            side.path += name_.substr(name_.size() - 2);
            side.component = part_->component;
            return side;
        }
        return std::nullopt;
    }

    const CppBlock& block_;
    std::string_view root_;
    std::string name_;
    std::optional<ComponentName> part_;
};

/// `gobo::runtime::operand(...)` of a side whose indices have those names.
std::string operand_text(const Side& side, const std::vector<std::string>& indices) {
    std::string expression;
    auto index = indices.begin();
    for (std::size_t i = 0; i < side.expression.size(); ++i) {
        const bool is_index = side.expression.compare(i, 2, "{}") == 0;
        expression += is_index ? *index++ : std::string(1, side.expression[i]);
        if (is_index) ++i;
    }
    return fmt::format("gobo::runtime::operand({}, {{{}}}, {}{})", cpp_literal(side.path),
                       fmt::join(indices, ", "), expression,
                       side.component ? fmt::format(", {}", *side.component) : "");
}

/// Whether the constraint can be said of members of these types.
bool is_fitting(const Constraint& constraint, const Side& first, const Side* second) {
    const auto is_square = [](const Side& side, int least) {
        return side.type.rows == side.type.columns && side.type.rows >= least;
    };
    switch (constraint.kind) {
        case Constraint::Kind::orthonormal:
            return is_square(first, 2);
        case Constraint::Kind::inverse_transpose:
            return is_square(first, 3) && first.type.rows == 3 && second != nullptr && is_square(*second, 3);
        default:
            return true;
    }
}

std::string_view sign_of(const Constraint& constraint, bool is_turned_round) {
    switch (constraint.kind) {
        case Constraint::Kind::less:
            return is_turned_round ? ">" : "<";
        case Constraint::Kind::less_equal:
            return is_turned_round ? ">=" : "<=";
        default:
            return "!=";
    }
}

/// The call with its sides; the second is empty where there is none.
std::string call_text(const Constraint& constraint, const std::string& first, const std::string& second) {
    const auto call = [](std::string_view name, const std::string& arguments) {
        return fmt::format("gobo::runtime::{}(found, {});", name, arguments);
    };
    switch (constraint.kind) {
        case Constraint::Kind::unit:
            return call("check_unit", first);
        case Constraint::Kind::not_zero:
            return call("check_not_zero", first);
        case Constraint::Kind::orthonormal:
            return call("check_orthonormal", first);
        case Constraint::Kind::distinct:
            return call("check_distinct", first + ", " + second);
        case Constraint::Kind::inverse_transpose:
            return call("check_inverse_transpose", first + ", " + second);
        case Constraint::Kind::less:
        case Constraint::Kind::less_equal:
        case Constraint::Kind::differ:
            break;
    }
    if (!constraint.has_number())
        return call("check_order", fmt::format("{}, \"{}\", {}", first, sign_of(constraint, false), second));
    const std::string_view sign = sign_of(constraint, constraint.names[0].empty());
    return call("check_bound", fmt::format("{}, \"{}\", {}", first, sign, constraint.number));
}

}  // namespace

std::optional<ConstraintCall> constraint_call(const Constraint& constraint, const CppBlock& block,
                                              const CppBlock& other) {
    std::vector<std::string> names = constraint.names;
    std::erase(names, "");
    const bool is_pair = &block != &other;
    if (is_pair && names.size() < 2) return std::nullopt;
    const auto find = [&](const std::string& name, bool is_in_other) {
        return SideFinder(is_in_other ? other : block, is_in_other ? "other" : "block", name).found();
    };
    bool is_swapped = false;  // the first stands in `other`
    auto first = find(names[0], false);
    if (!first && is_pair) {
        first = find(names[0], true);
        is_swapped = true;
    }
    if (!first) return std::nullopt;
    const auto second =
        names.size() > 1 ? find(names[1], is_pair && !is_swapped) : std::optional<Side>(std::nullopt);
    if ((names.size() > 1 && !second) || !is_fitting(constraint, *first, second ? &*second : nullptr))
        return std::nullopt;

    // The first index of both is one: elements are compared with their own. Others are all with all.
    std::vector<std::vector<std::string>> bounds = first->bounds;
    std::vector<std::string> of_first;
    std::vector<std::string> of_second;
    for (std::size_t i = 0; i < first->bounds.size(); ++i) of_first.push_back(fmt::format("i{}", i));
    for (std::size_t i = 0; second && i < second->bounds.size(); ++i) {
        if (i == 0 && !bounds.empty()) {
            for (const std::string& bound : second->bounds[0])
                if (std::ranges::find(bounds[0], bound) == bounds[0].end()) bounds[0].push_back(bound);
            of_second.emplace_back("i0");
            continue;
        }
        of_second.push_back(fmt::format("i{}", bounds.size()));
        bounds.push_back(second->bounds[i]);
    }
    ConstraintCall call;
    std::string indent(4, ' ');
    std::string tail;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const std::string index = fmt::format("i{}", i);
        std::vector<std::string> conditions;
        for (const std::string& bound : bounds[i]) {
            conditions.push_back(fmt::format("{} < {}", index, bound));
            call.is_counted |= bound == "count";
        }
        call.text += fmt::format("{0}for (int {1} = 0; {2}; ++{1}) {{\n", indent, index,
                                 fmt::join(conditions, " && "));
        tail = indent + "}\n" + tail;
        indent += "    ";
    }
    const std::string text =
        call_text(constraint, operand_text(*first, of_first), second ? operand_text(*second, of_second) : "");
    call.text += indent + text + "\n" + tail;
    return call;
}

}  // namespace gobo
