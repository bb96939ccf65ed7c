#include "targets.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/file_system.hpp"
#include "core/result_cache.hpp"
#include "core/text.hpp"
#include "emit/emit.hpp"
#include "family/expression.hpp"
#include "family/key.hpp"
#include "family/key_space.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/render/image.hpp"
#include "reflect/reflect.hpp"
#include "scene/effects.hpp"
#include "scene/picture.hpp"
#include "scene/read_scene.hpp"
#include "spirv/module.hpp"
#include "spirv/usage.hpp"
#include "validate/batch.hpp"
#include "validate/known_results.hpp"

namespace gobo::fuzz {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

/// Keys of a family that are looked at.
constexpr std::size_t kMostKeys = 16;

void require(bool is_so) {
    if (!is_so) std::abort();
}

/// Errors have to say something.
template <class T>
bool is_value(const Result<T>& result) {
    if (result) return true;
    require(!result.error().empty());
    for (const Diagnostic& error : result.error()) require(!error.message.empty() && !to_text(error).empty());
    return false;
}

/// Parts of an input between lines "---- NAME", by name. What stands before the first has the name "".
Files parts_of(std::string_view input) {
    Files parts;
    std::string name;
    while (!input.empty()) {
        const std::size_t end = std::min(input.find('\n'), input.size() - 1) + 1;
        const std::string_view line = input.substr(0, end);
        input.remove_prefix(end);
        if (line.starts_with("---- "))
            name = trim(line.substr(5));
        else
            parts[name] += line;
    }
    return parts;
}

std::vector<std::uint32_t> words_of(std::string_view input) {
    std::vector<std::uint32_t> words(input.size() / sizeof(std::uint32_t));
    if (!words.empty()) std::memcpy(words.data(), input.data(), words.size() * sizeof words[0]);
    return words;
}

/// A family that has every kind of feature, and two counts to add.
const Family& small_family() {
    static const Family family = read_family(R"(name = "tiny"
vertex = "tiny.vert"
fragment = "tiny.frag"
[features.fog]
values = ["none", "linear", "exponential"]
[features.shade]
define = "SHADED"
[features.point]
count = [0, 3]
constant = "POINTS"
[features.spot]
count = [1, 4]
constant = "SPOTS"
[[rules]]
forbid = "fog == none && point + spot > 3"
reason = "too many"
)",
                                             "tiny.toml")
                                     .value();
    return family;
}

std::vector<Key> some_keys(const Family& family) {
    const Result<std::vector<Key>> keys = select(family, {}, "450");
    if (!is_value(keys)) return {};
    return {keys->begin(), keys->begin() + static_cast<std::ptrdiff_t>(std::min(keys->size(), kMostKeys))};
}

Result<Family> family_of(const Files& parts, const std::string& name) {
    const auto text = parts.find(name);
    const auto find_base = [&](const std::string& base) -> Result<FamilyText> {
        const auto found = parts.find(base);
        if (found == parts.end()) return fail(Fault::usage, "there is no such family");
        return FamilyText{found->second, base};
    };
    return read_family(text == parts.end() ? "" : text->second, "f.toml", find_base);
}

void read_a_family(std::string_view input) {
    const Result<Family> family = family_of(parts_of(input), "");
    if (!is_value(family)) return;
    for (const Key& key : some_keys(*family)) {
        const Result<Key> again = parse_key(*family, key_text(*family, key));
        require(again.has_value() && canonical(*family, *again, "450") == canonical(*family, key, "450"));
    }
}

void read_a_condition(std::string_view input) {
    const Family& family = small_family();
    const auto condition = parse_expression(input, family.features, {"c", 1, 1}, Fault::usage);
    if (!is_value(condition)) return;
    const Expression opposite = negated(*condition);
    for (int fog = 0; fog < 3; ++fog)
        for (int point = 0; point < 4; ++point) {
            Key key(family.features.size(), 0);
            key[0] = fog;
            key[2] = point;
            require(holds(*condition, key) != holds(opposite, key));
        }
}

