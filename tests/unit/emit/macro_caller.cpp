// An application that includes the header behind what <windows.h> and <X11/Xlib.h> define, or before it.
#ifdef MACROS_FIRST
#include "windows_stand_in.hpp"
#endif

#include <climits>
#include <cmath>
#include <cstdio>

#include <gobo/environment_brdf.hpp>
#include <gobo/light_probes.hpp>
#include <gobo/normal_matrix.hpp>
#include <gobo/record.hpp>
#include <gobo/spot_cone.hpp>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>
#include <gobo/gl_uniforms.hpp>
#include <gobo/gl_vertices.hpp>

#include "macros.hpp"
#ifndef MACROS_FIRST
#include "windows_stand_in.hpp"
#endif

int main() {
    macros::Key key;
    key.small_ = macros::Small::None_;
    key.status = macros::Status_::ERROR_;
    key.Bool_ = true;
    key.interface_ = 2;
    key.limit = macros::Limit::INT_MAX_;
    if (macros::find(key) == nullptr) std::printf("%s\n", macros::describe_missing(key).c_str());
    macros::Complex_ block{};
    block.near_ = 2;
    block.True_ = true;
    block.min = block.max = 1;
    block.DELETE_.OPTIONAL_ = glm::vec4(1);
    static_assert(macros::declared::min_(macros::permutations[0]) == 1);
    macros::OPAQUE_ opaque{};
    static_cast<void>(macros::OPAQUE_::max_(&opaque, sizeof opaque));
    if (macros::check(block).size() != 1) std::puts("near is out of range");
    return macros::find(key) != nullptr && macros::attribute::OUT_ + macros::output::False_ == 0 ? 0 : 1;
}
