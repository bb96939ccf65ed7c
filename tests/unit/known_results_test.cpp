// What a cache knows of stages and programs: the same result as without it, and no more work than what
// changed.
#include "validate/known_results.hpp"

#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/selection.hpp"
#include "small_families.hpp"

namespace gobo {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

/// Loses or spoils every result that is asked for.
class Damaged final : public ResultCache {
  public:
    explicit Damaged(ResultCache& whole) : whole_(whole) {}
    std::optional<std::string> find(const Digest& key) override {
        std::optional<std::string> result = whole_.find(key);
        if (!result || ++asked_ % 2 == 0) return std::nullopt;
        result->resize(result->size() / 2);
        return result;
    }
    void keep(const Digest& key, std::string_view result) override { whole_.keep(key, result); }

  private:
    ResultCache& whole_;
    int asked_ = 0;
};

/// Everything that validating says, as text.
std::string text_of(const Validated& validated, const Composition& composition) {
    std::string text = to_text(validated.diagnostics);
    for (std::size_t i = 0; i < validated.stages.size(); ++i) {
        BatchResult result;
        result.stages.push_back({0, true, {}, validated.stages[i]});
        text += source_of(composition, composition.stages[i]) + bytes_of(result);
    }
    return text;
}

/// The source of each stage as a compiler that counts no lines sees it.
std::set<std::string> sources_of(const Composition& composition) {
    std::set<std::string> sources;
    for (const Stage& stage : composition.stages) {
        std::string source(name_of(stage.kind));
        bool is_empty_line = true;
        for (const char character : source_of(composition, stage)) {
            if (character != '\n' || !is_empty_line) source += character;
            is_empty_line = character == '\n';
        }
        sources.insert(source);
    }
    return sources;
}

class Known : public testing::Test {
  protected:
    Composition composed() const {
        const MemoryFileSystem disk(files);
        SearchPath search;
        for (const std::string part : {"shader_lib", "templates"}) search.add(disk, part, part + "/", false);
        return compose(family, keys, search, Dialect::own).value();
    }
    Validated validated(const Composition& composition, ResultCache* some_cache, int jobs = 1) const {
        ValidateOptions options;
        options.jobs = jobs;
        options.keep_spirv = true;
        options.cache = some_cache;
        return validate(family, composition, options);
    }
    void expect_as_without(const std::string& what, ResultCache& some_cache, int jobs = 1) {
        const Composition composition = composed();
        EXPECT_EQ(text_of(validated(composition, &some_cache, jobs), composition),
                  text_of(validated(composition, nullptr), composition))
            << what;
    }

