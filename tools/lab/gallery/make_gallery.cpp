#include "lab/gallery/make_gallery.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "family/diagnostic_groups.hpp"
#include "family/key.hpp"
#include "lab/gallery/evaluation.hpp"
#include "lab/gallery/exposure.hpp"
#include "lab/gallery/gallery.hpp"
#include "lab/render/render.hpp"
#include "validate/validate.hpp"

namespace gobo::gallery {
namespace {

/// White in the pictures of errors: the limit within which the witness of `gobo test --render` holds most
/// pixels is a fifth of it.
constexpr float kWhiteError = 1e-4F;

/// An entry, and what there is to say about it; no entry where the permutation could not be drawn.
struct Finished {
    std::optional<Entry> entry;
    Diagnostics diagnostics;
};

/// Makes entries, by any thread.
class Maker {
  public:
    Maker(const Scene& scene, const Family& family, const Composition& composition,
          const Validated& validated, const GalleryOptions& options, FileSystem& files)
        : scene_(scene),
          family_(family),
          composition_(composition),
          validated_(validated),
          options_(options),
          files_(files) {}

    [[nodiscard]] Finished make(const Context& context, const Permutation& permutation) const {
        const Interface interface = interface_of(validated_, permutation);
        const Result<Drawing> drawing = draw(context, scene_, family_, composition_, permutation, interface);
        if (!drawing) return {std::nullopt, drawing.error()};
        Finished finished{Entry{}, drawing->warnings};
        Entry& entry = *finished.entry;
        entry.key = permutation.key;
        entry.exposure = exposure_of(drawing->color);
        entry.actual = picture_name(key_text(family_, entry.key)) + ".png";
        Result<void> written =
            write(entry.actual, exposed(drawing->color, static_cast<float>(entry.exposure)));
        const Result<Evaluation> evaluation = evaluate(permutation, interface, *drawing);
        if (written && evaluation) written = write_evaluation(*evaluation, entry);
        if (!written) return {std::nullopt, written.error()};
        if (!evaluation) add_warnings(evaluation.error(), finished.diagnostics);
        return finished;
    }

  private:
    [[nodiscard]] Result<Evaluation> evaluate(const Permutation& permutation, const Interface& interface,
                                              const Drawing& drawing) const {
        const auto spirv = [&](int stage) -> const SpirvModule& {
            return validated_.stages[static_cast<std::size_t>(stage)].spirv;
        };
        return evaluate_drawing(drawing, scene_, spirv(permutation.vertex), spirv(permutation.fragment),
                                interface, options_.weights);
    }

    /// What cannot be evaluated is shown all the same.
    static void add_warnings(Diagnostics errors, Diagnostics& diagnostics) {
        for (Diagnostic& error : errors) {
            error.severity = Severity::warning;
            diagnostics.push_back(std::move(error));
        }
    }

    [[nodiscard]] Result<void> write_evaluation(const Evaluation& evaluation, Entry& entry) const {
        const verify::PictureReport& report = evaluation.report;
        entry.largest_error = report.largest_error;
        entry.root_mean_square = report.root_mean_square;
        entry.edges = report.edges;
        entry.pixels = report.pixels;
        entry.fragment_cost = evaluation.fragment_cost;
        entry.vertex_cost = evaluation.vertex_cost;
        const std::string stem = picture_name(key_text(family_, entry.key));
        entry.expected = stem + ".expected.png";
        entry.difference = stem + ".error.png";
        const Result<void> written =
            write(entry.expected, exposed(report.expected, static_cast<float>(entry.exposure)));
        if (!written) return written;
        return write(entry.difference, difference_picture(report.actual, report.expected, kWhiteError));
    }

    [[nodiscard]] Result<void> write(const std::string& name, const Image& picture) const {
        const auto written = write_image(files_, options_.folder + "/" + name, picture);
        if (!written) return tl::unexpected(written.error());
        return {};
    }

    const Scene& scene_;
    const Family& family_;
    const Composition& composition_;
    const Validated& validated_;
    const GalleryOptions& options_;
    FileSystem& files_;
};

/// All permutations, in their order, and what drew them.
struct All {
    std::vector<Finished> finished;
    std::string renderer;
};

All make_all(const Maker& maker, const GalleryOptions& options,
             const std::vector<Permutation>& permutations) {
    All all;
    all.finished.resize(permutations.size());
    std::atomic<std::size_t> next = 0;
    std::mutex renderer;
    const auto work = [&] {
        const Result<Context> context = open_context(options.backend);
        for (std::size_t i = next++; i < permutations.size(); i = next++)
            all.finished[i] =
                context ? maker.make(*context, permutations[i]) : Finished{std::nullopt, context.error()};
        const std::lock_guard<std::mutex> lock(renderer);
        if (context) all.renderer = context->renderer();
    };
    std::vector<std::jthread> threads;
    const std::size_t jobs =
        std::min(static_cast<std::size_t>(std::max(options.jobs, 1)), permutations.size());
    for (std::size_t i = 0; i < jobs; ++i) threads.emplace_back(work);
    threads.clear();  // joins
    return all;
}

}  // namespace

MadeGallery make_gallery(const Scene& scene, const Family& family, const Composition& composition,
                         const Validated& validated, const GalleryOptions& options, FileSystem& files,
                         const FileSystem& shipped) {
    const Maker maker(scene, family, composition, validated, options, files);
    All all = make_all(maker, options, composition.permutations);
    Gallery gallery;
    gallery.renderer = all.renderer;
    gallery.width = scene.view.width;
    gallery.height = scene.view.height;
    gallery.white_error = kWhiteError;
    gallery.cost_renderer = options.weights.renderer;
    DiagnosticGroups groups(family);
    std::vector<Finished>& finished = all.finished;
    for (std::size_t i = 0; i < finished.size(); ++i) {
        for (const Diagnostic& diagnostic : finished[i].diagnostics)
            groups.add(diagnostic, composition.permutations[i].key);
        if (finished[i].entry) gallery.entries.push_back(std::move(*finished[i].entry));
    }
    MadeGallery made;
    made.diagnostics = groups.result();
    const Result<std::string> text = page(shipped, family, gallery);
    const std::string path = options.folder + "/index.html";
    const Result<bool> written = text ? files.write(path, *text) : tl::unexpected(text.error());
    if (!written) {
        made.diagnostics.insert(made.diagnostics.end(), written.error().begin(), written.error().end());
        return made;
    }
    made.files.push_back(path);
    for (const Entry& entry : gallery.entries) made.files.push_back(options.folder + "/" + entry.actual);
    return made;
}

}  // namespace gobo::gallery
