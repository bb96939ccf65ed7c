// Pictures of a whole selection: the family lit, in every dialect and on both backends.
#include "lab/render/render_selection.hpp"

#include <set>

#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "lab/render/driver_tasks.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

template <class Value>
Value value_of(Result<Value> result) {
    EXPECT_TRUE(result) << to_text(result.error());
    return std::move(result.value());
}

/// A family with its pieces in files.
struct Source {
    const FileSystem& files;
    std::string folder;
    std::string family;
};

/// Renders the keys to memory, 32 x 24 pixels as PFM.
RenderedSelection render(const Source& source, const Selection& selection, Dialect dialect, Backend backend,
                         MemoryFileSystem& pictures) {
    const std::string path = source.folder + "/" + source.family;
    const Family family = value_of(read_family(value_of(source.files.read(path)), path));
    SearchPath search;
    for (const std::string folder : {"/shader_lib", "/templates"})
        search.add(source.files, source.folder + folder, folder.substr(1) + "/", false);
    const auto keys = value_of(select(family, selection, name_of(dialect)));
    const Composition composition = value_of(compose(family, keys, search, dialect));
    const Validated validated = validate(family, composition, {});
    EXPECT_EQ(to_text(validated.diagnostics), "");
    std::vector<Interface> interfaces;
    for (const Permutation& permutation : composition.permutations)
        interfaces.push_back(interface_of(validated, permutation));
    View view;
    view.camera = demo_camera();
    view.width = 32;
    view.height = 24;
    const std::vector<Object> objects = demo_objects(make_torus(1, 0.4, 48, 24));
    const auto open = [&]() -> Result<std::unique_ptr<KeyRenderer>> {
        GOBO_TRY(const Context context, open_context(backend));
        return opengl_renderer(context, {family, composition, interfaces, objects, view});
    };
    return value_of(
        render_selection("the renderer", 2, family, composition, {"out", ImageFormat::pfm}, pictures, open));
}

bool can_open(Backend backend) {
    DriverTasks<Context, int> tasks{"EGL", 1};
    tasks.open = [&] { return open_context(backend); };
    tasks.work = [](const Context&, std::size_t, DriverClock&) { return Result<int>(1); };
    tasks.done = [](std::size_t, const Result<int>&, std::optional<int>) {};
    return ask_driver(tasks).has_value();
}

struct Row {
    const char* name;
    Dialect dialect;
    Backend backend;
};

class Lit : public testing::TestWithParam<Row> {};

/// One renderer, the same expressions: the pictures are the same to the bit, whatever the dialect.
TEST_P(Lit, RendersAsIn450OnOsmesa) {
    // EGL is optional: OSMesa alone must draw, so only its absence is a failure.
    if (GetParam().backend == Backend::egl && !can_open(Backend::egl)) GTEST_SKIP() << "there is no EGL";
    const DiskFileSystem disk;
    const Source lit{disk, GOBO_SOURCE_DIR, "templates/lit.toml"};
    Selection selection;
    selection.cover = 2;
    selection.over = {"directional", "point", "spot", "specular", "fog", "shading"};
    selection.where = "directional <= 1 && point <= 2 && spot <= 1";
    MemoryFileSystem expected;
    MemoryFileSystem actual;
    const RenderedSelection reference = render(lit, selection, Dialect::glsl450, Backend::osmesa, expected);
    const RenderedSelection rendered = render(lit, selection, GetParam().dialect, GetParam().backend, actual);
    EXPECT_EQ(to_text(reference.diagnostics), "");
    EXPECT_EQ(to_text(rendered.diagnostics), "");
    EXPECT_GT(reference.files.size(), 10U);
    ASSERT_EQ(rendered.files, reference.files);
    for (const std::string& file : reference.files) EXPECT_EQ(actual.read(file), expected.read(file)) << file;
}

INSTANTIATE_TEST_SUITE_P(Render, Lit,
                         testing::Values(Row{"glsl330", Dialect::glsl330, Backend::osmesa},
                                         Row{"es300", Dialect::es300, Backend::osmesa},
                                         Row{"egl", Dialect::glsl450, Backend::egl}),
                         [](const auto& row) { return row.param.name; });

TEST(RenderSelection, EveryPictureDiffers) {
    const DiskFileSystem disk;
    const Source lit{disk, GOBO_SOURCE_DIR, "templates/lit.toml"};
    Selection selection;
    for (const char* key : {"default", "directional=1", "point=1", "spot=1", "point=1 fog=linear",
                            "point=1 fog=exponential", "point=1 specular=phong", "point=1 specular=blinn",
                            "point=1 diffuse=toon", "point=1 shading=vertex"})
        selection.keys.push_back({key, {}});
    MemoryFileSystem pictures;
    const RenderedSelection rendered = render(lit, selection, Dialect::own, Backend::osmesa, pictures);
    std::set<std::string> distinct;
    for (const std::string& file : rendered.files) distinct.insert(value_of(pictures.read(file)));
    EXPECT_EQ(rendered.files.size(), 10U);
    EXPECT_EQ(distinct.size(), 10U);
}

/// A value that does not fit concerns only the keys that have the uniform, and is said once.
TEST(RenderSelection, WhatFailsStopsNoOtherKey) {
    MemoryFileSystem files(std::map<std::string, std::string, std::less<>>{
        {"f/own.toml",
         "name = 'own'\nvertex = 'own.vert'\nfragment = 'own.frag'\n"
         "[features.tint]\nrole = 'effect'\ndefine = 'TINT'\n"
         "[features.half]\nrole = 'effect'\ndefine = 'HALF'\n"
         "[render]\n'tint' = [1, 2]\n"},
        {"f/templates/own.vert",
         "#version 330\nin vec3 position;\nuniform mat4 mvp;\nvoid main() { gl_Position = mvp * "
         "vec4(position, "
         "1.0); }\n"},
        {"f/templates/own.frag",
         "#version 330\nout vec4 color;\n#ifdef TINT\nuniform vec3 tint;\n#else\nconst vec3 tint = "
         "vec3(1.0);\n"
         "#endif\nvoid main() {\n    color = vec4(tint, 1.0);\n#ifdef HALF\n    color *= "
         "0.5;\n#endif\n}\n"}});
    Selection selection;
    selection.all = true;
    MemoryFileSystem pictures;
    const RenderedSelection rendered =
        render({files, "f", "own.toml"}, selection, Dialect::own, Backend::osmesa, pictures);
    EXPECT_EQ(rendered.files, (std::vector<std::string>{"out/default.pfm", "out/half-on.pfm"}));
    EXPECT_EQ(to_text(rendered.diagnostics),
              "f/own.toml:11:10: error: 'tint' is given 2 numbers [tint=on, and 1 more key]\n"
              "  help: it is of type vec3: give 3\n");
}

TEST(PictureName, IsSafeAndDistinct) {
    EXPECT_EQ(picture_name("default"), "default");
    EXPECT_EQ(picture_name("fog=linear fog_distance=planar point=3"),
              "fog-linear+fog_distance-planar+point-3");
    const std::string text(300, 'a');
    EXPECT_EQ(picture_name(text).size(), 200U);
    EXPECT_NE(picture_name(text + "b"), picture_name(text + "c"));
}

}  // namespace
}  // namespace gobo
