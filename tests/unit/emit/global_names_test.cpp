// Whether the headers of C++ and POSIX declare a name at global scope that a family's namespace could get.
#include <cstdlib>
#include <set>

#include <features.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compose/tokens.hpp"
#include "core/file_system.hpp"
#include "core/text.hpp"
#include "emit/reserved_names.hpp"

namespace gobo {
namespace {

constexpr std::string_view kHeaders =
    "cassert cctype cerrno climits clocale cmath complex.h csetjmp csignal cstdint cstdio cstdlib cstring "
    "ctime "
    "cuchar cwchar cwctype fcntl.h inttypes.h iostream pthread.h strings.h sys/stat.h sys/time.h sys/types.h "
    "sys/wait.h unistd.h";

TEST(GlobalNames, LackNoneThatTheHeadersOfCppDeclare) {
    if (__GLIBC_PREREQ(2, 37)) GTEST_SKIP() << "newer ones declare more";
    DiskFileSystem files;
    const std::string path = testing::TempDir() + "gobo_global_names";
    std::string source;
    for (const std::string& header : split(kHeaders, ' ')) source += fmt::format("#include <{}>\n", header);
    ASSERT_TRUE(files.write(path + ".cpp", source));
    ASSERT_EQ(std::system(fmt::format("g++ -std=gnu++17 -E -P '{0}.cpp' -o '{0}.ii'", path).c_str()), 0);
    const std::string declared = files.read(path + ".ii").value();
    std::set<std::string_view> names;
    for (const std::string_view name : tokens_of(declared))
        if (is_identifier(name) && !name.starts_with('_') && !name.ends_with('_') &&
            name.find("__") == std::string_view::npos && !is_reserved_name(name) && !is_global_name(name))
            names.insert(name);
    EXPECT_GT(names.size(), 1000u) << "what is local to something: members, parameters, all of std";
    for (const std::string_view name : names) source += fmt::format("namespace {} {{}}\n", name);
    ASSERT_TRUE(files.write(path + ".cpp", source));
    const int status =
        std::system(fmt::format("g++ -std=gnu++17 -fsyntax-only '{0}.cpp' > '{0}.log' 2>&1", path).c_str());
    EXPECT_EQ(status, 0) << files.read(path + ".log").value();
}

}  // namespace
}  // namespace gobo
