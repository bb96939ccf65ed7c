#include "scene/picture.hpp"

#include <csetjmp>
#include <cstdio>

#include <fmt/format.h>
#include <jpeglib.h>
// after what it needs
#include <jerror.h>
#include <lodepng.h>

namespace gobo::scene {
namespace {

tl::unexpected<NoPicture> too_large(std::size_t width, std::size_t height) {
    return tl::unexpected(
        NoPicture{fmt::format("is of {} x {} pixels, which is more than gobo decodes", width, height), ""});
}

tl::expected<TextureImage, NoPicture> decode_png(std::string_view bytes) {
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    unsigned width = 0;
    unsigned height = 0;
    lodepng::State state;
    TextureImage picture;
    unsigned error = lodepng_inspect(&width, &height, &state, data, bytes.size());
    if (error == 0 && std::size_t{width} * height > kMostTexels) return too_large(width, height);
    // Enough for 16 bits a channel and for interlaced rows: a small file may hold a thousand times its size.
    state.decoder.zlibsettings.max_output_size = std::size_t{8} * (width + 8) * (height + 8);
    if (error == 0) error = lodepng::decode(picture.texels, width, height, state, data, bytes.size());
    // Decoders tell what is missing by some ten errors; every whole file has this chunk at its end.
    if (error != 0 && bytes.find("IEND") == std::string_view::npos)
        return tl::unexpected(NoPicture{"is a PNG that is cut short", ""});
    if (error != 0)
        return tl::unexpected(
            NoPicture{fmt::format("is no PNG that can be decoded: {}", lodepng_error_text(error)), ""});
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    return picture;
}

/// libjpeg's errors do not return: they leap back to where the decoding began.
struct JpegErrors {
    jpeg_error_mgr manager;  // first, so that libjpeg's pointer to it is one to this
    std::jmp_buf back;
    jpeg_progress_mgr progress;
    char message[JMSG_LENGTH_MAX];
};

void leap_back(j_common_ptr info) {
    auto* errors = reinterpret_cast<JpegErrors*>(info->err);
    errors->manager.format_message(info, errors->message);
    std::longjmp(errors->back, 1);
}

void say_nothing(j_common_ptr) {}

/// What is cut short would be filled up with grey; other warnings are of no concern.
void refuse_cut(j_common_ptr info, int level) {
    if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF) leap_back(info);
}

/// Encoders write some ten scans, one for each step of a picture that grows clearer; each takes as long as
/// the whole picture, however short it is in the file.
constexpr int kMostScans = 100;

void refuse_many_scans(j_common_ptr info) {
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMostScans) return;
    auto* errors = reinterpret_cast<JpegErrors*>(info->err);
    std::snprintf(errors->message, sizeof errors->message, "it has more than %d scans", kMostScans);
    std::longjmp(errors->back, 1);
}

/// Nothing with a destructor lives between setjmp() and what leaps.
bool decode_rows(jpeg_decompress_struct& info, JpegErrors& errors, std::string_view bytes,
                 TextureImage& picture, bool& is_too_large, bool& has_inks) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_create_decompress(&info);
    info.progress = &errors.progress;
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
    picture.width = static_cast<int>(info.image_width);
    picture.height = static_cast<int>(info.image_height);
    is_too_large = std::size_t{info.image_width} * info.image_height > kMostTexels;
    has_inks = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
    if (is_too_large || has_inks) return true;
    info.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&info);
    const std::size_t stride = std::size_t{4} * info.output_width;
    picture.texels.resize(stride * info.output_height);
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = picture.texels.data() + stride * info.output_scanline;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    return true;
}

tl::expected<TextureImage, NoPicture> decode_jpeg(std::string_view bytes) {
    jpeg_decompress_struct info{};
    JpegErrors errors{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leap_back;
    errors.manager.output_message = say_nothing;
    errors.manager.emit_message = refuse_cut;
    errors.progress.progress_monitor = refuse_many_scans;
    TextureImage picture;
    bool is_too_large = false;
    bool has_inks = false;
    const bool is_decoded = decode_rows(info, errors, bytes, picture, is_too_large, has_inks);
    jpeg_destroy_decompress(&info);
    if (!is_decoded)
        return tl::unexpected(
            NoPicture{fmt::format("is no JPEG that can be decoded: {}", errors.message), ""});
    if (has_inks)
        return tl::unexpected(NoPicture{"is a JPEG in CMYK, but RGB and grey are read",
                                        "convert it (convert FILE.jpg -colorspace sRGB FILE.png)"});
    if (is_too_large)
        return too_large(static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
    return picture;
}

/// A format that glTF's extensions allow, and that gobo leaves to others.
struct OtherFormat {
    const char* name;
    std::string_view signature;
    std::size_t place;  ///< of the signature in the file
    const char* converter;
};

constexpr OtherFormat kOtherFormats[] = {
    {"KTX 2", "\xabKTX 20\xbb", 0, "ktx extract FILE.ktx2 FILE.png"},
    {"WebP", "WEBP", 8, "dwebp FILE.webp -o FILE.png"},
    {"AVIF", "ftypavif", 4, "avifdec FILE.avif FILE.png"},
    {"DDS", "DDS ", 0, "convert FILE.dds FILE.png"},
};

NoPicture not_decoded(std::string_view bytes) {
    for (const OtherFormat& format : kOtherFormats)
        if (bytes.size() > format.place && bytes.substr(format.place).starts_with(format.signature))
            return {
                fmt::format("is {}, but PNG and JPEG are read", format.name),
                fmt::format("convert it ({}), and let the texture's source name the PNG", format.converter)};
    return {"is neither PNG nor JPEG", "convert it to one of them"};
}

}  // namespace

PictureFormat format_of_picture(std::string_view bytes) {
    if (bytes.starts_with("\xff\xd8\xff")) return PictureFormat::jpeg;
    return bytes.starts_with("\x89PNG\r\n\x1a\n") ? PictureFormat::png : PictureFormat::unknown;
}

tl::expected<TextureImage, NoPicture> decode_picture(std::string_view bytes) {
    switch (format_of_picture(bytes)) {
        case PictureFormat::png:
            return decode_png(bytes);
        case PictureFormat::jpeg:
            return decode_jpeg(bytes);
        case PictureFormat::unknown:
            break;
    }
    return tl::unexpected(not_decoded(bytes));
}

}  // namespace gobo::scene
