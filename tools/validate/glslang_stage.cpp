#include "validate/glslang_stage.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "compose/dialect.hpp"
#include "compose/specialized_counts.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "reflect/reflect.hpp"
#include "spirv/transform.hpp"
#include "validate/declaration.hpp"
#include "validate/depth_layouts.hpp"
#include "validate/glslang_log.hpp"
#include "validate/language_rules.hpp"
#include "validate/missing_built_ins.hpp"
#include "validate/missing_ends.hpp"
#include "validate/module_rules.hpp"
#include "validate/names_by_place.hpp"
#include "validate/old_versions.hpp"
#include "validate/plain_messages.hpp"
#include "validate/stage_rules.hpp"
#include "validate/switch_rules.hpp"
#include "validate/syntax_tree.hpp"
#include "validate/vulkan_rules.hpp"

namespace gobo {
namespace {

EShMessages rules(bool for_spirv, bool is_vulkan) {
    return static_cast<EShMessages>((for_spirv ? EShMsgSpvRules : EShMsgDefault) |
                                    (is_vulkan ? EShMsgVulkanRules : EShMsgDefault));
}

EShLanguage language_of(StageKind kind) {
    static_assert(static_cast<int>(StageKind::compute) == EShLangCompute);  // the pipeline's order
    return static_cast<EShLanguage>(kind);
}

/// The first versions that have a stage, and the end of the extensions by which earlier ones do.
struct Since {
    int desktop;
    int es;
    std::string_view extension;
};
constexpr Since kTessellation = {400, 320, "_tessellation_shader"};
constexpr PerStage<Since> kSince = {
    {{{}, kTessellation, kTessellation, {150, 320, "_geometry_shader"}, {}, {430, 310, "_compute_shader"}}}};

bool has_errors(const Diagnostics& diagnostics) {
    return exit_status(diagnostics) != 0;
}

/// Bindings that the source states, by name; unstated ones are -1. Asked of glslang before it assigns the
/// others. It does not list what no function reads.
std::map<std::string, int, std::less<>> stated_bindings(const glslang::TProgram& program) {
    std::map<std::string, int, std::less<>> bindings;
    const auto add = [&](const std::string& name, int binding) {
        bindings.try_emplace(std::string(root_of(name)), binding);
    };
    for (int i = 0; i < program.getNumUniformBlocks(); ++i)
        add(program.getUniformBlock(i).name, program.getUniformBlock(i).getBinding());
    for (int i = 0; i < program.getNumBufferBlocks(); ++i)
        add(program.getBufferBlock(i).name, program.getBufferBlock(i).getBinding());
    for (int i = 0; i < program.getNumUniformVariables(); ++i)
        if (program.getUniform(i).index < 0)
            add(program.getUniform(i).name, program.getUniform(i).getBinding());
    return bindings;
}

GlTypes gl_types(const glslang::TProgram& program) {
    GlTypes types;
    for (int i = 0; i < program.getNumUniformVariables(); ++i)
        types[program.getUniform(i).name] = program.getUniform(i).glDefineType;
    for (int i = 0; i < program.getNumBufferVariables(); ++i)
        types[program.getBufferVariable(i).name] = program.getBufferVariable(i).glDefineType;
    return types;
}

/// Takes away the bindings that the source does not state: glslang gives those as 0.
template <class Bound>
void forget_assigned(std::vector<Bound>& list, const std::map<std::string, int, std::less<>>& stated,
                     const std::vector<const Piece*>& pieces) {
    for (Bound& bound : list) {
        const std::string_view root = root_of(bound.name);
        const auto found = stated.find(root);
        // What is neither 0 nor counted on from 0 is stated.
        if (found != stated.end() ? found->second < 0
                                  : bound.usage.unused && (bound.binding == 0 || root != bound.name) &&
                                        !declaration_of(root, "binding", pieces).mentions_hint)
            bound.binding = -1;
    }
}

bool lacks_locations(const Interface& interface) {
    const auto lacks = [](const auto& list) {
        return std::ranges::any_of(
            list, [](int location) { return location < 0; },
            [](const auto& variable) { return variable.location; });
    };
    return lacks(interface.inputs) || lacks(interface.outputs) || lacks(interface.uniforms);
}

SpirvModule spirv_of(const glslang::TIntermediate& intermediate, const std::vector<const Piece*>& pieces,
                     bool debug_information) {
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    options.generateDebugInfo = debug_information;
    SpirvModule module;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(intermediate, module, &logger, &options);
    if (!debug_information) return module;
    std::vector<spirv::TextOfFile> texts;
    for (const Piece* const piece : pieces) texts.push_back({piece->path, piece->first_line});
    return spirv::with_lines_of_files(module, texts);
}

/// Whether a sampler is bound to 0, which may be glslang's word for nothing stated; of a block it says so.
bool may_lack_bindings(const Interface& interface, const std::vector<const Piece*>& pieces) {
    return std::ranges::any_of(interface.samplers, [&](const Sampler& sampler) {
        return sampler.binding == 0 &&
               !declaration_of(sampler.name, "SAMPLER", pieces).quoted_line.starts_with("SAMPLER(0,");
    });
}

bool is_block(std::string_view declaration) {
    return declaration.find("uniform {") != std::string_view::npos ||
           declaration.find("buffer {") != std::string_view::npos;
}

/// Whether one states component 0, and the other none.
bool differ_in_component_0(std::string_view one, std::string_view other) {
    const bool states = one.find("component=") != std::string_view::npos;
    if (states == (other.find("component=") != std::string_view::npos)) return false;
    return (states ? one : other).find("component=0") != std::string_view::npos;
}

/// Drops what no linker minds: patch variables of one type that differ in size; in OpenGL that a block's
/// instance is called as a uniform of another stage, since its name stays in its stage; component 0 that one
/// stage states; the order of a matrix where there is none, for the layouts of blocks are compared; and on
/// the desktop how the memory of images is accessed. Of one pair glslang says several lines, the last with
/// both declarations.
bool drop_what_links(Diagnostics& log, bool is_es, bool is_for_spirv) {
    const std::size_t known = log.size();
    for (auto first = log.begin(); first != log.end();) {
        auto last = first;
        while (last + 1 != log.end() && last->message.find('"') == std::string::npos) ++last;
        const std::vector<std::string> parts = split(last->message, '"');
        const auto links = [&](const Diagnostic& line) {
            const auto says = [&](std::string_view what) {
                return line.message.find(what) != std::string::npos;
            };
            // Of a patch's variables it takes the size for the number of vertices; the types are compared,
            // too.
            if (says("Array sizes must be compatible:"))
                return says("tessellation control stage:") && parts[1] == parts[3];
            if (is_for_spirv) return false;
            return (says("Types must match:") && is_block(parts[1]) != is_block(parts[3])) ||
                   (says("Layout component qualifier must match:") &&
                    differ_in_component_0(parts[1], parts[3])) ||
                   says("member layout matrix qualifier must match:") ||
                   (!is_es && says("Memory ") && says(" qualifier must match:") && !is_block(parts[1]));
        };
        const bool is_instance = first->message.ends_with("Types must match:");
        if (parts.size() > 3 && std::all_of(first, is_instance ? first + 1 : last + 1, links))
            first = log.erase(first, last + 1);
        else
            first = last + 1;
    }
    return log.size() < known;
}

/// Whether a vertex stage states #pragma STDGL invariant(all) in a version that knows it, and in which
/// glslang passes it over.
bool makes_outputs_invariant(const ActiveText& text, const GlslVersion& version) {
    constexpr std::array<std::string_view, 5> words = {"STDGL", "invariant", "(", "all", ")"};
    return version.number != 110 && version.number < 150 &&
           std::ranges::any_of(text.directives, [&](const ActiveDirective& directive) {
               return directive.word == "pragma" && std::ranges::equal(tokens_of(directive.rest), words);
           });
}

tl::unexpected<Diagnostics> glslang_fault(std::string_view log) {
    return fail(Fault::internal, fmt::format("glslang refuses a stage that it parsed: {}", log));
}

/// The faults of the input where what they name is declared: "block 'B' takes more than 2 GiB".
tl::unexpected<Diagnostics> placed(Diagnostics found, const std::vector<const Piece*>& pieces) {
    for (Diagnostic& diagnostic : found) {
        const std::vector<std::string> parts = split(diagnostic.message, '\'');
        const Declaration at = declaration_of(parts.size() > 1 ? parts[1] : "", "", pieces);
        if (diagnostic.fault != Fault::input) continue;
        diagnostic.place = at.place;
        diagnostic.quoted_line = at.quoted_line;
    }
    return tl::unexpected(std::move(found));
}

}  // namespace

Diagnostics GlslangStage::parse_as(const std::string& prologue, bool for_spirv, bool map_bindings) {
    // Its tables are kept for the next composition.
    [[maybe_unused]] static const bool is_initialized = glslang::InitializeProcess();
    shader_ = std::make_unique<Shader>(language_of(kind_));
    MissingBuiltIns built_ins = for_spirv ? missing_built_ins(kind_, prologue, pieces_) : MissingBuiltIns{};
    if (!is_spirv(dialect_)) built_ins.declarations += driver_declarations(prologue, pieces_);
    const bool is_shipped = !is_spirv(dialect_);
    const auto seen_by_drivers = [&](const std::string& text) {
        std::string seen = is_shipped ? without_own_layouts(with_driver_macros(text)) : text;
        if (takes_depth_layouts_) seen = without_depth_layouts(std::move(seen));
        return without_formats_ ? without_formats(seen) : seen;
    };
    shader_->prologue = seen_by_drivers(prologue) +
                        (without_formats_ ? "#extension GL_EXT_shader_image_load_formatted : enable\n" : "") +
                        built_ins.declarations;
    for (const Piece* piece : pieces_) {
        const bool is_prologue = piece == pieces_.front();
        const bool is_changed = !built_ins.renamed.empty() || without_formats_ || takes_depth_layouts_ ||
                                (is_shipped && !is_prologue && read_.of(*piece).differs_from_drivers);
        const std::string& text =
            is_prologue ? shader_->prologue
            : !is_changed
                ? piece->text
                : shader_->renamed.emplace_back(seen_by_drivers(substituted(piece->text, built_ins.renamed)));
        shader_->texts.push_back(text.data());
        shader_->lengths.push_back(static_cast<int>(text.size()));
        shader_->numbers.push_back(std::to_string(shader_->numbers.size()));
    }
    for (const std::string& number : shader_->numbers) shader_->names.push_back(number.c_str());
    glslang::TShader& shader = shader_->shader;
    shader.setStringsWithLengthsAndNames(shader_->texts.data(), shader_->lengths.data(),
                                         shader_->names.data(), static_cast<int>(shader_->texts.size()));
    const bool is_vulkan = dialect_ == Dialect::vulkan;
    if (is_vulkan) {
        shader.setEnvInput(glslang::EShSourceGlsl, language_of(kind_), glslang::EShClientVulkan, 100);
        shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_0);
        shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    } else if (for_spirv) {
        shader.setEnvInput(glslang::EShSourceGlsl, language_of(kind_), glslang::EShClientOpenGL, 100);
        shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
        shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    }
    shader.setAutoMapLocations(!is_spirv(dialect_));
    shader.setAutoMapBindings(map_bindings);
    bindings_mapped_ = map_bindings;
    const auto messages = static_cast<EShMessages>(rules(for_spirv, is_vulkan) | further_messages_);
    const bool is_fine = shader.parse(GetDefaultResources(), 110, false, messages);
    if (is_fine && version_of(prologue).es) precisions_ = precisions_of(shader.getInfoDebugLog());
    const Place place{pieces_.back()->path, 0, 0};
    Diagnostics found = with_missing_ends(diagnostics_of_log(shader.getInfoLog(), pieces_, place), pieces_);
    if (!found.empty())
        found = with_macros(std::move(found), active_text(pieces_, dialect_, read_).directives);
    for (Diagnostic& diagnostic : found) {
        make_strict(diagnostic, prologue, (further_messages_ & EShMsgRelaxedErrors) != 0);
        name_built_ins(diagnostic);
    }
    if (is_fine || has_errors(found)) return found;
    found = diagnostics_of_log(shader.getInfoLog(), pieces_, place, true);
    if (has_errors(found)) return found;
    return fail(Fault::internal, "glslang refuses a stage without saying why").value();
}

