// An application of Xlib, with its header before or behind the generated one.
#ifdef XLIB_FIRST
#include <X11/Xlib.h>
#endif
#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "macros.hpp"
#ifndef XLIB_FIRST
#include <X11/Xlib.h>
#endif
#include <X11/Xutil.h>

int main() {
    macros::Key key;
    key.small_ = macros::Small::None_;
    key.status = macros::Status_::ERROR_;
    key.Bool_ = True;
    macros::Complex_ block{};
    block.True_ = true;
    const Bool is_out = macros::check(block).empty() ? False : True;
    return macros::key_text(key) == "small=None status=ERROR Bool=on" && is_out == False ? 0 : 1;
}