void select_keys(std::string_view input) {
    const Files parts = parts_of(input);
    const auto part = [&](const char* name) {
        const auto found = parts.find(name);
        return found == parts.end() ? std::string() : found->second;
    };
    Selection selection;
    selection.where = trim(part("where"));
    selection.over = split(part("over"), ',');
    selection.cover = static_cast<int>(split(part("cover"), ',').size());
    selection.all = !part("all").empty();
    selection.keys = keys_of_text(part("keys"), "keys");
    const Family& family = small_family();
    const auto keys = select(family, selection, "450");
    if (!is_value(keys)) return;
    require(std::ranges::is_sorted(*keys) && std::ranges::adjacent_find(*keys) == keys->end());
    for (const Key& key : *keys) require(forbidding_rule(family, key, "450") == nullptr);
}

Result<Composition> composed(const Files& parts, const Family& family) {
    const MemoryFileSystem disk(parts);
    SearchPath search;
    search.add(disk, "", "", true);
    return compose(family, some_keys(family), search, Dialect::own);
}

void compose_files(std::string_view input) {
    Files parts = parts_of(input);
    parts.try_emplace("tiny.vert", "void main() {}\n");
    parts.try_emplace("tiny.frag", "void main() {}\n");
    const Result<Composition> composition = composed(parts, small_family());
    if (!is_value(composition)) return;
    for (const Stage& stage : composition->stages) require(!source_of(*composition, stage).empty());
    for (const Piece& piece : composition->pieces) static_cast<void>(declarations_of(piece.text));
}

void emit_a_header(std::string_view input) {
    const Files parts = parts_of(input);
    const Result<Family> family = family_of(parts, "");
    if (!is_value(family)) return;
    const Result<Composition> composition = composed(parts, *family);
    if (!is_value(composition)) return;
    const DiskFileSystem disk;
    static const HeaderTemplates templates =
        read_header_templates(disk, GOBO_SOURCE_DIR "/templates/header").value();
    const Interface interface;
    const EmitInput emitted{*family, *composition, interface, {}};
    if (is_value(emit_header(emitted, templates))) static_cast<void>(emit_manifest(emitted));
}

void read_spirv(std::string_view input) {
    const std::vector<std::uint32_t> words = words_of(input);
    const Result<spirv::Module> module = spirv::read_module(words);
    if (!is_value(module)) return;
    static_cast<void>(is_value(reflect_stage(*module, spirv::usage_of(*module))));
}

void evaluate_spirv(std::string_view input) {
    const std::vector<std::uint32_t> words = words_of(input);
    const Result<evaluate::Program> program = evaluate::decode(words);
    if (!is_value(program)) return;
    evaluate::Options options;
    options.iteration_limit = 16;
    static_cast<void>(is_value(evaluate::run<float>(*program, {}, options)));
}

void read_gltf(std::string_view input) {
    MemoryFileSystem disk({{"a.gltf", std::string(input)}, {"a.glb", std::string(input)}});
    for (const char* path : {"a.gltf", "a.glb"}) {
        const Result<scene::Scene> scene = scene::read_scene(disk, path);
        if (is_value(scene))
            static_cast<void>(scene::required_effects(*scene, scene::eye_of_cameras(*scene), {}));
    }
}

void read_picture(std::string_view input) {
    const auto picture = scene::decode_picture(input);
    if (!picture) return require(!picture.error().message.empty());
    require(picture->texels.size() == std::size_t{4} * static_cast<std::size_t>(picture->width) *
                                          static_cast<std::size_t>(picture->height));
}

void read_exr(std::string_view input) {
    const Result<Image> image = decode_image(input, image_format_of("exr").value(), "a.exr");
    if (is_value(image))
        require(image->values.size() == static_cast<std::size_t>(image->width) *
                                            static_cast<std::size_t>(image->height) *
                                            static_cast<std::size_t>(image->channels));
}

void read_png(std::string_view input) {
    static_cast<void>(is_value(decode_image(input, image_format_of("png").value(), "a.png")));
}

void read_result(std::string_view input) {
    if (const auto result = result_of(input)) require(result_of(bytes_of(*result)).has_value());
}

}  // namespace

const std::array<Target, 12> kTargets = {{{"family", &read_a_family},
                                          {"condition", &read_a_condition},
                                          {"selection", &select_keys},
                                          {"compose", &compose_files},
                                          {"header", &emit_a_header},
                                          {"spirv", &read_spirv},
                                          {"evaluate", &evaluate_spirv},
                                          {"gltf", &read_gltf},
                                          {"picture", &read_picture},
                                          {"exr", &read_exr},
                                          {"png", &read_png},
                                          {"cache", &read_result}}};

}  // namespace gobo::fuzz
