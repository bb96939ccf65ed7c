#include "gobo/input.hpp"

#include <filesystem>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "compose/specialized_counts.hpp"
#include "core/text.hpp"
#include "family/cover.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "gobo/known_names.hpp"
#include "gobo/literal_counts.hpp"
#include "gobo/name_lists.hpp"
#include "gobo/shader_files.hpp"
#include "gobo/shard_run.hpp"
#include "scene/read_scene.hpp"
#include "scene/scene_domains.hpp"
#include "scene/scene_keys.hpp"

namespace gobo {
namespace {

/// Has the lab find what this program has read of standard input.
void keep_standard_input(const std::string& text) {
    const int file = memfd_create("standard input", 0);
    if (file < 0) return;
    const bool is_written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (is_written && lseek(file, 0, SEEK_SET) == 0) dup2(file, STDIN_FILENO);
    close(file);
}

/// Whether it is embedded in the program: named, not by its .toml file.
bool is_embedded(const World& world, const std::string& family) {
    return family != "-" && !family.ends_with(".toml") && world.options.library.empty();
}

bool is_shipped_family(const World& world, const std::string& name) {
    return world.library().is_file(world.in_library(fmt::format("templates/{}.toml", name)));
}

Result<FamilyText> find_family(const World& world, const std::string& name) {
    if (name == "-" || name.ends_with(".toml")) {
        GOBO_TRY(std::string text, read_input(world, name));
        return FamilyText{std::move(text), name == "-" ? "stdin" : name};
    }
    const std::string path = world.in_library(fmt::format("templates/{}.toml", name));
    if (!is_shipped_family(world, name))
        return fail(
            Fault::usage, fmt::format("there is no shipped family '{}'", name),
            suggestion(name, shipped_families(world)) + " (a family of your own is named by its .toml file)");
    GOBO_TRY(std::string text, world.library().read(path));
    return FamilyText{std::move(text), path};
}

Result<Dialect> read_dialect(const std::string& name) {
    if (name.empty()) return Dialect::own;
    if (const auto dialect = dialect_of(name)) return *dialect;
    return fail(Fault::usage, fmt::format("unknown dialect '{}'", name),
                suggestion(name, split(dialect_words(), '|')));
}

void add_include_folders(const World& world, SearchPath& search) {
    for (std::string folder : world.options.include_folders) {
        while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
        search.add(world.disk, folder, "", true);
    }
}

/// A scene for the family, whose files are added to `family.files`.
Result<scene::Scene> load_scene(const World& world, LoadedFamily& family, const std::string& path) {
    GOBO_TRY(scene::Scene scene, scene::read_scene(world.disk, path, scene::reading_for(family.family)));
    family.files.insert(family.files.end(), scene.files.begin(), scene.files.end());
    return scene;
}

/// The keys that the draws of a scene need, seen from any of its cameras, as `gobo scene --keys` lists them.
Result<std::vector<NamedKey>> keys_of_scene(const World& world, LoadedFamily& family, const std::string& path,
                                            const std::string& bucket_lights) {
    GOBO_TRY(const scene::Buckets buckets, scene::parse_buckets(bucket_lights));
    GOBO_TRY(const scene::Scene scene, load_scene(world, family, path));
    const scene::SceneDraws draws(scene, scene::eye_of_cameras(scene), {});
    GOBO_TRY(const auto needed,
             scene::keys_for_scene(family.family, draws, buckets, name_of(family.dialect)));
    std::ranges::copy(needed.notes, std::back_inserter(family.scene_notes));
    std::vector<NamedKey> named;
    for (const Key& key : scene::distinct_keys(needed.keys))
        named.push_back({key_text(family.family, key), {path}});
    // An empty selection would mean the family's default set.
    if (named.empty()) return fail(Place{path}, {}, "needs no permutation: it draws no triangles");
    return named;
}

Result<std::vector<NamedKey>> keys_of_file(const World& world, const std::string& path, bool may_hold_none) {
    GOBO_TRY(const std::string text, read_input(world, path));
    std::vector<NamedKey> keys = keys_of_text(text, path == "-" ? "stdin" : path);
    if (keys.empty() && !may_hold_none)
        return fail(Place{path}, {}, "holds no keys",
                    "write one key a line; 'default' is the key with every feature at its default");
    return keys;
}

/// Files have no key for a message to name.
template <class T>
Result<T> without_subjects(Result<T> result) {
    if (!result)
        for (Diagnostic& error : result.error()) error.subject.clear();
    return result;
}

/// The I-th of every N keys, for "I/N". The parts of all I together hold each key once.
Result<std::vector<Key>> shard_of(std::vector<Key> keys, const std::string& text) {
    if (text.empty()) return keys;
    const auto [number, count] = pair_from(text, '/').value_or(std::pair<std::size_t, std::size_t>());
    if (number < 1 || number > count)
        return fail(Fault::usage, fmt::format("'{}' is not a valid shard", text),
                    "write its number and how many there are, such as 2/4");
    std::vector<Key> part;
    for (std::size_t i = number - 1; i < keys.size(); i += count) part.push_back(keys[i]);
    return part;
}

/// How many keys are validated to make those of error messages simpler.
constexpr int kMostTrials = 100;

/// Puts features at their defaults in the key that an error names where the error stays the same, many at a
/// time at first.
class KeySimplifier {
  public:
    KeySimplifier(const LoadedFamily& family, ValidateOptions options)
        : family_(family), options_(std::move(options)) {
        options_.jobs = 1;
    }

