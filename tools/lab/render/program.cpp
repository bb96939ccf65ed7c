#include "lab/render/program.hpp"

#include <algorithm>
#include <numeric>
#include <regex>
#include <set>

#include "core/text.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// The piece that holds line `line` (from 1) of string number `string` (from 0) as a driver counts them;
/// `line` becomes that of the piece's file. Null where there is none.
const Piece* piece_at(const std::vector<Piece>& pieces, int string, int& line) {
    const Piece* found = string > 0 && string < static_cast<int>(pieces.size()) ? &pieces[string] : nullptr;
    for (std::size_t i = 0; string == 0 && i < pieces.size() && found == nullptr; ++i) {
        const auto ends = static_cast<int>(std::ranges::count(pieces[i].text, '\n'));
        if (line <= ends || i + 1 == pieces.size())
            found = &pieces[i];
        else
            line -= ends;
    }
    if (found != nullptr) line = found->line_in_file(line);
    return found;
}

/// A driver's form of message: which of the expression's groups is what.
struct LogForm {
    std::regex form;
    std::size_t string, line, severity, message;
};

/// A message without a place, as linkers give them: `error: text` or `warning: text`.
Diagnostic without_place(std::string_view text) {
    Diagnostic diagnostic;
    for (const auto& [prefix, severity] : {std::pair(std::string_view("error: "), Severity::error),
                                           std::pair(std::string_view("warning: "), Severity::warning)}) {
        if (!text.starts_with(prefix)) continue;
        diagnostic.severity = severity;
        text.remove_prefix(prefix.size());
    }
    diagnostic.message = text;
    return diagnostic;
}

Diagnostic diagnostic_of_line(const std::string& text, const StageText& stage) {
    static const std::array<LogForm, 3> forms = {
        {{std::regex(R"((\d{1,8}):(\d{1,8})\(\d{1,8}\): (error|warning): (.*))"), 1, 2, 3, 4},  // Mesa
         {std::regex(R"((\d{1,8})\((\d{1,8})\) : (error|warning) (.*))"), 1, 2, 3, 4},          // NVIDIA
         {std::regex(R"((ERROR|WARNING): (\d{1,8}):(\d{1,8}): (.*))"), 2, 3, 1, 4}}};           // others
    std::smatch match;
    const auto* const form = std::find_if(forms.begin(), forms.end(), [&](const LogForm& one) {
        return std::regex_match(text, match, one.form);
    });
    if (form == forms.end()) return without_place(text);
    Diagnostic diagnostic;
    const std::string severity = match[form->severity];
    diagnostic.severity = severity == "error" || severity == "ERROR" ? Severity::error : Severity::warning;
    diagnostic.message = match[form->message];
    int line = std::stoi(match[form->line]);
    if (const Piece* piece = piece_at(stage.pieces, std::stoi(match[form->string]), line))
        put_at(diagnostic, *piece, line);
    return diagnostic;
}