Diagnostics GlslangStage::parse_as_version(const std::string& prologue) {
    const GlslVersion version = version_of(prologue);
    const Since& since = kSince[kind_];
    const int first = version.es ? since.es : since.desktop;
    if (version.number < first &&
        (since.extension.empty() || prologue.find(since.extension) == std::string::npos))
        return fail(Place{pieces_.back()->path}, "",
                    fmt::format("a {} stage needs GLSL {}{}, but this is {}", name_of(kind_),
                                version.es ? "ES " : "", first, version.number),
                    fmt::format("state #version {}{}, or build it for another dialect", first,
                                version.es ? " es" : ""))
            .value();
    if (makes_spirv(version)) {
        if (is_spirv(dialect_)) return parse_as(prologue, true, false);
        const bool can_state_bindings = version.number >= (version.es ? 310 : 420);
        const Diagnostics found = parse_as(prologue, true, !can_state_bindings);
        // That a binding is not stated is an error unless glslang may choose it.
        return has_errors(found) && can_state_bindings ? parse_as(prologue, true, true) : found;
    }
    const Diagnostics own = parse_as(prologue, false, false);
    if (has_errors(own)) return own;
    const Diagnostics raised = parse_as(raised_for_spirv(prologue, renamed_functions()), true, true);
    if (!has_errors(raised)) return own;
    const bool is_right =
        has_old_functions(version) &&
        (!has_errors(parse_as(raised_for_spirv(prologue, old_functions(kind_)), true, true)) ||
         // The last version whose core still has gl_FragColor, attribute and varying.
         (version.number > 410 &&
          !has_errors(parse_as(raised_for_spirv(prologue, renamed_functions(), "410 core"), true, true))));
    return is_right ? own : explained(raised, version);
}

