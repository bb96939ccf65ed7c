#include "lab/render/image.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>
#include <lodepng.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// In the order of ImageFormat.
const std::vector<std::string> kFormats = {"png", "exr", "pfm"};

Result<std::string> encode_png(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.values.size());
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const bool linear = image.channels == 1 || i % static_cast<std::size_t>(image.channels) == 3;
        // NaN becomes 0: it fails every comparison.
        const double value = image.values[i] > 0 ? std::min(static_cast<double>(image.values[i]), 1.0) : 0;
        bytes.push_back(
            static_cast<unsigned char>(std::lround(255 * (linear ? value : srgb_of_linear(value)))));
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
    const char* const name = format == ImageFormat::png ? "PNG" : format == ImageFormat::exr ? "EXR" : "PFM";
    return fail(Place{path}, {}, fmt::format("this is not a readable {} file: {}", name, why));
}

/// A picture above this many pixels is taken for a damaged header: 2^28 pixels are 4 GiB as floats.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

Result<Image> decode_png(std::string_view bytes, const std::string& path) {
    std::vector<unsigned char> values;
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    unsigned width = 0;
    unsigned height = 0;
    lodepng::State state;
    unsigned error = lodepng_inspect(&width, &height, &state, data, bytes.size());
    if (error == 0 && std::int64_t{width} * height > kMostPixels)
        return damaged(path, ImageFormat::png, fmt::format("its size is {} x {}", width, height));
    // Enough for 16 bits a channel and for interlaced rows: a small file may hold a thousand times its size.
    state.decoder.zlibsettings.max_output_size = std::size_t{8} * (width + 8) * (height + 8);
    if (error == 0) error = lodepng::decode(values, width, height, state, data, bytes.size());
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

/// Nothing is compressed better: a picture of one colour takes a byte for some 500 pixels.
constexpr std::int64_t kPixelsPerByte = 4096;

class MemoryInput final : public Imf::IStream {
  public:
    explicit MemoryInput(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool read(char data[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (position_ > bytes_.size() || bytes_.size() - position_ < count)
            throw std::runtime_error("the file ends too soon");
        std::memcpy(data, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

  private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

std::vector<std::string> channel_names(int channels) {
    if (channels == 1) return {"Y"};
    if (channels == 3) return {"R", "G", "B"};
    return {"R", "G", "B", "A"};
}

/// The image's memory as OpenEXR's slices; `left` and `top` are the data window's corner.
Imf::FrameBuffer slices_of(Image& image, const std::vector<std::string>& names, int left, int top) {
    Imf::FrameBuffer frame;
    const std::size_t pixel = sizeof(float) * static_cast<std::size_t>(image.channels);
    const std::size_t row = pixel * static_cast<std::size_t>(image.width);
    for (std::size_t i = 0; i < names.size(); ++i) {
        // OpenEXR adds the corner again. As numbers: a pointer must not leave its array by so much.
        const auto first = reinterpret_cast<std::uintptr_t>(image.values.data() + i);
        const std::uintptr_t origin =
            first - static_cast<std::uintptr_t>(left) * pixel - static_cast<std::uintptr_t>(top) * row;
        frame.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(origin), pixel, row));
    }
    return frame;
}

std::vector<std::string> channels_of(const Imf::ChannelList& list) {
    if (list.findChannel("R") == nullptr && list.findChannel("Y") != nullptr) return {"Y"};
    return channel_names(list.findChannel("A") != nullptr ? 4 : 3);
}

Result<std::string> encode_exr(const Image& image) {
    try {
        // No attribute but those that the format demands: no date, no owner, no host.
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        const std::vector<std::string> names = channel_names(image.channels);
        for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        Image copy = image;  // OpenEXR's slices take mutable memory for reading and writing alike
        Imf::StdOSStream output;
        {
            Imf::OutputFile file(output, header, 0);
            file.setFrameBuffer(slices_of(copy, names, 0, 0));
            file.writePixels(image.height);
        }
        return output.str();
    } catch (const std::exception& error) {
        return fail(Fault::internal, fmt::format("cannot encode an EXR picture: {}", error.what()));
    }
}

Result<Image> decode_exr(std::string_view bytes, const std::string& path) {
    try {
        MemoryInput input(bytes);
        Imf::InputFile file(input, 0);
        const Imath::Box2i window = file.header().dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        const auto most = std::min(kMostPixels, kPixelsPerByte * static_cast<std::int64_t>(bytes.size()));
        if (width <= 0 || height <= 0 || width > most / height)
            return damaged(path, ImageFormat::exr, fmt::format("its size is {} x {}", width, height));
        const std::vector<std::string> names = channels_of(file.header().channels());
        Image image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()));
        file.setFrameBuffer(slices_of(image, names, window.min.x, window.min.y));
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& error) {
        return damaged(path, ImageFormat::exr, error.what());
    }
}

Result<ImageFormat> format_of_path(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return image_format_of(dot == std::string::npos ? std::string_view()
                                                    : std::string_view(path).substr(dot + 1));
}

}  // namespace

float absolute_difference(float first, float second) {
    if (first == second || (std::isnan(first) && std::isnan(second))) return 0;
    const float difference = std::abs(first - second);
    return std::isnan(difference) ? std::numeric_limits<float>::infinity() : difference;
}

std::vector<float> four_channels(const Image& image) {
    std::vector<float> texels;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < 4; ++channel)
                texels.push_back(channel < image.channels ? image.at(x, y, channel) : 1.0F);
    return texels;
}

