// An application that takes gobo in one of four ways: it finds the permutation that it asked for and misses
// another.
#include <cstdio>

#include "lit.hpp"

int main() {
    lit::Key key;
    key.fog = lit::Fog::linear;
    key.point = 3;
    const lit::Permutation* permutation = lit::find(key);
    if (permutation == nullptr) return std::puts(lit::describe_missing(key).c_str()), 1;
    std::size_t size = 0;
    permutation->fragment.for_each_piece([&size](std::string_view text) { size += text.size(); });
    key.point = 4;
    return size > 0 && lit::find(key) == nullptr ? 0 : 1;
}