Diagnostics GlslangStage::parse() {
    without_formats_ = false;
    const std::string prologue = without_requirements(pieces_.front()->text);
    takes_depth_layouts_ = kind_ == StageKind::fragment && takes_depth_layouts(prologue);
    const bool has_switches = has_strict_switches(pieces_);
    const bool asks = asks_for_tree(pieces_, read_);
    further_messages_ = has_switches || asks ? EShMsgAST : EShMsgDefault;
    Diagnostics found = parse_by_glslang(prologue);
    // That a macro gives `defined` is an error to glslang alone; it can be told to go on.
    const bool is_relaxed = std::ranges::any_of(found, [](const Diagnostic& diagnostic) {
        return diagnostic.message.starts_with(
            "'defined' : cannot use in preprocessor expression when expanded");
    });
    if (is_relaxed) {
        further_messages_ |= EShMsgRelaxedErrors;
        found = parse_by_glslang(prologue);
    }
    without_formats_ = !is_spirv(dialect_) && are_of_formats(found);
    if (without_formats_) {
        Diagnostics without = parse_by_glslang(prologue);
        if (!has_errors(without)) found = std::move(without);
    }
    drop_consequences(found);
    if (has_errors(found)) return found;
    Diagnostics more;
    // Vulkan's language is what glslang takes.
    if (dialect_ != Dialect::vulkan) {
        const ActiveText text = active_text(pieces_, dialect_, read_);
        stated_ = stated_in(text, default_precisions(kind_, pieces_.front()->text));
        makes_invariant_ = kind_ == StageKind::vertex && makes_outputs_invariant(text, version_of(prologue));
        if (takes_depth_layouts_) depth_mode_ = depth_mode(text);
        more = check_language(kind_, pieces_, text, dialect_);
        std::ranges::move(more, std::back_inserter(found));
    }
    if (asks && !is_spirv(dialect_)) {
        more = check_calls(shader_->shader.getInfoDebugLog(), pieces_);
        std::ranges::move(more, std::back_inserter(found));
    }
    if (has_switches) {
        more = check_switches(shader_->shader.getInfoDebugLog(), pieces_);
        std::ranges::move(more, std::back_inserter(found));
    }
    return found;
}

