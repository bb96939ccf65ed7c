// What commands work on: families, keys and shader files, from the options that name them.
#pragma once

#include <algorithm>
#include <map>
#include <thread>

#include "budget/budget.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "emit/emit.hpp"
#include "family/selection.hpp"
#include "gobo/command.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// Options of every command.
struct CommonOptions {
    std::vector<std::string> include_folders;  ///< -I
    int jobs = 0;                              ///< threads; 0: as many as the computer has
    std::string library;  ///< a folder to read shader_lib and templates from instead of the embedded ones
    std::string color = "auto";
    std::string diagnostics = "text";
    bool quiet = false;
    bool follow = false;      ///< links out of the folders that are searched for pieces
    bool in_process = false;  ///< glslang runs in this process, not in children
    std::string cache;        ///< a folder; empty: as the environment says
    int cache_megabytes = 1024;
    std::string stopped;  ///< a folder for the texts of stages that stop glslang; empty: they are not kept
};
[[nodiscard]] OptionGroup common_options(CommonOptions& options);

struct LoadedFamily;

/// What gobo-lab finds out of qualities; both null where it is not there.
struct MeasureQualities {
    /// Error and cost on the study's scenes, of a combination of effects that the study does not hold.
    std::function<Result<std::vector<StudiedKey>>(const World&, const LoadedFamily&, const StudiedEffects&,
                                                  const Key& effects)>
        on_scenes;
    /// StudiedKey::worst of each key, over the family's domain. One that errs by more than `enough` is
    /// searched until that is seen.
    std::function<Result<std::vector<double>>(const World&, const LoadedFamily&, const std::vector<Key>&,
                                              double enough)>
        over_domain;
};

/// The world that a command runs in.
struct World {
    FileSystem& disk;
    FileSystem& shipped;  ///< paths as in the source tree: "shader_lib/fog/linear.glsl"
    const CommonOptions& options;
    MeasureQualities measure;
    ResultCache* cache = nullptr;  ///< where results are kept from one run to the next; null: nowhere
    /// Writes what is told and the summary at once, for a command that goes on.
    std::function<void(const Outcome&)> tell = nullptr;
    GivenOptions given = {};  ///< of the command line
    /// Fault::usage where one of the paths is of a file that was read; null: none was.
    std::function<Result<void>(const std::vector<std::string>&)> spare = nullptr;

    /// An error where one of the files that a command is to write was read: asked before the first is
    /// written.
    [[nodiscard]] Result<void> refuse_inputs(const std::vector<std::string>& outputs) const {
        return spare ? spare(outputs) : Result<void>();
    }
    [[nodiscard]] int jobs() const {
        return options.jobs > 0 ? options.jobs
                                : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    }
    /// The files that hold shader_lib and templates, and a path in them.
    [[nodiscard]] FileSystem& library() const { return options.library.empty() ? shipped : disk; }
    [[nodiscard]] std::string in_library(const std::string& path) const {
        return options.library.empty() ? path : options.library + "/" + path;
    }
};

/// A family with where its pieces are found, the files read so far and the dialect to compose for.
struct LoadedFamily {
    std::string name;  ///< as the command line has it
    std::string text;  ///< of the family file, for messages
    Family family;
    SearchPath search;
    std::vector<std::string> files;             ///< on disk, for the depfile
    std::vector<std::string> scene_notes = {};  ///< notes_on_scene() of the scenes that chose keys
    std::vector<Domain> narrowed = {};          ///< of its domains, those that --domain narrowed
    /// By constant_id the constants of counts with `specialize = true`, which may be numbers at the moment.
    std::map<int, std::string> count_constants = {};
    Dialect dialect = Dialect::own;
    Comments comments = Comments::remove;
    /// run_of_shards(); empty without --shard.
    std::string run = {};
};

[[nodiscard]] Option family_argument(std::string& name);
[[nodiscard]] Option dialect_option(std::string& name);
[[nodiscard]] Option comments_option(bool& comments);

[[nodiscard]] std::vector<std::string> shipped_families(const World& world);
/// A shipped family's name, a .toml file, or `-` for standard input. An empty dialect is Dialect::own.
[[nodiscard]] Result<LoadedFamily> load_family(const World& world, const std::string& name,
                                               const std::string& dialect = {});

/// How a family and its keys are chosen on the command line.
struct SelectionOptions {
    std::string family = {};
    std::string dialect = {};
    std::vector<std::string> keys = {};
    std::vector<std::string> key_files = {};
    bool may_hold_none = false;  ///< files without keys are no error, but an empty selection
    std::vector<std::string> scenes = {};
    std::string bucket_lights = {};
    std::string shard = {};
    Selection more = {};  ///< what needs no reading
};
[[nodiscard]] OptionGroup selection_options(SelectionOptions& options);
/// The first option that chooses keys and was given, "--key"; empty where there is none.
[[nodiscard]] std::string_view first_given(const SelectionOptions& options);

/// What the options select. Key files, scenes and their buffers that were read are added to `family.files`.
[[nodiscard]] Result<Selection> load_selection(const World& world, LoadedFamily& family,
                                               const SelectionOptions& options);
