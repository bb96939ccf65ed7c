#include "lab/sanitize/constant_faults.hpp"

#include <algorithm>
#include <utility>

#include "lab/sanitize/constant_reader.hpp"

namespace gobo::sanitize {
namespace {

bool is_qualifier(std::string_view text) {
    static const std::set<std::string_view> kQualifiers = {
        "in",       "out",       "inout",    "uniform",  "varying", "attribute",     "buffer",
        "shared",   "flat",      "smooth",   "highp",    "mediump", "noperspective", "lowp",
        "centroid", "invariant", "precise",  "patch",    "sample",  "readonly",      "writeonly",
        "coherent", "volatile",  "restrict", "precision"};
    return kQualifiers.contains(text);
}

}  // namespace

std::vector<ConstantFault> ConstantReader::read() {
    while (!at_end()) {
        const std::size_t before = at_;
        statement();
        if (at_ == before) ++at_;
    }
    std::vector<ConstantFault> faults;
    const std::set<std::string_view> reached = reached_functions();
    for (const auto& [function, fault] : faults_)
        if ((function.empty() || reached.contains(function)) &&
            std::ranges::find(faults, fault) == faults.end())
            faults.push_back(fault);
    std::ranges::stable_sort(faults, {}, &ConstantFault::line);
    return faults;
}

std::set<std::string_view> ConstantReader::reached_functions() const {
    std::set<std::string_view> reached;
    std::vector<std::string_view> open = {"main"};
    while (!open.empty()) {
        const std::string_view name = open.back();
        open.pop_back();
        if (!reached.insert(name).second) continue;
        if (const auto called = calls_.find(name); called != calls_.end())
            open.insert(open.end(), called->second.begin(), called->second.end());
    }
    return reached;
}

void ConstantReader::statement() {
    if (sees("{")) return block();
    if (take(";")) return;
    if (take("if")) return conditional();
    if (take("for")) return loop();
    if (take("while") || take("switch")) {
        take("(");
        expression();
        take(")");
        if (!take(";")) statement();
        return;
    }
    if (take("do")) return statement();  // its condition is read as a loop of nothing
    if (take("else") || take("default")) {
        take(":");
        return;
    }
    if (take("case")) {
        expression();
        take(":");
        return;
    }
    if (take("return")) {
        expression();
        take(";");
        return;
    }
    declaration();
}

void ConstantReader::block() {
    take("{");
    scopes_.emplace_back(std::exchange(parameters_, {}));
    while (!at_end() && !sees("}")) {
        const std::size_t before = at_;
        statement();
        if (at_ == before) ++at_;
    }
    take("}");
    scopes_.pop_back();
}

void ConstantReader::guarded_statement(bool is_dead) {
    muted_ += is_dead ? 1 : 0;
    statement();
    muted_ -= is_dead ? 1 : 0;
}

void ConstantReader::conditional() {
    take("(");
    const std::optional<bool> holds = truth_of(expression());
    take(")");
    guarded_statement(holds == false);
    if (take("else")) guarded_statement(holds == true);
}

void ConstantReader::loop() {
    take("(");
    scopes_.emplace_back();
    statement();
    const std::optional<bool> holds = truth_of(expression());
    take(";");
    expression();
    take(")");
    guarded_statement(holds == false);
    scopes_.pop_back();
}

void ConstantReader::declaration() {
    bool is_constant = false;
    while (sees("const") || sees("layout") || is_qualifier(peek().text)) {
        is_constant = is_constant || sees("const");
        const bool has_brackets = sees("layout");
        ++at_;
        if (has_brackets && sees("(")) skip_brackets();
    }
    if (take("struct")) {
        structure();
    } else if (peek().is_name() && sees("{", 1)) {  // a block of uniforms
        ++at_;
        block();
    } else if (const std::size_t name = place_of_declared_name(); name != 0) {
        const std::string_view type = peek().text;
        const bool is_array_type = name > 1;
        at_ += name;
        if (sees("(", 1) && scopes_.size() == 1) return function_header();
        return declarators(is_constant, type, is_array_type);
    } else {
        expression();
        take(";");
        return;
    }
    while (!at_end() && !take(";")) {
        if (sees("}")) return;
        ++at_;
    }
}

void ConstantReader::structure() {
    const std::string_view name = peek().is_name() ? tokens_[at_++].text : "";
    const std::size_t first = at_ + 1;
    block();
    std::vector<Member> members;
    std::string_view type;
    int depth = 0;
    for (std::size_t i = first; i + 1 < at_; ++i) {
        const Token& token = tokens_[i];
        if (token.text == "[" || token.text == "(") ++depth;
        if (token.text == "]" || token.text == ")") --depth;
        if (token.text == ";") type = {};
        if (depth > 0 || !token.is_name() || is_qualifier(token.text) || token.text == "layout") continue;
        if (type.empty())
            type = token.text;
        else
            members.push_back({token.text, glsl_type(type)});
    }
    structures_[name] = std::move(members);
}

Constant ConstantReader::structure_of(std::string_view name, const std::vector<Constant>& given) const {
    const std::vector<Member>& members = structures_.at(name);
    if (given.size() != members.size()) return std::nullopt;
    ConstantValue value{{}, ConstantValue::kStructure, {}, name, {}};
    for (std::size_t i = 0; i < given.size(); ++i) {
        const bool is_single = given[i] && given[i]->elements == 0 && members[i].type;
        const Constant member = is_single ? converted(given[i], *members[i].type) : given[i];
        if (!member) return std::nullopt;
        value.members.push_back(*member);
    }
    return value;
}

Constant ConstantReader::member_of(const ConstantValue& value, std::string_view name) const {
    const std::vector<Member>& members = structures_.at(value.structure);
    const auto found = std::ranges::find(members, name, &Member::name);
    if (found == members.end()) return std::nullopt;
    return value.members[static_cast<std::size_t>(found - members.begin())];
}

std::size_t ConstantReader::place_of_declared_name() const {
    if (!peek().is_name()) return 0;
    std::size_t ahead = 1;
    while (sees("[", ahead)) {
        while (!peek(ahead).text.empty() && !sees("]", ahead)) ++ahead;
        ++ahead;
    }
    return peek(ahead).is_name() ? ahead : 0;
}

void ConstantReader::function_header() {
    const std::string_view name = peek().text;
    ++at_;
    functions_.insert(name);
    std::string_view last;
    int depth = 0;
    parameters_.clear();
    do {
        const Token& token = peek();
        if (token.text == "(") ++depth;
        if (token.text == ")") --depth;
        if ((token.text == "," || token.text == ")" || token.text == "[") && !last.empty()) {
            parameters_[last] = std::nullopt;
            last = {};
        }
        if (token.is_name()) last = token.text;
        ++at_;
    } while (depth > 0 && !at_end());
    if (!sees("{")) {
        parameters_.clear();
        take(";");
        return;
    }
    function_ = name;
    block();
    function_ = {};
}

void ConstantReader::declarators(bool is_constant, std::string_view type, bool is_array_type) {
    do {
        const std::string_view name = peek().text;
        ++at_;
        bool is_array = is_array_type;
        while (take("[")) {
            is_array = true;
            expression();
            take("]");
        }
        Constant value;
        if (take("=")) value = assignment();
        const std::optional<GlslType> wanted = glsl_type(type);
        const bool is_structure = value && value->elements == ConstantValue::kStructure;
        if (!is_constant || !(wanted || is_structure))
            value = std::nullopt;
        else if (!is_array && !is_structure)
            value = converted(value, *wanted);
        scopes_.back()[name] = std::move(value);
    } while (take(","));
    take(";");
}

std::vector<ConstantFault> faults_of_constants(std::string_view source) {
    return ConstantReader(source).read();
}

}  // namespace gobo::sanitize