Diagnostics GlslangStage::parse_by_glslang(const std::string& prologue) {
    const Diagnostics found = parse_as_version(prologue);
    std::set<std::string> names = taken_names(found, pieces_);
    for (std::size_t known = 0; names.size() > known;) {
        known = names.size();
        Diagnostics apart = parse_as_version(with_own_names(prologue, names));
        if (!has_errors(apart)) return apart;
        names.merge(taken_names(apart, pieces_));
    }
    return found;
}

Diagnostics link(const std::vector<GlslangStage*>& stages) {
    Diagnostics found = link_by_glslang(stages);
    const bool is_vulkan = stages.front()->dialect_ == Dialect::vulkan;
    if (is_vulkan)
        std::erase_if(found, [](const Diagnostic& said) {
            return said.message.find("different instance names") != std::string::npos;
        });
    if (!has_errors(found) || version_of(stages.front()->pieces_.front()->text).es) return found;
    // glslang compares what stages call by one name. What stands at two locations is not one, nor is to
    // Vulkan what stands at two bindings, while push constants are views of one memory: they are linked with
    // names of their own.
    std::vector<std::vector<const Piece*>> texts;
    for (const GlslangStage* const stage : stages) texts.push_back(stage->pieces_);
    const std::set<std::string> moved = names_at_two_locations(texts);
    std::deque<Piece> prologues;
    std::vector<std::unique_ptr<GlslangStage>> apart;
    std::vector<GlslangStage*> linked;
    bool is_changed = false;
    for (const GlslangStage* const stage : stages) {
        std::vector<const Piece*> pieces = stage->pieces_;
        Piece& prologue = prologues.emplace_back(*pieces.front());
        std::set<std::string> names = moved;
        if (is_vulkan) names.merge(names_of_resources(pieces));
        for (const std::string& name : names)
            prologue.text += fmt::format("#define {0} {0}_of_{1}\n", name, name_of(stage->kind_));
        is_changed = is_changed || prologue.text.size() > pieces.front()->text.size();
        pieces.front() = &prologue;
        apart.push_back(
            std::make_unique<GlslangStage>(stage->kind_, std::move(pieces), stage->dialect_, stage->read_));
        linked.push_back(apart.back().get());
    }
    if (!is_changed) return found;
    for (GlslangStage* const stage : linked)
        if (has_errors(stage->parse())) return found;
    found = link_by_glslang(linked);
    if (!has_errors(found))
        for (GlslangStage* const stage : stages) stage->parse();  // glslang keeps the error in them
    return found;
}

