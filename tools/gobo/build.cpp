// gobo build: the generated header, its manifest and its depfile.
#include "gobo/build.hpp"

#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.hpp"
#include "emit/depfile_names.hpp"
#include "emit/emit.hpp"
#include "gobo/commands.hpp"
#include "reflect/interface.hpp"

namespace gobo {
namespace {

/// The path of the header without its end, which those of the manifest and the depfile begin with, too.
Result<std::string> stem_of(const BuildOptions& options, const Family& family) {
    if (options.split && options.folder == kStandardOutput)
        return fail(Fault::usage, "--split writes two files, which cannot both be printed",
                    "name a folder with -o");
    if (options.folder == kStandardOutput) return family.name;
    if (options.header.empty()) return options.folder + "/" + family.name;
    const std::size_t size = options.header.size();
    if (!options.header.ends_with(".hpp") || size == 4 || options.header.find('/') != std::string::npos)
        return fail(Fault::usage, fmt::format("'{}' is not the name of a header", options.header),
                    "give a file name that ends in .hpp; --output says the folder");
    if (options.split && options.header.find_first_of("\"\\\n\r") != std::string::npos)
        return fail(Fault::usage, fmt::format("the source file cannot include '{}'", options.header),
                    "give the header a name without quotes and backslashes");
    return options.folder + "/" + options.header.substr(0, size - 4);
}

/// The interface of the whole family, and what its permutations declare differently, by their order in the
/// composition.
United united_interface(const Composition& composition, const Validated& validated) {
    std::vector<Interface> programs;
    std::map<StageNumbers, std::size_t> numbers;
    std::vector<std::size_t> program_of;
    for (const Permutation& permutation : composition.permutations) {
        const auto [place, is_new] = numbers.try_emplace(permutation.stages, programs.size());
        if (is_new) {
            Interface& program = programs.emplace_back(interface_of(validated, permutation));
            // The header lists the outputs of fragment stages.
            if (permutation.stages[StageKind::fragment] < 0) program.outputs.clear();
        }
        program_of.push_back(place->second);
    }
    United united = unite(programs);
    for (Differing& differing : united.differing) {
        std::vector<int> declared;
        for (const std::size_t program : program_of) declared.push_back(differing.declared[program]);
        differing.declared = std::move(declared);
    }
    return united;
}

/// An error where an output is a file that was read, or another output.
Result<void> check_outputs(const FileSystem& disk, const std::vector<OutputFile>& outputs,
                           const std::set<std::string>& inputs) {
    std::set<std::string> read;
    for (const std::string& input : inputs) read.insert(disk.real_path(input));
    std::set<std::string> written;
    for (const OutputFile& output : outputs) {
        // A link in the place of an output is replaced, not followed.
        const std::string folder = folder_of(output.path);
        const std::string path = disk.real_path(folder.empty() ? "." : folder) + "/" +
                                 output.path.substr(output.path.rfind('/') + 1);
        if (read.contains(path))
            return fail(Fault::usage, fmt::format("'{}' would be written over, but is read", output.path),
                        "name another file or folder for what is written");
        if (!written.insert(path).second)
            return fail(Fault::usage, fmt::format("'{}' is to be written twice", output.path),
                        "give the depfile a name of its own");
    }
    return {};
}

/// ", 12 modules of 34567 bytes" of SPIR-V.
std::string modules_text(const std::vector<std::span<const std::uint32_t>>& modules) {
    std::set<std::vector<std::uint32_t>> distinct;
    std::size_t words = 0;
    for (const std::span<const std::uint32_t> module : modules)
        if (!module.empty() && distinct.emplace(module.begin(), module.end()).second) words += module.size();
    if (distinct.empty()) return "";
    return fmt::format(", {} modules of {} bytes", distinct.size(), words * sizeof(std::uint32_t));
}

}  // namespace

Result<Built> build(const BuildOptions& options, const World& world) {
    GOBO_TRY_DO(refuse_without_budget(options.budget));
    GOBO_TRY(LoadedFamily family, load_family(world, options.family, options.dialect));
    GOBO_TRY(const std::string stem, stem_of(options, family.family));
    GOBO_TRY_DO(narrow_domains(world, family, options.budget.domain));
    GOBO_TRY_DO(refuse_scenes_outside(world, family, options.scenes, options.budget));
    if (options.comments) family.comments = Comments::keep;
    GOBO_TRY(std::vector<Key> keys, load_keys(world, family, options));
    std::vector<QualityChoice> qualities;
    if (options.budget.is_set()) {
        GOBO_TRY(qualities, choose_qualities(world, family, options.budget, keys));
        std::set<Key> chosen;
        for (const QualityChoice& choice : qualities) chosen.insert(choice.key);
        keys.assign(chosen.begin(), chosen.end());
    }
    GOBO_TRY(Composition composition, compose_keys(family, keys));
    if ((options.optimize || options.debug) && !is_spirv(family.dialect))
        return fail(Fault::usage, fmt::format("--{} is for SPIR-V", options.optimize ? "optimize" : "debug"),
                    "add --dialect vulkan or --dialect gl_spirv");
    ValidateOptions validate_options;
    validate_options.keep_spirv = is_spirv(family.dialect);
    validate_options.optimize = options.optimize;
    validate_options.debug_information = options.debug;
    validate_options.strip = !options.debug;
    GOBO_TRY(Validated validated, compile(world, family, composition, validate_options));
    append(validated.diagnostics, composition.notes);
    const United united = united_interface(composition, validated);
    GOBO_TRY(const HeaderTemplates templates,
             read_header_templates(world.library(), world.in_library("templates/header")));
    EmitInput input{family.family,        composition,      united.interface, options.cpp_namespace,
                    std::move(qualities), united.differing, family.narrowed};
    if (is_spirv(family.dialect))
        for (const ValidatedStage& stage : validated.stages) input.modules.emplace_back(stage.spirv);
    if (options.split) input.split_from = stem.substr(stem.rfind('/') + 1) + ".hpp";
    GOBO_TRY(EmittedCpp emitted, emit_header(input, templates));

    std::set<std::string> files(family.files.begin(), family.files.end());
    files.insert(composition.files.begin(), composition.files.end());
    if (!world.options.library.empty())
        for (const auto& [name, part] : templates) files.insert(part.name);
    const std::string target = options.depfile_target.empty() ? stem + ".hpp" : options.depfile_target;
    append(validated.diagnostics, check_depfile_names(target, files));
    const std::string manifest = emit_manifest(input);
    const std::string depfile = emit_depfile({target}, {files.begin(), files.end()});
    std::vector<std::string> summary = family.scene_notes;
    summary.push_back(fmt::format("{}.hpp: {} permutations, {} stages, {} pieces{}", one_line(stem),
                                  composition.permutations.size(), composition.stages.size(),
                                  composition.pieces.size(), modules_text(input.modules)));
    Outcome outcome{{},
                    std::move(validated.diagnostics),
                    join(summary, "\n"),
                    {},
                    world.cache == nullptr ? -1 : static_cast<int>(validated.compiled)};
    const bool is_printed = options.folder == kStandardOutput;
    // The header is what others are compiled with: where it is new, the rest is.
    if (!is_printed || !options.depfile.empty())
        outcome.files.push_back({options.depfile.empty() ? stem + ".d" : options.depfile, depfile});
    if (is_printed) {
        outcome.output = std::move(emitted.header);
    } else {
        outcome.files.push_back({stem + ".json", manifest});
        if (options.split) outcome.files.push_back({stem + ".cpp", std::move(emitted.source)});
        outcome.files.push_back({stem + ".hpp", std::move(emitted.header)});
    }
    GOBO_TRY_DO(check_outputs(world.disk, outcome.files, files));
    append(outcome.diagnostics, warn_of_no_keys(composition, "nothing can be found in the header"));
    return Built{std::move(outcome), std::move(family.family), std::move(composition)};
}

std::vector<Option> build_arguments(BuildOptions& options) {
    return {family_argument(options.family),
            {"-o,--output", "DIR",
             "Folder for FAMILY.hpp, FAMILY.json and FAMILY.d; - prints the header and writes none of them",
             &options.folder, kRequired},
            {"--header", "FILE",
             "Name of the header, the manifest's and the depfile's; by default FAMILY.hpp", &options.header},
            {"--namespace", "NAME", "C++ namespace of the header; by default the family's name",
             &options.cpp_namespace},
            {"--depfile", "FILE", "The depfile, also -MF; by default FAMILY.d beside the header",
             &options.depfile},
            {"--glslc-depfile", "", "-MD of glslc: the depfile is written anyway", &options.glslc_depfile,
             kHidden},
            {"--depfile-target", "FILE",
             "What the depfile says is made, also -MT, by default the header: a stamp, for build tools that "
             "compare times",
             &options.depfile_target},
            comments_option(options.comments),
            {"--split", "",
             "Put the tables into FAMILY.cpp, which is compiled once; the header keeps types and functions",
             &options.split},
            {"--optimize", "", "Let SPIRV-Tools' optimizer make the SPIR-V of vulkan and gl_spirv faster",
             &options.optimize},
            {"--debug", "", "Keep names and lines in the SPIR-V of vulkan and gl_spirv", &options.debug},
            dialect_option(options.dialect)};
}

std::vector<OptionGroup> build_groups(BuildOptions& options) {
    return {selection_options(options), budget_options(options.budget)};
}

Command build_command() {
    const auto options = std::make_shared<BuildOptions>();
    return {{"build", "Write the C++ header, the JSON manifest and the depfile"},
            build_arguments(*options),
            build_groups(*options),
            "  gobo build lit --key 'fog=linear point=3' --key default -o generated\n"
            "  gobo build lit --cover 3 --where 'point <= 2' -o out\n"
            "  gobo build lit --keys-from recorded.txt --namespace game::shaders --dialect 330 -o generated\n"
            "  gobo build lit --key 'directional=1 specular=blinn' --max-error 0.01 -o generated\n"
            "  gobo build lit --cover 2 --dialect vulkan --optimize -o generated\n"
            "  gobo build game.toml --all -I my_pieces -o generated",
            [options](const World& world) -> Result<Outcome> {
                GOBO_TRY(Built built, build(*options, world));
                return std::move(built.outcome);
            }};
}

}  // namespace gobo
