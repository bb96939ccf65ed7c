#include "lab/render/render_selection.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "family/key.hpp"
#include "lab/render/driver_tasks.hpp"

namespace gobo {
namespace {

class OpenGlRenderer final : public KeyRenderer {
  public:
    OpenGlRenderer(const Context& context, const DrawnSelection& selection, const GivenTextures& textures,
                   const DepthPass* pass)
        : context_(context), selection_(selection), textures_(textures), pass_(pass) {}

    [[nodiscard]] std::string name() const override { return context_.renderer(); }

    [[nodiscard]] Result<Picture> draw(std::size_t permutation) override {
        const Permutation& drawn = selection_.composition.permutations[permutation];
        std::vector<RenderValue> values = selection_.family.render;
        GivenTextures textures = textures_;
        std::optional<ShadowMaps> maps;
        const std::vector<ShadowLight> shadows = shadow_lights(selection_.family, drawn.key);
        if (!shadows.empty() && pass_ != nullptr) {
            GOBO_TRY(ShadowMaps own, draw_shadow_maps(context_, *pass_, shadows, selection_.objects,
                                                      selection_.view.camera.view()));
            maps.emplace(std::move(own));
            textures["shadowMaps"] = maps->texture();
            values.insert(values.end(), maps->values().begin(), maps->values().end());
        }
        return render_permutation(context_, stages_of(selection_.composition, drawn),
                                  selection_.interfaces[permutation], selection_.objects, values,
                                  selection_.view, textures);
    }

  private:
    Context context_;
    DrawnSelection selection_;
    GivenTextures textures_;
    const DepthPass* pass_;
};

}  // namespace

std::unique_ptr<KeyRenderer> opengl_renderer(const Context& context, const DrawnSelection& selection,
                                             const GivenTextures& textures, const DepthPass* pass) {
    return std::make_unique<OpenGlRenderer>(context, selection, textures, pass);
}

Result<PictureFile> picture_file(Picture picture, const PictureFiles& pictures, const std::string& renderer) {
    picture.warnings.insert(picture.warnings.end(), picture.background_alone.begin(),
                            picture.background_alone.end());
    GOBO_TRY(std::string bytes, encode_image(shrunk(picture.color, pictures.smooth), pictures.format));
    return PictureFile{std::move(bytes), renderer, std::move(picture.warnings)};
}

Result<RenderedSelection> render_selection(
    const std::string& driver, int jobs, const Family& family, const Composition& composition,
    const PictureFiles& pictures, FileSystem& files,
    const std::function<Result<std::unique_ptr<KeyRenderer>>()>& open) {
    const std::vector<Permutation>& permutations = composition.permutations;
    RenderedSelection rendered;
    std::vector<std::string> written(permutations.size());
    std::vector<Diagnostics> said(permutations.size());
    DriverTasks<std::unique_ptr<KeyRenderer>, PictureFile> tasks{driver, permutations.size(), jobs, open};
    tasks.work = [&](std::unique_ptr<KeyRenderer>& renderer, std::size_t i,
                     DriverClock& clock) -> Result<PictureFile> {
        GOBO_TRY(Picture picture, renderer->draw(i));
        clock.stop();
        return picture_file(std::move(picture), pictures, renderer->name());
    };
    tasks.done = [&](std::size_t i, Result<PictureFile> picture, std::optional<int> death) {
        if (death) return rendered.deaths.push_back({i, std::move(picture).error()});
        if (!picture) return said[i].swap(picture.error());
        rendered.renderer = picture->renderer;
        said[i] = std::move(picture->warnings);
        const std::string path =
            fmt::format("{}/{}.{}", pictures.folder, picture_name(key_text(family, permutations[i].key)),
                        name_of(pictures.format));
        if (auto kept = files.write(path, picture->bytes); kept)
            written[i] = path;
        else
            said[i] = std::move(kept).error();
    };
    GOBO_TRY_DO(ask_driver(tasks));
    DiagnosticGroups groups(family);
    for (std::size_t i = 0; i < permutations.size(); ++i) {
        for (const Diagnostic& diagnostic : said[i]) groups.add(diagnostic, permutations[i].key);
        if (!written[i].empty()) rendered.files.push_back(std::move(written[i]));
    }
    rendered.diagnostics = groups.result();
    std::ranges::sort(rendered.deaths, {}, &DriverDeath::permutation);
    return rendered;
}

}  // namespace gobo
