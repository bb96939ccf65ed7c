// One stage in glslang's hands: parsed once, linked with its partners, then turned into SPIR-V.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glslang/Public/ShaderLang.h>

#include "validate/stated.hpp"
#include "validate/syntax_tree.hpp"
#include "validate/validate.hpp"

namespace gobo {

/// A parsed stage. The pieces and what is read of them must outlive it. Not safe for use by two threads at
/// once.
class GlslangStage {
  public:
    GlslangStage(StageKind kind, std::vector<const Piece*> pieces, Dialect dialect, ReadPieces& read)
        : kind_(kind), pieces_(std::move(pieces)), dialect_(dialect), read_(read) {}

    /// Parses under OpenGL 4.5's rules for SPIR-V; a version that SPIR-V does not know is first parsed by its
    /// own rules, then raised. For Vulkan under the rules of Vulkan 1.0. Where SPIR-V is shipped, locations
    /// and bindings must be stated. What glslang says of it, and where it is content what check_language()
    /// and check_switches() do.
    Diagnostics parse();

    /// The SPIR-V of the parsed stage, unstated locations and bindings assigned, and its interface, where
    /// unstated ones are -1.
    /// `places_vertices` as check_stage() wants it.
    [[nodiscard]] Result<ValidatedStage> generate(bool debug_information, bool places_vertices);
    /// Whether that changed the stage, so that it cannot be linked with another any more.
    [[nodiscard]] bool is_changed() const { return is_changed_; }

    /// What glslang says of the stages as one program. All must have been parsed.
    friend Diagnostics link(const std::vector<GlslangStage*>& stages);
    friend Diagnostics link_by_glslang(const std::vector<GlslangStage*>& stages);

  private:
    /// glslang's shader with the strings it points into.
    struct Shader {
        explicit Shader(EShLanguage language) : shader(language) {}

        std::string prologue;
        std::deque<std::string> renamed;  ///< texts in which built-ins have other names
        std::vector<const char*> texts;
        std::vector<int> lengths;
        std::vector<std::string> numbers;  ///< of the texts: their names to glslang
        std::vector<const char*> names;
        glslang::TShader shader;
    };

    Diagnostics parse_as(const std::string& prologue, bool for_spirv, bool map_bindings);
    Diagnostics parse_by_glslang(const std::string& prologue);
    Diagnostics parse_as_version(const std::string& prologue);

    StageKind kind_;
    std::vector<const Piece*> pieces_;
    Dialect dialect_;
    ReadPieces& read_;
    std::unique_ptr<Shader> shader_;
    bool bindings_mapped_ = false;
    bool is_changed_ = false;
    bool without_formats_ = false;      ///< glslang sees no formats of images
    bool takes_depth_layouts_ = false;  ///< by an extension: glslang sees none of them
    std::optional<std::uint32_t> depth_mode_;
    Precisions precisions_;  ///< of the stage as OpenGL ES, where it is that
    Stated stated_;
    bool makes_invariant_ = false;          ///< each of its outputs, by a pragma that glslang does not read
    int further_messages_ = EShMsgDefault;  ///< beside those that the version asks for
};

}  // namespace gobo
