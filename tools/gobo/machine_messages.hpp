// Messages for other programs: a JSON object, or a log in SARIF, which code hosts and editors read.
#pragma once

#include <string>

#include "core/diagnostic.hpp"

namespace gobo {

/// How messages are written to standard error.
enum class MessageFormat { text, json, sarif };

/// {"diagnostics": [{"severity", "fault", "file", "line", "column", "message", "quoted_line", "help",
/// "key"}], "exit_status"}; what is unknown is left out. Lines and columns count from 1, columns in
/// characters.
[[nodiscard]] std::string json_of(const Diagnostics& diagnostics, int status);

/// A SARIF 2.1.0 log of one run (https://docs.oasis-open.org/sarif/sarif/v2.1.0/). `program` is the name of
/// what ran.
[[nodiscard]] std::string sarif_of(const Diagnostics& diagnostics, int status, const std::string& program);

}  // namespace gobo
