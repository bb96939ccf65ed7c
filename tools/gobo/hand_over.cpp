#include "gobo/hand_over.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

namespace gobo {

Diagnostics hand_over(const std::string& needs, const std::vector<std::string>& arguments) {
    std::vector<char*> passed = {const_cast<char*>("gobo-lab")};
    for (const std::string& argument : arguments) passed.push_back(const_cast<char*>(argument.c_str()));
    passed.push_back(nullptr);
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) execv((program.parent_path() / "gobo-lab").c_str(), passed.data());
    execvp("gobo-lab", passed.data());
    return fail(Fault::needs_lab,
                fmt::format("{} needs gobo-lab, which is neither beside gobo nor in PATH", needs),
                "install the package gobo-lab, or build it: cmake --build --preset release --target gobo-lab")
        .value();
}

void keep_standard_input(const std::string& text) {
    const int file = memfd_create("standard input", 0);
    if (file < 0) return;
    const bool is_written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (is_written && lseek(file, 0, SEEK_SET) == 0) dup2(file, STDIN_FILENO);
    close(file);
}

}  // namespace gobo
