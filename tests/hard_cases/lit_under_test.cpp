#include "lit_under_test.hpp"

#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/sanitize/sanitize.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

const Inputs& ordinary_inputs() {
    static const Inputs inputs = {
        {"position", {0, 0, -5}},
        {"normal", {0, 0, 1}},
        {"Transform.modelView", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        {"Transform.projection", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0}},
        {"Transform.normalMatrix", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"gl_FragCoord", {0.5, 0.5, 0.5, 1}},
        {"Material.emission", {0.125, 0.125, 0.125}},
        {"Material.shininess", {8}},
        {"Material.ambient", {1, 1, 1}},
        {"Material.strength", {1}},
        {"Material.diffuse", {1, 1, 1}},
        {"Material.specular", {1, 1, 1}},
        {"Ambient.color", {0.125, 0.125, 0.125}},
        {"DirectionalLights.lights[].direction", {0, 0, 1}},
        {"DirectionalLights.lights[].color", {1, 1, 1}},
        {"PointLights.lights[].position", {0, 0, -1, 1}},
        {"PointLights.lights[].color", {1, 1, 1}},
        {"PointLights.lights[].attenuation", {1, 0, 0}},
        {"SpotLights.lights[].position", {0, 0, 0, 1}},
        {"SpotLights.lights[].color", {1, 1, 1}},
        {"SpotLights.lights[].exponent", {0}},
        {"SpotLights.lights[].attenuation", {1, 0, 0}},
        {"SpotLights.lights[].innerOneMinusCosine", {0.25}},
        {"SpotLights.lights[].outerOneMinusCosine", {0.5}},
        {"SpotLights.lights[].axis", {0, 0, -1}},
        {"Toon.levels", {4}},
        {"Fog.color", {0.5, 0.25, 0.75}},
        {"Fog.density", {0.1}},
        {"Fog.start", {1}},
        {"Fog.end", {9}},
        {"DepthOffset.offset", {0.125}},
        // Every point is looked up in the middle of a directional or spot light's map, and on a point light's
        // +x.
        {"Shadows.shadows[].toMap", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0.5, 0.5, 1}},
        {"Shadows.shadows[].layer", {0}},
        {"Shadows.shadows[].depthScale", {0.5}},
        {"Shadows.shadows[].depthShift", {0}},
        {"Shadows.shadows[].spread", {0.5}},
        {"shadowMaps", {1}},
        {"color", {1, 1, 1, 1}},
        {"opacityMap", {1}},
        {"Cutout.threshold", {0.5}},
        {"gl_FrontFacing", {1}},
        {"ToonThresholds.thresholds", {0.95, 0.5, 0.25}},
        {"ToonThresholds.tones", {1, 0.625, 0.375}},
        {"DirectionalOrPointLights.lights[].position", {0, 0, 1, 0}},
        {"DirectionalOrPointLights.lights[].color", {1, 1, 1}},
        {"DirectionalOrPointLights.lights[].attenuation", {1, 0, 0}},
        {"LightAmbients.colors[]", {0.25, 0.25, 0.25}},
        {"Hemisphere.up", {0, 1, 0}},
        {"Hemisphere.sky", {0.5, 0.5, 0.5}},
        {"Hemisphere.ground", {0.25, 0.25, 0.25}},
        {"Harmonics.toProbe", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"Harmonics.coefficients[]", {0, 0, 0}},
        {"Harmonics.scale", {1}},
        {"Materials.rows[].ambient", {1, 1, 1}},
        {"Materials.rows[].diffuse", {1, 1, 1}},
        {"Materials.rows[].specular", {1, 1, 1}},
        {"Materials.rows[].shininess", {8}},
        {"Materials.rows[].strength", {1}},
        {"ImageLight.color", {0.125, 0.125, 0.125}},
        {"ImageLight.weight", {0.5}},
        {"ImageLight.toMap", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"Reflection.weight", {0.5}},
        {"Reflection.toMap", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"diffuseMap", {0.25, 0.5, 1, 1}},
        {"specularMap", {0.25, 0.5, 1, 1}},
        {"texcoord", {0.5, 0.5}},
        {"tangent", {1, 0, 0, 1}},
        {"normalMap", {0.5, 0.5, 1, 1}},
        {"environmentBrdfTable", {0.7, 0.1, 0, 1}},
        {"Reflection.roughestLevel", {0}},
        {"Material.baseColor", {0.5, 0.5, 0.5, 1}},
        {"Material.metallic", {0.5}},
        {"Material.roughness", {0.5}},
        {"Material.dielectric", {0.04, 0.04, 0.04}},
        {"Material.dielectricEdge", {1}},
        {"Material.anisotropy", {0.5}},
        {"Material.anisotropyDirection", {1, 0}},
        {"Material.clearcoat", {1}},
        {"Material.clearcoatRoughness", {0.25}},
        {"Iridescence.factor", {1}},
        {"Iridescence.ior", {1.3}},
        {"Iridescence.thickness", {400}},
        {"Material.normalScale", {1}},
        {"Material.occlusionStrength", {1}},
    };
    return inputs;
}

