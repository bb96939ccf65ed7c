#include "lab/render/image.hpp"
#include "results.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

void read_exr(std::string_view input) {
    const Result<Image> image = decode_image(input, image_format_of("exr").value(), "a.exr");
    if (is_value(image))
        require(image->values.size() == static_cast<std::size_t>(image->width) *
                                            static_cast<std::size_t>(image->height) *
                                            static_cast<std::size_t>(image->channels));
}

void read_png(std::string_view input) {
    static_cast<void>(is_value(decode_image(input, image_format_of("png").value(), "a.png")));
}

}  // namespace gobo::fuzz