Image shrunk(const Image& picture, int factor) {
    Image small(picture.width / factor, picture.height / factor, picture.channels);
    const float weight = 1 / static_cast<float>(factor * factor);
    for (int y = 0; y < small.height * factor; ++y)
        for (int x = 0; x < small.width * factor; ++x)
            for (int channel = 0; channel < picture.channels; ++channel)
                small.at(x / factor, y / factor, channel) += weight * picture.at(x, y, channel);
    return small;
}

Image difference_picture(const Image& first, const Image& second, float scale) {
    Image picture(first.width, first.height, 3);
    for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
            float largest = 0;
            for (int channel = 0; channel < first.channels; ++channel)
                largest =
                    std::max(largest, absolute_difference(first.at(x, y, channel), second.at(x, y, channel)));
            const float heat = 3 * std::min(largest / scale, 1.0F);
            for (int channel = 0; channel < 3; ++channel)
                picture.at(x, y, channel) = std::clamp(heat - static_cast<float>(channel), 0.0F, 1.0F);
        }
    }
    return picture;
}

std::string_view name_of(ImageFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

Result<ImageFormat> image_format_of(std::string_view name) {
    const auto found = std::find(kFormats.begin(), kFormats.end(), name);
    if (found != kFormats.end()) return static_cast<ImageFormat>(found - kFormats.begin());
    return fail(Fault::usage, fmt::format("unknown image format '{}'", name), suggestion(name, kFormats));
}

double srgb_of_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_of_srgb(double signal) {
    return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4);
}

Result<std::string> encode_image(const Image& image, ImageFormat format) {
    return format == ImageFormat::png   ? encode_png(image)
           : format == ImageFormat::exr ? encode_exr(image)
                                        : encode_pfm(image);
}

Result<Image> decode_image(std::string_view bytes, ImageFormat format, const std::string& path) {
    return format == ImageFormat::png   ? decode_png(bytes, path)
           : format == ImageFormat::exr ? decode_exr(bytes, path)
                                        : decode_pfm(bytes, path);
}

Result<bool> write_image(FileSystem& files, const std::string& path, const Image& image) {
    GOBO_TRY(const ImageFormat format, format_of_path(path));
    GOBO_TRY(const std::string bytes, encode_image(image, format));
    return files.write(path, bytes);
}

Result<Image> read_image(const FileSystem& files, const std::string& path) {
    GOBO_TRY(const ImageFormat format, format_of_path(path));
    GOBO_TRY(const std::string bytes, files.read(path));
    return decode_image(bytes, format, path);
}

}  // namespace gobo
