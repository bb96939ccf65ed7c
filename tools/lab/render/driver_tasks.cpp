#include "lab/render/driver_tasks.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <unistd.h>

namespace gobo {

std::string ending_of(Death death, int seconds) {
    switch (death) {
        case Death::time:
            return fmt::format("gave no answer within {} s", seconds);
        case Death::memory:
            return "ran out of memory";
        case Death::killed:
            return "was killed";
        case Death::exit:
            return "ended the process";
        case Death::crash:
            break;
    }
    return "crashed";
}

tl::unexpected<Diagnostics> fail_to_open(const std::string& driver, const std::string& ending) {
    return fail(Fault::file, driver + " " + ending, "try the other --backend, or another version of Mesa");
}

void send_output_to_errors() {
    static_cast<void>(::dup2(STDERR_FILENO, STDOUT_FILENO));
}

bool is_of_driver(const Diagnostics& errors) {
    return std::ranges::count(errors, Fault::file, &Diagnostic::fault) > 0;
}

}  // namespace gobo
