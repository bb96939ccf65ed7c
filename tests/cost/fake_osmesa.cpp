// OSMesa that crashes as soon as a context is asked for. A test puts it in front of Mesa's by
// LD_LIBRARY_PATH.
#include <cstdlib>

extern "C" {

void* OSMesaCreateContextAttribs(const int*, void*) {
    std::abort();
}
void* OSMesaCreateContextExt(unsigned, int, int, int, void*) {
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
