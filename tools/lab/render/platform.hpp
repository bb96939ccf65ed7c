// What makes an OpenGL context on a machine without a screen. Internal to tools/render.
#pragma once

#include <memory>
#include <string>

#include "core/diagnostic.hpp"

namespace gobo {

/// An OpenGL context of one windowing library, opened at run time. Destroying it destroys the context.
class Platform {
  public:
    using Function = void (*)();

    Platform() = default;
    Platform(const Platform&) = delete;
    Platform& operator=(const Platform&) = delete;
    virtual ~Platform() = default;

    /// Makes the context the calling thread's current one.
    [[nodiscard]] virtual bool make_current() = 0;
    /// The address of an OpenGL function; null where there is none.
    [[nodiscard]] virtual Function function(const char* name) const = 0;
};

/// A shared library that was opened with dlopen. It stays loaded to the end of the process: Mesa and LLVM
/// keep thread-local state that does not survive unloading.
class SharedLibrary {
  public:
    /// Tries each file name in turn.
    [[nodiscard]] static Result<SharedLibrary> open(const std::vector<const char*>& file_names,
                                                    const std::string& help);
    /// Null where the library has no such symbol.
    template <class Pointer>
    [[nodiscard]] Pointer symbol(const char* name) const {
        return reinterpret_cast<Pointer>(address(name));
    }

  private:
    [[nodiscard]] void* address(const char* name) const;
    void* handle_ = nullptr;
};

/// A core-profile context of at least the given version.
[[nodiscard]] Result<std::unique_ptr<Platform>> open_osmesa(int major, int minor);
[[nodiscard]] Result<std::unique_ptr<Platform>> open_egl(int major, int minor);

}  // namespace gobo
