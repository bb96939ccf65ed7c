// A reader of a stage's text that computes what is constant in it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sanitize/constant_faults.hpp"
#include "lab/sanitize/constant_tokens.hpp"

namespace gobo::sanitize {

/// Reads statements in order, and knows the constants in scope. Whatever it does not understand is skipped:
/// the text is one that glslang has accepted.
class ConstantReader {
  public:
    explicit ConstantReader(std::string_view source) : tokens_(lines_as_tokens(source)) {}

    /// Everything at fault in what main() reaches, by line.
    [[nodiscard]] std::vector<ConstantFault> read();

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
    [[nodiscard]] std::set<std::string_view> reached_functions() const;

    [[nodiscard]] ReportFault reporter() {
        return [this, line = line_](std::string_view message, const std::string& operation) {
            if (muted_ == 0)
                faults_.emplace_back(function_, ConstantFault{line, std::string(message), operation});
        };
    }

    // Statements.
    void statement();
    void block();
    /// What a constant condition excludes is no fault.
    void guarded_statement(bool is_dead);
    void conditional();
    void loop();
    void declaration();
    void structure();
    /// `S(1.0, 2.0)`, where all of it is known.
    [[nodiscard]] Constant structure_of(std::string_view name, const std::vector<Constant>& given) const;
    [[nodiscard]] Constant member_of(const ConstantValue& value, std::string_view name) const;
    /// How far ahead a declared name stands: behind a type and perhaps brackets; 0 where none is declared.
    [[nodiscard]] std::size_t place_of_declared_name() const;
    void function_header();
    void declarators(bool is_constant, std::string_view type, bool is_array_type);

    // Expressions (constant_expressions.cpp).
    Constant expression();
    Constant assignment();
    Constant choice();
    template <class Read>
    Constant muted_unless(bool is_live, const Read& read);
    Constant binary(int least);
    Constant unary();
    Constant postfix(Constant value);
    Constant primary();
    Constant call(const Token& name, const std::optional<GlslType>& type);
    /// Up to the bracket that closes.
    std::vector<Constant> arguments(std::string_view close);

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

}  // namespace gobo::sanitize
