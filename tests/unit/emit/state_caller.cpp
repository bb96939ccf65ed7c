// An application that asks for permutations by the state of its own scene, and records what it asked for.
// emit_compile_test.cpp compiles and runs it; it prints what fails. Its argument is a folder to write to.
#include <fstream>
#include <sstream>
#include <string>

#include <gobo/record.hpp>

#include "bare.hpp"
#include "expectations.hpp"
#include "lit.hpp"
#include "nasty.hpp"

namespace {

/// An application's own idea of a draw: members named after features are taken.
struct OwnState {
    const char* name = "crate";
    unsigned point = 0;
    lit::Fog fog = lit::Fog::none;
    bool is_selected = false;
};

struct OwnSettings {
    lit::Shading shading = lit::Shading::fragment;
};

constexpr OwnSettings per_vertex{lit::Shading::vertex};

static_assert(lit::select(OwnState{}) == lit::Key{}, "a default state is the default key");
static_assert(lit::find(lit::select(OwnState{"torch", 3, lit::Fog::linear, true}, per_vertex)) != nullptr,
              "a state that was built is found at compile time, too");

std::string selected(const OwnState& state, const OwnSettings& settings = {}) {
    return lit::key_text(lit::select(state, settings));
}

void test_own_states() {
    expect_text(selected({"a", 0, lit::Fog::linear, false}), "fog=linear");
    expect_text(selected({"b", 3, lit::Fog::linear, false}, per_vertex), "fog=linear point=3 shading=vertex");
    // Built for three lights only: two are shaded by that one, four by none.
    expect_text(selected({"c", 2, lit::Fog::linear, false}, per_vertex), "fog=linear point=3 shading=vertex");
    expect_text(selected({"d", 4, lit::Fog::linear, false}, per_vertex), "fog=linear point=4 shading=vertex");
    expect_text(lit::describe_missing(lit::select(OwnState{"d", 4, lit::Fog::linear, false}, per_vertex)),
                "fog=linear point=4 shading=vertex was not built; the nearest that was: fog=linear point=3 "
                "shading=vertex (differs in point); to build it, add KEYS \"fog=linear point=4 "
                "shading=vertex\"");
    expect_text(lit::describe_missing(lit::select(OwnState{"e", 99, lit::Fog::none, false})),
                "point=99 is out of range: 0 to 8");
}

void test_scene_state() {
    lit::SceneState state;
    state.fog = lit::Fog::linear;
    expect_text(lit::key_text(lit::select(state)), "fog=linear");
    expect_text(nasty::key_text(nasty::select(nasty::SceneState{})), "default");
    expect_text(bare::key_text(bare::select(bare::SceneState{})), "default");
}

std::string content_of(const std::string& path) {
    std::ostringstream content;
    content << std::ifstream(path).rdbuf();
    return content.str();
}

void test_record(const std::string& folder) {
    const std::string path = folder + "/recorded.keys";
    std::ofstream(path) << "# from the last run\n  fog=linear  # seen in level 1\r\n\n";
    {
        gobo::KeyRecord record(path);
        if (record.note("fog=linear")) expect_text("new", "known from the file");
        if (!record.note(lit::key_text(lit::select(OwnState{"b", 3, lit::Fog::linear, false}, per_vertex))))
            expect_text("known", "new");
        expect_text(record.save(), "");
        expect_text(content_of(path), "fog=linear\nfog=linear point=3 shading=vertex\n");
        (void)record.note("default");
    }
    expect_text(content_of(path), "default\nfog=linear\nfog=linear point=3 shading=vertex\n");
    gobo::KeyRecord nowhere(folder + "/no/such/folder/recorded.keys");
    (void)nowhere.note("default");
    expect_text(nowhere.save().substr(0, 12), "cannot write");
}

}  // namespace

int main(int argc, char** argv) {
    test_own_states();
    test_scene_state();
    if (argc == 2) test_record(argv[1]);
    return failures == 0 ? 0 : 1;
}
