#include "displayed.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lab/render/image.hpp"

namespace viewer {

gobo::Result<void> Displayed::frame(Renderer& renderer, const Settings& settings, const Orbit& orbit,
                                    const std::string& change) {
    const double time = renderer.frame_time(settings, orbit);
    fmt::print("frame {}{}: {:.2f} ms", number_, change.empty() ? "" : ", " + change, time);
    if (number_ > 0 && time_ > 0) fmt::print(" ({:.2f} of the frame before)", time / time_);
    fmt::print(", {}\n", renderer_name_);
    for (const std::string& key : renderer.keys()) fmt::print("  {}\n", key);
    for (const std::string& complaint : renderer.take_complaints())
        fmt::print(stderr, "viewer: {}\n", complaint);
    time_ = time;
    const int number = number_++;
    if (!options_.folder.empty()) {
        gobo::DiskFileSystem disk;
        const std::string path = fmt::format("{}/frame_{:03}.png", options_.folder, number);
        const gobo::Result<bool> written = write_image(disk, path, renderer.picture());
        if (!written) return tl::unexpected(written.error());
    }
    std::fflush(stdout);  // tests that press keys wait for this line
    return {};
}

}  // namespace viewer
