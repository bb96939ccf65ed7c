// A linked OpenGL program.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reflect/interface.hpp"
#include "lab/render/context.hpp"
#include "lab/render/stage_text.hpp"

namespace gobo {

/// Owns an OpenGL program object.
class Program {
  public:
    Program(const Context& context, GLuint id) : context_(context), id_(id) {}
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    [[nodiscard]] GLuint id() const { return id_; }

  private:
    Context context_;
    GLuint id_;
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
