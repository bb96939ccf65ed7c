#include "lab/render/render_selection.hpp"

#include <optional>

#include <fmt/format.h>
#define XXH_INLINE_ALL  // one hash is no reason to link a library
#include <xxhash.h>

#include "family/diagnostic_groups.hpp"
#include "family/key.hpp"
#include "lab/render/lit_shadows.hpp"

namespace gobo {
namespace {

constexpr std::size_t longest_name = 200;

/// Draws one permutation and writes its picture. The result are warnings.
Result<Diagnostics> render_one(const Context& context, const std::vector<StageText>& stages,
                               const Interface& interface, const std::vector<Object>& objects,
                               std::vector<RenderValue> values, const std::vector<ShadowLight>& shadows,
                               const PictureOptions& options, FileSystem& files, const std::string& path) {
    GivenTextures textures = options.textures;
    std::optional<Result<ShadowMaps>> maps;
    if (!shadows.empty() && options.depth_pass != nullptr) {
        maps.emplace(
            draw_shadow_maps(context, *options.depth_pass, shadows, objects, options.view.camera.view()));
        if (!*maps) return tl::unexpected(maps->error());
        textures["shadowMaps"] = (*maps)->texture();
        values.insert(values.end(), (*maps)->values().begin(), (*maps)->values().end());
    }
    const auto picture =
        render_permutation(context, stages, interface, objects, values, options.view, textures);
    if (!picture) return tl::unexpected(picture.error());
    if (const auto written = write_image(files, path, shrunk(picture->color, options.smooth)); !written)
        return tl::unexpected(written.error());
    return picture->warnings;
}

}  // namespace

RenderedSelection render_selection(const Context& context, const Family& family,
                                   const Composition& composition, const std::vector<Interface>& interfaces,
                                   const std::vector<Object>& objects, const PictureOptions& options,
                                   FileSystem& files) {
    RenderedSelection rendered;
    DiagnosticGroups groups(family);
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        const std::string path =
            fmt::format("{}/{}.{}", options.folder, picture_name(key_text(family, permutation.key)),
                        name_of(options.format));
        const auto warnings = render_one(
            context,
            {stage_text(composition, permutation.vertex), stage_text(composition, permutation.fragment)},
            interfaces[i], objects, family.render, shadow_lights(family, permutation.key), options, files,
            path);
        if (warnings) rendered.files.push_back(path);
        for (const Diagnostic& diagnostic : warnings ? *warnings : warnings.error())
            groups.add(diagnostic, permutation.key);
    }
    rendered.diagnostics = groups.result();
    return rendered;
}

std::string picture_name(std::string_view key_text) {
    std::string name;
    for (const char character : key_text) name += character == '=' ? '-' : character == ' ' ? '+' : character;
    if (name.size() <= longest_name) return name;
    const XXH64_hash_t hash = XXH3_64bits(key_text.data(), key_text.size());
    return fmt::format("{}+{:016x}", name.substr(0, longest_name - 17), hash);
}

}  // namespace gobo
