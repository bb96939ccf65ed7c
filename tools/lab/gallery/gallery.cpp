#include "lab/gallery/gallery.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <mutex>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/html.hpp"
#include "core/parallel.hpp"
#include "core/text_template.hpp"
#include "family/key.hpp"

namespace gobo::gallery {
namespace {

using Json = nlohmann::ordered_json;

/// White in the pictures of errors: the limit that `gobo test --render` holds most pixels to is a fifth of
/// it.
constexpr float kWhiteError = 1e-4F;

std::string value_text(const Feature& feature, int value) {
    return feature.kind == FeatureKind::count ? std::to_string(value)
                                              : feature.values[static_cast<std::size_t>(value)];
}

/// Three digits tell costs apart; more would suggest an exactness that an average has not.
double to_three_digits(double number) {
    const std::string text =
        fmt::format("{:.3g}", number);  // of the doubles nearby the one that is shown as this
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
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

/// Draws a permutation, writes its picture, and evaluates it: an entry without the names of files of what
/// cannot be evaluated. `warnings` are to be told all the same.
Result<Entry> make_entry(const Context& context, const Scene& scene, const Family& family,
                         const Composition& composition, const Validated& validated,
                         const Permutation& permutation, const GalleryOptions& options, FileSystem& files,
                         Diagnostics& warnings) {
    GOBO_TRY(const Drawing drawing, draw(context, scene, family, composition, validated, permutation));
    Entry entry;
    const auto write = [&](std::string& name, const char* end, const Image& picture) {
        name = picture_name(key_text(family, permutation.key)) + end;
        return write_image(files, options.folder + "/" + name, picture);
    };
    entry.key = permutation.key;
    const float exposure = exposure_of(drawing.color);
    entry.exposure = exposure;
    GOBO_TRY_DO(write(entry.actual, ".png", exposed(drawing.color, exposure)));
    warnings = drawing.warnings;
    const auto evaluation = evaluate_drawing(drawing, scene, validated, permutation, options.weights);
    if (!evaluation) {
        for (Diagnostic error : evaluation.error()) {
            error.severity = Severity::warning;
            warnings.push_back(std::move(error));
        }
        return entry;
    }
    const raster::PictureReport& report = evaluation->report;
    entry.largest_error = report.largest_error;
    entry.root_mean_square = report.root_mean_square;
    entry.edges = report.edges;
    entry.pixels = report.pixels;
    entry.fragment_cost = evaluation->fragment_cost;
    entry.vertex_cost = evaluation->vertex_cost;
    GOBO_TRY_DO(write(entry.expected, ".expected.png", exposed(report.expected, exposure)));
    GOBO_TRY_DO(write(entry.difference, ".error.png",
                      difference_picture(report.actual, report.expected, kWhiteError)));
    return entry;
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
    return fill({kTemplate, text}, {{"title", html_escaped("Permutations of " + family.name)},
                                    {"data", html_script(data.dump())}});
}

RenderedSelection make_gallery(const Scene& scene, const Family& family, const Composition& composition,
                               const Validated& validated, const GalleryOptions& options, FileSystem& files,
                               const FileSystem& shipped) {
    const std::vector<Permutation>& permutations = composition.permutations;
    std::vector<Result<Entry>> entries(permutations.size());
    std::vector<Diagnostics> warnings(permutations.size());
    Gallery gallery;
    std::mutex renderer;
    std::atomic<std::size_t> next = 0;
    // Each thread has a context of its own.
    const int jobs =
        std::clamp(options.jobs, 1, static_cast<int>(std::max<std::size_t>(permutations.size(), 1)));
    parallel_for(jobs, static_cast<std::size_t>(jobs), [&](std::size_t) {
        const Result<Context> context = open_context(options.backend);
        for (std::size_t i = next++; i < permutations.size(); i = next++)
            entries[i] = context ? make_entry(*context, scene, family, composition, validated,
                                              permutations[i], options, files, warnings[i])
                                 : tl::unexpected(context.error());
        const std::lock_guard<std::mutex> lock(renderer);
        if (context) gallery.renderer = context->renderer();
    });
    gallery.width = scene.view.width;
    gallery.height = scene.view.height;
    gallery.white_error = kWhiteError;
    gallery.cost_renderer = options.weights.renderer;
    DiagnosticGroups groups(family);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        for (const Diagnostic& diagnostic : entries[i] ? warnings[i] : entries[i].error())
            groups.add(diagnostic, permutations[i].key);
        if (entries[i]) gallery.entries.push_back(std::move(*entries[i]));
    }
    RenderedSelection made;
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
    for (const Entry& entry : gallery.entries) made.files.push_back(options.folder + "/" + entry.actual);
    return made;
}

}  // namespace gobo::gallery
