// OSMesa that crashes as soon as a context is asked for, ends the process with status 0 where RENDERER_EXITS
// is set, or where RENDERER_DRAWS names Mesa's own is that until it gets a text that defines CRASH. A test
// puts it in front of Mesa's by LD_LIBRARY_PATH.
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <unistd.h>

namespace {

/// A function of Mesa's own library, which a variable names.
template <class Function>
Function mesas(const char* name) {
    static void* const library = ::dlopen(std::getenv("RENDERER_DRAWS"), RTLD_NOW | RTLD_LOCAL);
    return reinterpret_cast<Function>(::dlsym(library, name));
}

using Source = void (*)(unsigned, int, const char* const*, const int*);

void shader_source(unsigned shader, int count, const char* const* texts, const int* lengths) {
    for (int i = 0; i < count; ++i)
        if (std::strstr(texts[i], "#define CRASH") != nullptr) std::abort();
    reinterpret_cast<Source>(mesas<void* (*)(const char*)>("OSMesaGetProcAddress")("glShaderSource"))(
        shader, count, texts, lengths);
}

bool draws() {
    return std::getenv("RENDERER_DRAWS") != nullptr;
}

[[noreturn]] void die() {
    if (std::getenv("RENDERER_EXITS") != nullptr) ::_exit(0);
    std::abort();
}

}  // namespace

extern "C" {

void* OSMesaCreateContextAttribs(const int* attributes, void* shared) {
    if (!draws()) die();
    return mesas<void* (*)(const int*, void*)>("OSMesaCreateContextAttribs")(attributes, shared);
}
void* OSMesaCreateContextExt(unsigned format, int depth, int stencil, int accumulation, void* shared) {
    if (!draws()) die();
    return mesas<void* (*)(unsigned, int, int, int, void*)>("OSMesaCreateContextExt")(format, depth, stencil,
                                                                                      accumulation, shared);
}
unsigned char OSMesaMakeCurrent(void* context, void* buffer, unsigned type, int width, int height) {
    if (!draws()) return 0;
    return mesas<unsigned char (*)(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(
        context, buffer, type, width, height);
}
void OSMesaDestroyContext(void* context) {
    if (draws()) mesas<void (*)(void*)>("OSMesaDestroyContext")(context);
}
void* OSMesaGetProcAddress(const char* name) {
    if (!draws()) return nullptr;
    if (std::strcmp(name, "glShaderSource") == 0) return reinterpret_cast<void*>(&shader_source);
    return mesas<void* (*)(const char*)>("OSMesaGetProcAddress")(name);
}
}
