#include "lab/render/cube_maps.hpp"

#include <fmt/format.h>

namespace gobo {

Result<void> CubeMaps::add(const std::string& sampler, const Image& faces) {
    if (faces.height != 6 * faces.width || faces.width < 1 || faces.channels < 3) {
        return fail(Fault::input,
                    fmt::format("a picture of {} x {} texels in {} channels is no cube map for '{}'",
                                faces.width, faces.height, faces.channels, sampler),
                    "give six square faces in colour, one below the other, as gobo probe writes them");
    }
    const Context& context = resources_.context();
    context.make_current();
    const GladGLContext& gl = context.gl();
    Texture texture{0, GL_TEXTURE_CUBE_MAP};
    gl.GenTextures(1, &texture.name);
    resources_.adopt(texture);
    gl.BindTexture(texture.target, texture.name);
    const auto face_size = static_cast<std::size_t>(faces.width) * static_cast<std::size_t>(faces.width) *
                           static_cast<std::size_t>(faces.channels);
    const GLenum format = faces.channels == 4 ? GL_RGBA : GL_RGB;
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (GLenum face = 0; face < 6; ++face)
        gl.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA32F, faces.width, faces.width, 0,
                      format, GL_FLOAT, faces.values.data() + face * face_size);
    gl.TexParameteri(texture.target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(texture.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    textures_[sampler] = texture;
    return {};
}

}  // namespace gobo
