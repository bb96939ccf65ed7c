#include "gallery/make_gallery.hpp"

#include <deque>
#include <future>

#include <fmt/format.h>

#include "family/diagnostic_groups.hpp"
#include "family/key.hpp"
#include "gallery/evaluation.hpp"
#include "gallery/exposure.hpp"
#include "gallery/gallery.hpp"
#include "render/render_selection.hpp"
#include "validate/validate.hpp"

namespace gobo::gallery {
namespace {

/// White in the pictures of errors: the limit within which the witness of `gobo test --render` holds most
/// pixels is a fifth of it.
constexpr float kWhiteError = 1e-4F;

/// Draws one permutation after the other, since a context is one thread's, while others are evaluated.
class Maker {
  public:
    Maker(const Context& context, const Scene& scene, const Family& family, const Composition& composition,
          const Validated& validated, const GalleryOptions& options, FileSystem& files)
        : context_(context),
          scene_(scene),
          family_(family),
          composition_(composition),
          validated_(validated),
          options_(options),
          files_(files),
          groups_(family) {
        gallery_.renderer = context.renderer();
        gallery_.width = scene.view.width;
        gallery_.height = scene.view.height;
        gallery_.white_error = kWhiteError;
    }

    void make(const Permutation& permutation) {
        Interface interface = interface_of(validated_, permutation);
        Result<Drawing> drawing = draw(context_, scene_, family_, composition_, permutation, interface);
        add(drawing ? drawing->warnings : drawing.error(), permutation.key);
        if (!drawing) return;
        while (under_way_.size() >= static_cast<std::size_t>(std::max(options_.jobs, 1))) finish_first();
        const auto evaluate = [this, &permutation, interface = std::move(interface),
                               drawing = std::move(*drawing)] {
            return entry_of(permutation, interface, drawing);
        };
        under_way_.push_back({&permutation.key, std::async(std::launch::async, evaluate)});
    }

    /// What was made, once all is finished.
    Gallery finish() {
        while (!under_way_.empty()) finish_first();
        return std::move(gallery_);
    }
    [[nodiscard]] Diagnostics diagnostics() const { return groups_.result(); }

  private:
    /// An entry, and why it has no evaluation.
    struct Finished {
        Entry entry;
        Diagnostics warnings;
    };

    struct UnderWay {
        const Key* key;
        std::future<Result<Finished>> finished;
    };

    void finish_first() {
        Result<Finished> finished = under_way_.front().finished.get();
        add(finished ? finished->warnings : finished.error(), *under_way_.front().key);
        if (finished) gallery_.entries.push_back(std::move(finished->entry));
        under_way_.pop_front();
    }

    [[nodiscard]] Result<Finished> entry_of(const Permutation& permutation, const Interface& interface,
                                            const Drawing& drawing) const {
        const auto spirv = [&](int stage) -> const SpirvModule& {
            return validated_.stages[static_cast<std::size_t>(stage)].spirv;
        };
        Result<Evaluation> evaluation =
            evaluate_drawing(drawing, scene_, spirv(permutation.vertex), spirv(permutation.fragment),
                             interface, options_.weights);
        Finished finished;
        Entry& entry = finished.entry;
        entry.key = permutation.key;
        entry.exposure = exposure_of(drawing.color);
        entry.actual = picture_name(key_text(family_, entry.key)) + ".png";
        Result<void> written =
            write(entry.actual, exposed(drawing.color, static_cast<float>(entry.exposure)));
        if (written && evaluation) written = write_evaluation(*evaluation, entry);
        if (!written) return tl::unexpected(written.error());
        if (evaluation) return finished;
        finished.warnings = evaluation.error();
        for (Diagnostic& warning : finished.warnings) warning.severity = Severity::warning;
        return finished;
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

    void add(const Diagnostics& diagnostics, const Key& key) {
        for (const Diagnostic& diagnostic : diagnostics) groups_.add(diagnostic, key);
    }

    const Context& context_;
    const Scene& scene_;
    const Family& family_;
    const Composition& composition_;
    const Validated& validated_;
    const GalleryOptions& options_;
    FileSystem& files_;
    DiagnosticGroups groups_;
    Gallery gallery_;
    std::deque<UnderWay> under_way_;
};

}  // namespace

MadeGallery make_gallery(const Context& context, const Scene& scene, const Family& family,
                         const Composition& composition, const Validated& validated,
                         const GalleryOptions& options, FileSystem& files, const FileSystem& shipped) {
    Maker maker(context, scene, family, composition, validated, options, files);
    for (const Permutation& permutation : composition.permutations) maker.make(permutation);
    Gallery gallery = maker.finish();
    gallery.cost_renderer = options.weights.renderer;
    MadeGallery made;
    made.diagnostics = maker.diagnostics();
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
