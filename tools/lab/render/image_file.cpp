#include "lab/render/image_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <lodepng.h>

#include "core/text.hpp"
#include "lab/render/exr_file.hpp"

namespace gobo {
namespace {

constexpr std::array<ImageFormat, 3> all_formats = {ImageFormat::png, ImageFormat::exr, ImageFormat::pfm};

unsigned char byte_of(double value) {
    return static_cast<unsigned char>(std::lround(255 * value));
}

/// NaN becomes 0: it fails every comparison.
double clamped(float value) {
    return value > 0 ? std::min(static_cast<double>(value), 1.0) : 0.0;
}

Result<std::string> encode_png(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.values.size());
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const bool linear = image.channels == 1 || i % static_cast<std::size_t>(image.channels) == 3;
        const double value = clamped(image.values[i]);
        bytes.push_back(byte_of(linear ? value : srgb_of_linear(value)));
    }
    const LodePNGColorType type = image.channels == 1 ? LCT_GREY : image.channels == 3 ? LCT_RGB : LCT_RGBA;
    std::vector<unsigned char> file;
    const unsigned error = lodepng::encode(file, bytes, static_cast<unsigned>(image.width),
                                           static_cast<unsigned>(image.height), type, 8);
    if (error != 0)
        return fail(Fault::internal,
                    fmt::format("cannot encode a PNG picture: {}", lodepng_error_text(error)));
    return std::string(file.begin(), file.end());
}

tl::unexpected<Diagnostics> damaged(const std::string& path, ImageFormat format, std::string_view why) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message =
        fmt::format("this is no readable {} file: {}", format == ImageFormat::png ? "PNG" : "PFM", why);
    return fail(std::move(diagnostic));
}

Result<Image> decode_png(std::string_view bytes, const std::string& path) {
    std::vector<unsigned char> values;
    unsigned width = 0;
    unsigned height = 0;
    const unsigned error = lodepng::decode(
        values, width, height, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    if (error != 0) return damaged(path, ImageFormat::png, lodepng_error_text(error));
    Image image(static_cast<int>(width), static_cast<int>(height), 4);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double signal = values[i] / 255.0;
        image.values[i] = static_cast<float>(i % 4 == 3 ? signal : linear_of_srgb(signal));
    }
    return image;
}

/// Rows from the bottom up, after a header of three lines; the scale's sign tells the byte order.
Result<std::string> encode_pfm(const Image& image) {
    const int channels = std::min(image.channels, 3);
    std::string bytes =
        fmt::format("{}\n{} {}\n-1.0\n", channels == 1 ? "Pf" : "PF", image.width, image.height);
    for (int y = image.height - 1; y >= 0; --y) {
        for (int x = 0; x < image.width; ++x) {
            for (int channel = 0; channel < channels; ++channel) {
                const auto bits = std::bit_cast<std::uint32_t>(image.at(x, y, channel));
                for (int shift = 0; shift < 32; shift += 8)
                    bytes.push_back(static_cast<char>(static_cast<unsigned char>(bits >> shift)));
            }
        }
    }
    return bytes;
}

float float_at(std::string_view bytes, std::size_t position, bool big_endian) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[position + (big_endian ? i : 3 - i)]);
        bits = bits << 8 | byte;
    }
    return std::bit_cast<float>(bits);
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

Result<Image> decode_pfm(std::string_view bytes, const std::string& path) {
    std::array<std::string_view, 4> words;  // kind, width, height, scale
    std::size_t position = 0;
    for (std::string_view& word : words) {
        const std::size_t end = std::min(bytes.find_first_of(" \n", position), bytes.size());
        word = bytes.substr(position, end - position);
        position = std::min(end + 1, bytes.size());
    }
    int width = 0;
    int height = 0;
    double scale = 0;
    const bool numbers =
        read_number(words[1], width) && read_number(words[2], height) && read_number(words[3], scale);
    if ((words[0] != "PF" && words[0] != "Pf") || !numbers || width <= 0 || height <= 0 || scale == 0)
        return damaged(path, ImageFormat::pfm, "its header is not that of the format");
    const int channels = words[0] == "PF" ? 3 : 1;
    const std::size_t count = (bytes.size() - position) / 4;
    if (count / static_cast<std::size_t>(width) / static_cast<std::size_t>(channels) <
        static_cast<std::size_t>(height))
        return damaged(path, ImageFormat::pfm, "the file ends too soon");
    Image image(width, height, channels);
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < channels; ++channel, position += 4)
                image.at(x, y, channel) = float_at(bytes, position, scale > 0);
    return image;
}

Result<ImageFormat> format_of_path(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return image_format_of(dot == std::string::npos ? std::string_view()
                                                    : std::string_view(path).substr(dot + 1));
}

}  // namespace

std::string_view name_of(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return "png";
        case ImageFormat::exr:
            return "exr";
        case ImageFormat::pfm:
            return "pfm";
    }
    return "png";
}

Result<ImageFormat> image_format_of(std::string_view name) {
    for (const ImageFormat format : all_formats)
        if (name == name_of(format)) return format;
    return fail(Fault::usage, fmt::format("unknown image format '{}'", name),
                suggestion(name, {"png", "exr", "pfm"}));
}

double srgb_of_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_of_srgb(double signal) {
    return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4);
}

Result<std::string> encode_image(const Image& image, ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return encode_png(image);
        case ImageFormat::exr:
            return encode_exr(image);
        case ImageFormat::pfm:
            return encode_pfm(image);
    }
    return encode_png(image);
}

Result<Image> decode_image(std::string_view bytes, ImageFormat format, const std::string& path) {
    switch (format) {
        case ImageFormat::png:
            return decode_png(bytes, path);
        case ImageFormat::exr:
            return decode_exr(bytes, path);
        case ImageFormat::pfm:
            return decode_pfm(bytes, path);
    }
    return decode_png(bytes, path);
}

Result<bool> write_image(FileSystem& files, const std::string& path, const Image& image) {
    const auto format = format_of_path(path);
    if (!format) return tl::unexpected(format.error());
    const auto bytes = encode_image(image, *format);
    if (!bytes) return tl::unexpected(bytes.error());
    return files.write(path, *bytes);
}

Result<Image> read_image(const FileSystem& files, const std::string& path) {
    const auto format = format_of_path(path);
    if (!format) return tl::unexpected(format.error());
    const auto bytes = files.read(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return decode_image(*bytes, *format, path);
}

}  // namespace gobo
