// write_sample_header NAME FILE: writes the generated header of a sample family, for tests that are built
// against one.
#include <cstdio>
#include <string>

#include "core/file_system.hpp"
#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

constexpr std::size_t large_size = 10000;

Result<bool> write_header(const std::string& name, const std::string& path) {
    DiskFileSystem files;
    const auto templates = read_header_templates(files, GOBO_SOURCE_DIR "/templates/header");
    if (!templates) return tl::make_unexpected(templates.error());
    const sample::Built built = name == "large"    ? sample::large(large_size)
                                : name == "lit"    ? sample::lit()
                                : name == "nasty"  ? sample::nasty()
                                : name == "bare"   ? sample::bare()
                                : name == "macros" ? sample::macros()
                                : name == "arrays" ? sample::arrays()
                                                   : sample::drawn();
    const auto header = emit_header(built.input(name), *templates);
    if (!header) return tl::make_unexpected(header.error());
    return files.write(path, header->header);
}

}  // namespace
}  // namespace gobo

int main(int count, char** arguments) {
    if (count != 3) return 2;
    const auto written = gobo::write_header(arguments[1], arguments[2]);
    if (written) return 0;
    std::fputs(gobo::to_text(written.error().front()).c_str(), stderr);
    return gobo::exit_status(written.error());
}
