// What gobo build and gobo watch do.
#pragma once

#include <string>
#include <vector>

#include "gobo/command.hpp"
#include "gobo/input.hpp"

namespace gobo {

struct BuildOptions : SelectionOptions {
    BudgetOptions budget;
    std::string folder;
    std::string header;
    std::string cpp_namespace;
    std::string depfile;
    std::string depfile_target;
    bool glslc_depfile = false;
    bool comments = false;
    bool split = false;  ///< the tables in a source file beside the header
    bool optimize = false;
    bool debug = false;  ///< names and lines in SPIR-V
};

/// What -o says to have the header printed.
inline constexpr const char* kStandardOutput = "-";

[[nodiscard]] std::vector<Option> build_arguments(BuildOptions& options);
[[nodiscard]] std::vector<OptionGroup> build_groups(BuildOptions& options);

struct Built {
    Outcome outcome;
    Family family;
    Composition composition;
};
[[nodiscard]] Result<Built> build(const BuildOptions& options, const World& world);

}  // namespace gobo