    void simplify(Diagnostic& error) {
        const Result<Key> named = parse_key(family_.family, error.subject);
        // What takes glslang too much time or memory takes it again.
        if (!named || is_of_stopped_glslang(error)) return;
        Key key = *named;
        std::vector<std::size_t> set;
        for (std::size_t feature = 0; feature < key.size(); ++feature)
            if (key[feature] != 0) set.push_back(feature);
        for (std::size_t count = (set.size() + 1) / 2; count > 0 && set.size() > 1; count = count / 2)
            for (std::size_t first = 0; first < set.size();) {
                const std::size_t last = std::min(first + count, set.size());
                if (const std::optional<Key> simpler =
                        without(key, {set.begin() + first, set.begin() + last}, error)) {
                    key = *simpler;
                    set.erase(set.begin() + first, set.begin() + last);
                } else {
                    first = last;
                }
            }
        error.subject = key_text(family_.family, key);
    }

  private:
    std::optional<Key> without(Key key, const std::vector<std::size_t>& features, const Diagnostic& error) {
        for (const std::size_t feature : features) key[feature] = 0;
        const std::string_view dialect = name_of(family_.dialect);
        key = canonical(family_.family, std::move(key), dialect);
        if (forbidding_rule(family_.family, key, dialect) != nullptr || ++trials_ > kMostTrials)
            return std::nullopt;
        const Result<Composition> composition = compose_keys(family_, {key});
        if (!composition) return std::nullopt;
        const Diagnostics found = validate(family_.family, *composition, options_).diagnostics;
        const bool is_same = std::ranges::any_of(found, [&](const Diagnostic& other) {
            return other.place == error.place && other.message == error.message;
        });
        return is_same ? std::optional(std::move(key)) : std::nullopt;
    }