/// "PointLights.lights[2].color" without the number.
std::string without_number(std::string name) {
    const auto open = name.find('[');
    const auto close = name.find(']');
    return open == std::string::npos ? name : name.erase(open + 1, close - open - 1);
}

/// One invocation of the stage; values of the vertex stage stand between ordinary ones and the case's.
evaluate::Invocations invocation(const evaluate::Program& program, const Inputs& handed_on,
                                 const Inputs& inputs) {
    evaluate::Invocations invocations;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            for (const Inputs* source : {&ordinary_inputs(), &handed_on, &inputs})
                for (const std::string& name : {without_number(port.name), port.name})
                    if (const auto found = source->find(name); found != source->end())
                        invocations.values[port.name] = as_floats(found->second);
    for (const evaluate::ImagePort& image : program.images)
        for (const Inputs* source : {&ordinary_inputs(), &inputs})
            if (const auto found = source->find(image.name); found != source->end())
                invocations.images[image.name] = [numbers = as_floats(found->second)](const auto& request) {
                    std::array<double, 4> color{};
                    color.fill(numbers.back());  // one number is that of every channel
                    std::copy_n(numbers.begin(), std::min<std::size_t>(numbers.size(), 4), color.begin());
                    return evaluate::answer(color, request);
                };
    return invocations;
}

evaluate::Outputs run(const evaluate::Program& program, const evaluate::Invocations& invocations, Mode mode) {
    const Result<evaluate::Outputs> outputs =
        mode ? evaluate::run<float>(program, invocations, sanitize::options_of(*mode))
             : evaluate::run<double>(program, invocations);
    EXPECT_TRUE(outputs);
    return outputs ? *outputs : evaluate::Outputs{};
}

std::vector<std::string> traps_of(const evaluate::Program& program, const evaluate::Invocations& invocations,
                                  Mode mode) {
    std::vector<std::string> texts;
    if (!mode) return texts;
    const auto found = sanitize::find_traps(program, invocations, *mode);
    EXPECT_TRUE(found);
    for (const sanitize::Finding& finding : *found)
        texts.push_back(fmt::format("{}:{}: {}", finding.place.file, finding.place.line, to_text(finding)));
    return texts;
}

Shaded shaded_by(const evaluate::Program& fragment, const evaluate::Invocations& invocations, Mode mode) {
    const evaluate::Outputs outputs = run(fragment, invocations, mode);
    Shaded shaded;
    shaded.is_discarded = outputs.discarded.front();
    const auto color = outputs.values.find("fragmentColor");
    EXPECT_NE(color, outputs.values.end());
    for (std::size_t i = 0; i < 4 && color != outputs.values.end(); ++i) shaded.color[i] = color->second[i];
    if (const auto depth = outputs.values.find("gl_FragDepth"); depth != outputs.values.end())
        shaded.depth = depth->second.front();
    return shaded;
}

/// One stage alone, as a permutation of only this.
Composition alone(const Composition& composition, int stage) {
    const Stage& source = composition.stages[static_cast<std::size_t>(stage)];
    Composition result = composition;
    result.stages = {source};
    Permutation permutation{composition.permutations.front().key};
    permutation.stages[source.kind] = 0;
    result.permutations = {std::move(permutation)};
    return result;
}

std::vector<std::uint32_t> words_of(const Family& family, const Composition& composition, int stage,
                                    bool with_lines) {
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = with_lines;
    const Validated validated = validate(family, alone(composition, stage), options);
    EXPECT_EQ(exit_status(validated.diagnostics), 0);
    return validated.stages.front().spirv;
}

/// Kept for whoever asks for the same text next.
const evaluate::Program& compiled(const Family& family, const Composition& composition, int stage) {
    static std::map<std::string, evaluate::Program> programs;
    const Stage& source = composition.stage(stage);
    std::string text = family.name;
    for (const int piece : source.pieces) text += "\n" + composition.piece(piece).path;
    text += "\n" + source_of(composition, source);
    const auto known = programs.find(text);
    if (known != programs.end()) return known->second;
    Result<evaluate::Program> program = evaluate::decode(words_of(family, composition, stage, true));
    EXPECT_TRUE(program);
    return programs.emplace(std::move(text), program ? std::move(*program) : evaluate::Program{})
        .first->second;
}

/// The project's pieces and family files, read once: rows compose by the hundred.
const MemoryFileSystem& project_files() {
    static const MemoryFileSystem files([] {
        const DiskFileSystem disk;
        std::map<std::string, std::string, std::less<>> texts;
        for (const std::string folder : {"shader_lib/", "templates/"})
            for (const std::string& file : disk.files_below(GOBO_SOURCE_DIR "/" + folder))
                texts[folder + file] = disk.read(GOBO_SOURCE_DIR "/" + folder + file).value();
        return texts;
    }());
    return files;
}

