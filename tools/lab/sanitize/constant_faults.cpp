#include "lab/sanitize/constant_faults.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "lab/sanitize/constant_tokens.hpp"

namespace gobo::sanitize {
namespace {

/// How tightly a binary operator binds; 0 for what is none.
int precedence_of(std::string_view text) {
    static const std::map<std::string_view, int> kPrecedences = {
        {"*", 11}, {"/", 11}, {"%", 11}, {"+", 10}, {"-", 10}, {"<<", 9}, {">>", 9},
        {"<", 8},  {">", 8},  {"<=", 8}, {">=", 8}, {"==", 7}, {"!=", 7}, {"&", 6},
        {"^", 5},  {"|", 4},  {"&&", 3}, {"^^", 2}, {"||", 1}};
    const auto found = kPrecedences.find(text);
    return found == kPrecedences.end() ? 0 : found->second;
}

bool is_assignment(std::string_view text) {
    constexpr std::array<std::string_view, 11> kAssignments = {
        "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
    return std::ranges::find(kAssignments, text) != kAssignments.end();
}

bool is_qualifier(std::string_view text) {
    static const std::set<std::string_view> kQualifiers = {
        "in",       "out",       "inout",    "uniform",  "varying", "attribute",     "buffer",
        "shared",   "flat",      "smooth",   "highp",    "mediump", "noperspective", "lowp",
        "centroid", "invariant", "precise",  "patch",    "sample",  "readonly",      "writeonly",
        "coherent", "volatile",  "restrict", "precision"};
    return kQualifiers.contains(text);
}

/// Reads statements in order, and knows the constants in scope. Whatever it does not understand is skipped:
/// the text is one that glslang has accepted.
class ConstantReader {
  public:
    explicit ConstantReader(std::string_view source) : tokens_(lines_as_tokens(source)) {}

    std::vector<ConstantFault> read() {
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

  private:
    using Scope = std::map<std::string_view, Constant>;
    struct Member {
        std::string_view name;
        std::optional<GlslType> type;  ///< nothing of another structure
    };

    [[nodiscard]] bool at_end() const { return at_ >= tokens_.size(); }
    [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
        static const Token kEnd{};
        return at_ + ahead < tokens_.size() ? tokens_[at_ + ahead] : kEnd;
    }
    [[nodiscard]] bool sees(std::string_view text, std::size_t ahead = 0) const {
        return peek(ahead).text == text;
    }
    bool take(std::string_view text) {
        if (!sees(text)) return false;
        ++at_;
        return true;
    }
    /// Behind the bracket that closes the one that comes next.
    void skip_brackets() {
        int depth = 0;
        while (!at_end()) {
            const std::string_view text = tokens_[at_++].text;
            if (text == "(" || text == "[" || text == "{") ++depth;
            if (text == ")" || text == "]" || text == "}") --depth;
            if (depth <= 0) return;
        }
    }

    [[nodiscard]] const Constant* find(std::string_view name) const {
        for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
            if (const auto found = scope->find(name); found != scope->end()) return &found->second;
        return nullptr;
    }

    /// Functions that main() calls, and those that these call.
    [[nodiscard]] std::set<std::string_view> reached_functions() const {
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

    [[nodiscard]] ReportFault reporter() {
        return [this, line = line_](std::string_view message, const std::string& operation) {
            if (muted_ == 0)
                faults_.emplace_back(function_, ConstantFault{line, std::string(message), operation});
        };
    }

    // Statements.

    void statement() {
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

    void block() {
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

    /// What a constant condition excludes is no fault.
    void guarded_statement(bool is_dead) {
        muted_ += is_dead ? 1 : 0;
        statement();
        muted_ -= is_dead ? 1 : 0;
    }

    void conditional() {
        take("(");
        const std::optional<bool> holds = truth_of(expression());
        take(")");
        guarded_statement(holds == false);
        if (take("else")) guarded_statement(holds == true);
    }

    void loop() {
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

    void declaration() {
        bool is_constant = false;
        bool is_specialised = false;  // by the application: compilers do not know the value
        while (sees("const") || sees("layout") || is_qualifier(peek().text)) {
            is_constant = is_constant || sees("const");
            const bool has_brackets = sees("layout");
            const std::size_t first = ++at_;
            if (!has_brackets || !sees("(")) continue;
            skip_brackets();
            is_specialised =
                is_specialised || std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(first),
                                              tokens_.begin() + static_cast<std::ptrdiff_t>(at_),
                                              [](const Token& token) { return token.text == "constant_id"; });
        }
        is_constant = is_constant && !is_specialised;
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

    void structure() {
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

    /// `S(1.0, 2.0)`, where all of it is known.
    [[nodiscard]] Constant structure_of(std::string_view name, const std::vector<Constant>& given) const {
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

    [[nodiscard]] Constant member_of(const ConstantValue& value, std::string_view name) const {
        const std::vector<Member>& members = structures_.at(value.structure);
        const auto found = std::ranges::find(members, name, &Member::name);
        if (found == members.end()) return std::nullopt;
        return value.members[static_cast<std::size_t>(found - members.begin())];
    }

    /// How far ahead a declared name stands: behind a type and perhaps brackets; 0 where none is declared.
    [[nodiscard]] std::size_t place_of_declared_name() const {
        if (!peek().is_name()) return 0;
        std::size_t ahead = 1;
        while (sees("[", ahead)) {
            while (!peek(ahead).text.empty() && !sees("]", ahead)) ++ahead;
            ++ahead;
        }
        return peek(ahead).is_name() ? ahead : 0;
    }

    void function_header() {
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

    void declarators(bool is_constant, std::string_view type, bool is_array_type) {
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

    // Expressions.

    Constant expression() {
        Constant value = assignment();
        while (take(",")) value = assignment();
        return value;
    }

    Constant assignment() {
        Constant value = choice();
        if (!is_assignment(peek().text)) return value;
        ++at_;
        assignment();
        return std::nullopt;
    }

    Constant choice() {
        const Constant condition = binary(1);
        if (!take("?")) return condition;
        const std::optional<bool> holds = truth_of(condition);
        Constant first = muted_unless(holds != false, [&] { return expression(); });
        take(":");
        Constant second = muted_unless(holds != true, [&] { return assignment(); });
        if (!holds) return std::nullopt;
        return *holds ? first : second;
    }

    template <class Read>
    Constant muted_unless(bool is_live, const Read& read) {
        muted_ += is_live ? 0 : 1;
        Constant value = read();
        muted_ -= is_live ? 0 : 1;
        return value;
    }

    Constant binary(int least) {
        Constant left = unary();
        while (true) {
            const Token operation = peek();
            const int precedence = precedence_of(operation.text);
            if (precedence < least || precedence == 0) return left;
            ++at_;
            const std::optional<bool> known = truth_of(left);
            const bool is_decided =
                (operation.text == "&&" && known == false) || (operation.text == "||" && known == true);
            const Constant right = muted_unless(!is_decided, [&] { return binary(precedence + 1); });
            line_ = operation.line;
            if (!is_decided) left = folded_binary(operation.text, left, right, reporter());
        }
    }

    Constant unary() {
        for (const std::string_view operation : {"-", "+", "!", "~"})
            if (take(operation)) return folded_unary(operation, unary());
        if (take("++") || take("--")) {
            unary();
            return std::nullopt;
        }
        return postfix(primary());
    }

    Constant postfix(Constant value) {
        while (true) {
            if (take("++") || take("--")) {
                value = std::nullopt;
            } else if (take("[")) {
                const Constant index = expression();
                take("]");
                value = element_of(value, index);
            } else if (take(".")) {
                const std::string_view member = peek().text;
                ++at_;
                if (sees("(")) {  // .length()
                    skip_brackets();
                    value = std::nullopt;
                } else if (value && value->elements == ConstantValue::kStructure) {
                    value = member_of(*value, member);
                } else {
                    value = components_of(value, member);
                }
            } else {
                return value;
            }
        }
    }

    Constant primary() {
        const Token token = peek();
        if (token.text.empty() ||
            std::string_view(";)],}:").find(token.text.front()) != std::string_view::npos)
            return std::nullopt;
        ++at_;
        if (token.text == "(") {
            Constant value = expression();
            take(")");
            return value;
        }
        if (token.text == "{") {
            const std::vector<Constant> elements = arguments("}");
            return array_of(elements);
        }
        if (is_number(token.text)) return literal(token.text);
        if (token.text == "true" || token.text == "false")
            return ConstantValue{{Scalar::boolean, 1, 1}, 0, {token.text == "true" ? 1.0 : 0.0}};
        if (!token.is_name()) return std::nullopt;
        const std::optional<GlslType> type = glsl_type(token.text);
        if (type && sees("[")) {
            skip_brackets();
            return take("(") ? array_of(arguments(")")) : std::nullopt;
        }
        if (take("(")) return call(token, type);
        const Constant* const known = find(token.text);
        return known != nullptr ? *known : std::nullopt;
    }

    Constant call(const Token& name, const std::optional<GlslType>& type) {
        const std::vector<Constant> given = arguments(")");
        line_ = name.line;
        if (type) return constructed(*type, given, reporter());
        if (structures_.contains(name.text)) return structure_of(name.text, given);
        calls_[function_].insert(name.text);
        if (functions_.contains(name.text)) return std::nullopt;
        return folded_call(name.text, given, reporter());
    }

    /// Up to the bracket that closes.
    std::vector<Constant> arguments(std::string_view close) {
        std::vector<Constant> all;
        while (!at_end() && !sees(close)) {
            const std::size_t before = at_;
            all.push_back(assignment());
            if (!take(",") && !sees(close) && at_ == before) ++at_;
        }
        take(close);
        return all;
    }

    std::vector<Token> tokens_;
    std::size_t at_ = 0;
    int line_ = 0;  ///< of the operation at hand
    std::vector<Scope> scopes_ = std::vector<Scope>(1);
    Scope parameters_;           ///< of the function whose body comes next
    std::string_view function_;  ///< whose body is read; empty outside of all
    std::map<std::string_view, std::vector<Member>> structures_;
    std::set<std::string_view> functions_;
    std::map<std::string_view, std::set<std::string_view>> calls_;  ///< by the function that calls
    int muted_ = 0;  ///< above 0 where a constant condition keeps the operation from happening
    std::vector<std::pair<std::string_view, ConstantFault>> faults_;  ///< with the function they stand in
};

}  // namespace

std::vector<ConstantFault> faults_of_constants(std::string_view source) {
    return ConstantReader(source).read();
}

}  // namespace gobo::sanitize
