#include "validate/glslang_stage.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "compose/dialect.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "reflect/reflect.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/language_rules.hpp"
#include "validate/missing_ends.hpp"
#include "validate/plain_messages.hpp"
#include "validate/stage_rules.hpp"
#include "validate/tree_rules.hpp"

namespace gobo {
namespace {

EShMessages rules(bool for_spirv, bool are_relaxed) {
    return static_cast<EShMessages>((for_spirv ? EShMsgSpvRules : EShMsgDefault) |
                                    (are_relaxed ? EShMsgRelaxedErrors : EShMsgDefault));
}

/// The texture functions of before GLSL 1.30, which carried their sampler's type in their name; those of
/// shadows gave four components.
std::string renamed_functions() {
    std::string text;
    for (const char* shape : {"1D", "2D", "3D", "Cube", "2DRect"})
        for (const char* kind : {"", "Proj", "Lod", "ProjLod"})
            text += fmt::format("#define texture{0}{1} texture{1}\n", shape, kind);
    for (const char* shape : {"1D", "2D"}) {
        for (const char* kind : {"", "Proj"}) {
            text += fmt::format("#define shadow{0}{1}(s, p) vec4(texture{1}(s, p))\n", shape, kind);
            text +=
                fmt::format("#define shadow{0}{1}Lod(s, p, l) vec4(texture{1}Lod(s, p, l))\n", shape, kind);
        }
    }
    return text;
}

/// The same as functions, for shaders that call something else `texture`: they are read before that.
std::string old_functions(StageKind stage) {
    std::string text;
    const auto add = [&](std::string_view name, std::string_view sampler, std::string_view place,
                         std::string_view kind) {
        const bool is_shadow = name.starts_with("shadow");
        const auto add_call = [&](std::string_view lod, std::string_view more, std::string_view value) {
            const std::string call = fmt::format("texture{}{}(s, p{})", kind, lod, value);
            text += fmt::format("vec4 {}{}{}({} s, {} p{}) {{ return {}; }}\n", name, kind, lod, sampler,
                                place, more, is_shadow ? "vec4(" + call + ")" : call);
        };
        add_call("", "", "");
        if (stage == StageKind::fragment) add_call("", ", float b", ", b");
        add_call("Lod", ", float l", ", l");
    };
    add("texture1D", "sampler1D", "float", "");
    add("texture2D", "sampler2D", "vec2", "");
    add("texture3D", "sampler3D", "vec3", "");
    add("textureCube", "samplerCube", "vec3", "");
    for (const char* place : {"vec2", "vec4"}) add("texture1D", "sampler1D", place, "Proj");
    for (const char* place : {"vec3", "vec4"}) add("texture2D", "sampler2D", place, "Proj");
    add("texture3D", "sampler3D", "vec4", "Proj");
    for (const char* shape : {"1D", "2D"}) {
        add(fmt::format("shadow{}", shape), fmt::format("sampler{}Shadow", shape), "vec3", "");
        add(fmt::format("shadow{}", shape), fmt::format("sampler{}Shadow", shape), "vec4", "Proj");
    }
    return text;
}

/// Behind the names of functions that glslang has and the shader's version has not.
constexpr std::string_view kOwnName = "_of_the_shader";

/// Functions that every version of OpenGL ES has: a shader may not define one of the same name.
constexpr std::string_view kEsFunctions =
    " radians degrees sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh pow exp log exp2 log2 sqrt "
    "inversesqrt abs sign floor trunc round roundEven ceil fract mod modf min max clamp mix step smoothstep "
    "isnan "
    "isinf floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat packSnorm2x16 unpackSnorm2x16 "
    "packUnorm2x16 unpackUnorm2x16 packHalf2x16 unpackHalf2x16 length distance dot cross normalize "
    "faceforward "
    "reflect refract matrixCompMult outerProduct transpose determinant inverse lessThan lessThanEqual "
    "greaterThan "
    "greaterThanEqual equal notEqual any all not textureSize texture textureProj textureLod textureOffset "
    "texelFetch texelFetchOffset textureProjOffset textureLodOffset textureProjLod textureProjLodOffset "
    "textureGrad textureGradOffset textureProjGrad textureProjGradOffset dFdx dFdy fwidth ";

/// The functions of the shader's own, in OpenGL ES 3.00 or below, that glslang takes for built-in ones of
/// later versions or extensions, by its errors. Names that are members of structs too are left out:
/// reflection would show another one.
std::set<std::string> taken_names(const Diagnostics& errors, const std::vector<const Piece*>& pieces) {
    std::set<std::string> names;
    const GlslVersion version = version_of(pieces.front()->text);
    if (!version.es || version.number > 300) return names;
    for (const Diagnostic& error : errors) {
        const std::size_t end = error.message.find("' : ");
        if (!error.message.starts_with('\'') || end == std::string::npos) continue;
        const std::string_view rest = std::string_view(error.message).substr(end + 4);
        if (rest.starts_with("function name is redeclaration") ||
            rest.starts_with("redefinition of built-in"))
            names.insert(error.message.substr(1, end - 1));
    }
    std::erase_if(names, [&](const std::string& name) {
        return kEsFunctions.find(fmt::format(" {} ", name)) != std::string_view::npos ||
               std::ranges::any_of(pieces, [&](const Piece* piece) {
                   return piece->text.find("." + name) != std::string::npos;
               });
    });
    return names;
}

/// The prologue with macros that keep the shader's own names apart from glslang's.
std::string with_own_names(std::string prologue, const std::set<std::string>& names) {
    for (const std::string& name : names) prologue += fmt::format("#define {0} {0}{1}\n", name, kOwnName);
    return prologue;
}

/// Whether glslang makes SPIR-V of the version as it is.
bool makes_spirv(const GlslVersion& version) {
    return version.number >= (version.es ? 310 : 330) && version.profile != "compatibility";
}

/// Whether the version has the texture functions that carry their sampler's type in their name.
bool has_old_functions(const GlslVersion& version) {
    return version.es ? version.number < 300 : version.number < 150 || version.profile == "compatibility";
}

/// The lowest version that has what this one has and of which glslang makes SPIR-V.
std::string raised_version(const GlslVersion& version) {
    // ES 100 goes with the desktop's: 310 es has no attribute and varying, 330 core still has.
    if (version.es && version.number != 100) return "310 es";
    return fmt::format("{} core", std::max(version.number, 330));
}

/// The prologue with its version raised, and the old functions behind that.
std::string raised_for_spirv(std::string_view prologue, const std::string& functions,
                             const std::string& raised = "") {
    const GlslVersion version = version_of(prologue);
    const auto end = prologue.find('\n');
    const std::string_view rest =
        prologue.starts_with("#version") && end != std::string_view::npos ? prologue.substr(end) : "\n";
    return fmt::format("#version {}{}{}", raised.empty() ? raised_version(version) : raised,
                       has_old_functions(version) ? "\n" + functions : "", rest);
}

/// glslang has read on to the next line, or further, where it finds a directive wrong: the directive's line.
int line_of_directive(std::string_view message, const Piece& piece, int line) {
    const std::string_view word = message.starts_with("'#extension'")                ? "extension"
                                  : message.starts_with("'preprocessor evaluation'") ? "if"
                                                                                     : "";
    for (int above = line; !word.empty() && above > 0; --above) {
        const std::vector<std::string_view> tokens = tokens_of(line_of(piece, above));
        if (tokens.size() > 1 && tokens[0] == "#" &&
            (tokens[1] == word || (word == "if" && tokens[1] == "elif")))
            return above;
    }
    return line;
}

/// Moves `path:12: rest` of one of the pieces to its place. Paths may hold colons, so they are compared, not
/// searched for.
void locate(Diagnostic& diagnostic, const std::vector<const Piece*>& pieces) {
    const std::string message = diagnostic.message;
    for (const Piece* piece : pieces) {
        if (!message.starts_with(piece->path + ":")) continue;
        int line = 0;
        const char* end = message.data() + message.size();
        const auto parsed = std::from_chars(message.data() + piece->path.size() + 1, end, line);
        if (parsed.ec != std::errc{} || parsed.ptr == end || *parsed.ptr != ':') continue;
        diagnostic.message = trim({parsed.ptr + 1, end});
        line = line_of_directive(diagnostic.message, *piece, line);
        // A generated piece carries the lines of the file it comes from only where it stands for one.
        put_at(diagnostic, *piece, line);
        if (!diagnostic.quoted_line.empty()) return;  // else another piece of the same file may hold it
    }
}

/// Extensions that drivers have and glslang does not know; what they bring is in the versions that glslang
/// checks by, or is told where it is used.
constexpr std::array<std::string_view, 13> kUnknownToGlslang = {
    "GL_ARB_arrays_of_arrays",     "GL_ARB_compatibility",    "GL_ARB_conservative_depth",
    "GL_AMD_conservative_depth",   "GL_ARB_cull_distance",    "GL_ARB_draw_buffers",
    "GL_ARB_ES3_1_compatibility",  "GL_ARB_shader_precision", "GL_ARB_fragment_layer_viewport",
    "GL_ARB_texture_query_levels", "GL_EXT_texture_array",    "GL_AMD_vertex_shader_layer",
    "GL_EXT_clip_cull_distance"};

/// The prologue for glslang: it refuses to require what it does not know.
std::string without_requirements(std::string prologue) {
    for (const std::string_view extension : kUnknownToGlslang) {
        const std::string required = fmt::format("#extension {} : require\n", extension);
        if (const auto at = prologue.find(required); at != std::string::npos)
            prologue.replace(at, required.size(), fmt::format("#extension {} : enable\n", extension));
    }
    return prologue;
}

/// Makes errors of what glslang only warns of, although the specification refuses it and drivers do.
void make_strict(Diagnostic& diagnostic, std::string_view prologue, bool is_relaxed) {
    const auto says = [&](std::string_view text) { return diagnostic.message.starts_with(text); };
    if (diagnostic.severity != Severity::warning) return;
    if (says("'return' : type conversion on return values was not explicitly allowed until") &&
        prologue.find("GL_ARB_shading_language_420pack") == std::string_view::npos) {
        diagnostic.severity = Severity::error;
        diagnostic.message = "'return' of another type than the function's: GLSL converts it from 4.20 on";
        diagnostic.help = "write the value in the function's type, as 1.0 for a float, or state #version 420";
    }
    // Of what glslang's relaxed rules let pass, drivers take but one.
    constexpr std::array<std::string_view, 6> relaxed = {"The following extension must be enabled",
                                                         "undefined macro in expression",
                                                         "unexpected tokens following",
                                                         "requires declaration of default precision",
                                                         "(un)defined",
                                                         "non-constant global initializer"};
    for (const std::string_view text : relaxed)
        if (is_relaxed && diagnostic.message.find(text) != std::string::npos)
            diagnostic.severity = Severity::error;
    if (says("'switch' : last case/default label not followed by statements")) {
        diagnostic.severity = Severity::error;
        diagnostic.help = "write break; behind it";
    }
}

/// Adds what glslang leaves out: which extension, which numbers.
void explain(Diagnostic& diagnostic) {
    if (diagnostic.severity == Severity::warning &&
        diagnostic.message.starts_with("'#extension' : extension not supported"))
        diagnostic.help =
            "glslang, by which shaders are checked, does not know it: what it brings is refused";
    if (diagnostic.message.starts_with("'depth layout qualifier' : not supported for this version"))
        diagnostic.help = "write '#extension GL_ARB_conservative_depth : require', or raise #version to 420";
    if (diagnostic.message.starts_with("'depth layout qualifier' : not supported with this profile"))
        diagnostic.help = "OpenGL ES has it by GL_EXT_conservative_depth only, which glslang does not know";
    if (diagnostic.message.starts_with("'subroutine' : not allowed") ||
        diagnostic.message.starts_with("'subroutine' : feature not yet implemented")) {
        diagnostic.message = "'subroutine' : SPIR-V, by which shaders are checked, has no subroutines";
        diagnostic.help =
            "make each subroutine uniform a feature: [features.NAME] with define = \"UNIFORM\" and values = "
            "[\"FUNCTION\", \"FUNCTION\"]";
    }
    // The alignment of an array, a struct or a matrix is left to the reader.
    if (!diagnostic.message.starts_with("'offset' : must be a multiple of")) return;
    const std::vector<std::string_view> tokens = tokens_of(diagnostic.quoted_line);
    const auto at = std::ranges::find(tokens, "offset");
    if (tokens.end() - at < 5 || at[1] != "=" || at[3] != ")") return;
    const std::optional<GlslType> type = glsl_type(at[4]);
    if (type && !type->is_matrix())
        diagnostic.message += fmt::format(": {} is not a multiple of {}, to which a {} is aligned", at[2],
                                          type->column_alignment(), at[4]);
}

/// Reads the lines of an info log. A message that names one of the pieces gets that piece's path and line,
/// with the line quoted; the rest (those of linking) stand at `otherwise`.
/// `all`: those too that as a rule follow from others.
Diagnostics diagnostics_of_log(std::string_view log, const std::vector<const Piece*>& pieces,
                               const Place& otherwise, bool all = false) {
    constexpr std::string_view given_up = "'' : compilation terminated";
    // Where glslang gives up, an #extension seems to lack its line's end.
    const bool gave_up = log.find(given_up) != std::string_view::npos;
    const auto says_nothing = [&](std::string_view line) {
        const auto holds = [&](std::string_view text) { return line.find(text) != std::string_view::npos; };
        return holds(given_up) || holds(" compilation errors.") || holds("No code generated.") ||
               (!all && holds("'subroutine' : feature not yet implemented")) ||
               (!all && gave_up && holds("'#extension' : extra tokens"));
    };
    Diagnostics diagnostics;
    for (const std::string& full_line : split(log, '\n')) {
        const std::string_view line = full_line;
        if (says_nothing(line)) continue;
        const bool is_error = line.starts_with("ERROR: ");
        if (is_error || line.starts_with("WARNING: ")) {
            Diagnostic& diagnostic = diagnostics.emplace_back();
            diagnostic.severity = is_error ? Severity::error : Severity::warning;
            diagnostic.place = otherwise;
            diagnostic.message = trim(line.substr(line.find(' ')));
            locate(diagnostic, pieces);
        } else if (!diagnostics.empty()) {  // a message that goes on
            diagnostics.back().message += fmt::format(" {}", line);
        }
    }
    // The composer has seen to the ends of all conditions: another error keeps glslang from finding one.
    const auto is_missing_end = [](const Diagnostic& diagnostic) {
        return diagnostic.message == "'' : missing #endif";
    };
    if (!std::ranges::all_of(diagnostics, is_missing_end)) std::erase_if(diagnostics, is_missing_end);
    for (Diagnostic& diagnostic : diagnostics) explain(diagnostic);
    return diagnostics;
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

SpirvModule spirv_of(const glslang::TIntermediate& intermediate, bool debug_information) {
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    options.generateDebugInfo = debug_information;
    SpirvModule module;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(intermediate, module, &logger, &options);
    return module;
}

/// The shader is right by its own version's rules, so the errors of the raised one need a word.
Diagnostics explained(Diagnostics diagnostics, const GlslVersion& version) {
    std::erase_if(diagnostics, [](const Diagnostic& found) { return found.severity != Severity::error; });
    for (Diagnostic& diagnostic : diagnostics) {
        diagnostic.help = fmt::format(
            "glslang makes no SPIR-V of GLSL {}{}{}, so gobo reads it as {}, which lacks this; write it with "
            "what that has",
            version.number, version.profile.empty() ? "" : " ", version.profile, raised_version(version));
    }
    return diagnostics;
}

/// Whether a sampler is bound to 0, which may be glslang's word for nothing stated; of a block it says so.
bool may_lack_bindings(const Interface& interface) {
    return std::ranges::any_of(interface.samplers,
                               [](const Sampler& sampler) { return sampler.binding == 0; });
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
    shader_->prologue = prologue;
    for (const Piece* piece : pieces_) {
        const std::string& text = piece == pieces_.front() ? shader_->prologue : piece->text;
        shader_->texts.push_back(text.data());
        shader_->lengths.push_back(static_cast<int>(text.size()));
        shader_->names.push_back(piece->path.c_str());
    }
    glslang::TShader& shader = shader_->shader;
    shader.setStringsWithLengthsAndNames(shader_->texts.data(), shader_->lengths.data(),
                                         shader_->names.data(), static_cast<int>(shader_->texts.size()));
    if (for_spirv) {
        shader.setEnvInput(glslang::EShSourceGlsl, language_of(kind_), glslang::EShClientOpenGL, 100);
        shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
        shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    }
    shader.setAutoMapLocations(true);
    shader.setAutoMapBindings(map_bindings);
    bindings_mapped_ = map_bindings;
    const bool is_fine = shader.parse(GetDefaultResources(), 110, false, rules(for_spirv, is_relaxed_));
    const Place place{pieces_.back()->path, 0, 0};
    Diagnostics found = with_macros(
        with_missing_ends(diagnostics_of_log(shader.getInfoLog(), pieces_, place), pieces_), pieces_);
    for (Diagnostic& diagnostic : found) make_strict(diagnostic, prologue, is_relaxed_);
    if (is_fine && shader.getIntermediate()->getNumEntryPoints() == 0)
        return fail(place, "", fmt::format("the {} stage has no main()", name_of(kind_)),
                    "write void main() in the template")
            .value();
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
    const std::string prologue = without_requirements(pieces_.front()->text);
    is_relaxed_ = false;
    Diagnostics found = parse_by_glslang(prologue);
    // That a macro gives `defined` is an error to glslang alone; it can be told to go on.
    is_relaxed_ = std::ranges::any_of(found, [](const Diagnostic& diagnostic) {
        return diagnostic.message.starts_with(
            "'defined' : cannot use in preprocessor expression when expanded");
    });
    if (is_relaxed_) found = parse_by_glslang(prologue);
    if (has_errors(found)) return found;
    for (Diagnostics& more :
         std::array{check_tree(*shader_->shader.getIntermediate(), pieces_), check_language(kind_, pieces_)})
        std::ranges::move(more, std::back_inserter(found));
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
    glslang::TProgram program;
    for (GlslangStage* const stage : stages) program.addShader(&stage->shader_->shader);
    const bool is_fine = program.link(rules(true, false));
    std::vector<const Piece*> earlier;
    for (std::size_t i = 0; i + 1 < stages.size(); ++i)
        earlier.insert(earlier.end(), stages[i]->pieces_.begin(), stages[i]->pieces_.end());
    Diagnostics found =
        with_places(diagnostics_of_log(program.getInfoLog(), {}, {stages.back()->pieces_.back()->path, 0, 0}),
                    stages.back()->pieces_, earlier);
    if (!is_fine && found.empty())
        return fail(Fault::internal, "glslang refuses to link without saying why").value();
    return found;
}

Result<ValidatedStage> GlslangStage::generate(bool debug_information, bool places_vertices) {
    glslang::TProgram program;
    program.addShader(&shader_->shader);
    if (!program.link(rules(true, false))) {  // no main(), recursion
        Diagnostics found =
            with_places(diagnostics_of_log(program.getInfoLog(), {}, {pieces_.back()->path, 0, 0}), pieces_);
        if (has_errors(found)) return tl::unexpected(std::move(found));
        return glslang_fault(program.getInfoLog());
    }
    const glslang::TIntermediate& intermediate = *program.getIntermediate(language_of(kind_));
    ValidatedStage stage;
    stage.spirv = spirv_of(intermediate, debug_information);
    Result<spirv::Module> read = spirv::read_module(stage.spirv);
    if (!read) return placed(std::move(read).error(), pieces_);
    const spirv::Module& module = *read;
    const spirv::Usage usage = spirv::usage_of(module);
    Result<Interface> interface = reflect_stage(module, usage);
    if (!interface) return placed(std::move(interface).error(), pieces_);
    stage.interface = *std::move(interface);
    stage.diagnostics = check_stage(module, usage, pieces_, places_vertices);
    const bool asks_for_bindings = bindings_mapped_ || may_lack_bindings(stage.interface);
    if (asks_for_bindings || may_hold_bools(stage.interface)) {
        program.buildReflection(EShReflectionAllBlockVariables | EShReflectionSharedStd140UBO |
                                EShReflectionSeparateBuffers);
        stage.interface = restore_bools(std::move(stage.interface), gl_types(program));
    }
    if (asks_for_bindings) {
        const auto stated = stated_bindings(program);
        forget_assigned(stage.interface.blocks, stated, pieces_);
        forget_assigned(stage.interface.samplers, stated, pieces_);
    }
    if (bindings_mapped_ || lacks_locations(stage.interface)) {
        is_changed_ = true;
        if (!program.mapIO()) return glslang_fault(program.getInfoLog());
        stage.spirv = spirv_of(intermediate, debug_information);
    }
    return stage;
}

}  // namespace gobo
