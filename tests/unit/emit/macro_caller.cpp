// An application that includes the header behind what <windows.h> and <X11/Xlib.h> define.
#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define OPTIONAL
#define DELETE (0x00010000L)
#define ERROR 0
#define TRANSPARENT 1
#define None 0L
#define Bool int
#define Status int
#define True 1
#define False 0
#define Success 0
#define Always 2
#define Above 0
#define Complex 0
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))

#include <climits>
#include <cmath>
#include <cstdio>

#include <gobo/light_probes.hpp>
#include <gobo/normal_matrix.hpp>
#include <gobo/record.hpp>
#include <gobo/spot_cone.hpp>

#include "macros.hpp"

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
    if (macros::check(block).size() != 1) std::puts("near is out of range");
    return macros::find(key) != nullptr && macros::attribute::OUT_ + macros::output::False_ == 0 ? 0 : 1;
}
