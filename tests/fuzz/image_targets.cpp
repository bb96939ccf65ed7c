#include "lab/render/image.hpp"
#include "results.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

bool read_exr(std::string_view input) {
    const Result<Image> image = decode_image(input, image_format_of("exr").value(), "a.exr");
    if (!is_value(image)) return false;
    require(image->values.size() == static_cast<std::size_t>(image->width) *
                                        static_cast<std::size_t>(image->height) *
                                        static_cast<std::size_t>(image->channels));
    return true;
}

bool read_png(std::string_view input) {
    return is_value(decode_image(input, image_format_of("png").value(), "a.png"));
}

}  // namespace gobo::fuzz