/// What the driver says of a shader or program that it refuses. Nothing is never an error message: a driver
/// that fails without a log is reported as `silent`.
template <class GetNumber, class GetLog>
Diagnostics refusal(GLuint object, GetNumber get_number, GetLog get_log, const StageText& stage,
                    const char* silent) {
    GLint length = 0;
    get_number(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    if (length > 0) get_log(object, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    Diagnostics diagnostics = diagnostics_of_log(log, stage);
    if (diagnostics.empty()) diagnostics.emplace_back().message = silent;
    return diagnostics;
}

Diagnostics compile(const GladGLContext& gl, GLuint shader, const StageText& stage) {
    std::vector<const GLchar*> texts;
    std::vector<GLint> lengths;
    for (const Piece& piece : stage.pieces) {
        texts.push_back(piece.text.data());
        lengths.push_back(static_cast<GLint>(piece.text.size()));
    }
    gl.ShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return {};
    return refusal(shader, gl.GetShaderiv, gl.GetShaderInfoLog, stage,
                   "the driver refuses the stage without a message");
}

/// `stated` where it is one, else the lowest number that is neither stated by anything nor given yet.
/// `count` consecutive numbers are taken.
int take(std::set<int>& taken, int stated, int count) {
    if (stated >= 0) return stated;
    int first = 0;
    for (int i = 0; i < count; ++i) {
        if (!taken.contains(first + i)) continue;
        first += i + 1;
        i = -1;
    }
    for (int i = 0; i < count; ++i) taken.insert(first + i);
    return first;
}

}  // namespace

StageText stage_text(const Composition& composition, int stage) {
    const Stage& source = composition.stages[static_cast<std::size_t>(stage)];
    StageText text{source.kind, {}};
    for (const int piece : source.pieces)
        text.pieces.push_back(composition.pieces[static_cast<std::size_t>(piece)]);
    return text;
}

StageText stage_text(StageKind kind, const std::string& name, const std::string& text) {
    return {kind, {Piece{name, name, text, false}}};
}

std::vector<StageText> stages_of(const Composition& composition, const Permutation& permutation) {
    std::vector<StageText> stages;
    for (const int stage : permutation.stages.values)
        if (stage >= 0) stages.push_back(stage_text(composition, stage));
    return stages;
}

Diagnostics diagnostics_of_log(std::string_view log, const StageText& stage) {
    Diagnostics diagnostics;
    for (const std::string_view text : split(log, '\n'))
        diagnostics.push_back(diagnostic_of_line(std::string(text), stage));
    return diagnostics;
}

Program::Program(const Context& context, GLuint id)
    : id_(new GLuint(id), [context](const GLuint* name) {
          context.make_current();
          context.gl().DeleteProgram(*name);
          delete name;
      }) {}

Bindings bindings_of(const Interface& interface) {
    Bindings bindings;
    std::set<int> buffers;
    for (const Block& block : interface.blocks)
        if (block.binding >= 0) buffers.insert(block.binding);
    for (const Block& block : interface.blocks) bindings.blocks[block.name] = take(buffers, block.binding, 1);
    std::set<int> units;
    for (const Sampler& sampler : interface.samplers)
        for (int i = 0; sampler.binding >= 0 && i < element_count(sampler.array); ++i)
            units.insert(sampler.binding + i);
    for (const Sampler& sampler : interface.samplers)
        bindings.samplers[sampler.name] = take(units, sampler.binding, element_count(sampler.array));
    return bindings;
}

Result<Program> link_program(const Context& context, const std::vector<StageText>& stages) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    Program program(context, gl.CreateProgram());
    Diagnostics diagnostics;
    for (const StageText& stage : stages) {
        constexpr PerStage<GLenum> kKinds = {{GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER,
                                              GL_TESS_EVALUATION_SHADER, GL_GEOMETRY_SHADER,
                                              GL_FRAGMENT_SHADER, GL_COMPUTE_SHADER}};
        const GLuint shader = gl.CreateShader(kKinds[stage.kind]);
        const Diagnostics errors = compile(gl, shader, stage);
        diagnostics.insert(diagnostics.end(), errors.begin(), errors.end());
        gl.AttachShader(program.id(), shader);
        gl.DeleteShader(shader);  // once the program is
    }
    if (!diagnostics.empty()) return tl::unexpected(std::move(diagnostics));
    gl.LinkProgram(program.id());
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return program;
    return tl::unexpected(refusal(program.id(), gl.GetProgramiv, gl.GetProgramInfoLog, {},
                                  "the driver refuses to link the stages without a message"));
}

void set_bindings(const Context& context, const Program& program, const Interface& interface) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    const Bindings bindings = bindings_of(interface);
    for (const auto& [name, binding] : bindings.blocks) {
        const GLuint index = gl.GetUniformBlockIndex(program.id(), name.c_str());
        if (index != GL_INVALID_INDEX)
            gl.UniformBlockBinding(program.id(), index, static_cast<GLuint>(binding));
    }
    gl.UseProgram(program.id());
    for (const Sampler& sampler : interface.samplers) {
        const GLint location = gl.GetUniformLocation(program.id(), sampler.name.c_str());
        if (location < 0) continue;
        std::vector<GLint> units(static_cast<std::size_t>(element_count(sampler.array)));
        std::iota(units.begin(), units.end(), bindings.samplers.at(sampler.name));
        gl.Uniform1iv(location, static_cast<GLsizei>(units.size()), units.data());
    }
    gl.UseProgram(0);
}

}  // namespace gobo
