// Where the pieces of a stage declare a name, for messages: SPIR-V does not say it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

struct Declaration {
    Place place;              ///< of the stage's last piece, without a line, where the name is not found
    std::string quoted_line;  ///< empty where the line is unknown
    bool mentions_hint = false;

    /// "lamp.vert:3", or only the file.
    [[nodiscard]] std::string text() const;
};

/// The first line that looks like the declaration of the name: of those that mention it, one with a storage
/// qualifier before one without, and of these one that mentions the hint (the type) before one that does
/// not. Of "Surface.normal" and "Surface[1]" the declaration of Surface.
[[nodiscard]] Declaration declaration_of(std::string_view name, std::string_view hint,
                                         const std::vector<const Piece*>& pieces);

/// The first line of a block's declaration that mentions its member.
[[nodiscard]] Declaration declaration_of_member(std::string_view block, std::string_view member,
                                                const std::vector<const Piece*>& pieces);

/// The first line that mentions a name and declares nothing.
[[nodiscard]] Declaration use_of(std::string_view name, const std::vector<const Piece*>& pieces);

/// A message at a declaration, its line quoted.
[[nodiscard]] Diagnostic diagnostic_at(const Declaration& declaration, Severity severity, std::string message,
                                       std::string help);

}  // namespace gobo
