#include "lit_library.hpp"

#include "compose/compose.hpp"
#include "core/file_system.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

const std::string kSource = GOBO_SOURCE_DIR;

}  // namespace

Family lit_family() {
    const DiskFileSystem disk;
    return read_family(disk.read(kSource + "/templates/lit.toml").value(), "templates/lit.toml").value();
}

Result<Composition> compose_lit(const Family& family, const std::vector<Key>& keys, const Overlay& overlay) {
    std::map<std::string, std::string, std::less<>> laid_over;
    for (const auto& [path, text] : overlay) laid_over["overlay/" + path] = text;
    const MemoryFileSystem memory(std::move(laid_over));
    const DiskFileSystem disk;
    SearchPath search;
    search.add(memory, "overlay", "", false);
    search.add(disk, kSource + "/shader_lib", "shader_lib/", false);
    search.add(disk, kSource + "/templates", "templates/", false);
    return compose(family, keys, search, Dialect::own);
}

Result<verify::VerifyReport> verify_lit(const Family& family, const std::vector<Key>& keys,
                                        const Overlay& overlay, const verify::VerifyOptions& options) {
    const Result<Composition> composition = compose_lit(family, keys, overlay);
    if (!composition) return tl::unexpected(composition.error());
    ValidateOptions validate_options;
    validate_options.keep_spirv = true;
    const Validated validated = validate(family, *composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    return verify::verify(family, *composition, validated, options);
}

std::vector<Key> keys_of(const Family& family, const std::vector<std::string>& texts) {
    std::vector<Key> keys;
    keys.reserve(texts.size());
    for (const std::string& text : texts) keys.push_back(parse_key(family, text).value());
    return keys;
}

std::size_t failed_points(const verify::VerifyReport& report) {
    std::size_t count = 0;
    for (const verify::PermutationReport& permutation : report.permutations)
        count += permutation.failed_points;
    return count;
}

}  // namespace gobo
