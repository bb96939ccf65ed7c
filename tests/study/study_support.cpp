#include "study_support.hpp"

#include "../verify/lit_library.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo::study {
namespace {

const std::string kSource = GOBO_SOURCE_DIR "/";

/// The source tree, by paths that are relative to it.
class SourceFiles final : public FileSystem {
  public:
    [[nodiscard]] bool is_file(const std::string& path) const override {
        return disk_.is_file(kSource + path);
    }
    [[nodiscard]] Result<std::string> read(const std::string& path) const override {
        return disk_.read(kSource + path);
    }
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override {
        return disk_.files_below(kSource + folder);
    }
    Result<bool> write(const std::string& path, std::string_view) override {
        return fail(Fault::internal, "a test writes to " + path);
    }

  private:
    DiskFileSystem disk_;
};

const MemoryFileSystem& small_pieces() {
    static const MemoryFileSystem pieces({
        {"small/small.vert",
         "#include \"place.glsl\"\n#include <varyings>\nBLOCK(0, Transform) { mat4 modelViewProjection; "
         "} transform;\n"
         "void main() { gl_Position = transform.modelViewProjection * vec4(position, 1.0); writeVaryings(); "
         "}\n"},
        {"small/place.glsl", "ATTRIBUTE(0) vec3 position;\n"},
        {"small/small.frag",
         "#include <shape>\nOUTPUT(0) vec4 color;\nvoid main() { color = vec4(shape(place), 0.0, 0.0, 1.0); "
         "}\n"},
        {"small/shape/good.glsl", "float shape(vec3 p) { return 0.5 + 0.5 * sin(p.x); }\n"},
        {"small/shape/slow.glsl", "float shape(vec3 p) { return 0.5 + 0.5 * sin(p.x + 1e-3 * cos(p.y)); }\n"},
        {"small/shape/rough.glsl", "float shape(vec3 p) { return 0.5 + 0.4 * p.x; }\n"},
    });
    return pieces;
}

}  // namespace

Family read_small_family() {
    return read_family(R"(
name = "small"
vertex = "small.vert"
fragment = "small.frag"
[features.shape]
role = "quality"
values = ["good", "slow", "rough"]
[varyings.place]
location = 0
type = "vec3"
piece = "place.glsl"
value = "position"
)",
                       "small/small.toml")
        .value();
}

SearchPath search_for_small_family() {
    SearchPath search;
    search.add(small_pieces(), "small", "small/", false);
    return search;
}

const FileSystem& source_files() {
    static const SourceFiles files;
    return files;
}

const LitUnderStudy& lit_under_study() {
    static const LitUnderStudy lit = [] {
        LitUnderStudy made;
        made.family = lit_family();
        for (const std::string folder : {"shader_lib", "templates"})
            made.search.add(source_files(), folder, folder + "/", false);
        const std::string path = "data/study/weights.csv";
        made.weights = read_weights(source_files().read(path).value(), path).value().front();
        return made;
    }();
    return lit;
}

Key lit_key(const std::string& text) {
    return parse_key(lit_under_study().family, text).value();
}

Append append_to(MemoryFileSystem& files) {
    return [&files](const std::string& path, std::string_view text) -> Result<void> {
        const std::string before = files.is_file(path) ? files.read(path).value() : "";
        if (auto written = files.write(path, before + std::string(text)); !written)
            return tl::unexpected(written.error());
        return {};
    };
}

Subject lit_subject(int jobs) {
    const LitUnderStudy& lit = lit_under_study();
    return {source_files(), lit.family, lit.search, jobs};
}

StudyOptions quick_options(std::vector<std::string> effects) {
    StudyOptions options;
    options.effects = std::move(effects);
    options.quick = true;
    const std::string path = "data/study/lit.toml";
    options.plan = read_plan(source_files().read(path).value(), path, lit_under_study().family).value();
    options.weights = lit_under_study().weights;
    return options;
}

}  // namespace gobo::study
