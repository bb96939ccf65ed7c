#include "textures.hpp"

#include <thread>

#include "core/file_system.hpp"
#include "core/shipped_files.hpp"
#include "lab/probe/environment.hpp"
#include "lab/render/texture.hpp"
#include "lab/scene_picture/picture_levels.hpp"

namespace viewer {

gobo::Result<EnvironmentMaps> studio_maps() {
    const std::string path = "data/environments/studio.exr";
    const gobo::Result<gobo::Image> image =
        gobo::read_image(gobo::MemoryFileSystem(gobo::shipped_files()), path);
    if (!image) return tl::unexpected(image.error());
    const auto environment = gobo::probe::environment_of(*image, path);
    if (!environment) return tl::unexpected(environment.error());
    const int jobs = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    return EnvironmentMaps{{gobo::probe::lobe_map(*environment, 1, 16, jobs)},
                           gobo::probe::roughness_maps(*environment, 64, gobo::kRoughnessLevels, jobs)};
}

GLuint Textures::of(const gobo::scene::TextureImage& picture, const gobo::scene::TextureUse& use,
                    bool is_srgb) {
    GLuint& name = pictures_[{&picture, use.wrap_s, use.wrap_t, use.is_nearest, use.min_filter, is_srgb}];
    if (name != 0) return name;
    gl_.GenTextures(1, &name);
    gl_.BindTexture(GL_TEXTURE_2D, name);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    GLint number = 0;
    for (const gobo::scene::TextureImage& level : gobo::scene::picture_levels(picture, is_srgb))
        gl_.TexImage2D(GL_TEXTURE_2D, number++, is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, level.width,
                       level.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, level.texels.data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, use.min_filter);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, use.is_nearest ? GL_NEAREST : GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, use.wrap_s);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, use.wrap_t);
    return name;
}

GLuint Textures::of(const std::vector<gobo::Image>& levels) const {
    GLuint name = 0;
    gl_.GenTextures(1, &name);
    gl_.BindTexture(GL_TEXTURE_CUBE_MAP, name);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const gobo::Image& faces = levels[level];
        const std::size_t face_size = faces.values.size() / 6;
        for (GLenum face = 0; face < 6; ++face)
            gl_.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, static_cast<GLint>(level), GL_RGBA16F,
                           faces.width, faces.width, 0, faces.channels == 4 ? GL_RGBA : GL_RGB, GL_FLOAT,
                           faces.values.data() + face * face_size);
    }
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    return name;
}

}  // namespace viewer
