// What is too bright for a display is shown darker; what is not stays as it is.
#include <limits>

#include <gtest/gtest.h>

#include "lab/gallery/gallery.hpp"

namespace gobo::gallery {
namespace {

/// 200 pixels: `bright` of them have that red, the others 0.5.
Image picture_of(int bright, float red) {
    Image picture(20, 10, 4);
    for (int i = 0; i < 200; ++i) {
        picture.at(i % 20, i / 20, 0) = i < bright ? red : 0.5F;
        picture.at(i % 20, i / 20, 3) = 1;
    }
    return picture;
}

TEST(Exposure, LetsAHundredthOfThePixelsShine) {
    struct Row {
        const char* name;
        int bright;
        float red;
        float exposure;
    };
    const float infinity = std::numeric_limits<float>::infinity();
    for (const Row& row :
         {Row{"dark", 200, 0.5F, 1}, Row{"a highlight", 2, 8, 1}, Row{"bright", 3, 8, 0.95F / 8},
          Row{"bright everywhere", 200, 1.9F, 0.5F}, Row{"infinite", 200, infinity, 1}})
        EXPECT_FLOAT_EQ(exposure_of(picture_of(row.bright, row.red)), row.exposure) << row.name;
    EXPECT_EQ(exposure_of(Image()), 1);
}

TEST(Exposure, ScalesColoursAndNotAlpha) {
    const Image half = exposed(picture_of(1, 8), 0.5F);
    EXPECT_EQ(half.at(0, 0, 0), 4);
    EXPECT_EQ(half.at(1, 0, 0), 0.25F);
    EXPECT_EQ(half.at(0, 0, 3), 1);
}

}  // namespace
}  // namespace gobo::gallery
