#include "lab/gallery/gallery.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "core/text_template.hpp"
#include "family/key.hpp"
#include "lab/gallery/live_page.hpp"
#include "lab/raster/raster_object.hpp"
#include "lab/raster/shade.hpp"
#include "lab/raster/shared_textures.hpp"
#include "lab/render/driver_tasks.hpp"
#include "lab/study/html.hpp"

namespace gobo {

GOBO_FIELDS(RenderValue, name, source, numbers, place)

}  // namespace gobo

namespace gobo::gallery {
namespace {

using Json = nlohmann::ordered_json;

/// A picture's name beside the page, and its bytes.
struct NamedFile {
    std::string name;
    std::string bytes;
};
GOBO_FIELDS(NamedFile, name, bytes)

/// What a child process made of one permutation.
struct Made {
    Entry entry;
    std::vector<NamedFile> pictures;
    std::string renderer;
    Diagnostics warnings;
    bool is_evaluated = false;
    Image expected;  ///< this and what follows for a live page
    std::vector<RenderValue> values;
    std::vector<Image> shadow_maps;
};
GOBO_FIELDS(Made, entry, pictures, renderer, warnings, is_evaluated, expected, values, shadow_maps)

/// White in the pictures of errors: the limit that `gobo test --render` holds most pixels to is a fifth of
/// it.
constexpr float kWhiteError = 1e-4F;

std::string value_text(const Feature& feature, int value) {
    return feature.values[static_cast<std::size_t>(value)];
}

/// Three digits tell costs apart; more would suggest an exactness that an average has not.
double to_three_digits(double number) {
    // Of the doubles nearby the one that is shown as this.
    return number_from<double>(fmt::format("{:.3g}", number)).value_or(0);
}

/// Each feature with those of its values that occur, in the family's order.
Json features_of(const Family& family, const Gallery& gallery) {
    Json features = Json::array();
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        std::set<int> occurring;
        for (const Entry& entry : gallery.entries) occurring.insert(entry.key[i]);
        Json values = Json::array();
        for (const int value : occurring) values.push_back(value_text(family.features[i], value));
        features.push_back({{"name", family.features[i].name}, {"index", i}, {"values", std::move(values)}});
    }
    return features;
}

Json entry_json(const Family& family, const Entry& entry) {
    Json values = Json::array();
    for (std::size_t i = 0; i < family.features.size(); ++i)
        values.push_back(value_text(family.features[i], entry.key[i]));
    return {{"key", key_text(family, entry.key)},
            {"values", std::move(values)},
            {"actual", entry.actual},
            {"expected", entry.expected},
            {"difference", entry.difference},
            {"largest_error", entry.largest_error},
            {"root_mean_square", entry.root_mean_square},
            {"edges", entry.edges},
            {"pixels", entry.pixels},
            {"exposure", to_three_digits(entry.exposure)},
            {"fragment_cost", to_three_digits(entry.fragment_cost)},
            {"vertex_cost", to_three_digits(entry.vertex_cost)}};
}

/// The values, and for each sampler2D that they leave out the texture that the renderer would take.
std::vector<RenderValue> with_usual_textures(const Interface& interface, std::vector<RenderValue> values) {
    for (const Sampler& sampler : interface.samplers) {
        const bool is_given = find_value(values, sampler.name) != nullptr;
        if (is_given || sampler.type != "sampler2D" || !sampler.array.empty()) continue;
        TextureSource source = texture_source_of(sampler.name, values);
        values.push_back({sampler.name, std::move(source.name), std::move(source.numbers), {}});
    }
    return values;
}

}  // namespace

Result<std::string> page(const FileSystem& shipped, const Family& family, const Gallery& gallery) {
    constexpr const char* kTemplate = "templates/gallery/index.html.in";
    GOBO_TRY(const std::string text, shipped.read(kTemplate));
    Json entries = Json::array();
    for (const Entry& entry : gallery.entries) entries.push_back(entry_json(family, entry));
    const std::string about = fmt::format(
        "Each permutation drawn by {} and evaluated in single precision without a renderer. Error: the "
        "largest difference of linear radiance between the two, but for pixels at an edge. Cost: the "
        "operations of a fragment and of a vertex on average, weighted by what they cost on {}, in "
        "additions.",
        gallery.renderer, gallery.cost_renderer);
    const Json data = {{"family", family.name},
                       {"about", about},
                       {"renderer", gallery.renderer},
                       {"width", gallery.width},
                       {"height", gallery.height},
                       {"white_error", gallery.white_error},
                       {"features", features_of(family, gallery)},
                       {"entries", std::move(entries)}};
    return fill({kTemplate, text}, {{"title", study::html_escaped("Permutations of " + family.name)},
                                    {"data", study::html_script(data.dump())}});
}

