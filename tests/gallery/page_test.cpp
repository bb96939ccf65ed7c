// The page holds what it was given, and nothing that could end its script.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "family/read_family.hpp"
#include "lab/gallery/gallery.hpp"

namespace gobo::gallery {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A template that is nothing but its data.
Family small_family() {
    const auto none = [](const std::string&) -> Result<FamilyText> { return fail(Fault::input, "none"); };
    return read_family(
               "name = \"small\"\nvertex = \"a.vert\"\nfragment = \"a.frag\"\n"
               "[features]\nfog = { values = [\"none\", \"linear\"] }\nlights = { count = [0, 4], constant = "
               "\"N\" }\n",
               "small.toml", none)
        .value();
}

Gallery small_gallery() {
    Gallery gallery;
    gallery.renderer = "a </script> driver";
    gallery.cost_renderer = "another";
    Entry entry;
    entry.key = {0, 3};
    entry.actual = "lights-3.png";
    entry.fragment_cost = 1234.5;
    entry.vertex_cost = 56.87;
    entry.largest_error = 0.1;
    gallery.entries.push_back(entry);
    entry.key = {0, 1};
    entry.actual = "lights-1.png";
    gallery.entries.push_back(entry);
    return gallery;
}

std::string page_of(const std::string& text) {
    MemoryFileSystem files;
    EXPECT_TRUE(files.write("templates/gallery/index.html.in", text));
    return page(files, small_family(), small_gallery()).value();
}

TEST(GalleryPage, HoldsEachKeyItsValuesAndItsFigures) {
    const nlohmann::json data = nlohmann::json::parse(page_of("{{data}}"));
    EXPECT_EQ(data["family"], "small");
    ASSERT_EQ(data["entries"].size(), 2U);
    const nlohmann::json& entry = data["entries"][0];
    EXPECT_EQ(entry["key"], "lights=3");
    EXPECT_THAT(entry["values"], ElementsAre("none", "3"));
    EXPECT_EQ(entry["actual"], "lights-3.png");
    EXPECT_EQ(entry["fragment_cost"], 1230) << "three digits";
    EXPECT_EQ(entry["vertex_cost"].dump(), "56.9") << "and no more";
    EXPECT_EQ(entry["largest_error"], 0.1);
}

TEST(GalleryPage, OffersTheValuesThatOccur) {
    const nlohmann::json data = nlohmann::json::parse(page_of("{{data}}"));
    EXPECT_THAT(data["features"][0]["values"], ElementsAre("none"));
    EXPECT_THAT(data["features"][1]["values"], ElementsAre("1", "3"));
}

TEST(GalleryPage, CannotBeEndedByWhatItShows) {
    EXPECT_THAT(page_of("{{data}}"), Not(HasSubstr("</script>")));
    EXPECT_THAT(page_of("{{data}}"), HasSubstr("a \\u003c/script> driver"));
    EXPECT_EQ(page_of("{{title}}"), "Permutations of small");
}

}  // namespace
}  // namespace gobo::gallery
