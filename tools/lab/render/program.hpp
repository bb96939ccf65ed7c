// A linked OpenGL program: the texts of its stages, their errors at the piece and its own line, its bindings.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "lab/render/context.hpp"
#include "reflect/interface.hpp"

namespace gobo {

/// One stage as a driver compiles it: its pieces, one after the other.
struct StageText {
    StageKind kind = StageKind::vertex;
    std::vector<Piece> pieces;
};

/// The pieces of one stage of a composition.
[[nodiscard]] StageText stage_text(const Composition& composition, int stage);
/// A stage of one text, named `name` in diagnostics.
[[nodiscard]] StageText stage_text(StageKind kind, const std::string& name, const std::string& text);
/// The stages of a permutation.
[[nodiscard]] std::vector<StageText> stages_of(const Composition& composition,
                                               const Permutation& permutation);

/// Every message of a driver's log as a diagnostic at its piece and that piece's own line, with the quoted
/// line. Understood: Mesa `0:12(5): error: text`, NVIDIA `0(12) : error C1: text`, AMD and Intel
/// `ERROR: 0:12: text`. Other lines become diagnostics without a place; empty lines are left out.
[[nodiscard]] Diagnostics diagnostics_of_log(std::string_view log, const StageText& stage);

/// An OpenGL program object, deleted with the last of its copies.
class Program {
  public:
    Program(const Context& context, GLuint id);
    [[nodiscard]] GLuint id() const { return *id_; }

  private:
    std::shared_ptr<const GLuint> id_;
};

/// The unit or buffer binding of every block and sampler, by name. Those that the interface states are kept;
/// the others (GLSL 330 cannot state any) get the lowest free ones in the order of their names.
struct Bindings {
    std::map<std::string, int> blocks;
    std::map<std::string, int> samplers;  ///< the first of an array's units
};
[[nodiscard]] Bindings bindings_of(const Interface& interface);

/// Compiles and links the stages. Errors of the driver name the piece and its own line.
[[nodiscard]] Result<Program> link_program(const Context& context, const std::vector<StageText>& stages);

/// Sets the program's blocks and samplers to their bindings, as GLSL 330 needs it.
void set_bindings(const Context& context, const Program& program, const Interface& interface);

}  // namespace gobo
