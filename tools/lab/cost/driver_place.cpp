#include "lab/cost/driver_place.hpp"

#include <array>

#include <fmt/format.h>

namespace gobo::cost {
namespace {

constexpr std::array<const char*, 5> kLibraryFolders = {
    "usr/lib/x86_64-linux-gnu", "usr/lib/aarch64-linux-gnu", "usr/lib64", "usr/lib", "lib"};
constexpr const char* kShim = "libnouveau_noop_drm_shim.so";

std::string library_of(Maker maker) {
    return maker == Maker::amd ? "libvulkan_radeon.so" : "libvulkan_nouveau.so";
}

/// The file's path where it is there, else nothing.
std::string file_or_nothing(const FileSystem& disk, const std::string& path) {
    return disk.is_file(path) ? path : "";
}

}  // namespace

Result<DriverPlace> find_driver(const FileSystem& disk, const std::string& where, Maker maker) {
    const std::string library = library_of(maker);
    const std::string shim = maker == Maker::nvidia ? kShim : "";
    const bool is_library = where.find(".so") != std::string::npos && where.back() != '/';
    if (!where.empty() && !is_library && disk.is_file(where))
        return fail(Fault::file, fmt::format("{} is a file, and neither a folder nor a library (.so)", where),
                    "name the folder into which Mesa's packages were unpacked, or its " + library);
    if (where.empty() || is_library) return DriverPlace{where.empty() ? library : where, "", "", shim};
    for (const std::string folder : kLibraryFolders) {
        const std::string libraries = fmt::format("{}/{}", where, folder);
        if (!disk.is_file(fmt::format("{}/{}", libraries, library))) continue;
        DriverPlace place{fmt::format("{}/{}", libraries, library), libraries};
        for (const char* loader : {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"})
            if (place.loader.empty())
                place.loader = file_or_nothing(disk, fmt::format("{}/{}", libraries, loader));
        if (maker == Maker::nvidia)
            place.shim = file_or_nothing(disk, fmt::format("{}/{}", libraries, kShim));
        if (maker == Maker::nvidia && place.shim.empty()) place.shim = kShim;
        return place;
    }
    return fail(
        Fault::file,
        fmt::format("{} holds no {}, such as {}/{}/{}", where, library, where, kLibraryFolders[0], library),
        "fetch Mesa's drivers into a folder with tools/fetch_mesa.sh (installed: share/gobo/tools)");
}

}  // namespace gobo::cost