Result<RenderedSelection> make_gallery(const Scene& scene, const Family& family,
                                       const Composition& composition, const Validated& validated,
                                       const GalleryOptions& options, FileSystem& files,
                                       const FileSystem& shipped) {
    const std::vector<Permutation>& permutations = composition.permutations;
    std::vector<std::optional<Entry>> entries(permutations.size());
    std::vector<Diagnostics> said(permutations.size());
    Gallery gallery;
    RenderedSelection made;
    // Draws a permutation and evaluates it: an entry without the names of files of what cannot be evaluated.
    // Warnings are to be told all the same.
    DriverTasks<Context, Made> tasks{options.driver, permutations.size(), options.jobs};
    tasks.open = [&] { return open_context(options.backend); };
    tasks.work = [&](const Context& context, std::size_t i, DriverClock& clock) -> Result<Made> {
        const Permutation& permutation = permutations[i];
        GOBO_TRY(Drawing drawing, draw(context, scene, family, composition, validated, permutation));
        clock.stop();
        Made one;
        one.renderer = context.renderer();
        Entry& entry = one.entry;
        const auto add = [&](std::string& name, const char* end, const Image& picture) -> Result<void> {
            name = picture_name(key_text(family, permutation.key)) + end;
            GOBO_TRY(std::string bytes, encode_image(picture, ImageFormat::png));
            one.pictures.push_back({name, std::move(bytes)});
            return {};
        };
        entry.key = permutation.key;
        const float exposure = exposure_of(drawing.color);
        entry.exposure = exposure;
        GOBO_TRY_DO(add(entry.actual, ".png", exposed(drawing.color, exposure)));
        one.warnings = drawing.warnings;
        auto evaluation = evaluate_drawing(drawing, scene, validated, permutation, options.weights);
        if (!evaluation) {
            for (Diagnostic error : evaluation.error()) {
                error.severity = Severity::warning;
                one.warnings.push_back(std::move(error));
            }
            return one;
        }
        raster::PictureReport& report = evaluation->report;
        entry.largest_error = report.largest_error;
        entry.root_mean_square = report.root_mean_square;
        entry.edges = report.edges;
        entry.pixels = report.pixels;
        entry.fragment_cost = evaluation->fragment_cost;
        entry.vertex_cost = evaluation->vertex_cost;
        GOBO_TRY_DO(add(entry.expected, ".expected.png", exposed(report.expected, exposure)));
        GOBO_TRY_DO(add(entry.difference, ".error.png",
                        difference_picture(report.actual, report.expected, kWhiteError)));
        if (options.live == nullptr) return one;
        one.is_evaluated = true;
        one.expected = std::move(report.expected);
        one.values = std::move(drawing.values);
        one.shadow_maps = std::move(drawing.shadow_maps);
        return one;
    };
    const auto keep = [&](std::size_t i, Made one) -> Result<void> {
        gallery.renderer = made.renderer = one.renderer;
        said[i] = std::move(one.warnings);
        for (const NamedFile& file : one.pictures)
            GOBO_TRY_DO(files.write(options.folder + "/" + file.name, file.bytes));
        if (one.is_evaluated) {
            Drawing drawing;
            drawing.values = std::move(one.values);
            drawing.shadow_maps = std::move(one.shadow_maps);
            GOBO_TRY_DO(options.live->add(i, drawing, one.expected, static_cast<float>(one.entry.exposure)));
        }
        entries[i] = std::move(one.entry);
        return {};
    };
    tasks.done = [&](std::size_t i, Result<Made> one, std::optional<int> death) {
        if (death) return made.deaths.push_back({i, std::move(one).error()});
        if (!one) return said[i].swap(one.error());
        if (auto kept = keep(i, *std::move(one)); !kept)
            said[i].insert(said[i].end(), kept.error().begin(), kept.error().end());
    };
    GOBO_TRY_DO(ask_driver(tasks));
    std::ranges::sort(made.deaths, {}, &DriverDeath::permutation);
    gallery.width = scene.view.width;
    gallery.height = scene.view.height;
    gallery.white_error = kWhiteError;
    gallery.cost_renderer = options.weights.renderer;
    DiagnosticGroups groups(family);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        for (const Diagnostic& diagnostic : said[i]) groups.add(diagnostic, permutations[i].key);
        if (entries[i]) gallery.entries.push_back(std::move(*entries[i]));
    }
    made.diagnostics = groups.result();
    const std::string path = options.folder + "/index.html";
    const auto written = page(shipped, family, gallery).and_then([&](const std::string& text) {
        return files.write(path, text);
    });
    if (!written) {
        made.diagnostics.insert(made.diagnostics.end(), written.error().begin(), written.error().end());
        return made;
    }
    made.files.push_back(path);
    if (options.live != nullptr) {
        const std::string live = options.folder + "/live.html";
        const auto kept = options.live->text(shipped, kWhiteError).and_then([&](const std::string& text) {
            return files.write(live, text);
        });
        if (kept) made.files.push_back(live);
        if (!kept) made.diagnostics.insert(made.diagnostics.end(), kept.error().begin(), kept.error().end());
    }
    for (const Entry& entry : gallery.entries) made.files.push_back(options.folder + "/" + entry.actual);
    return made;
}

