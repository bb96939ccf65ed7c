#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>

#include <fmt/format.h>

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
    search.add(disk, "", "", false);
    return compose(family, some_keys(family), search, Dialect::own);
}

/// Where GOBO_FUZZ_HEADERS names a folder, headers are kept there to be compiled, each once.
void keep_header(const std::string& text) {
    const char* const folder = std::getenv("GOBO_FUZZ_HEADERS");
    if (folder == nullptr) return;
    DiskFileSystem disk;
    require(
        disk.write(fmt::format("{}/{:016x}.hpp", folder, std::hash<std::string>()(text)), text).has_value());
}

bool emit(const Family& family, const Files& parts) {
    const Result<Composition> composition = composed(parts, family);
    if (!is_value(composition)) return false;
    const DiskFileSystem disk;
    static const HeaderTemplates templates =
        read_header_templates(disk, GOBO_SOURCE_DIR "/templates/header").value();
    const Interface interface;
    const EmitInput emitted{family, *composition, interface, {}};
    const Result<EmittedCpp> header = emit_header(emitted, templates);
    if (!is_value(header)) return false;
    keep_header(header->header);
    static_cast<void>(emit_manifest(emitted));
    return true;
}

/// As TOML writes it; what is no UTF-8 stays so.
std::string quoted_toml(std::string_view text) {
    std::string quoted = "\"";
    for (const char character : text) {
        const bool is_control = static_cast<unsigned char>(character) < 0x20 || character == 0x7f;
        if (is_control)
            quoted += fmt::format("\\u{:04x}", static_cast<int>(character));
        else
            quoted +=
                character == '"' || character == '\\' ? std::string{'\\', character} : std::string{character};
    }
    return quoted + '"';
}

}  // namespace

bool read_compose(std::string_view input) {
    Files parts = parts_of(input);
    parts.try_emplace("tiny.vert", "void main() {}\n");
    parts.try_emplace("tiny.frag", "void main() {}\n");
    const Result<Composition> composition = composed(parts, small_family());
    if (!is_value(composition)) return false;
    for (const Stage& stage : composition->stages) require(!source_of(*composition, stage).empty());
    return true;
}

bool read_header(std::string_view input) {
    const Files parts = parts_of(input);
    const Result<Family> family = family_of(parts);
    return is_value(family) && emit(*family, parts);
}

bool read_names(std::string_view input) {
    // What stands for each is taken from the lines in turn; what is left is the fragment stage's text.
    std::string toml =
        "name = NAME\nvertex = NAME\nfragment = NAME\n[features.NAME]\nvalues = [\"off\", NAME, NAME]\n"
        "[features.NAME]\ncount = [0, 2]\nconstant = NAME\n[features.NAME]\ndefine = NAME\n";
    Files parts;
    for (std::size_t at = 0; (at = toml.find("NAME", at)) != std::string::npos;) {
        const std::string line(input.substr(0, input.find('\n')));
        input.remove_prefix(std::min(line.size() + 1, input.size()));
        parts.try_emplace(line, "void main() {}\n");
        const std::string quoted = quoted_toml(line);
        toml.replace(at, 4, quoted);
        at += quoted.size();
    }
    for (auto& [path, text] : parts) text += input;
    parts["family.toml"] = toml;
    const Result<Family> family = family_of(parts);
    return is_value(family) && emit(*family, parts);
}

}  // namespace gobo::fuzz
