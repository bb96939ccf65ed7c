// write_stages FAMILY KEYS_FILE FOLDER [includes]: every distinct stage of those keys of a family, lit or a
// .toml file, as a file, as other compilers take it; with a fourth argument its pieces are files too, which
// it includes as glslc knows it.
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "core/file_system.hpp"
#include "core/shipped_files.hpp"
#include "core/text.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"

namespace gobo {
namespace {

Result<Composition> compose_keys(const FileSystem& disk, const FileSystem& shipped, const std::string& name,
                                 const std::string& keys_file) {
    const bool is_shipped = !name.ends_with(".toml");
    const std::string path = is_shipped ? "templates/" + name + ".toml" : name;
    const Result<std::string> family_text = is_shipped ? shipped.read(path) : disk.read(path);
    if (!family_text) return tl::unexpected(family_text.error());
    const Result<Family> family = read_family(*family_text, path);
    if (!family) return tl::unexpected(family.error());
    const Result<std::string> text = disk.read(keys_file);
    if (!text) return tl::unexpected(text.error());
    Selection selection;
    selection.keys = keys_of_text(*text, keys_file);
    const Result<std::vector<Key>> keys = select(*family, selection, "450");
    if (!keys) return tl::unexpected(keys.error());
    SearchPath search;
    if (!is_shipped) search.add(disk, folder_of(path), "", true);
    search.add(shipped, "shader_lib", "shader_lib/", false);
    search.add(shipped, "templates", "templates/", false);
    return compose(*family, *keys, search, Dialect::glsl450);
}

/// The stage with a line for each piece behind its prologue.
std::string including(const Composition& composition, const Stage& stage) {
    std::string text = composition.piece(stage.pieces.front()).text;
    text += "#extension GL_GOOGLE_include_directive : require\n";
    for (std::size_t i = 1; i < stage.pieces.size(); ++i)
        text += fmt::format("#include \"pieces/{}.glsl\"\n", stage.pieces[i]);
    return text;
}

Result<bool> write_stages(const std::string& family, const std::string& keys_file, const std::string& folder,
                          bool includes) {
    DiskFileSystem disk;
    const MemoryFileSystem shipped(shipped_files());
    const Result<Composition> composition = compose_keys(disk, shipped, family, keys_file);
    if (!composition) return tl::unexpected(composition.error());
    for (std::size_t i = 0; includes && i < composition->pieces.size(); ++i) {
        const std::string path = fmt::format("{}/pieces/{}.glsl", folder, i);
        if (const auto written = disk.write(path, composition->pieces[i].text); !written) return written;
    }
    int number = 0;
    for (const Stage& stage : composition->stages) {
        const char* extension = stage.kind == StageKind::vertex ? "vert" : "frag";
        const std::string path = fmt::format("{}/{:04}.{}", folder, number++, extension);
        const Result<bool> written =
            disk.write(path, includes ? including(*composition, stage) : source_of(*composition, stage));
        if (!written) return written;
    }
    return true;
}

}  // namespace
}  // namespace gobo

int main(int argc, char** argv) {
    if (argc != 4 && argc != 5) return 2;
    const auto written = gobo::write_stages(argv[1], argv[2], argv[3], argc == 5);
    if (written) return 0;
    for (const gobo::Diagnostic& diagnostic : written.error())
        std::fputs(gobo::to_text(diagnostic, false).c_str(), stderr);
    return 1;
}