const Result<Family>& family_named(const std::string& name) {
    static std::map<std::string, Result<Family>> families;
    const auto known = families.find(name);
    if (known != families.end()) return known->second;
    const FindFamily find = [](const std::string& other) -> Result<FamilyText> {
        const std::string path = "templates/" + other + ".toml";
        GOBO_TRY(std::string text, project_files().read(path));
        return FamilyText{std::move(text), path};
    };
    const auto read = [&]() -> Result<Family> {
        GOBO_TRY(const FamilyText text, find(name));
        return read_family(text.text, text.path, find);
    };
    return families.emplace(name, read()).first->second;
}

LitUnderTest::Composed composed_of(const std::string& where, const std::vector<std::string>& over,
                                   const Overlay& overlay, int cover, const std::string& of) {
    LitUnderTest::Composed result;
    MemoryFileSystem memory;
    for (const auto& [path, text] : overlay) EXPECT_TRUE(memory.write("overlay/" + path, text));
    SearchPath search;
    search.add(memory, "overlay", "", false);
    search.add(project_files(), "shader_lib", "shader_lib/", false);
    search.add(project_files(), "templates", "templates/", false);
    const Result<Family>& family = family_named(of);
    EXPECT_TRUE(family);
    if (!family) return result;
    result.family = *family;
    Selection selection;
    selection.all = cover == 0;
    selection.cover = cover;
    selection.over = over;
    selection.where = "directional + point + spot <= 1" + (where.empty() ? "" : " && (" + where + ")");
    selection.excluded = true;  // who names such a value has its guards, too
    const auto keys = select(result.family, selection, "450");
    EXPECT_TRUE(keys) << where << ": " << (keys ? "" : to_text(keys.error().front()));
    if (!keys) return result;
    Result<Composition> composition = compose(result.family, *keys, search, Dialect::own);
    EXPECT_TRUE(composition);
    if (!composition) return result;
    result.composition = std::move(*composition);
    result.programs.resize(result.composition.stages.size());
    return result;
}

}  // namespace

std::vector<double> as_floats(std::vector<double> numbers) {
    for (double& number : numbers) number = static_cast<double>(static_cast<float>(number));
    return numbers;
}

LitUnderTest::LitUnderTest(const std::string& where, const std::vector<std::string>& over,
                           const Overlay& overlay, int cover, const std::string& of) {
    static std::map<std::tuple<std::string, std::vector<std::string>, Overlay, int, std::string>,
                    std::shared_ptr<Composed>>
        all;
    std::shared_ptr<Composed>& composed = all[{where, over, overlay, cover, of}];
    if (!composed) composed = std::make_shared<Composed>(composed_of(where, over, overlay, cover, of));
    composed_ = composed;
}

std::vector<std::uint32_t> LitUnderTest::spirv(std::size_t permutation, StageKind kind) const {
    return words_of(composed_->family, composition(), composition().permutations[permutation].stages[kind],
                    false);
}

const evaluate::Program& LitUnderTest::program(int stage) const {
    const evaluate::Program*& program = composed_->programs[static_cast<std::size_t>(stage)];
    if (program == nullptr) program = &compiled(composed_->family, composition(), stage);
    return *program;
}

std::string LitUnderTest::key(std::size_t permutation) const {
    return key_text(composed_->family, composition().permutations[permutation].key);
}

const evaluate::Program& LitUnderTest::vertex(std::size_t permutation) const {
    return program(composition().permutations[permutation].stages[StageKind::vertex]);
}

const evaluate::Program& LitUnderTest::fragment(std::size_t permutation) const {
    return program(composition().permutations[permutation].stages[StageKind::fragment]);
}

StageInputs LitUnderTest::inputs_of(std::size_t permutation, const Inputs& inputs, Mode mode) const {
    StageInputs both;
    both.vertex = invocation(vertex(permutation), {}, inputs);
    const evaluate::Outputs handed_on = run(vertex(permutation), both.vertex, mode);
    both.fragment =
        invocation(fragment(permutation), Inputs(handed_on.values.begin(), handed_on.values.end()), inputs);
    return both;
}

Shaded LitUnderTest::shade(std::size_t permutation, const Inputs& inputs, Mode mode) const {
    const StageInputs stages = inputs_of(permutation, inputs, mode);
    Shaded shaded = shaded_by(fragment(permutation), stages.fragment, mode);
    shaded.traps = traps_of(vertex(permutation), stages.vertex, mode);
    const std::vector<std::string> more = traps_of(fragment(permutation), stages.fragment, mode);
    shaded.traps.insert(shaded.traps.end(), more.begin(), more.end());
    return shaded;
}

Shaded LitUnderTest::shade_unwatched(std::size_t permutation, const Inputs& inputs, Mode mode) const {
    return shaded_by(fragment(permutation), inputs_of(permutation, inputs, mode).fragment, mode);
}

}  // namespace gobo
