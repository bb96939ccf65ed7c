#include "lab/render/exr_file.hpp"

#include <algorithm>
#include <cstring>
#include <exception>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <fmt/format.h>

namespace gobo {
namespace {

/// A picture above this many pixels is taken for a damaged header: 2^28 pixels are 4 GiB as floats.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

class MemoryOutput final : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("memory") {}
    void write(const char data[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (bytes.size() < position_ + count) bytes.resize(position_ + count);
        std::copy_n(data, count, bytes.begin() + static_cast<std::ptrdiff_t>(position_));
        position_ += count;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::string bytes;

  private:
    std::size_t position_ = 0;
};

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
        char* const first = reinterpret_cast<char*>(image.values.data() + i);
        char* const origin =
            first - left * static_cast<std::ptrdiff_t>(pixel) - top * static_cast<std::ptrdiff_t>(row);
        frame.insert(names[i], Imf::Slice(Imf::FLOAT, origin, pixel, row));
    }
    return frame;
}

std::vector<std::string> channels_of(const Imf::ChannelList& list) {
    if (list.findChannel("R") == nullptr && list.findChannel("Y") != nullptr) return {"Y"};
    return channel_names(list.findChannel("A") != nullptr ? 4 : 3);
}

tl::unexpected<Diagnostics> damaged(const std::string& path, const std::string& why) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = fmt::format("this is no readable EXR file: {}", why);
    return fail(std::move(diagnostic));
}

}  // namespace

Result<std::string> encode_exr(const Image& image) {
    try {
        // No attribute but those that the format demands: no date, no owner, no host.
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        const std::vector<std::string> names = channel_names(image.channels);
        for (const std::string& name : names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        Image copy = image;  // OpenEXR's slices take mutable memory for reading and writing alike
        MemoryOutput output;
        {
            Imf::OutputFile file(output, header, 0);
            file.setFrameBuffer(slices_of(copy, names, 0, 0));
            file.writePixels(image.height);
        }
        return std::move(output.bytes);
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
        if (width <= 0 || height <= 0 || width > most_pixels / height)
            return damaged(path, fmt::format("its size is {} x {}", width, height));
        const std::vector<std::string> names = channels_of(file.header().channels());
        Image image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(names.size()));
        file.setFrameBuffer(slices_of(image, names, window.min.x, window.min.y));
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& error) {
        return damaged(path, error.what());
    }
}

}  // namespace gobo
