#include "lab/commands/lab_input.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <unistd.h>

#include "compose/piece_marks.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/probe/environment.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/render/texture.hpp"
#include "lab/sanitize/sanitize.hpp"
#include "lab/study/qualities.hpp"
#include "lab/study/worst_case.hpp"

namespace gobo {
namespace {

constexpr const char* kEnvironmentHelp =
    "name a folder that gobo probe wrote, or a latitude-longitude map FILE.exr";

/// The map of the file `path`; the shipped `studio` where that is empty.
Result<probe::Environment> load_panorama(const World& world, const std::string& path) {
    const std::string file = path.empty() ? "data/environments/studio.exr" : path;
    const Result<Image> image = read_image(path.empty() ? world.shipped : world.disk, file);
    if (!image) return with_help(image.error(), kEnvironmentHelp);
    return probe::environment_of(*image, file);
}

/// Whether --environment names a latitude-longitude map, not a folder: a file .exr, or where it is empty the
/// shipped `studio`.
bool is_panorama(const std::string& environment) {
    return environment.empty() || environment.ends_with(".exr");
}

/// Whether some permutation mirrors an environment that is blurred by roughness.
bool mirrors_by_roughness(const std::vector<Interface>& interfaces) {
    return std::ranges::any_of(interfaces, [](const Interface& interface) {
        return std::ranges::any_of(interface.blocks, [](const Block& block) {
            return block.name == "Reflection" &&
                   std::ranges::count(block.members, "roughestLevel", &Member::name) > 0;
        });
    });
}

Result<CubeImages> environment_from_panorama(const World& world, const std::string& path, bool by_roughness) {
    GOBO_TRY(const auto environment, load_panorama(world, path));
    const int jobs = world.jobs();
    return CubeImages{
        {"diffuseMap", {probe::lobe_map(environment, 1, 16, jobs)}},
        {"specularMap", by_roughness ? probe::roughness_maps(environment, 64, kRoughnessLevels, jobs)
                                     : std::vector{probe::lobe_map(environment, 48, 32, jobs)}}};
}

bool looks_up_environment(const Interface& interface) {
    return std::ranges::any_of(interface.samplers, [](const Sampler& sampler) {
        return sampler.name == "diffuseMap" || sampler.name == "specularMap";
    });
}

}  // namespace

Result<Mesh> load_mesh(const World& world, const std::string& name) {
    if (name == "teapot") return read_obj(world.shipped, "data/meshes/teapot.obj");
    if (name == "sphere") return make_sphere(64, 32);
    if (name == "torus") return make_torus(1, 0.4, 96, 48);
    if (name == "plane") return make_plane(3, 32);
    if (name.ends_with(".obj")) return read_obj(world.disk, name);
    return fail(Fault::usage, fmt::format("there is no mesh '{}'", name),
                suggestion(name, {"plane", "sphere", "teapot", "torus"}) + "; or name an .obj file");
}

Result<std::pair<int, int>> read_size(const std::string& text) {
    const auto [width, height] = pair_from(text, 'x').value_or(std::pair<std::size_t, std::size_t>());
    if (std::min(width, height) > 0 && std::max(width, height) <= kLargestSide)
        return std::pair(static_cast<int>(width), static_cast<int>(height));
    return fail(Fault::usage, fmt::format("'{}' is not a valid size", text),
                "write width x height, such as 640x480, each at most 16384");
}

Result<CubeImages> load_environment(const World& world, const std::string& path,
                                    const std::vector<Interface>& interfaces) {
    const bool is_wanted = std::ranges::any_of(interfaces, looks_up_environment);
    if (path.empty() && !is_wanted) return CubeImages{};
    CubeImages images;  // read, and told of, even where no key looks them up
    if (is_panorama(path)) {
        GOBO_TRY(images, environment_from_panorama(world, path, mirrors_by_roughness(interfaces)));
        return is_wanted ? images : CubeImages{};
    }
    for (const auto& [sampler, file] :
         {std::pair("diffuseMap", "diffuse.exr"), std::pair("specularMap", "specular.exr")}) {
        auto image = read_image(world.disk, path + "/" + file);
        if (!image) return with_help(image.error(), kEnvironmentHelp);
        images[sampler].push_back(std::move(*image));
    }
    return is_wanted ? images : CubeImages{};
}

Diagnostics warnings_of_environment(const std::string& path, const std::vector<Interface>& interfaces) {
    if (is_panorama(path) || !mirrors_by_roughness(interfaces)) return {};
    return {{.severity = Severity::warning,
             .place = {path + "/specular.exr"},
             .message = "it is mirrored equally sharp by surfaces of every roughness",
             .help = "give --environment the latitude-longitude map that it was made from, FILE.exr"}};
}

std::vector<Interface> interfaces_of(const Composition& composition, const Validated& validated) {
    std::vector<Interface> interfaces;
    for (const Permutation& permutation : composition.permutations)
        interfaces.push_back(interface_of(validated, permutation));
    return interfaces;
}

Result<std::optional<verify::ShadowPass>> load_shadow_pass(const World& world, const Family& family,
                                                           const Composition& composition) {
    const auto has_shadows = [&](const Permutation& permutation) {
        return !shadow_lights(family, permutation.key).empty();
    };
    if (std::ranges::none_of(composition.permutations, has_shadows)) return std::nullopt;
    const bool is_vulkan = composition.dialect == Dialect::vulkan;
    GOBO_TRY(LoadedFamily depth, load_family(world, "depth", is_vulkan ? "vulkan" : ""));
    GOBO_TRY(Composition stages, compose_selection(world, depth, {}));
    GOBO_TRY(const Validated validated, compile(world, depth, stages, {.keep_spirv = true}));
    const Permutation& permutation = stages.permutations.front();
    verify::ShadowPass pass;
    pass.pass.stages = stages_of(stages, permutation);
    pass.pass.interface = interface_of(validated, permutation);
    pass.pass.values = depth.family.render;
    pass.vertex = validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])].spirv;
    pass.fragment = validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])].spirv;
    return pass;
}

