#include "gobo/command.hpp"

#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/read_family.hpp"
#include "gobo/hand_over.hpp"
#include "gobo/scene_selection.hpp"

namespace gobo {
namespace {

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The path of a family file that `path` names relative to itself; the name of a shipped family as it is.
std::string beside(const std::string& path, const std::string& name) {
    const std::string folder = folder_of(path);
    const bool is_as_it_is = !name.ends_with(".toml") || name.starts_with('/') || folder.empty();
    return is_as_it_is ? name : folder + "/" + name;
}

std::vector<std::string> shipped_families(const FileSystem& shipped) {
    std::vector<std::string> names;
    for (const std::string& file : shipped.files_below("templates")) {
        if (file.ends_with(".toml") && file.find('/') == std::string::npos)
            names.push_back(file.substr(0, file.size() - 5));
    }
    return names;
}

/// A family file's text and where its templates lie.
struct FamilySource {
    std::string text;
    std::string path;
    bool on_disk = true;
};

Result<FamilySource> find_family(const World& world, const std::string& name, const CommonOptions& options) {
    if (name == "-" || name.ends_with(".toml")) {
        Result<std::string> text = read_input(world, name);
        if (!text) return tl::unexpected(text.error());
        return FamilySource{std::move(*text), name == "-" ? "stdin" : name, name != "-"};
    }
    const std::string path = fmt::format("templates/{}.toml", name);
    const bool from_disk = !options.library.empty();
    const std::string place = from_disk ? options.library + "/" + path : path;
    const FileSystem& files = from_disk ? world.disk : world.shipped;
    if (!files.is_file(place)) {
        const auto known = from_disk ? std::vector<std::string>{} : shipped_families(world.shipped);
        return fail(Fault::usage, fmt::format("there is no shipped family '{}'", name),
                    suggestion(name, known) + " (a family of your own is named by its .toml file)");
    }
    Result<std::string> text = files.read(place);
    if (!text) return tl::unexpected(text.error());
    return FamilySource{std::move(*text), place, from_disk};
}

void add_library(const World& world, const CommonOptions& options, SearchPath& search) {
    const bool from_disk = !options.library.empty();
    const std::string prefix = from_disk ? options.library + "/" : "";
    for (const std::string folder : {"shader_lib", "templates"}) {
        search.add(from_disk ? world.disk : world.shipped, prefix + folder, folder + "/", from_disk);
    }
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
    app.add_option("-I", options.include_folders,
                   "Folder searched for pieces before the family's own (repeatable)")
        ->type_name("FOLDER")
        ->allow_extra_args(false);
    app.add_option("-j,--jobs", options.jobs, "Threads")
        ->check(CLI::Range(1, 1024))
        ->type_name("N")
        ->default_val(std::max(1u, std::thread::hardware_concurrency()));
    app.add_option("--library", options.library,
                   "Folder that holds shader_lib and templates, instead of those built in")
        ->type_name("FOLDER");
    app.add_option("--color", options.color, "Colour in messages")
        ->check(CLI::IsMember({"auto", "always", "never"}))
        ->type_name("auto|always|never");
    app.add_flag("-q,--quiet", options.quiet, "Print no summary");
}

void add_selection_options(CLI::App& app, SelectionOptions& options) {
    app.add_option("--key", options.keys, "A key, such as 'fog=linear point=3' (repeatable)")
        ->type_name("TEXT")
        ->allow_extra_args(false);
    app.add_option("--keys-from", options.key_files,
                   "A file of keys, one a line; - is standard input (repeatable)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    app.add_option("--scene", options.scenes, "A glTF scene: the keys that its draws call for (repeatable)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    app.add_option("--bucket-lights", options.bucket_lights,
                   "Round the light counts of --scene up to one of these")
        ->type_name("0,1,2,...");
    app.add_flag("--all", options.all, "Every valid key");
    app.add_option("--cover", options.cover, "Keys that contain every combination of T feature values")
        ->type_name("T")
        ->check(CLI::Range(1, 8));
    app.add_option("--over", options.over,
                   "Features that --all and --cover range over; the others stand at their defaults")
        ->type_name("A,B,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--where", options.where, "Condition on the keys, such as 'point <= 2 && fog != none'")
        ->type_name("EXPR");
    app.add_flag("--retired", options.retired, "Let --all and --cover take retired values too");
}

void add_dialect_option(CLI::App& app, std::string& dialect) {
    app.add_option("--dialect", dialect, "GLSL dialect; by default the templates' own #version, or 450")
        ->type_name("450|330|es300");
}

void add_comments_option(CLI::App& app, bool& comments) {
    app.add_flag("--comments", comments, "Keep the comments of the shaders; without it, blanks replace them");
}

Result<std::string> read_input(const World& world, const std::string& path) {
    if (path != "-") return world.disk.read(path);
    Result<std::string> text = world.disk.read("/dev/stdin");
    if (text) keep_standard_input(*text);
    return text;
}

Result<Dialect> read_dialect(const std::string& name) {
    if (name.empty()) return Dialect::own;
    if (const auto dialect = dialect_of(name)) return *dialect;
    return fail(Fault::usage, fmt::format("unknown dialect '{}'", name),
                suggestion(name, {"450", "330", "es300"}));
}

Result<LoadedFamily> load_family(const World& world, const std::string& name, const CommonOptions& options) {
    Result<FamilySource> source = find_family(world, name, options);
    if (!source) return tl::unexpected(source.error());
    LoadedFamily loaded;
    std::string base_folder = folder_of(source->path);
    const FindFamily find_base = [&](const std::string& base_name) -> Result<FamilyText> {
        const std::string base_path = beside(source->path, base_name);
        Result<FamilySource> base = find_family(world, base_path, options);
        if (!base) return tl::unexpected(base.error());
        if (base->on_disk) loaded.files.push_back(base->path);
        if (base_name.ends_with(".toml")) base_folder = folder_of(base->path);
        return FamilyText{std::move(base->text), std::move(base->path)};
    };
    Result<Family> family = read_family(source->text, source->path, find_base);
    if (!family) return tl::unexpected(family.error());
    loaded.family = std::move(*family);
    for (const std::string& folder : options.include_folders) {
        std::string trimmed = folder;
        while (trimmed.size() > 1 && trimmed.ends_with('/')) trimmed.pop_back();
        loaded.search.add(world.disk, trimmed, "", true);
    }
    const bool is_shipped =
        source->path == fmt::format("templates/{}.toml", name) || !options.library.empty();
    if (!is_shipped || source->on_disk) loaded.search.add(world.disk, folder_of(source->path), "", true);
    if (base_folder != folder_of(source->path)) loaded.search.add(world.disk, base_folder, "", true);
    add_library(world, options, loaded.search);
    if (source->on_disk) loaded.files.push_back(source->path);
    return loaded;
}

Selection to_selection(const SelectionOptions& options) {
    Selection selection;
    for (const std::string& text : options.keys) selection.keys.push_back({text, {}});
    selection.all = options.all;
    selection.cover = options.cover;
    selection.over = options.over;
    selection.where = options.where;
    selection.retired = options.retired;
    return selection;
}

Result<Selection> load_selection(const World& world, LoadedFamily& family, const SelectionOptions& options,
                                 Dialect dialect) {
    Selection selection = to_selection(options);
    for (const std::string& path : options.key_files) {
        const Result<std::string> text = read_input(world, path);
        if (!text) return tl::unexpected(text.error());
        const std::vector<NamedKey> keys = keys_of_text(*text, path == "-" ? "stdin" : path);
        if (keys.empty()) {
            Diagnostic diagnostic;
            diagnostic.place.file = path;
            diagnostic.message = "holds no keys";
            diagnostic.help = "write one key a line; 'default' is the key with every feature at its default";
            return fail(std::move(diagnostic));
        }
        selection.keys.insert(selection.keys.end(), keys.begin(), keys.end());
        if (path != "-") family.files.push_back(path);
    }
    for (const std::string& path : options.scenes) {
        const Result<std::vector<NamedKey>> keys =
            keys_of_scene(world, family, path, options.bucket_lights, dialect);
        if (!keys) return tl::unexpected(keys.error());
        selection.keys.insert(selection.keys.end(), keys->begin(), keys->end());
    }
    return selection;
}

Result<std::vector<Key>> load_keys(const World& world, LoadedFamily& family, const SelectionOptions& options,
                                   Dialect dialect) {
    const Result<Selection> selection = load_selection(world, family, options, dialect);
    if (!selection) return tl::unexpected(selection.error());
    return select(family.family, *selection, name_of(dialect));
}

Result<Composition> load_composition(const World& world, LoadedFamily& family,
                                     const SelectionOptions& options, Dialect dialect, Comments comments) {
    const Result<std::vector<Key>> keys = load_keys(world, family, options, dialect);
    if (!keys) return tl::unexpected(keys.error());
    return compose(family.family, *keys, family.search, dialect, comments);
}

Outcome failed(Diagnostics diagnostics) {
    return {{}, std::move(diagnostics), {}};
}

}  // namespace gobo