    Files files;
    Family family;
    std::vector<Key> keys;
    MemoryCache cache;
};

class KnownLit : public Known {
  protected:
    void SetUp() override {
        const DiskFileSystem disk;
        for (const std::string folder : {"shader_lib", "templates"})
            for (const std::string& file : disk.files_below(GOBO_SOURCE_DIR "/" + folder))
                files[folder + "/" + file] = disk.read(GOBO_SOURCE_DIR "/" + folder + "/" + file).value();
        family = lit_family();
        Selection selection;
        selection.cover = 1;
        keys = select(family, selection, "450").value();
    }
    /// How many stages are compiled now, which the cache then knows.
    std::size_t compiled() {
        const Composition composition = composed();
        return validated(composition, &cache).compiled;
    }
};

TEST_F(KnownLit, IsTheSameWithTheCacheColdWarmAndDamaged) {
    expect_as_without("cold", cache);
    expect_as_without("warm", cache);
    expect_as_without("warm, two threads", cache, 2);
    EXPECT_EQ(compiled(), 0U);
    Damaged damaged(cache);
    expect_as_without("damaged", damaged);
}

/// An edit is put behind the first place of a piece where it belongs.
struct EditRow {
    const char* name;
    const char* behind;
    const char* edit;
    bool compiles;
};

void PrintTo(const EditRow& row, std::ostream* stream) {
    *stream << row.name;
}

class Edit : public KnownLit, public testing::WithParamInterface<EditRow> {};

TEST_P(Edit, CompilesExactlyTheStagesThatHoldThePiece) {
    const std::set<std::string> before = sources_of(composed());
    const Files whole = files;
    int tried = 0;
    int number = 0;
    for (const auto& [path, text] : whole) {
        const std::size_t at = text.find(GetParam().behind);
        if (at == std::string::npos || path.ends_with(".toml") || path.find("/header/") != std::string::npos)
            continue;
        // Each takes a tenth of a second: some, but at least one that a key holds.
        if (number++ % 7 != 0 && (tried > 0 || !GetParam().compiles)) continue;
        files = whole;
        files[path].insert(at + std::string_view(GetParam().behind).size(), GetParam().edit);
        std::size_t changed = 0;
        for (const std::string& source : sources_of(composed())) changed += before.contains(source) ? 0 : 1;
        MemoryCache of_before;
        const Files edited = std::exchange(files, whole);
        const Composition composition = composed();
        static_cast<void>(validated(composition, &of_before));
        files = edited;
        const Composition now = composed();
        EXPECT_EQ(validated(now, &of_before).compiled, GetParam().compiles ? changed : 0) << path;
        expect_as_without(path, of_before);
        if (changed > 0) ++tried;
    }
    EXPECT_GE(tried, GetParam().compiles ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Rows, Edit,
                         testing::Values(EditRow{"in_a_function", ") {", " float editedHere = 1.0; ", true},
                                         EditRow{"a_declaration", "#piece none\n",
                                                 "float editedHere(float x) { return x; }\n", true},
                                         EditRow{"a_comment", "//", " edited", false},
                                         EditRow{"a_line", "//", "\n//", false}),
                         [](const auto& row) { return row.param.name; });

const char* const features =
    "[features]\nfog = { values = [\"none\", \"linear\"] }\npoint = { count = [0, 3], constant = \"POINTS\" "
    "}\n";

class KnownErrors : public Known {
  protected:
    void SetUp() override {
        family = family_of(features);
        Selection selection;
        selection.all = true;
        keys = select(family, selection, "450").value();
        files = {{"templates/tiny.vert",
                  "out vec3 shade;\nvoid main() { shade = vec3(1.0); gl_Position = vec4(0.0); }\n"},
                 {"templates/tiny.frag",
                  "#include <fog>\nin vec3 shade;\nlayout(location = 0) out vec4 color;\n"
                  "void main() { color = vec4(shade, POINTS); color += seen(); }\n"},
                 {"shader_lib/fog/none.glsl", "vec4 seen() { return vec4(1.0); }\n"},
                 {"shader_lib/fog/linear.glsl", "// thick\nvec4 seen() { return density; }\n"}};
    }
};

TEST_F(KnownErrors, AreToldAgainAtTheirPlaces) {
    expect_as_without("cold", cache);
    expect_as_without("warm", cache);
    EXPECT_EQ(validated(composed(), &cache).compiled, 0U);
    files["shader_lib/fog/linear.glsl"].insert(0, "// further down\n");
    const std::string first = first_text(validated(composed(), &cache).diagnostics);
    EXPECT_THAT(first, testing::StartsWith("shader_lib/fog/linear.glsl:3: error: 'density'"));
    expect_as_without("moved", cache);
    files["shader_lib/fog/linear.glsl"] = "vec4 seen() { return vec4(0.5); }\n";
    expect_as_without("fixed", cache);
}

TEST_F(KnownErrors, OfLinkingAreToldAgain) {
    files["shader_lib/fog/linear.glsl"] = "vec4 seen() { return vec4(0.5); }\n";
    expect_as_without("fine", cache);
    files["templates/tiny.vert"].replace(0, 8, "out vec4");
    files["templates/tiny.vert"].replace(files["templates/tiny.vert"].find("vec3(1.0)"), 9, "vec4(1.0)");
    EXPECT_THAT(first_text(validated(composed(), &cache).diagnostics), testing::HasSubstr("shade"));
    expect_as_without("types differ, warm", cache);
    files["templates/tiny.vert"].insert(0, "\n");
    expect_as_without("types differ, a line further down", cache);
}

struct DeclarationRow {
    const char* name;
    const char* text;
    const char* declarations;
};

void PrintTo(const DeclarationRow& row, std::ostream* stream) {
    *stream << row.name;
}

class Declarations : public testing::TestWithParam<DeclarationRow> {};

TEST_P(Declarations, AreWhatIsOutsideOfBodies) {
    EXPECT_EQ(declarations_of(GetParam().text), GetParam().declarations);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, Declarations,
    testing::Values(
        DeclarationRow{"body",
                       "uniform vec4 a;\nfloat f(int x) { if (x) { return 1.0; } return 2.0; } in vec2 b;\n",
                       "uniform vec4 a;\nfloat f(int x)  in vec2 b;\n"},
        DeclarationRow{"block", "uniform Fog { vec3 color; } fog;\nvoid main()\n{\n}\n",
                       "uniform Fog { vec3 color; } fog;\nvoid main()\n\n"},
        DeclarationRow{"directive_in_a_body", "void f() {\n#define A 1\n  g();\n}\nuniform float u[A];\n",
                       "void f() \n#define A 1\n\nuniform float u[A];\n"},
        DeclarationRow{"brackets_that_do_not_end", "void f() {\n", "void f() {\n"},
        DeclarationRow{"bracket_too_many", "void f() { } }\n", "void f() { } }\n"},
        DeclarationRow{"bracket_of_a_macro", "#define BEGIN {\nvoid f() BEGIN }\nin vec2 b;\n",
                       "#define BEGIN {\nvoid f() BEGIN }\nin vec2 b;\n"},
        DeclarationRow{"comment", "void f() { } // }\n", "void f() { } // }\n"}),
    [](const auto& row) { return row.param.name; });

TEST(Declarations, ThatAreSizedByUseAreKnown) {
    EXPECT_TRUE(sizes_by_use("float a[ ];"));
    EXPECT_TRUE(sizes_by_use("void main() { gl_ClipDistance[3] = 1.0; }"));
    EXPECT_FALSE(sizes_by_use("float a[3]; void main() { a[0] = 1.0; }"));
}

}  // namespace
}  // namespace gobo
