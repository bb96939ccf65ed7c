// The shipped family `lit`, verified with pieces of the test's own laid over it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "../shipped_pieces.hpp"
#include "lab/verify/verify.hpp"

namespace gobo {

/// Pieces by include path: "fog/linear.glsl".
using Overlay = std::map<std::string, std::string, std::less<>>;

/// lit as it stands in the source tree.
[[nodiscard]] Family lit_family();

/// The keys of `lit`, or of the family that extends it, composed with the overlay; errors in the pieces come
/// back.
[[nodiscard]] Result<Composition> compose_lit(const Family& family, const std::vector<Key>& keys,
                                              const Overlay& overlay);

/// compose_lit(), validate() and verify() in one; one thread.
[[nodiscard]] Result<verify::VerifyReport> verify_lit(const Family& family, const std::vector<Key>& keys,
                                                      const Overlay& overlay = {},
                                                      const verify::VerifyOptions& options = {});

/// Keys of lit from their texts.
[[nodiscard]] std::vector<Key> keys_of(const Family& family, const std::vector<std::string>& texts);

/// All points that are out of tolerance.
[[nodiscard]] std::size_t failed_points(const verify::VerifyReport& report);

}  // namespace gobo
