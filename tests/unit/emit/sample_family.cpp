#include "sample_family.hpp"

#include <set>

#include <fmt/format.h>

namespace gobo::sample {
namespace {

int add_piece(Composition& composition, const std::string& name, const std::string& text) {
    composition.pieces.push_back({name, name, text, false});
    return static_cast<int>(composition.pieces.size()) - 1;
}

Interface lit_interface() {
    Interface interface;
    const std::vector<Member> light = {member("position", "vec4", 0), member("color", "vec3", 16),
                                       member("attenuation", "vec3", 32), member("enabled", "bool", 44)};
    interface.blocks = {
        block("Camera", 0, 112, {matrix("projection", "mat4", 0), matrix("normalMatrix", "mat3", 64)}),
        block("Fog", 3, 32,
              {member("color", "vec3", 0), member("near", "float", 12), member("far", "float", 16)}),
        block("PointLights", 2, 16 + 3 * 48,
              {member("ambient", "vec3", 0), array(structure("lights", "PointLight", 16, light), {3}, 48)}),
    };
    interface.inputs = {{"normal", "vec3", 1, {}}, {"position", "vec3", 0, {}}};
    interface.outputs = {{"fragmentColor", "vec4", -1, {}}};
    interface.samplers = {{"shadowMaps", "sampler2DArrayShadow", 4, {}, {"fragment"}}};
    interface.uniforms = {{"exposure", "float", -1, {}, {}, {"fragment"}}};
    return interface;
}

Interface nasty_interface() {
    Interface interface;
    const std::vector<Member> inner = {matrix("basis", "mat3", 0), member("switch", "float", 48)};
    const std::vector<Member> outer = {array(structure("inner", "Inner", 0, inner), {2}, 64),
                                       member("Inner", "vec2", 128)};
    interface.blocks = {
        // A member with the block's own name, and one with that of a constant.
        block("Lights", -1, 32,
              {member("Lights", "vec4", 0), member("binding", "ivec3", 16), member("size", "uint", 28)}),
        block("default", 1, 16, {member("bytes", "bool", 0)}),
        block("std140", -1, 496,
              {array(member("weights", "float", 0), {3}, 16), array(member("pairs", "vec2", 48), {2, 3}, 48),
               array(matrix("turns", "mat3", 144), {2}, 48), matrix("rows", "mat3x2", 240, true),
               matrix("columns", "mat3x2", 272), matrix("square", "mat4", 320, true),
               member("flags", "bvec3", 384), structure("outer", "Outer", 400, outer)}),
        block("key", 7, 144, {structure("Outer", "Outer", 0, outer)}),
    };
    interface.blocks[2].size = 544;
    interface.inputs = {{"auto", "vec3", -1, {}}, {"bones", "mat4", 0, {}}, {"gl_VertexID", "int", -1, {}}};
    interface.samplers = {{"int_", "sampler2D", -1, {4}, {"fragment"}},
                          {"register", "samplerCube", -1, {}, {}}};
    interface.outputs = {{"a", "vec4", 0, {}}, {"b", "vec4", 1, {}}};
    interface.uniforms = {
        {"lamp", "Lamp", -1, {}, {member("tint", "vec3", 0)}, {}},
        {"lamps", "Lamps", 3, {2}, {array(member("tint", "vec3", 0), {2}, 0)}, {}},
        {"table", "float", -1, {2, 3}, {}, {}},
    };
    return interface;
}

}  // namespace

void compose_keys(Built& built, const std::vector<std::string>& keys) {
    Composition& composition = built.composition;
    const int shared =
        add_piece(composition, "shader_lib/common.glsl", "// shared\nfloat half() { return 0.5; }\n");
    const int vertex = add_piece(composition, "lit.vert", "void main() {}\n");
    composition.stages.push_back({StageKind::vertex, {shared, vertex}});
    for (const std::string& text : keys) {
        const Key key = canonical(built.family, parse_key(built.family, text).value(), "450");
        const std::string name = key_text(built.family, key);
        const int own =
            add_piece(composition, "piece of " + name, "// " + name + "\n\"quoted\" \\ )gobo\" )gobo2\"\n");
        composition.pieces.back().first_line = 31;
        composition.stages.push_back({StageKind::fragment, {shared, own}});
        composition.permutations.push_back({key, {0, static_cast<int>(composition.stages.size()) - 1}});
    }
}

Built lit() {
    Built built;
    Family& family = built.family;
    family.name = "lit";
    family.features = {
        choice("depth", {"default", "early", "less"}),
        count("directional", 8),
        choice("fog", {"none", "linear", "exponential"}),
        choice("fog_distance", {"radial", "planar"}),
        count("point", 8),
        choice("shading", {"fragment", "vertex", "hybrid"}),
        choice("specular", {"none", "phong", "blinn"}),
    };
    family.rules = {
        defaults(family, "fog == none", {"fog_distance"}),
        defaults(family, "directional + point == 0", {"specular", "shading"}),
        forbid(family, "shading == hybrid && directional + point > 12",
               "more than the 60 varying components that OpenGL guarantees"),
    };
    family.domains = {{"Fog.near", 0, 1e6, false, {}, {}, {}},
                      {"Fog.near <= Fog.far", 0, 0, false, {}, {}, {}},
                      {"PointLights.lights[].attenuation", 0.001, 10, false, {}, {0}, {}},
                      {"PointLights.lights[].attenuation.x", 0.001, 2, false, {}, {0}, {}},
                      {"normal", 0.5, 2, true, {}, {}, {}}};
    built.interface = lit_interface();
    compose_keys(built,
                 {"default", "fog=linear", "point=3 shading=vertex fog=linear", "point=3", "directional=2"});
    return built;
}

Built grown_lit() {
    Built built = lit();
    Family& family = built.family;
    family.features.insert(family.features.begin(), choice("attenuation", {"quadratic", "window"}));
    family.features[3].values = {"none", "height", "linear", "exponential"};
    // Conditions hold feature numbers: they are read again.
    family.rules = {defaults(family, "fog == none", {"fog_distance"}),
                    defaults(family, "directional + point == 0", {"specular", "shading", "attenuation"})};
    built.composition = {};
    compose_keys(built, {"default", "fog=linear", "point=3 shading=vertex fog=linear", "point=3",
                         "directional=2", "attenuation=window point=3"});
    return built;
}

Built nasty() {
    Built built;
    Family& family = built.family;
    family.name = "class";
    family.features = {
        choice("2d", {"4x", "16x", "_8x", "8x"}),
        choice("Key", {"Key", "NULL", "linux"}),
        define("default"),
        choice("fog", {"Fog", "fog", "a__b", "a-b"}),
        choice("fog_", {"none"}),
        count("int", 8),
        choice("key", {"register", "co_await"}),
        choice("switch", {"int", "default", "requires"}),
    };
    for (int number = 10; number < 30; ++number)
        family.features.push_back(count(fmt::format("z{}", number), 15));
    family.rules = {
        // The second rule sets what the first one looks at: one pass is not enough.
        defaults(family, "default == off", {"int"}),
        defaults(family, "switch == int", {"default"}),
        forbid(family, "!(int <= 6) || (switch == requires && key == co_await)",
               "because \"quoted\" \\ \t odd ?\?/"),
    };
    family.domains = {{"std140.outer.Inner", 0, 4, true, {}, {}, {}},
                      {"std140.outer.inner[].switch", 0, 1, false, {}, {}, {}},
                      {"std140.rows", -5, 5, false, {}, {}, {}},
                      {"std140.weights", 0, 1, false, {}, {}, {}}};
    built.interface = nasty_interface();
    compose_keys(built,
                 {"default", "switch=default default=on int=5", "z10=15 z29=7 2d=8x", "z29=8 Key=linux"});
    Piece& piece = built.composition.pieces.front();
    for (int line = 0; line < 3000; ++line)
        piece.text += fmt::format("// line {} of a long file\n", line + 3);
    built.composition.pieces[1].text = std::string(
        "bytes \x01 \xC3\xA9 \0 ?"
        "?/ end without a line end",
        39);
    return built;
}

Built macros() {
    Built built;
    built.family.name = "macros";
    built.family.features = {choice("small", {"none", "None", "near", "far", "IN", "TRANSPARENT"}),
                             choice("status", {"Success", "Always", "ERROR"}), count("interface", 3),
                             define("Bool"), choice("limit", {"EOF", "INT_MAX", "M_PI", "EDOM"})};
    built.family.rules = {defaults(built.family, "Bool == off", {"interface"})};
    built.interface.blocks = {
        block("Complex", 0, 48,
              {member("near", "float", 0), member("far", "float", 4), member("True", "bool", 8),
               structure("DELETE", "Status", 16, {member("OPTIONAL", "vec4", 0)}), member("min", "float", 32),
               member("max", "float", 36)})};
    built.family.domains = {{"Complex.near", 0, 1, false, {}, {}, {}}};
    built.interface.inputs = {{"OUT", "vec3", 0, {}}};
    built.interface.outputs = {{"False", "vec4", 0, {}}};
    built.interface.samplers = {{"Above", "sampler2D", 0, {}, {}}};
    built.interface.storage_blocks = {
        block("OPAQUE", 0, 0, {member("near", "uint", 0), array(member("max", "float", 4), {0}, 4)})};
    built.interface.uniforms = {{"min", "float", -1, {}, {}, {}},
                                {"min", "vec2", -1, {}, {}, {}},
                                {"Window", "Bool", -1, {}, {member("small", "float", 0)}, {}}};
    compose_keys(built, {"default", "small=None status=ERROR Bool=on interface=2 limit=INT_MAX"});
    built.differing = {{"uniform", "min", {1, 2}}};
    return built;
}

Built arrays() {
    Built built;
    built.family.name = "arrays";
    Member reached = array(matrix("turns", "mat3", 0), {2}, 48);
    reached.offset = 352;
    built.interface.blocks = {
        block("Arrays", 0, 512,
              {array(member("taps", "vec2", 0), {3}, 16), array(member("order", "uint", 48), {4}, 16),
               array(member("weights", "float", 112), {2}, 16), array(member("on", "bool", 144), {3}, 16),
               array(member("masks", "bvec3", 192), {2}, 16), array(member("offsets", "vec3", 224), {2}, 16),
               matrix("turn", "mat3", 256), matrix("rows", "mat3", 304, true), reached,
               member("lit", "bool", 448), member("mask", "bvec2", 456), member("point", "vec3", 464)}),
        // Stated offsets need not rise with the members.
        block("Order", 1, 16, {member("late", "float", 8), member("early", "float", 4)})};
    // An array of blocks, by name: "Shadows[10]" stands before "Shadows[2]".
    for (const char* index : {"0", "1", "10", "2", "3", "4", "5", "6", "7", "8", "9"})
        built.interface.blocks.push_back(
            block(fmt::format("Shadows[{}]", index), -1, 64, {matrix("view", "mat4", 0)}));
    const std::vector<Member> pair = {member("a", "vec2", 0)};
    const std::vector<Member> particle = {member("position", "vec3", 0), member("mass", "float", 12),
                                          member("tint", "vec2", 16), member("fixed", "bool", 24)};
    Member turn = matrix("turn", "mat2", 16);
    turn.matrix_stride = 8;
    built.interface.storage_blocks = {
        // As std430 lays it out: structs and arrays are not rounded up to 16 bytes.
        block("Grid", 3, 0,
              {array(member("cells", "float", 0), {4}, 4), turn, structure("pair", "Pair", 32, pair),
               member("after", "float", 40), array(member("on", "bool", 44), {2}, 4),
               array(structure("pairs", "Pair", 56, pair), {2}, 8)}),
        block("Loose", -1, 0, {array(structure("pairs", "Pair", 0, pair), {2}, 16)}),
        block("Mixed", -1, 0,
              {member("wide", "double", 0), member("narrow", "float", 8),
               array(member("rest", "float", 12), {0, 3}, 12)}),
        block("Particles", -1, 0,
              {member("count", "uint", 0), member("awake", "bool", 4),
               array(structure("particles", "Particle", 16, particle), {0}, 32)}),
        block("Samples", -1, 0, {array(member("samples", "vec3", 0), {0}, 16)})};
    built.family.domains = {{"Grid.after", 0, 1, false, {}, {}, {}},
                            {"Arrays.on", 0, 1, false, {}, {}, {}},
                            {"Arrays.masks", 0, 1, false, {}, {}, {}}};
    compose_keys(built, {"default"});
    return built;
}

Built bare() {
    Built built;
    built.family.name = "bare";
    compose_keys(built, {"default"});
    return built;
}

namespace {

Family large_family() {
    Family family;
    family.name = "large";
    family.features = {
        choice("depth", {"default", "early", "any", "greater", "less", "unchanged"}),
        choice("diffuse", {"lambert", "toon"}),
        count("directional", 8),
        choice("fog", {"none", "linear", "exponential", "exponential_squared"}),
        choice("fog_distance", {"radial", "planar"}),
        count("point", 8),
        choice("shading", {"fragment", "vertex", "hybrid"}),
        choice("specular", {"none", "phong", "blinn"}),
        count("spot", 8),
    };
    family.rules = {
        defaults(family, "fog == none", {"fog_distance"}),
        defaults(family, "directional + point + spot == 0", {"specular", "shading", "diffuse"}),
        defaults(family, "diffuse == toon", {"specular"}),
        forbid(family, "shading == hybrid && directional + point + spot > 12", "too many varying components"),
        forbid(family, "directional + point + spot > 20", "too many uniforms"),
    };
    return family;
}

/// Different canonical keys, spread over the whole family: the values of multiples of a prime in mixed radix.
std::vector<Key> spread_keys(const Family& family, std::size_t count) {
    std::set<Key> keys;
    for (std::size_t number = 0; keys.size() < count; number += 7919) {
        Key key;
        std::size_t rest = number;
        for (const Feature& feature : family.features) {
            key.push_back(static_cast<int>(rest % feature.values.size()));
            rest /= feature.values.size();
        }
        keys.insert(canonical(family, key, "450"));
    }
    return {keys.begin(), keys.end()};
}

}  // namespace

Built large(std::size_t permutations) {
    Built built;
    built.family = large_family();
    built.interface = lit_interface();
    Composition& composition = built.composition;
    constexpr int piece_count = 200;
    for (int piece = 0; piece < piece_count; ++piece) {
        std::string text;
        for (int line = 0; line < 40; ++line) {
            text += fmt::format("float f{}_{}() {{ return 1.0; }}\n", piece, line);
        }
        add_piece(composition, fmt::format("shader_lib/piece_{}.glsl", piece), text);
    }
    composition.stages.push_back({StageKind::vertex, {0, 1, 2}});
    for (const Key& key : spread_keys(built.family, permutations)) {
        const auto number = static_cast<int>(composition.stages.size());
        Stage stage{StageKind::fragment, {}};
        for (int piece = 0; piece < 13; ++piece) {
            stage.pieces.push_back((number * 7 + piece * (number + 1)) % piece_count);
        }
        composition.stages.push_back(stage);
        composition.permutations.push_back({key, {0, number}});
    }
    return built;
}

Built drawn() {
    Built built;
    Family& family = built.family;
    family.name = "drawn";
    family.features = {choice("tint", {"none", "texture", "broken"})};
    Composition& composition = built.composition;
    composition.dialect = Dialect::glsl330;
    const int version = add_piece(composition, "version.glsl", "#version 330 core\n");
    const int vertex = add_piece(composition, "drawn.vert",
                                 "in vec4 corner;\nin vec4 position;\n"
                                 "void main() { gl_Position = position + corner; }\n");
    const int block = add_piece(composition, "colors.glsl",
                                "layout(std140) uniform Colors { vec4 color; };\n"
                                "layout(std140) uniform Bases { vec4 base; };\nout vec4 result;\n");
    composition.stages.push_back({StageKind::vertex, {version, vertex}});
    const std::vector<std::string> tints = {
        "void main() { result = color * base; }\n",
        "uniform sampler2D maps[2];\nuniform sampler2D image;\n"
        "void main() { result = color * base * texture(maps[1], color.xy) * texture(image, color.xy); }\n",
        "void main() {\n    result = colour;\n}\n",
    };
    for (std::size_t value = 0; value < tints.size(); ++value) {
        const int tint =
            add_piece(composition, "tint/" + family.features[0].values[value] + ".glsl", tints[value]);
        composition.stages.push_back({StageKind::fragment, {version, block, tint}});
        composition.permutations.push_back({{static_cast<int>(value)}, {0, static_cast<int>(value) + 1}});
    }
    built.interface.blocks = {sample::block("Bases", 5, 16, {member("base", "vec4", 0)}),
                              sample::block("Colors", 2, 16, {member("color", "vec4", 0)})};
    built.interface.inputs = {{"corner", "vec4", 4, {}}, {"position", "vec4", -1, {}}};
    built.interface.outputs = {{"result", "vec4", -1, {}}};
    built.interface.samplers = {{"image", "sampler2D", -1, {}, {}}, {"maps", "sampler2D", 3, {2}, {}}};
    return built;
}

}  // namespace gobo::sample
