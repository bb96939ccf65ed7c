#include "sanitize_lit.hpp"

#include <gtest/gtest.h>

#include "../shipped_pieces.hpp"
#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// The changed piece, in a folder that is searched first.
void write_changed(const Change& change, MemoryFileSystem& memory) {
    if (change.piece.empty()) return;
    std::string changed = piece_text(change.piece);
    std::size_t code = 0;  // the comment before it tells of it in its own words
    while (changed[code] == '\n' || changed.compare(code, 2, "//") == 0) code = changed.find('\n', code) + 1;
    const auto at = changed.find(change.from, code);
    ASSERT_NE(at, std::string::npos) << change.piece << " has no " << change.from;
    changed.replace(at, change.from.size(), change.to);
    ASSERT_TRUE(memory.write("overlay/" + change.piece, changed));
}

}  // namespace

sanitize::SanitizeReport sanitized_lit(const std::string& key, const sanitize::SanitizeOptions& options,
                                       const Change& change) {
    const DiskFileSystem disk;
    MemoryFileSystem memory;
    write_changed(change, memory);
    SearchPath search;
    search.add(memory, "overlay", "", false);
    search.add(disk, GOBO_SOURCE_DIR "/shader_lib", "shader_lib/", false);
    search.add(disk, GOBO_SOURCE_DIR "/templates", "templates/", false);
    const std::string path = GOBO_SOURCE_DIR "/templates/lit.toml";
    const Result<Family> family = read_family(*disk.read(path), path);
    EXPECT_TRUE(family);
    const Result<Key> named = parse_key(*family, key);
    EXPECT_TRUE(named) << key;
    const Result<Composition> composition = compose(*family, {*named}, search, Dialect::own);
    EXPECT_TRUE(composition) << key;
    ValidateOptions validate_options;
    validate_options.keep_spirv = true;
    validate_options.debug_information = true;
    const Validated validated = validate(*family, *composition, validate_options);
    for (const Diagnostic& error : validated.diagnostics) ADD_FAILURE() << to_text(error);
    return sanitize::sanitize(*family, *composition, validated, options);
}

std::vector<std::string> messages_of(const sanitize::SanitizeReport& report) {
    std::vector<std::string> messages;
    for (const sanitize::SharedFinding& shared : report.findings) messages.push_back(to_text(shared.finding));
    return messages;
}

}  // namespace gobo
