// What gobo sanitize and gobo prove have in common: what is looked at, and how a finding is told.
#pragma once

#include "lab/commands/lab_input.hpp"
#include "lab/sanitize/sanitize.hpp"

namespace gobo {

struct FindingOptions : SelectionOptions {
    std::vector<std::string> names;  ///< FAMILY, or files
    std::vector<std::string> stages;
    std::string dialect;
    std::string folder;  ///< for inputs of what is found; empty: they are not kept
    std::string inputs;  ///< a file of domains
};

/// What is evaluated over its domains.
struct Examined {
    Subject subject;
    Validated validated;
};
/// `what` the command does, for the error where a key has other stages: "gobo prove evaluates".
[[nodiscard]] Result<Examined> load_examined(const World& world, const FindingOptions& options,
                                             const std::string& what);

/// Where shader files without subroutine uniforms are all there is, no message names a key.
void leave_out_keys(const Subject& subject, Diagnostics& diagnostics);

/// A finding as an error with how to follow it, its example as an input file where -o says. `permutations`
/// are those that have it, `message` is what it says.
[[nodiscard]] Diagnostics report_finding(const World& world, const FindingOptions& options,
                                         const Subject& subject, const sanitize::Finding& finding,
                                         const std::vector<std::size_t>& permutations, std::string message,
                                         std::size_t number);

/// --inputs.
[[nodiscard]] Option domains_option(FindingOptions& options);

}  // namespace gobo
