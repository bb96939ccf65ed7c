// Errors as values: what is wrong, where, and how to fix it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace gobo {

/// A place in a text. Lines and columns count from 1; 0 means unknown. Columns count bytes.
struct Place {
    std::string file = {};
    int line = 0;
    int column = 0;

    friend bool operator==(const Place&, const Place&) = default;
};

enum class Severity { error, warning, note };

/// Whose fault an error is. It decides the exit status of the command (see exit_status()).
enum class Fault {
    input,      ///< the input has errors, or a check failed: 1
    usage,      ///< unknown command, option, family, feature or value: 2
    file,       ///< a file could not be read or written: 3
    needs_lab,  ///< only gobo-lab can go on: gobo becomes it, and where it is not there the status is 3
    internal,   ///< a fault of gobo's own: 4
};

/// One message. `message` is a sentence in lower case without a full stop.
struct Diagnostic {
    Severity severity = Severity::error;
    Fault fault = Fault::input;
    Place place = {};
    std::string message = {};
    std::string quoted_line = {};  ///< the line of text at `place`, or empty
    std::string help = {};         ///< how to fix it, or empty
    std::string subject = {};      ///< the permutation it concerns, as key text, or empty
    std::size_t more_keys = 0;     ///< how many other permutations it concerns

    friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

using Diagnostics = std::vector<Diagnostic>;

/// A value, or the reasons why there is none.
template <class T>
using Result = tl::expected<T, Diagnostics>;

/// An error of the given fault, ready to be returned from a function whose type is Result<T>.
[[nodiscard]] tl::unexpected<Diagnostics> fail(Fault fault, std::string message, std::string help = {});
[[nodiscard]] tl::unexpected<Diagnostics> fail(Diagnostic diagnostic);
/// An error in the input at a place, whose line is quoted.
[[nodiscard]] tl::unexpected<Diagnostics> fail(const Place& place, std::string_view quoted_line,
                                               std::string message, std::string help = {});

#define GOBO_JOIN_(a, b) a##b
#define GOBO_JOIN(a, b) GOBO_JOIN_(a, b)
/// `GOBO_TRY(const auto keys, load_keys(family));` declares `keys` as the value of a Result, or returns its
/// errors from the function. GOBO_TRY_DO(check(x)); does the same for a Result whose value nobody wants.
#define GOBO_TRY(declaration, ...)                                                   \
    auto&& GOBO_JOIN(gobo_result_, __LINE__) = __VA_ARGS__;                          \
    if (!GOBO_JOIN(gobo_result_, __LINE__))                                          \
        return tl::unexpected(std::move(GOBO_JOIN(gobo_result_, __LINE__)).error()); \
    declaration = *std::move(GOBO_JOIN(gobo_result_, __LINE__))
#define GOBO_TRY_DO(...) \
    if (auto&& gobo_result = __VA_ARGS__; !gobo_result) return tl::unexpected(std::move(gobo_result).error())

/// "fog=linear, and 2 more keys": whom it concerns, on one line and not beyond measure.
[[nodiscard]] std::string subject_text(const Diagnostic& diagnostic);

/// The diagnostic as a compiler prints it, ending in a newline:
/// `file:line:column: error: message [subject]`, the quoted line with a caret, the help.
[[nodiscard]] std::string to_text(const Diagnostic& diagnostic, bool color = false);

/// All of them, one after the other.
[[nodiscard]] std::string to_text(const Diagnostics& diagnostics, bool color = false);

void append(Diagnostics& diagnostics, const Diagnostics& more);

/// 0 where there is no error, otherwise the status of the gravest fault: internal (4), file (3), usage (2),
/// input (1).
[[nodiscard]] int exit_status(const Diagnostics& diagnostics);

/// Line `number` (from 1) of `text`, without its end; empty where there is none.
[[nodiscard]] std::string_view line_of(std::string_view text, int number);

}  // namespace gobo
