#include "validate/syntax_tree.hpp"

#include <set>

#include <fmt/format.h>
#include <glslang/MachineIndependent/localintermediate.h>

#include "validate/declaration.hpp"

namespace gobo {
namespace {

void add_precisions(const std::string& path, const glslang::TType& type, Precisions& precisions) {
    if (type.isStruct()) {
        for (const glslang::TTypeLoc& member : *type.getStruct())
            add_precisions(path + "." + member.type->getFieldName().c_str(), *member.type, precisions);
    } else if (type.getQualifier().precision != glslang::EpqNone) {
        precisions[path] = glslang::GetPrecisionQualifierString(type.getQualifier().precision);
    }
}

void set_precision(const std::string& path, Usage& usage, const Precisions& precisions) {
    if (const auto found = precisions.find(path); found != precisions.end()) usage.precision = found->second;
}

void set_precisions(const std::string& path, std::vector<Member>& members, const Precisions& precisions) {
    for (Member& member : members) {
        const std::string own = path + "." + member.name;
        set_precision(own, member.usage, precisions);
        set_precisions(own, member.members, precisions);
    }
}

/// Names as glslang has them, with the types of the parameters: "f(f1;".
class Calls : public glslang::TIntermTraverser {
  public:
    bool visitAggregate(glslang::TVisit, glslang::TIntermAggregate* node) override {
        if (node->getOp() == glslang::EOpFunction) written.insert(node->getName().c_str());
        if (node->getOp() == glslang::EOpFunctionCall && node->isUserDefined())
            called.insert(node->getName().c_str());
        return true;
    }

    std::set<std::string> written;
    std::set<std::string> called;
};

}  // namespace

Precisions precisions_of(const glslang::TShader& shader) {
    Precisions precisions;
    const glslang::TIntermediate& tree = *shader.getIntermediate();
    if (tree.getTreeRoot() == nullptr) return precisions;
    for (TIntermNode* const object : tree.findLinkerObjects()->getSequence()) {
        const glslang::TIntermSymbol* const symbol = object->getAsSymbolNode();
        if (symbol == nullptr || symbol->getQualifier().storage != glslang::EvqUniform ||
            symbol->getBasicType() == glslang::EbtBlock)
            continue;
        add_precisions(symbol->getName().c_str(), symbol->getType(), precisions);
    }
    return precisions;
}

void set_precisions(Interface& interface, const Precisions& precisions) {
    for (Uniform& uniform : interface.uniforms) {
        const std::string path = without_indices(uniform.name);
        set_precision(path, uniform.usage, precisions);
        set_precisions(path, uniform.members, precisions);
    }
    for (Sampler& sampler : interface.samplers)
        set_precision(without_indices(sampler.name), sampler.usage, precisions);
}

Diagnostics check_calls(const glslang::TShader& shader, const std::vector<const Piece*>& pieces) {
    Calls calls;
    if (TIntermNode* const root = shader.getIntermediate()->getTreeRoot()) root->traverse(&calls);
    Diagnostics found;
    for (const std::string& mangled : calls.called) {
        if (calls.written.contains(mangled)) continue;
        const std::string name = mangled.substr(0, mangled.find('('));
        found.push_back(diagnostic_at(use_of(name, pieces), Severity::error,
                                      fmt::format("the function '{}' has no body", name),
                                      "write it, or include the piece that holds it"));
    }
    return found;
}

}  // namespace gobo
