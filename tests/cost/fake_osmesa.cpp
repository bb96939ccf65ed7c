// OSMesa that crashes as soon as a context is asked for, or ends the process with status 0 where
// RENDERER_EXITS is set. A test puts it in front of Mesa's by LD_LIBRARY_PATH.
#include <cstdlib>

#include <unistd.h>

extern "C" {

void* OSMesaCreateContextAttribs(const int*, void*) {
    if (std::getenv("RENDERER_EXITS") != nullptr) ::_exit(0);
    std::abort();
}
void* OSMesaCreateContextExt(unsigned, int, int, int, void*) {
    if (std::getenv("RENDERER_EXITS") != nullptr) ::_exit(0);
    std::abort();
}
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) {
    return 0;
}
void OSMesaDestroyContext(void*) {}
void* OSMesaGetProcAddress(const char*) {
    return nullptr;
}
}