Result<std::string> dialect_for(const std::string& backend, const std::string& dialect) {
    const std::vector<std::string> known = split(kBackends, '|');
    if (std::ranges::count(known, backend) == 0)
        return fail(Fault::usage, fmt::format("unknown backend '{}'", backend), suggestion(backend, known));
    if (backend != kVulkanBackend) {
        if (dialect == "vulkan" || dialect == "gl_spirv")
            return fail(
                Fault::usage, fmt::format("--dialect {} is not drawn by --backend {}", dialect, backend),
                dialect == "vulkan" ? "add --backend vulkan" : "draw --dialect 450: its text is the same");
        return dialect;
    }
    if (!dialect.empty() && dialect != "vulkan")
        return fail(
            Fault::usage, fmt::format("--backend vulkan does not draw --dialect {}", dialect),
            dialect == "gl_spirv"
                ? "leave --dialect out, or draw --dialect 450, whose text is the same, by --backend osmesa"
                : "leave --dialect out, or draw by --backend osmesa");
    return "vulkan";
}

Result<void> refuse_other_stages(const Family& family, const Composition& composition,
                                 const std::string& what, bool wants_pair) {
    const auto program = family.index_of("program");
    const std::string help =
        program ? fmt::format("leave such keys out: --where 'program == {}'",
                              family.features[static_cast<std::size_t>(*program)].values.front())
        : wants_pair
            ? ""
            : "each invocation is followed alone: where several share memory, a patch or a primitive, "
              "what one computes hangs on the others";
    for (const Permutation& permutation : composition.permutations)
        for (const StageNames& stage : kStages) {
            const bool is_usual = stage.kind == StageKind::vertex || stage.kind == StageKind::fragment;
            const bool has = permutation.stages[stage.kind] >= 0;
            if (is_usual ? has || !wants_pair : !has) continue;
            Diagnostics errors = fail(Place{family.path}, "",
                                      fmt::format("{} a vertex and a fragment stage, and here is {} {} stage",
                                                  what, has ? "a" : "no", stage.name),
                                      help)
                                     .value();
            if (!permutation.key.empty()) errors.front().subject = key_text(family, permutation.key);
            return tl::unexpected(std::move(errors));
        }
    return {};
}