/// The selected keys; of a shard its own.
[[nodiscard]] Result<std::vector<Key>> load_keys(const World& world, LoadedFamily& family,
                                                 const SelectionOptions& options);

/// What a budget chooses qualities by.
struct BudgetOptions : Budget {
    std::string study;                   ///< a study.csv or summary.csv; empty: the shipped one of the family
    std::string domain;                  ///< a file of narrower domains
    std::vector<std::string> gpus = {};  ///< chips whose cycles are the cost
};
[[nodiscard]] OptionGroup budget_options(BudgetOptions& options);
/// An error where options say how a budget chooses and there is none.
[[nodiscard]] Result<void> refuse_without_budget(const BudgetOptions& options);

/// Whether a path names a scene: .gltf or .glb.
[[nodiscard]] bool is_scene_file(std::string_view path);
/// What a scene holds of the family's domains (see scene::domains_of_scene()). Its files are added to
/// `family.files`.
[[nodiscard]] Result<std::vector<Domain>> domains_of_scene(const World& world, LoadedFamily& family,
                                                           const std::string& path);
/// An error for each domain that a scene leaves, where errors are promised over them.
[[nodiscard]] Result<void> refuse_scenes_outside(const World& world, LoadedFamily& family,
                                                 const std::vector<std::string>& scenes,
                                                 const BudgetOptions& options);
/// Narrows the family's domains by --domain, where it is given: a TOML file or a scene.
[[nodiscard]] Result<void> narrow_domains(const World& world, LoadedFamily& family, const std::string& file);

/// For each key the one that the budget chooses for its effects, in the same order, with what it was chosen
/// by. Effects that the study has not measured are measured now, on the study's scenes, at the qualities that
/// lie on a front of the study; what errors are promised over the domain is searched for now, too, where the
/// study does not say it or the domain is narrower. Keys that the dialect forbids are not chosen. Errors: no
/// quality within the budget, for each combination; effects that cannot be measured here (Fault::needs_lab);
/// a study that cannot be read (its file is added to `family.files`).
[[nodiscard]] Result<std::vector<QualityChoice>> choose_qualities(const World& world, LoadedFamily& family,
                                                                  const BudgetOptions& options,
                                                                  const std::vector<Key>& keys);

[[nodiscard]] Result<Composition> compose_keys(const LoadedFamily& family, const std::vector<Key>& keys);
/// The selected keys, composed.
[[nodiscard]] Result<Composition> compose_selection(const World& world, LoadedFamily& family,
                                                    const SelectionOptions& options);

/// A warning where the selection holds no keys, of which silence would be taken for success: "nothing was
/// checked". Else nothing.
[[nodiscard]] Diagnostics warn_of_no_keys(const Composition& composition, std::string_view consequence);

/// Validates on all cores, in child processes unless CommonOptions::in_process. What has errors is no value;
/// each error names a key with no more features than it takes. Keys whose counts cannot be specialisation
/// constants are composed anew.
[[nodiscard]] Result<Validated> compile(const World& world, const LoadedFamily& family,
                                        Composition& composition, ValidateOptions options = {});

/// What FAMILY and keys name, or loose shader files.
struct Subject {
    LoadedFamily family;
    Composition composition;
    bool are_files = false;  ///< there is no key to speak of
};
/// What counts with `specialize = true` become where the dialect is SPIR-V.
enum class Counts {
    specialized,  ///< constants of the pipeline, which nobody has set yet
    literal,      ///< the numbers of the key, as evaluation needs them
};
/// Counts::literal for one family.
void make_counts_literal(Family& family);
/// `names` are files, told by their ends; or FAMILY [KEY], or FAMILY alone where there is a selection.
/// `stages` are the values of -S.
[[nodiscard]] Result<Subject> load_subject(const World& world, const std::vector<std::string>& names,
                                           const std::vector<std::string>& stages, const std::string& dialect,
                                           const SelectionOptions* selection = nullptr,
                                           Counts counts = Counts::specialized);
[[nodiscard]] Result<Validated> compile(const World& world, Subject& subject,
                                        const ValidateOptions& options = {});
[[nodiscard]] Option subject_argument(std::vector<std::string>& names);
/// Of commands that have a selection.
[[nodiscard]] Option family_or_files_argument(std::vector<std::string>& names);
/// -S of commands that take shader files.
[[nodiscard]] Option stages_option(std::vector<std::string>& stages);
/// "vertex|tess_control|...|vert|tesc|...", the choices of an option.
[[nodiscard]] std::string stage_words();

/// A file, or standard input where the path is `-`.
[[nodiscard]] Result<std::string> read_input(const World& world, const std::string& path);

struct InputFile {
    std::string path;
    std::string text;
};
/// A file that the user names; the shipped one where the path is empty.
[[nodiscard]] Result<InputFile> read_or_shipped(const World& world, const std::string& path,
                                                const std::string& shipped);

/// "studio" of "maps/studio.exr".
[[nodiscard]] std::string stem_of(const std::string& path);

}  // namespace gobo
