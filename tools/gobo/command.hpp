// What the subcommands share: their options, where input comes from and where output goes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "budget/budget.hpp"
#include "compose/composition.hpp"
#include "compose/search_path.hpp"
#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "family/family.hpp"
#include "family/selection.hpp"

namespace gobo {

struct World;
struct LoadedFamily;

/// Measures error and cost of a combination of effects that the study does not hold, on `jobs` threads.
/// Fault::needs_lab where this program cannot.
using MeasureQualities = std::function<Result<std::vector<StudiedKey>>(
    const World&, const LoadedFamily&, const StudiedEffects&, const Key& effects, int jobs)>;

/// The world that a command runs in.
struct World {
    FileSystem& disk;
    FileSystem& shipped;  ///< paths as in the source tree: "shader_lib/fog/linear.glsl"
    MeasureQualities measure;
};

/// What a command leaves: its data for standard output, and messages for standard error.
struct Outcome {
    std::string output;
    Diagnostics diagnostics;
    std::string summary;  ///< a closing line for standard error, unless --quiet
};

/// A command, once the command line has been read.
using Run = std::function<Outcome(const World&)>;

/// Adds a subcommand to the application. The function it returns runs it, if it was the one chosen.
struct Command {
    CLI::App* app;
    Run run;
};

/// Options of every command.
struct CommonOptions {
    std::vector<std::string> include_folders;  ///< -I
    int jobs = 1;
    std::string library;  ///< a folder to read shader_lib and templates from instead of the embedded ones
    std::string color = "auto";
    bool quiet = false;
};

/// How keys are selected on the command line.
struct SelectionOptions {
    std::vector<std::string> keys;
    std::vector<std::string> key_files;
    std::vector<std::string> scenes;
    std::string bucket_lights;
    bool all = false;
    int cover = 0;
    std::vector<std::string> over;
    std::string where;
    bool retired = false;
};

void add_common_options(CLI::App& app, CommonOptions& options);
void add_selection_options(CLI::App& app, SelectionOptions& options);
void add_dialect_option(CLI::App& app, std::string& dialect);
void add_comments_option(CLI::App& app, bool& comments);
void add_comments_option(CLI::App& app, bool& comments);

/// A family with where its pieces are found and the files read so far.
struct LoadedFamily {
    Family family;
    SearchPath search;
    std::vector<std::string> files;  ///< on disk, for the depfile
};

/// A shipped family's name, a .toml file, or `-` for standard input.
[[nodiscard]] Result<LoadedFamily> load_family(const World& world, const std::string& name,
                                               const CommonOptions& options);

/// The selected keys. Key files, scenes and their buffers that were read are added to `family.files`.
[[nodiscard]] Result<std::vector<Key>> load_keys(const World& world, LoadedFamily& family,
                                                 const SelectionOptions& options, Dialect dialect);

/// load_keys() and compose() in one.
[[nodiscard]] Result<Composition> load_composition(const World& world, LoadedFamily& family,
                                                   const SelectionOptions& options, Dialect dialect,
                                                   Comments comments = Comments::remove);

/// A file, or standard input where the path is `-`.
[[nodiscard]] Result<std::string> read_input(const World& world, const std::string& path);

/// Empty is Dialect::own.
[[nodiscard]] Result<Dialect> read_dialect(const std::string& name);

[[nodiscard]] Selection to_selection(const SelectionOptions& options);

/// An outcome of nothing but errors.
[[nodiscard]] Outcome failed(Diagnostics diagnostics);

}  // namespace gobo
