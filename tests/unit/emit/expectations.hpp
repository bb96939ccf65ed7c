// What callers of generated headers expect; they print what fails.
#pragma once

#include <cstdio>
#include <string>

inline int failures = 0;

inline void expect(bool holds, const std::string& what) {
    if (holds) return;
    std::printf("failed: %s\n", what.c_str());
    ++failures;
}

inline void expect_text(const std::string& actual, const std::string& expected) {
    if (actual == expected) return;
    std::printf("failed: expected \"%s\"\n             got \"%s\"\n", expected.c_str(), actual.c_str());
    ++failures;
}
