// OSMesa: Mesa's renderer in the calling process, without a display of any kind.
#include <array>

#include <fmt/format.h>

#include "lab/render/platform.hpp"

namespace gobo {
namespace {

// From Mesa's GL/osmesa.h, whose package need not be installed to build gobo.
using OsmesaContext = void*;
using CreateContextAttribs = OsmesaContext (*)(const int*, OsmesaContext);
using DestroyContext = void (*)(OsmesaContext);
using MakeCurrent = unsigned char (*)(OsmesaContext, void*, unsigned, int, int);
using GetProcAddress = Platform::Function (*)(const char*);
constexpr int osmesa_format = 0x22;
constexpr int osmesa_rgba = 0x1908;
constexpr int osmesa_depth_bits = 0x30;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_context_major_version = 0x36;
constexpr int osmesa_context_minor_version = 0x37;
constexpr unsigned unsigned_byte = 0x1401;

constexpr const char* help = "install it: apt-get install libosmesa6, or use --backend egl";

class OsmesaPlatform final : public Platform {
  public:
    OsmesaPlatform(const SharedLibrary& library, OsmesaContext context)
        : make_current_(library.symbol<MakeCurrent>("OSMesaMakeCurrent")),
          get_proc_address_(library.symbol<GetProcAddress>("OSMesaGetProcAddress")),
          destroy_context_(library.symbol<DestroyContext>("OSMesaDestroyContext")),
          context_(context) {}
    ~OsmesaPlatform() override { destroy_context_(context_); }

    bool make_current() override {
        return make_current_(context_, window_.data(), unsigned_byte, window_size, window_size) != 0;
    }
    Function function(const char* name) const override { return get_proc_address_(name); }

  private:
    // OSMesa insists on a default framebuffer; gobo draws to framebuffer objects only.
    static constexpr int window_size = 4;
    std::array<unsigned char, 4 * window_size* window_size> window_ = {};
    MakeCurrent make_current_;
    GetProcAddress get_proc_address_;
    DestroyContext destroy_context_;
    OsmesaContext context_;
};

}  // namespace

Result<std::unique_ptr<Platform>> open_osmesa(int major, int minor) {
    const auto library = SharedLibrary::open({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, help);
    if (!library) return tl::unexpected(library.error());
    const auto create = library->symbol<CreateContextAttribs>("OSMesaCreateContextAttribs");
    if (create == nullptr)
        return fail(Fault::file, "this OSMesa is older than 12.0 and has no OSMesaCreateContextAttribs",
                    help);
    const std::array<int, 11> attributes = {osmesa_format,
                                            osmesa_rgba,
                                            osmesa_depth_bits,
                                            0,
                                            osmesa_profile,
                                            osmesa_core_profile,
                                            osmesa_context_major_version,
                                            major,
                                            osmesa_context_minor_version,
                                            minor,
                                            0};
    OsmesaContext context = create(attributes.data(), nullptr);
    if (context == nullptr)
        return fail(Fault::file, fmt::format("OSMesa gives no OpenGL {}.{} core profile", major, minor));
    return std::make_unique<OsmesaPlatform>(*library, context);
}

}  // namespace gobo