    const LoadedFamily& family_;
    ValidateOptions options_;
    int trials_ = 0;
};

void simplify_subjects(Diagnostics& diagnostics, const LoadedFamily& family, const ValidateOptions& options) {
    KeySimplifier simplifier(family, options);
    for (Diagnostic& diagnostic : diagnostics)
        if (diagnostic.severity == Severity::error) simplifier.simplify(diagnostic);
}

/// A template that is missing is told where the family file names it.
void put_at_mention(Diagnostic& error, const LoadedFamily& family) {
    const std::vector<std::string> parts = split(error.message, '\'');
    if (!error.message.starts_with("no template '") || parts.size() < 2) return;
    const std::string wanted = fmt::format("\"{}\"", parts[1]);
    std::istringstream lines(family.text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const auto at = line.find(wanted);
        if (at == std::string::npos) continue;
        error.place = {family.family.path, number, static_cast<int>(at) + 1};
        error.quoted_line = line;
        return;
    }
}

}  // namespace

OptionGroup common_options(CommonOptions& options) {
    return {
        "Common options",
        {{"-I", "FOLDER", "A folder searched for pieces before the family's own", &options.include_folders},
         {"-j,--jobs", "N", "Threads; by default as many as the computer has", &options.jobs,
          between(1, 1024)},
         {"--follow", "", "Take pieces that links lead to out of the folders searched", &options.follow},
         {"--library", "FOLDER", "A folder that holds shader_lib and templates, instead of those built in",
          &options.library},
         {"--color", "auto|always|never", "Colour in messages; auto is on a terminal only", &options.color,
          kOneOf},
         {"--diagnostics", "text|json|sarif",
          "How messages are written to standard error: for readers, or as one JSON or SARIF document",
          &options.diagnostics, kOneOf},
         {"-q,--quiet", "", "Print no summary", &options.quiet},
         {"--in-process", "",
          "Run glslang in gobo's own process, not in child processes: what crashes glslang ends gobo",
          &options.in_process},
         {"--cache", "DIR",
          "A folder where results are kept for later runs, or redis://HOST:PORT; by default what "
          "GOBO_CACHE_DIR names, or none",
          &options.cache},
         {"--cache-size", "MB", "How much the cache may hold; what was used longest ago goes first",
          &options.cache_megabytes, between(1, 1'000'000)},
         {"--keep-stopped", "DIR", "Where to keep the texts of stages that crash glslang or take it too long",
          &options.stopped}}};
}

Option family_argument(std::string& name) {
    return {"FAMILY", "", "A shipped family, such as lit, or a .toml file", &name,
            name.empty() ? kRequired : OptionRule()};
}

Option subject_argument(std::vector<std::string>& names) {
    return {"NAMES", "FAMILY KEY|FILES...",
            "A family and a key, or shader files (.vert, .frag, .geom, .comp, .vert.glsl, ...)", &names,
            kRequired};
}

Option family_or_files_argument(std::vector<std::string>& names) {
    return {"NAMES", "FAMILY|FILES...",
            "A family, or shader files (.vert, .frag, .geom, .comp, .vert.glsl, ...)", &names, kRequired};
}

std::string stage_words() {
    std::vector<std::string> words;
    for (const StageNames& stage : kStages) words.emplace_back(stage.name);
    for (const StageNames& stage : kStages) words.emplace_back(stage.infix);
    return join(words, "|");
}

Option stages_option(std::vector<std::string>& stages) {
    return {
        "-S", "STAGE",
        "The stage of a shader file whose name does not tell it (vert, tesc, tese, geom, frag or comp); for "
        "several files once each, in order",
        &stages};
}

Option comments_option(bool& comments) {
    return {"--comments", "", "Keep the comments of the shaders; without it, blanks replace them", &comments};
}

Option dialect_option(std::string& name) {
    return {"--dialect", dialect_words(),
            "GLSL dialect; by default the #version that the family's templates state, or 450; vulkan and "
            "gl_spirv make SPIR-V",
            &name};
}

std::vector<std::string> shipped_families(const World& world) {
    std::vector<std::string> names;
    for (const std::string& file : world.library().files_below(world.in_library("templates")))
        if (file.ends_with(".toml") && file.find('/') == std::string::npos) names.push_back(stem_of(file));
    return names;
}

Result<LoadedFamily> load_family(const World& world, const std::string& name, const std::string& dialect) {
    LoadedFamily loaded;
    loaded.name = name;
    GOBO_TRY(loaded.dialect, read_dialect(dialect));
    GOBO_TRY(const FamilyText source, find_family(world, name));
    loaded.text = source.text;
    const std::string folder = folder_of(source.path);
    std::string base_folder = folder;
    const FindFamily find_base = [&](const std::string& base_name) -> Result<FamilyText> {
        if (base_name == "-") return fail(Fault::usage, "'-' is no family's name");
        const bool is_file = base_name.ends_with(".toml");
        const bool is_beside = is_file && !base_name.starts_with('/') && !folder.empty();
        GOBO_TRY(FamilyText base, find_family(world, is_beside ? folder + "/" + base_name : base_name));
        if (!is_embedded(world, base_name)) loaded.files.push_back(base.path);
        if (is_file) base_folder = folder_of(base.path);
        return base;
    };
    GOBO_TRY(loaded.family, read_family(source.text, source.path, find_base));
    for (const auto& [feature, id] : specialized_counts(loaded.family, loaded.dialect))
        loaded.count_constants[id] = loaded.family.features[static_cast<std::size_t>(feature)].macro;
    add_include_folders(world, loaded.search);
    const bool is_on_disk = !is_embedded(world, name);
    if (is_on_disk) loaded.search.add(world.disk, folder, "", true);
    if (base_folder != folder) loaded.search.add(world.disk, base_folder, "", true);
    for (const std::string part : {"shader_lib", "templates"})
        loaded.search.add(world.library(), world.in_library(part), part + "/",
                          !world.options.library.empty());
    if (is_on_disk && name != "-") loaded.files.push_back(source.path);
    return loaded;
}

OptionGroup selection_options(SelectionOptions& options) {
    return {"Which keys",
            {{"--key", "KEY", "A key, such as 'fog=linear point=3'", &options.keys},
             {"--keys-from", "FILE", "A file of keys, one a line; - is standard input", &options.key_files},
             {"--scene", "FILE", "A glTF scene: the keys that its draws need", &options.scenes},
             {"--bucket-lights",
              "0,1,2,...",
              "Round the light counts of --scene up to one of these",
              &options.bucket_lights,
              {.needs = "--scene"}},
             {"--all", "", "Every valid key", &options.more.all},
             {"--cover", "T", "Few keys that contain every combination of T feature values",
              &options.more.cover, between(1, kLargestCover)},
             {"--over", "A,B,...", "Features that --all and --cover vary; the others stand at their defaults",
              &options.more.over},
             {"--where", "EXPR", "Condition on the keys, such as 'point <= 2 && fog != none'",
              &options.more.where},
             {"--excluded", "", "Let --all and --cover take values that the family excludes by default",
              &options.more.excluded},
             {"--shard", "I/N", "Of all these keys only every N-th, from the I-th on", &options.shard}}};
}

std::string_view first_given(const SelectionOptions& options) {
    const Selection& more = options.more;
    const std::pair<std::string_view, bool> given[] = {
        {"--key", !options.keys.empty()},     {"--keys-from", !options.key_files.empty()},
        {"--scene", !options.scenes.empty()}, {"--all", more.all},
        {"--cover", more.cover != 0},         {"--over", !more.over.empty()},
        {"--where", !more.where.empty()},     {"--excluded", more.excluded},
        {"--shard", !options.shard.empty()}};
    for (const auto& [name, is_given] : given)
        if (is_given) return name;
    return "";
}

Result<Selection> load_selection(const World& world, LoadedFamily& family, const SelectionOptions& options) {
    Selection selection = options.more;
    GOBO_TRY(selection.over, names_in("--over", options.more.over));
    for (const std::string& text : options.keys) selection.keys.push_back({text});
    for (const std::string& path : options.key_files) {
        GOBO_TRY(const auto keys, keys_of_file(world, path, options.may_hold_none));
        selection.keys.insert(selection.keys.end(), keys.begin(), keys.end());
        if (path != "-") family.files.push_back(path);
    }
    for (const std::string& path : options.scenes) {
        GOBO_TRY(const auto keys, keys_of_scene(world, family, path, options.bucket_lights));
        selection.keys.insert(selection.keys.end(), keys.begin(), keys.end());
    }
    return selection;
}

Result<std::vector<Key>> load_keys(const World& world, LoadedFamily& family,
                                   const SelectionOptions& options) {
    const std::vector<std::string> own_files = family.files;
    GOBO_TRY(const Selection selection, load_selection(world, family, options));
    // To select() it would mean the family's default set.
    const bool holds_none = options.may_hold_none && !options.key_files.empty() && selection.keys.empty() &&
                            !selection.all && selection.cover == 0;
    if (holds_none) return std::vector<Key>();
    GOBO_TRY(std::vector<Key> keys, select(family.family, selection, name_of(family.dialect)));
    if (!options.shard.empty()) family.run = run_of_shards(world, family, own_files, keys);
    return shard_of(std::move(keys), options.shard);
}

namespace {

/// Keeps the texts that glslang stopped at where the user wants them, and says so.
Diagnostics keep_stopped(const World& world, const std::string& family, const Validated& validated) {
    Diagnostics notes;
    for (std::size_t i = 0; i < validated.stopped.size(); ++i) {
        const StoppedStage& stage = validated.stopped[i];
        const std::string path =
            fmt::format("{}/{}.{}.{}", world.options.stopped, family, i + 1, names_of(stage.kind).infix);
        const Result<bool> written = world.disk.write(path, stage.text);
        if (!written) return written.error();
        notes.push_back(
            {.severity = Severity::note,
             .place = {path},
             .message = fmt::format("the text of the {} stage that stopped glslang", name_of(stage.kind))});
    }
    return notes;
}

}  // namespace

Result<Composition> compose_keys(const LoadedFamily& family, const std::vector<Key>& keys) {
    Result<Composition> composition =
        compose(family.family, keys, family.search, family.dialect, family.comments);
    if (!composition)
        for (Diagnostic& error : composition.error()) put_at_mention(error, family);
    return composition;
}

Diagnostics warn_of_no_keys(const Composition& composition, std::string_view consequence) {
    if (!composition.permutations.empty()) return {};
    return {{.severity = Severity::warning,
             .message = fmt::format("the selection holds no keys, so {}", consequence),
             .help = "see what a selection holds with 'gobo list'"}};
}

Result<Composition> compose_selection(const World& world, LoadedFamily& family,
                                      const SelectionOptions& options) {
    GOBO_TRY(const auto keys, load_keys(world, family, options));
    return compose_keys(family, keys);
}

namespace {

/// Of the stages that are valid, also with all counts at their highest.
std::vector<Interface> interfaces_of_cover(const World& world, const LoadedFamily& family, int strength,
                                           const ValidateOptions& options) {
    LoadedFamily copy = family;
    std::vector<Interface> interfaces;
    const Result<std::vector<Key>> cover = load_keys(world, copy, {.more = {.cover = strength}});
    if (!cover) return interfaces;
    std::set<Key> keys(cover->begin(), cover->end());
    for (const Key& key : *cover)
        if (auto highest = with_highest_counts(copy, key)) keys.insert(std::move(*highest));
    Result<Composition> composition = compose_keys(copy, {keys.begin(), keys.end()});
    if (!composition) return interfaces;
    for (ValidatedStage& stage : validate(copy.family, *composition, options).stages)
        interfaces.push_back(std::move(stage.interface));
    return interfaces;
}

}  // namespace

Result<Validated> compile(const World& world, const LoadedFamily& family, Composition& composition,
                          ValidateOptions options) {
    options.jobs = world.jobs();
    options.child_processes = !world.options.in_process;
    options.cache = world.cache;
    Validated validated = validate_with_counts(family, composition, options);
    const Diagnostics unknown = is_embedded(world, family.name)
                                    ? Diagnostics{}
                                    : unknown_names(family, composition, validated, [&](int strength) {
                                          return interfaces_of_cover(world, family, strength, options);
                                      });
    if (exit_status(validated.diagnostics) != 0) {
        if (!world.options.stopped.empty())
            append(validated.diagnostics, keep_stopped(world, family.family.name, validated));
        simplify_subjects(validated.diagnostics, family, options);
        append(validated.diagnostics, unknown);
        return tl::unexpected(std::move(validated.diagnostics));
    }
    append(validated.diagnostics, unknown);
    append(validated.diagnostics, clashes_with_counts(family, composition, validated));
    append(validated.diagnostics, clashes_of_keys(family.family, composition, validated));
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(std::move(validated.diagnostics));
    return validated;
}

bool is_scene_file(std::string_view path) {
    return path.ends_with(".gltf") || path.ends_with(".glb");
}

Result<std::vector<Domain>> domains_of_scene(const World& world, LoadedFamily& family,
                                             const std::string& path) {
    GOBO_TRY(const scene::Scene scene, load_scene(world, family, path));
    return scene::domains_of_scene(scene, scene::required_effects(scene, scene::eye_of_cameras(scene), {}),
                                   family.family.domains);
}

void make_counts_literal(Family& family) {
    for (Feature& feature : family.features) feature.is_specialized = false;
}

namespace {

/// Shader files; all functions of their subroutine uniforms, or where one key is wanted, those that stand
/// beside the files as a key.
Result<Subject> load_files(const World& world, const std::vector<std::string>& names,
                           const std::vector<std::string>& stages, const std::string& dialect,
                           bool wants_one_key) {
    Subject subject;
    std::vector<StageKind> kinds;
    for (const std::string& name : stages) {
        const std::optional<StageKind> kind = stage_named(name);
        if (!kind)
            return fail(Fault::usage, fmt::format("-S: there is no stage '{}'", name),
                        suggestion(name, split(stage_words(), '|')));
        kinds.push_back(*kind);
    }
    subject.are_files = true;
    GOBO_TRY(subject.family.dialect, read_dialect(dialect));
    add_include_folders(world, subject.family.search);
    std::vector<std::string> files = names;
    std::vector<std::string> key;
    std::erase_if(files, [&](const std::string& name) {
        const bool is_key = wants_one_key && !is_shader_file(name) && !world.disk.is_file(name) &&
                            (name == "default" || name.find('=') != std::string::npos);
        if (is_key) key.push_back(name);
        return is_key;
    });
    GOBO_TRY(subject.family.family, family_of_files(files, world.disk, subject.family.search, kinds));
    Family& family = subject.family.family;
    GOBO_TRY(subject.composition, without_subjects(compose_keys(subject.family, {Key{}})));
    const bool is_vulkan = dialect.empty() && is_for_vulkan(subject.composition);
    if (is_vulkan) subject.family.dialect = Dialect::vulkan;
    const bool is_legacy = read_as_legacy(subject.composition, family);
    const bool has_subroutines = add_subroutines(subject.composition, family);
    if (is_legacy)
        subject.family.search.add(world.library(), world.in_library("templates"), "templates/",
                                  !world.options.library.empty());
    GOBO_TRY(const Key chosen, parse_key(family, key.empty() ? "default" : join(key, " ")));
    if (is_vulkan || is_legacy || has_subroutines) {
        const std::vector<Key> keys =
            wants_one_key ? std::vector<Key>{chosen} : keys_with_every_value(family);
        GOBO_TRY(subject.composition, without_subjects(compose_keys(subject.family, keys)));
    }
    return subject;
}

}  // namespace

Result<Subject> load_subject(const World& world, const std::vector<std::string>& names,
                             const std::vector<std::string>& stages, const std::string& dialect,
                             const SelectionOptions* selection, Counts counts) {
    const bool names_a_family =
        names.size() == 1 && (names[0].ends_with(".toml") || is_shipped_family(world, names[0]));
    if (!stages.empty() && names_a_family)
        return fail(Fault::usage,
                    fmt::format("-S tells the stage of a shader file, and '{}' is a family", names[0]),
                    "leave it out");
    if (!stages.empty() || std::any_of(names.begin(), names.end(), is_shader_file)) {
        const std::string_view option = selection != nullptr ? first_given(*selection) : "";
        if (!option.empty())
            return fail(Fault::usage, fmt::format("{} chooses keys of a family, and files have none", option),
                        "leave it out, or name a family");
        return load_files(world, names, stages, dialect, selection == nullptr);
    }
    Subject subject;
    const std::size_t most = selection != nullptr ? 1 : 2;
    if (names.size() > most)
        return fail(Fault::usage, fmt::format("unexpected argument '{}'", names[most]),
                    selection != nullptr
                        ? "name one family, or shader files; keys are named with --key"
                        : "name a family and a key, or shader files; quote a key that has blanks");
    GOBO_TRY(subject.family, load_family(world, names[0], dialect));
    if (counts == Counts::literal) make_counts_literal(subject.family.family);
    const SelectionOptions one_key{.keys = {names.size() > 1 ? names[1] : "default"}};
    GOBO_TRY(subject.composition,
             compose_selection(world, subject.family, selection != nullptr ? *selection : one_key));
    return subject;
}

Result<Validated> compile(const World& world, Subject& subject, const ValidateOptions& options) {
    auto validated = compile(world, subject.family, subject.composition, options);
    if (!subject.are_files) return validated;
    if (validated)
        for (Diagnostic& diagnostic : validated->diagnostics) diagnostic.subject.clear();
    return without_subjects(std::move(validated));
}

Result<std::string> read_input(const World& world, const std::string& path) {
    if (path != "-") return world.disk.read(path);
    GOBO_TRY(std::string text, world.disk.read("/dev/stdin"));
    keep_standard_input(text);
    return text;
}

Result<InputFile> read_or_shipped(const World& world, const std::string& path, const std::string& shipped) {
    GOBO_TRY(std::string text, path.empty() ? world.shipped.read(shipped) : read_input(world, path));
    return InputFile{path.empty() ? shipped : path, std::move(text)};
}

std::string stem_of(const std::string& path) {
    return std::filesystem::path(path).stem().string();
}

}  // namespace gobo
