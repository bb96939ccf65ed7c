// Writes docs/data/guard_prices.csv and docs/numerics.md. Times are measured anew with --time, and for guards
// that have none; the others are kept. Cycles are costed anew where GOBO_MESA names a folder with drivers.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "numerics_page.hpp"
#include "pbr_guards.hpp"

namespace {

using namespace gobo;

int run(bool measures_all) {
    DiskFileSystem disk;
    const std::string csv_path = GOBO_SOURCE_DIR "/docs/data/guard_prices.csv";
    const Result<std::string> old = disk.read(csv_path);
    GuardTimes times = old && !measures_all ? times_of_csv(*old) : GuardTimes{};
    const Result<Context> context = open_context(Backend::osmesa);
    if (!context) {
        std::fputs(to_text(context.error().front()).c_str(), stderr);
        return 3;
    }
    for (const Guard& guard : all_guards())
        if (!times.contains(guard.name)) times[guard.name] = measure(guard, *context);
    if (const char* folder = std::getenv("GOBO_MESA")) {
        const auto cycles = measure_cycles(folder, GOBO_LAB);
        if (!cycles) {
            std::fputs(to_text(cycles.error().front()).c_str(), stderr);
            return 3;
        }
        for (const auto& [name, of_guard] : *cycles) times[name].cycles = of_guard;
    }
    // The page shows what the table says, rounded as it is there.
    const std::string csv = to_csv(times);
    const bool is_written = disk.write(csv_path, csv) &&
                            disk.write(GOBO_SOURCE_DIR "/docs/numerics.md", numerics_page(times_of_csv(csv)));
    return is_written && !testing::Test::HasFailure() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    setenv("LP_NUM_THREADS", "0", 1);      // llvmpipe draws in this thread
    testing::InitGoogleTest(&argc, argv);  // what the tables are made by reports its failures to it
    return run(argc > 1 && std::string_view(argv[1]) == "--time");
}
