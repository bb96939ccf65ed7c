#include "lab/study/instructions.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define GOBO_HAS_CALLGRIND 1
#else
#define GOBO_HAS_CALLGRIND 0
#endif

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "family/key.hpp"
#include "lab/render/framebuffer.hpp"
#include "lab/study/scene_shadows.hpp"
#include "lab/verify/render_feed.hpp"

namespace gobo::study {
namespace {

constexpr std::array<std::pair<int, int>, 2> kSizes = {{{64, 48}, {160, 120}}};

#if GOBO_HAS_CALLGRIND
constexpr std::string_view kOnlyWhatIsAsked = "--instr-atstart=no ";
void start_counting_instructions() {
    CALLGRIND_START_INSTRUMENTATION;
}
void stop_counting_instructions() {
    CALLGRIND_STOP_INSTRUMENTATION;
}
#else  // built without valgrind's headers: all that the process does is counted, which takes ten times as long
constexpr std::string_view kOnlyWhatIsAsked;
void start_counting_instructions() {}
void stop_counting_instructions() {}
#endif

/// What a command prints, both streams; nothing where it fails.
std::optional<std::string> printed_by(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    std::string text;
    std::array<char, 4096> buffer{};
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        text.append(buffer.data(), count);
    if (::pclose(pipe) != 0) return std::nullopt;
    return text;
}

/// The number after a word.
std::optional<double> number_after(const std::string& text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string::npos) return std::nullopt;
    return std::strtod(text.c_str() + at + word.size(), nullptr);
}

struct Drawn {
    double instructions = 0;
    double fragments = 0;
};

Result<Drawn> draw_under_callgrind(const std::string& command) {
    const std::string whole = fmt::format(
        "valgrind --tool=callgrind {}--callgrind-out-file=/dev/null {}", kOnlyWhatIsAsked, command);
    const std::optional<std::string> text = printed_by(whole);
    const auto instructions = text ? number_after(*text, "Collected :") : std::nullopt;
    const auto fragments = text ? number_after(*text, "fragments ") : std::nullopt;
    if (instructions && fragments) return Drawn{*instructions, *fragments};
    return fail(Fault::file, fmt::format("callgrind counts nothing: {}", whole),
                "install valgrind, or leave out --callgrind");
}

Result<double> slope(const DrawCommand& command, const std::string& key) {
    std::array<Drawn, 2> drawn;
    for (std::size_t i = 0; i < 2; ++i) {
        const Result<Drawn> one = draw_under_callgrind(command(key, kSizes[i].first, kSizes[i].second));
        if (!one) return tl::unexpected(one.error());
        drawn[i] = *one;
    }
    return (drawn[1].instructions - drawn[0].instructions) / (drawn[1].fragments - drawn[0].fragments);
}

}  // namespace

Result<double> draw_once(const FileSystem& shipped, const Family& family, const SearchPath& search,
                         const StudyPlan& plan, const Context& context, const Key& key, int width,
                         int height) {
    Result<DrawnScene> scene = draw_scene(shipped, family, plan.scenes.front(), width, height);
    if (!scene) return tl::unexpected(scene.error());
    scene = with_shadows(family, key, std::move(*scene));
    const Result<Variants> variants = load_variants(family, search, {key}, 1);
    if (!variants) return tl::unexpected(variants.error());
    const Permutation& permutation = variants->composition.permutations.front();
    const auto framebuffer = make_framebuffer(context, width, height);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    const auto program = link_program(context, {stage_text(variants->composition, permutation.vertex),
                                                stage_text(variants->composition, permutation.fragment)});
    if (!program) return tl::unexpected(program.error());
    const Interface& interface = variants->all.front().interface;
    set_bindings(context, *program, interface);
    ViewedObject viewed;
    viewed.view = scene->view.camera.view();
    viewed.projection = scene->view.camera.projection(static_cast<double>(width) / height);
    viewed.viewport = {width, height};
    const auto list = make_draw_list(context, *program, interface, scene->objects,
                                     verify::with_plain_textures(interface, scene->values), viewed);
    if (!list) return tl::unexpected(list.error());
    framebuffer->bind();
    count_fragments(context, *list);  // compiles, which is not to be counted
    start_counting_instructions();
    const double fragments = count_fragments(context, *list);
    stop_counting_instructions();
    return fragments;
}

Result<void> count_instructions(const Family& family, const SearchPath& search, const DrawCommand& command,
                                const std::string& machine, const Progress& progress, Journal& journal,
                                Study& study) {
    EffectsResult& effects = study.effects.back();
    for (std::size_t i = 0; i < effects.keys.size(); ++i) {
        KeyResult& result = effects.keys[i];
        if (!result.timing) continue;
        progress("instructions of " + key_text(family, result.key), i, effects.keys.size());
        const Result<Variants> variants = load_variants(family, search, {result.key}, 1);
        if (!variants) return tl::unexpected(variants.error());
        const std::string identity = identity_of_text(fmt::format(
            "instructions 1 {} {} {:x}", machine, result.timing->renderer, variants->all.front().hash));
        if (const auto known = journal.find(identity); known && known->is_number()) {
            result.instructions = known->get<double>();
            continue;
        }
        const Result<double> counted = slope(command, key_text(family, result.key));
        if (!counted) return tl::unexpected(counted.error());
        result.instructions = *counted;
        if (auto added = journal.add(identity, *counted); !added) return added;
    }
    progress("", effects.keys.size(), effects.keys.size());
    return {};
}

}  // namespace gobo::study
