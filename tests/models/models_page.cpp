// models_page ROOT FIGURES... [--update]: writes docs/models.md, or says where it is stale (exit status 1).
#include <cstdio>
#include <span>

#include <fmt/format.h>

#include "page.hpp"

namespace gobo::models {
namespace {

int tell(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics) fmt::print(stderr, "{}", to_text(diagnostic));
    return exit_status(diagnostics);
}

int run(std::span<char*> arguments) {
    DiskFileSystem disk;
    const std::string root = arguments[0];
    bool update = false;
    std::map<std::string, Figures> figures;
    for (const std::string path : arguments.subspan(1)) {
        update = update || path == "--update";
        if (path == "--update") continue;
        const Result<std::string> json = disk.read(path);
        if (!json) return tell(json.error());
        Result<Figures> run = read_figures(*json, path);
        if (!run) return tell(run.error());
        figures[run->family] = std::move(*run);
    }
    const Result<std::string> toml = disk.read(root + "/docs/models.toml");
    if (!toml) return tell(toml.error());
    const Result<std::vector<Model>> models = read_catalogue(*toml, "docs/models.toml");
    if (!models) return tell(models.error());
    const Result<std::string> page = models_page(disk, root, *models, figures);
    if (!page) return tell(page.error());
    const std::string path = root + "/docs/models.md";
    if (update) {
        const Result<bool> written = disk.write(path, *page);
        return written ? 0 : tell(written.error());
    }
    const Result<std::string> present = disk.read(path);
    if (present && say_the_same(*present, *page)) return 0;
    fmt::print(stderr, "docs/models.md is stale\n  help: cmake --build --preset release --target models\n");
    return 1;
}

}  // namespace
}  // namespace gobo::models

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: models_page ROOT FIGURES... [--update]\n");
        return 2;
    }
    return gobo::models::run(std::span(argv + 1, static_cast<std::size_t>(argc) - 1));
}