Camera gallery_camera() {
    return {.position = {0, 2.8, 4.3}, .target = {0, -0.14, 0}, .field_of_view = 0.5, .far_plane = 50};
}

Result<Drawing> draw(const Context& context, const Scene& scene, const Family& family,
                     const Composition& composition, const Validated& validated,
                     const Permutation& permutation) {
    Drawing drawing;
    drawing.interface = interface_of(validated, permutation);
    drawing.values = with_usual_textures(drawing.interface, family.render);
    raster::SharedTextures textures(context);
    GOBO_TRY_DO(textures.add(drawing.interface, drawing.values, scene.cube_maps));
    drawing.images = textures.images();
    GivenTextures given = textures.given();
    std::optional<ShadowMaps> maps;
    const std::vector<ShadowLight> lights = shadow_lights(family, permutation.key);
    if (!lights.empty() && !scene.depth_pass.stages.empty()) {
        GOBO_TRY(ShadowMaps drawn, draw_shadow_maps(context, scene.depth_pass, lights, scene.objects,
                                                    scene.view.camera.view()));
        maps.emplace(std::move(drawn));
        drawing.values.insert(drawing.values.end(), maps->values().begin(), maps->values().end());
        drawing.shadow_maps = raster::layers_of(*maps, lights);
        drawing.images["shadowMaps"] = raster::depths_of(drawing.shadow_maps);
        given["shadowMaps"] = maps->texture();
    }
    GOBO_TRY(Picture picture,
             render_permutation(context, stages_of(composition, permutation), drawing.interface,
                                scene.objects, drawing.values, scene.view, given));
    drawing.color = std::move(picture.color);
    drawing.depth = std::move(picture.depth);
    drawing.warnings = std::move(picture.warnings);
    return drawing;
}

Result<Evaluation> evaluate_drawing(const Drawing& drawing, const Scene& scene, const Validated& validated,
                                    const Permutation& permutation, const study::Weights& weights) {
    const auto spirv = [&](int stage) -> const SpirvModule& {
        return validated.stages[static_cast<std::size_t>(stage)].spirv;
    };
    GOBO_TRY(const raster::Pipeline program,
             raster::pipeline_of(spirv(permutation.stages[StageKind::vertex]),
                                 spirv(permutation.stages[StageKind::fragment])));
    const auto objects_in = [&](const View& view) {
        return raster::rasterise_objects(program, drawing.interface, scene.objects,
                                         raster::with_plain_textures(drawing.interface, drawing.values), view,
                                         drawing.images);
    };
    GOBO_TRY(const auto seen, objects_in(scene.view));
    Evaluation evaluation;
    evaluation.report = raster::compare_picture({drawing.color, drawing.depth, {}}, program, seen,
                                                scene.view.background, raster::KeptPictures::all);
    if (!evaluation.report.diagnostics.empty()) return tl::unexpected(evaluation.report.diagnostics);

    // Costs are averages: a picture this small tells them to a few parts in a hundred.
    View small = scene.view;
    small.width = 80;
    small.height = 60;
    GOBO_TRY(const auto objects, objects_in(small));
    raster::Work work;
    std::size_t fragments = 0;
    std::size_t vertices = 0;
    for (const raster::RasterObject& object : objects) {
        GOBO_TRY(const auto shaded, raster::shade<float>(program, object, &work));
        fragments += shaded.size();
        vertices += shaded.empty() ? 0 : object.positions.size();
    }
    const auto each = [](double all, std::size_t count) {
        return all / static_cast<double>(std::max<std::size_t>(count, 1));
    };
    evaluation.fragment_cost = each(study::weighted(work.fragments, weights), fragments);
    evaluation.vertex_cost = each(study::weighted(work.vertices, weights), vertices);
    return evaluation;
}

float exposure_of(const Image& picture) {
    constexpr float kWhite = 0.95F;  // leaves the brightest hundredth room above it
    std::vector<float> brightness;   // the largest colour that is not infinite, of each pixel
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            float& largest = brightness.emplace_back(0.0F);
            for (int channel = 0; channel < std::min(picture.channels, 3); ++channel)
                if (std::isfinite(picture.at(x, y, channel)))
                    largest = std::max(largest, picture.at(x, y, channel));
        }
    }
    if (brightness.empty()) return 1;
    const auto place = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() / 100);
    std::nth_element(brightness.begin(), place, brightness.end(), std::greater<>());
    return *place > kWhite ? kWhite / *place : 1;
}

Image exposed(Image picture, float exposure) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = 0; i < picture.values.size(); ++i)
        if (channels < 4 || i % channels < 3) picture.values[i] *= exposure;
    return picture;
}

}  // namespace gobo::gallery
