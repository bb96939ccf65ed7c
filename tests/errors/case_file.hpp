// A bad input with the answer that gobo must give, all in one file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gobo {

/// The parts of a case file, in its order:
///
///     what is wrong with the input, in a sentence
///     $ gobo check family.toml         (a shell command; `gobo` is the one that was built)
///     ---- family.toml                 (any number of input files)
///     its lines
///     ---- exit 1                      (the exit status, followed by the exact standard error)
///     the messages
struct CaseFile {
    std::string summary;
    std::string command;
    std::vector<std::pair<std::string, std::string>> files;  ///< path and text
    std::string answer;                                      ///< from "exit" on
};

[[nodiscard]] CaseFile read_case(std::string_view text);
[[nodiscard]] std::string case_text(const CaseFile& file);

}  // namespace gobo
