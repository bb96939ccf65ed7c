// Prints what a part of the program has and finds.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

template <class Permutations, class Permutation>
void report(const char* who, const Permutations& permutations, const Permutation* found) {
    std::printf("%s: %zu built; found:", who, permutations.size());
    for (int position = 0; found != nullptr && position < found->fragment.piece_count(); ++position) {
        const std::string_view name = found->fragment.piece(position).name;
        for (const std::string_view own : {"directional.glsl#directional", "point.glsl#point",
                                           "spot.glsl#spot", "fog.glsl#linear", "fog.glsl#exponential"})
            if (name == std::string("shader_lib/").append(own)) std::printf(" %s", own.data());
    }
    std::puts(found != nullptr ? "" : " nothing");
}
