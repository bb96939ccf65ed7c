#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/file_system.hpp"
#include "emit/emit.hpp"
#include "family_texts.hpp"
#include "results.hpp"
#include "targets.hpp"

namespace gobo::fuzz {
namespace {

Result<Composition> composed(const Files& parts, const Family& family) {
    const MemoryFileSystem disk(parts);
    SearchPath search;
    search.add(disk, "", "", true);
    return compose(family, some_keys(family), search, Dialect::own);
}

}  // namespace

void read_compose(std::string_view input) {
    Files parts = parts_of(input);
    parts.try_emplace("tiny.vert", "void main() {}\n");
    parts.try_emplace("tiny.frag", "void main() {}\n");
    const Result<Composition> composition = composed(parts, small_family());
    if (!is_value(composition)) return;
    for (const Stage& stage : composition->stages) require(!source_of(*composition, stage).empty());
}

void read_header(std::string_view input) {
    const Files parts = parts_of(input);
    const Result<Family> family = family_of(parts);
    if (!is_value(family)) return;
    const Result<Composition> composition = composed(parts, *family);
    if (!is_value(composition)) return;
    const DiskFileSystem disk;
    static const HeaderTemplates templates =
        read_header_templates(disk, GOBO_SOURCE_DIR "/templates/header").value();
    const Interface interface;
    const EmitInput emitted{*family, *composition, interface, {}};
    if (is_value(emit_header(emitted, templates))) static_cast<void>(emit_manifest(emitted));
}

}  // namespace gobo::fuzz