Result<study::Weights> load_weights(const World& world, const std::string& path) {
    GOBO_TRY(const auto file, read_or_shipped(world, path, "data/study/weights.csv"));
    GOBO_TRY(const auto weights, study::read_weights(file.text, file.path));
    return weights.front();
}

Result<study::StudyPlan> load_plan(const World& world, const Family& family, const std::string& path) {
    const std::string shipped = fmt::format("data/study/{}.toml", family.name);
    if (path.empty() && !world.shipped.is_file(shipped)) return study::default_plan(family);
    GOBO_TRY(const auto file, read_or_shipped(world, path, shipped));
    return study::read_plan(file.text, file.path, family);
}

study::Progress progress_on_terminal(const World& world) {
    if (world.options.quiet || isatty(STDERR_FILENO) == 0)
        return [](std::string_view, std::size_t, std::size_t) {};
    return [](std::string_view what, std::size_t done, std::size_t total) {
        const std::string text = done < total ? fmt::format("{}/{} {}", done + 1, total, one_line(what)) : "";
        std::fputs(("\r\x1b[K" + text).c_str(), stderr);
        std::fflush(stderr);
    };
}

Result<std::vector<StudiedKey>> measure_qualities(const World& world, const LoadedFamily& family,
                                                  const StudiedEffects& studied, const Key& effects) {
    GOBO_TRY(const auto weights, load_weights(world));
    GOBO_TRY(const auto plan, load_plan(world, family.family));
    std::vector<Key> keys = study::front_qualities(family.family, studied, effects);
    if (studied.empty())
        for (const study::Choice& choice : study::single_choices(family.family, effects))
            keys.push_back(choice.key);
    const study::Progress progress = progress_on_terminal(world);
    progress("measuring " + key_text(family.family, effects), 0, 1);
    study::Journal journal;
    GOBO_TRY(const auto result,
             study::measure_keys({world.shipped, family.family, family.search, world.jobs()}, effects, keys,
                                 plan, journal));
    progress("", 1, 1);
    return study::studied_keys(result, weights);
}

Result<std::vector<double>> worst_errors(const World& world, const LoadedFamily& family,
                                         const std::vector<Key>& keys, double enough) {
    const study::Progress progress = progress_on_terminal(world);
    progress(fmt::format("searching the domain for the worst error of {} keys", keys.size()), 0, 1);
    const study::WorstCaseOptions options{kPromisePoints, 1, enough};
    GOBO_TRY(
        const auto cases,
        study::find_worst_cases({world.shipped, family.family, family.search, world.jobs()}, keys, options));
    std::vector<double> errors;
    for (const Key& key : keys) {
        const auto found = std::ranges::find(cases, key, &study::WorstCase::key);
        errors.push_back(found == cases.end() ? std::numeric_limits<double>::infinity() : found->error);
    }
    progress("", 1, 1);
    return errors;
}

Diagnostic note_in(const std::string& file, std::string message) {
    return {.severity = Severity::note, .place = {file}, .message = std::move(message)};
}

std::string shell_word(std::string_view text) {
    const auto is_plain = [](char character) {
        return is_identifier_part(character) ||
               std::string_view("./=+-,:@%").find(character) != std::string_view::npos;
    };
    if (!text.empty() && std::ranges::all_of(text, is_plain)) return std::string(text);
    std::string word = "'";
    for (const char character : text) {
        if (character == '\'')
            word += "'\\''";
        else
            word += character;
    }
    return word + "'";
}

Result<std::vector<Domain>> constraints_in_comments(const Composition& composition) {
    constexpr std::string_view kMark = "// assume:";
    std::vector<Domain> constraints;
    Diagnostics errors;
    for (const Piece& piece : composition.pieces) {
        int line = 0;
        for_each_line(piece.file_text, [&](std::string_view text) {
            ++line;
            const auto mark = text.find(kMark);
            if (mark == std::string_view::npos) return true;
            Domain& domain = constraints.emplace_back();
            domain.name = trim(text.substr(mark + kMark.size()));
            domain.place = {piece.path, line, static_cast<int>(mark) + 1};
            if (!constraint_of(domain.name))
                errors.push_back({.place = domain.place,
                                  .message = fmt::format("'{}' is no constraint", domain.name),
                                  .help = std::string(kConstraintHelp)});
            return true;
        });
    }
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    return constraints;
}