Diagnostics link_by_glslang(const std::vector<GlslangStage*>& stages) {
    glslang::TProgram program;
    for (GlslangStage* const stage : stages) program.addShader(&stage->shader_->shader);
    const bool is_vulkan = stages.front()->dialect_ == Dialect::vulkan;
    const bool is_fine = program.link(rules(true, is_vulkan));
    std::vector<const Piece*> earlier;
    for (std::size_t i = 0; i + 1 < stages.size(); ++i)
        earlier.insert(earlier.end(), stages[i]->pieces_.begin(), stages[i]->pieces_.end());
    Diagnostics log =
        diagnostics_of_log(program.getInfoLog(), {}, {stages.back()->pieces_.back()->path, 0, 0});
    const bool is_es = version_of(stages.front()->pieces_.front()->text).es;
    if (drop_what_links(log, is_es, is_spirv(stages.front()->dialect_)) && log.empty()) {
        for (GlslangStage* const stage : stages) stage->parse();  // glslang keeps the error in them
        return {};
    }
    Diagnostics found = with_places(std::move(log), stages.back()->pieces_, earlier);
    if (!is_fine && found.empty())
        return fail(Fault::internal, "glslang refuses to link without saying why").value();
    return found;
}

Result<ValidatedStage> GlslangStage::generate(bool debug_information, bool places_vertices) {
    glslang::TProgram program;
    program.addShader(&shader_->shader);
    const bool is_vulkan = dialect_ == Dialect::vulkan;
    if (!program.link(rules(true, is_vulkan))) {
        if (std::string_view(program.getInfoLog()).find("Missing entry point") != std::string_view::npos)
            return fail(Place{pieces_.back()->path, 0, 0}, "",
                        fmt::format("the {} stage has no main()", name_of(kind_)),
                        "write void main() in the template");
        Diagnostics found =
            with_places(diagnostics_of_log(program.getInfoLog(), {}, {pieces_.back()->path, 0, 0}), pieces_);
        if (has_errors(found)) return tl::unexpected(std::move(found));
        return glslang_fault(program.getInfoLog());
    }
    const glslang::TIntermediate& intermediate = *program.getIntermediate(language_of(kind_));
    ValidatedStage stage;
    const auto make_spirv = [&] {
        SpirvModule module = spirv_of(intermediate, pieces_, debug_information);
        return depth_mode_ ? with_depth_mode(std::move(module), *depth_mode_) : module;
    };
    stage.spirv = make_spirv();
    GOBO_TRY_DO(refuse_capabilities(stage.spirv, pieces_, dialect_));
    if (is_spirv(dialect_)) {
        GOBO_TRY(stage.spirv, spirv::with_largest_arrays(stage.spirv, count_ids(pieces_.front()->text)));
    }
    Result<spirv::Module> read = spirv::read_module(stage.spirv);
    if (!read) {
        const bool is_malformed = read.error().front().fault == Fault::internal;
        Diagnostics refused;  // spirv_type() makes types that SPIR-V does not have
        if (is_malformed) refused = check_module(stage.spirv, environment_of(dialect_), pieces_);
        return has_errors(refused) ? tl::unexpected(std::move(refused))
                                   : placed(std::move(read).error(), pieces_);
    }
    const spirv::Module& module = *read;
    const spirv::Usage usage = spirv::usage_of(module);
    Result<Interface> interface = reflect_stage(module, usage, is_vulkan ? Api::vulkan : Api::opengl);
    if (!interface) return placed(std::move(interface).error(), pieces_);
    stage.interface = *std::move(interface);
    set_precisions(stage.interface, precisions_);
    set_stated(stage.interface, stated_);
    if (makes_invariant_)
        for (Variable& output : stage.interface.outputs) output.interpolation.invariant = true;
    std::erase_if(stage.interface.uniforms,
                  [](const Uniform& uniform) { return is_missing_built_in(uniform.name); });
    stage.diagnostics = check_stage(module, usage, stage.interface, pieces_, places_vertices, dialect_);
    if (is_vulkan)
        std::ranges::move(check_vulkan(kind_, stage.interface, pieces_),
                          std::back_inserter(stage.diagnostics));
    const bool asks_for_bindings =
        !is_spirv(dialect_) && (bindings_mapped_ || may_lack_bindings(stage.interface, pieces_));
    if (asks_for_bindings || may_hold_bools(stage.interface)) {
        program.buildReflection(EShReflectionAllBlockVariables | EShReflectionSharedStd140UBO |
                                EShReflectionSeparateBuffers);
        stage.interface = restore_bools(std::move(stage.interface), gl_types(program));
    }
    if (asks_for_bindings) {
        const auto stated = stated_bindings(program);
        forget_assigned(stage.interface.blocks, stated, pieces_);
        forget_assigned(stage.interface.storage_blocks, stated, pieces_);
        forget_assigned(stage.interface.samplers, stated, pieces_);
    }
    if (!is_spirv(dialect_) && (bindings_mapped_ || lacks_locations(stage.interface))) {
        is_changed_ = true;
        if (!program.mapIO()) return glslang_fault(program.getInfoLog());
        stage.spirv = make_spirv();
    }
    return stage;
}

}  // namespace gobo
