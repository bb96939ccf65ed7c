// An application as it is released: reloading costs it nothing.
#include <type_traits>

#include <gobo/reload.hpp>

static_assert(std::is_empty_v<gobo::Reload>);
static_assert(!gobo::Reload::is_connected());

// No socket is mentioned: it could not be, since this declares one of another kind.
int socket;

/// Compiles to nothing but the return.
int frame(gobo::Reload& reload) {
    int changed = 0;
    reload.take([&](const gobo::ReloadedProgram&) { ++changed; });
    return changed;
}