Diagnostics as_warnings(Diagnostics errors) {
    for (Diagnostic& error : errors) error.severity = Severity::warning;
    return errors;
}

Result<Validated> compile_over_domains(const World& world, Subject& subject, const std::string& inputs) {
    std::vector<Domain>& domains = subject.family.family.domains;
    std::vector<Domain> stated;
    if (!inputs.empty()) {
        GOBO_TRY(const std::string text, read_input(world, inputs));
        GOBO_TRY(stated, read_domain_file(text, inputs));
    }
    std::vector<Domain> of_family;  // where other keys than those at hand may read what is named
    std::ranges::copy_if(domains, std::back_inserter(of_family), is_constraint, &Domain::name);
    if (subject.are_files) {
        GOBO_TRY(const std::vector<Domain> commented, constraints_in_comments(subject.composition));
        stated.insert(stated.end(), commented.begin(), commented.end());
    }
    domains.insert(domains.begin(), stated.begin(), stated.end());  // ahead of the family's own
    GOBO_TRY_DO(refuse_contradictions(domains));
    GOBO_TRY(Validated validated, compile(world, subject, {.keep_spirv = true, .debug_information = true}));
    if (Diagnostics errors = sanitize::domains_of_nothing(stated, {}, validated); !errors.empty())
        return tl::unexpected(std::move(errors));
    // What else compilers warn of, the evaluation finds or gobo check tells.
    validated.diagnostics = as_warnings(sanitize::domains_of_nothing(of_family, domains, validated));
    return validated;
}

Diagnostics keep_file(const World& world, const std::string& path, std::string_view content) {
    const auto written = world.disk.write(path, content);
    return written ? Diagnostics{} : as_warnings(written.error());
}

Diagnostics with_kept_stages(const World& world, const std::string& folder, const Family& family,
                             const Composition& composition, const Validated& validated,
                             const Permutation& permutation, Diagnostics errors) {
    const bool has_words = is_spirv(composition.dialect);
    const std::string key = key_text(family, permutation.key);
    Diagnostics problems;
    std::vector<std::string> paths;
    for (const StageNames& stage : kStages) {
        const int number = permutation.stages[stage.kind];
        if (number < 0) continue;
        paths.push_back(
            fmt::format("{}/{}.{}{}", folder, picture_name(key), stage.infix, has_words ? ".spv" : ""));
        const SpirvModule& words = validated.stage(number).spirv;
        const std::string text = has_words ? std::string(reinterpret_cast<const char*>(words.data()),
                                                         words.size() * sizeof(words[0]))
                                           : source_of(composition, composition.stages[number]);
        if (!folder.empty()) append(problems, keep_file(world, paths.back(), text));
    }
    for (Diagnostic& error : errors) {
        error.subject = key;
        if (!error.help.empty()) error.help += "; ";
        error.help += folder.empty() ? fmt::format("keep its {} with -o DIR", has_words ? "SPIR-V" : "stages")
                                     : fmt::format("what it was given is in {}", join(paths, " and "));
    }
    append(errors, problems);
    return errors;
}

std::string quoted_line(const Composition& composition, const Place& place) {
    const auto piece = std::ranges::find(composition.pieces, place.file, &Piece::path);
    return piece == composition.pieces.end() ? "" : std::string(line_of(*piece, place.line));
}

tl::unexpected<Diagnostics> with_help(Diagnostics errors, const std::string& help) {
    for (Diagnostic& error : errors) error.help = help;
    return tl::unexpected(std::move(errors));
}

Option keep_option(std::string& folder, const std::string& what) {
    return {"-o,--output", "DIR", fmt::format("Keep {} in this folder; without it nothing is written", what),
            &folder};
}

}  // namespace gobo
