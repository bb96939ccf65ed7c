// Where drivers are: installed, or in a folder that packages of another version were unpacked into.
#pragma once

#include <string>

#include "core/file_system.hpp"
#include "lab/cost/chips.hpp"

namespace gobo::cost {

/// A Vulkan driver and what it is loaded with.
struct DriverPlace {
    std::string library;         ///< a shared library by its name or path
    std::string libraries = {};  ///< folder of what it stands on; empty: the system's
    std::string loader = {};     ///< the dynamic loader of that folder; empty: the system's
    /// What stands in for NVIDIA's kernel driver, loaded before all else; empty: nothing.
    std::string shim = {};

    friend bool operator==(const DriverPlace&, const DriverPlace&) = default;
};

/// The driver for a maker's chips. `where` is empty (the system's), a shared library by its name or path, or
/// a folder in which Debian's packages were unpacked (dpkg -x), with or without a libc of their own.
/// Fault::file where the folder holds no such driver.
[[nodiscard]] Result<DriverPlace> find_driver(const FileSystem& disk, const std::string& where, Maker maker);

}  // namespace gobo::cost
