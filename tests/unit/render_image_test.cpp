// Picture files and comparison.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "image_comparison.hpp"
#include "lab/render/image.hpp"

namespace gobo {
namespace {

Image sample(int channels) {
    Image image(3, 2, channels);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = -0.5F + 0.37F * static_cast<float>(i);
    image.values[2] = 65536.125F;  // above half precision
    return image;
}

struct RoundTrip {
    const char* name;
    ImageFormat format;
    int channels;
};

class FloatFormats : public testing::TestWithParam<RoundTrip> {};

TEST_P(FloatFormats, KeepEveryBit) {
    const Image image = sample(GetParam().channels);
    MemoryFileSystem files;
    const std::string path = "picture." + std::string(name_of(GetParam().format));
    const auto written = write_image(files, path, image);
    ASSERT_TRUE(written);
    const auto read = read_image(files, path);
    ASSERT_TRUE(read) << to_text(read.error().front());
    EXPECT_EQ(*read, image);
    EXPECT_EQ(encode_image(image, GetParam().format), files.read(path));
}

INSTANTIATE_TEST_SUITE_P(Image, FloatFormats,
                         testing::Values(RoundTrip{"exr_grey", ImageFormat::exr, 1},
                                         RoundTrip{"exr_rgb", ImageFormat::exr, 3},
                                         RoundTrip{"exr_rgba", ImageFormat::exr, 4},
                                         RoundTrip{"pfm_grey", ImageFormat::pfm, 1},
                                         RoundTrip{"pfm_rgb", ImageFormat::pfm, 3}),
                         [](const auto& row) { return row.param.name; });

TEST(Image, PfmIsWrittenFromTheBottomUp) {
    Image image(1, 2, 1);
    image.values = {1.0F, 2.0F};
    const auto bytes = encode_image(image, ImageFormat::pfm);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, std::string("Pf\n1 2\n-1.0\n\0\0\0\x40\0\0\x80\x3f", 20));
}

TEST(Image, PngIsSrgbEncodedAndClamped) {
    Image image(2, 1, 4);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    image.values = {0.5F, 0.001F, 7.0F, 0.5F, -1.0F, nan, 1.0F, 2.0F};
    const auto bytes = encode_image(image, ImageFormat::png);
    ASSERT_TRUE(bytes);
    const auto read = decode_image(*bytes, ImageFormat::png, "a.png");
    ASSERT_TRUE(read);
    // 0.5 is sRGB 188 and 0.001 is 12.92 * 0.001 * 255 = 3; alpha is 128 of 255.
    const std::vector<double> signals = {188, 3, 255, 128, 0, 0, 255, 255};
    for (std::size_t i = 0; i < signals.size(); ++i) {
        const double expected = i % 4 == 3 ? signals[i] / 255 : linear_of_srgb(signals[i] / 255);
        EXPECT_FLOAT_EQ(read->values[i], static_cast<float>(expected)) << i;
    }
}

TEST(Image, SrgbIsItsOwnInverse) {
    for (int i = 0; i <= 255; ++i) {
        const double signal = i / 255.0;
        // The standard's two branches meet only to 1e-7 at the threshold.
        EXPECT_NEAR(srgb_of_linear(linear_of_srgb(signal)), signal, 1e-7);
    }
}

struct Damaged {
    const char* name;
    ImageFormat format;
    std::string bytes;
    const char* text;
};

class DamagedFiles : public testing::TestWithParam<Damaged> {};

TEST_P(DamagedFiles, AreReported) {
    const auto image = decode_image(GetParam().bytes, GetParam().format, "picture");
    ASSERT_FALSE(image);
    EXPECT_EQ(to_text(image.error().front()), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Image, DamagedFiles,
    testing::Values(
        Damaged{"png", ImageFormat::png, "not a picture at all",
                "picture: error: this is not a readable PNG file: PNG file is smaller than a PNG header\n"},
        Damaged{"png_huge", ImageFormat::png,
                std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xff\xff\0\0\xff\xff\b\6\0\0\0\xb6\5\xd9P", 33),
                "picture: error: this is not a readable PNG file: its size is 65535 x 65535\n"},
        Damaged{"exr", ImageFormat::exr, "not a picture at all",
                "picture: error: this is not a readable EXR file: Cannot read image file \"memory\". File is "
                "not an image file.\n"},
        Damaged{"pfm_header", ImageFormat::pfm, "PF\n-3 2\n-1.0\n",
                "picture: error: this is not a readable PFM file: its header is not that of the format\n"},
        Damaged{"pfm_short", ImageFormat::pfm, "Pf\n1 2\n-1.0\n1234",
                "picture: error: this is not a readable PFM file: the file ends too soon\n"},
        Damaged{"pfm_huge", ImageFormat::pfm, "Pf\n2147483647 2147483647\n-1.0\n1234",
                "picture: error: this is not a readable PFM file: the file ends too soon\n"}),
    [](const auto& row) { return row.param.name; });

TEST(Image, UnknownFormatSuggestsTheNearest) {
    MemoryFileSystem files;
    const auto written = write_image(files, "picture.pgn", sample(3));
    ASSERT_FALSE(written);
    EXPECT_EQ(to_text(written.error().front()),
              "gobo: error: unknown image format 'pgn'\n  help: did you mean 'png'?\n");
}

TEST(Compare, CountsWhatDiffers) {
    Image first(40, 50, 1);
    Image second = first;
    second.at(3, 4, 0) = 0.5F;
    second.at(7, 9, 0) = -2.0F;
    const auto comparison = compare(first, second, 1);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->largest, 2.0);
    // 0.1 % of 2,000 values are the two that differ: all others are 0 apart.
    EXPECT_EQ(comparison->percentile_999, 0.0);
    EXPECT_DOUBLE_EQ(comparison->root_mean_square, std::sqrt(4.25 / 2000));
    EXPECT_EQ(to_text(*comparison),
              "largest 2, 99.9th percentile 0, RMSE 0.0460977223\n  (7, 9): 0 against -2, 2 apart\n");
}

TEST(Compare, NotANumberIsNeverNear) {
    Image first(2, 1, 1);
    Image second = first;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    first.values = {nan, nan};
    second.values = {nan, 0.0F};
    const auto comparison = compare(first, second);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->largest, std::numeric_limits<double>::infinity());
    ASSERT_EQ(comparison->worst.size(), 1U);
    EXPECT_EQ(comparison->worst.front().x, 1);
}

TEST(Compare, SizesMustAgree) {
    const auto comparison = compare(Image(2, 1, 3), Image(2, 1, 4));
    ASSERT_FALSE(comparison);
    EXPECT_EQ(to_text(comparison.error().front()),
              "gobo: error: pictures of 2 x 1 x 3 and 2 x 1 x 4 cannot be compared\n");
}

TEST(Compare, DifferencePictureGoesFromBlackToWhite) {
    Image first(3, 1, 1);
    Image second = first;
    second.values = {0.0F, 0.5F, 9.0F};
    const Image picture = difference_picture(first, second, 1.0F);
    EXPECT_EQ(picture.values, (std::vector<float>{0, 0, 0, 1, 0.5F, 0, 1, 1, 1}));
}

}  // namespace
}  // namespace gobo
