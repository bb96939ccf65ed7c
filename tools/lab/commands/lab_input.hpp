// The commands of gobo-lab, what they read beside what gobo's do, and where they keep what failed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "gobo/commands.hpp"
#include "lab/render/image.hpp"
#include "lab/study/study.hpp"
#include "lab/verify/shadow_map_check.hpp"

namespace gobo {

namespace cost {
struct Chip;
struct ChipCost;
}  // namespace cost

/// A mesh of that name, or of an .obj file.
[[nodiscard]] Result<Mesh> load_mesh(const World& world, const std::string& name);

/// Pixels along a side: what OpenGL's renderers in software draw.
inline constexpr int kLargestSide = 16384;
/// "640x480".
[[nodiscard]] Result<std::pair<int, int>> read_size(const std::string& text);

/// Cube maps by the name of their sampler, level by level.
using CubeImages = std::map<std::string, std::vector<Image>>;
/// The environment that pictures are lit by: diffuseMap and specularMap as gobo probe wrote them into the
/// folder `path`, or made from it where it is a panorama: specularMap level by level of roughness where an
/// interface mirrors it so, else for a shininess of 48. None where no interface looks any up.
[[nodiscard]] Result<CubeImages> load_environment(const World& world, const std::string& path,
                                                  const std::vector<Interface>& interfaces);
/// What is not to be seen of that environment: a folder holds one lobe, whatever a surface's roughness.
[[nodiscard]] Diagnostics warnings_of_environment(const std::string& path,
                                                  const std::vector<Interface>& interfaces);
[[nodiscard]] std::vector<Interface> interfaces_of(const Composition& composition,
                                                   const Validated& validated);

/// The default key of the family `depth`, which draws shadow maps, for the composition's dialect where that
/// is vulkan; nothing where no key has shadows.
[[nodiscard]] Result<std::optional<verify::ShadowPass>> load_shadow_pass(const World& world,
                                                                         const Family& family,
                                                                         const Composition& composition);

/// The renderers that --backend names.
inline constexpr const char* kBackends = "osmesa|egl|vulkan";
inline constexpr std::string_view kVulkanBackend = "vulkan";
/// The dialect that a backend draws: `dialect`, and vulkan where the backend is. Fault::usage where the two
/// do not go together, or there is no such backend.
[[nodiscard]] Result<std::string> dialect_for(const std::string& backend, const std::string& dialect);

/// An error where a key has a stage that the lab does not evaluate, or where `wants_pair` not both of those
/// that it does. `what` the lab does: "gobo test evaluates".
[[nodiscard]] Result<void> refuse_other_stages(const Family& family, const Composition& composition,
                                               const std::string& what, bool wants_pair = false);

/// The first weights of a file; of the shipped data/study/weights.csv where the path is empty.
[[nodiscard]] Result<study::Weights> load_weights(const World& world, const std::string& path = {});
/// The plan of a file; where the path is empty that which came with the family, data/study/NAME.toml, or
/// default_plan().
[[nodiscard]] Result<study::StudyPlan> load_plan(const World& world, const Family& family,
                                                 const std::string& path = {});
/// One line that is written over, on a terminal only.
[[nodiscard]] study::Progress progress_on_terminal(const World& world);

/// Measures a combination of effects that a study does not hold: on the scenes of the family's plan, with the
/// shipped weights, at the qualities that lie on a front of the study; without a study at every single
/// choice.
[[nodiscard]] Result<std::vector<StudiedKey>> measure_qualities(const World& world,
                                                                const LoadedFamily& family,
                                                                const StudiedEffects& studied,
                                                                const Key& effects);

/// StudiedKey::worst of each key, over the family's domain, by a search of kPromisePoints points of each. One
/// that errs by more than `enough` is searched until that is seen.
[[nodiscard]] Result<std::vector<double>> worst_errors(const World& world, const LoadedFamily& family,
                                                       const std::vector<Key>& keys, double enough);
inline constexpr std::size_t kPromisePoints = 65536;

/// What the keys of a study.csv at `path` cost on chips, by the drivers that `driver` names (see
/// cost::find_driver()). What cannot be told is added to `diagnostics`.
[[nodiscard]] std::vector<cost::ChipCost> costs_of_study(const World& world, const LoadedFamily& family,
                                                         const CsvTable& study, const std::string& path,
                                                         const std::vector<cost::Chip>& chips,
                                                         const std::string& driver, Diagnostics& diagnostics);

/// A note about a file, or where the name is empty about none.
[[nodiscard]] Diagnostic note_in(const std::string& file, std::string message);
/// Keeps what shows a failure. Where it cannot be written that is a warning: the failure decides the status.
[[nodiscard]] Diagnostics keep_file(const World& world, const std::string& path, std::string_view content);
/// The errors about a permutation that a driver died of, with its stages kept as FOLDER/KEY.vert and so on:
/// their SPIR-V where that is shipped, else their texts. Nothing is kept where the folder is empty.
[[nodiscard]] Diagnostics with_kept_stages(const World& world, const std::string& folder,
                                           const Family& family, const Composition& composition,
                                           const Validated& validated, const Permutation& permutation,
                                           Diagnostics errors);
/// The text as a word of a shell's command: in quotes where it holds more than letters, digits and what file
/// names usually hold.
[[nodiscard]] std::string shell_word(std::string_view text);
/// What shader files say of their inputs: `// assume: near < far`. An error for each comment that is of
/// no form that is read.
[[nodiscard]] Result<std::vector<Domain>> constraints_in_comments(const Composition& composition);
/// The SPIR-V of what is evaluated over domains, whose own are joined by those of the file `inputs` (none
/// where that is empty), which come first, and by what comments in shader files say. Errors are also domains
/// of what no stage has.
[[nodiscard]] Result<Validated> compile_over_domains(const World& world, Subject& subject,
                                                     const std::string& inputs);
/// The errors as warnings.
[[nodiscard]] Diagnostics as_warnings(Diagnostics errors);
/// The line of the piece that a place names; empty where there is none.
[[nodiscard]] std::string quoted_line(const Composition& composition, const Place& place);

/// The errors with what to do about them.
[[nodiscard]] tl::unexpected<Diagnostics> with_help(Diagnostics errors, const std::string& help);

/// -o of commands that keep what failed, and without it write nothing.
[[nodiscard]] Option keep_option(std::string& folder, const std::string& what);

/// --driver of commands that ask the drivers of GPUs.
[[nodiscard]] Option driver_option(std::string& driver);

[[nodiscard]] Command eval_command();
[[nodiscard]] Command test_command();
[[nodiscard]] Command sanitize_command();
[[nodiscard]] Command prove_command();
[[nodiscard]] Command probe_command();
[[nodiscard]] Command render_command();
[[nodiscard]] Command link_command();
[[nodiscard]] Command cost_command();
/// Hidden: what a process of gobo cost runs for one chip (see cost::DriverProcess).
[[nodiscard]] Command compile_pipelines_command();
[[nodiscard]] Command study_command();

}  // namespace gobo
