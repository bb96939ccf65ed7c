#include "validate/tree_rules.hpp"

#include <fmt/format.h>
#include <glslang/MachineIndependent/localintermediate.h>

#include "compose/dialect.hpp"

namespace gobo {
namespace {

class Traverser : public glslang::TIntermTraverser {
  public:
    explicit Traverser(const std::vector<const Piece*>& pieces) : pieces_(pieces) {}

    Diagnostics found;

    bool visitSwitch(glslang::TVisit /*visit*/, glslang::TIntermSwitch* node) override {
        const glslang::TBasicType type = node->getCondition()->getAsTyped()->getBasicType();
        for (TIntermNode* const part : node->getBody()->getSequence()) {
            const glslang::TIntermBranch* const label = part->getAsBranchNode();
            if (label == nullptr || label->getFlowOp() != glslang::EOpCase) continue;
            const glslang::TIntermTyped* const value = label->getExpression();
            if (value == nullptr || value->getBasicType() == type) continue;
            const auto string = static_cast<std::size_t>(label->getLoc().string);
            const bool is_signed = type == glslang::EbtInt;
            Diagnostic& diagnostic = found.emplace_back();
            diagnostic.message = fmt::format("a case of {} in a switch of {}", is_signed ? "uint" : "int",
                                             is_signed ? "int" : "uint");
            diagnostic.help = is_signed ? "write it without the u" : "write a u behind the number";
            put_at(diagnostic, *pieces_[std::min(string, pieces_.size() - 1)], label->getLoc().line);
        }
        return true;
    }

  private:
    const std::vector<const Piece*>& pieces_;
};

}  // namespace

Diagnostics check_tree(const glslang::TIntermediate& tree, const std::vector<const Piece*>& pieces) {
    const GlslVersion version = version_of(pieces.front()->text);
    if (tree.getTreeRoot() == nullptr || (!version.es && version.number >= 400)) return {};
    Traverser traverser(pieces);
    tree.getTreeRoot()->traverse(&traverser);
    return std::move(traverser.found);
}

}  // namespace gobo
