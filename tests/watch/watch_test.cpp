// gobo watch: what is saved is built, errors are told, and an application that runs takes what changed.
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gobo/reload.hpp>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file_system.hpp"

namespace gobo {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using testing::Not;

/// However slow the computer is; nothing here waits as long on a quiet one.
constexpr std::chrono::seconds kPatience{30};

void save(const std::string& path, const std::string& text) {
    fs::create_directories(fs::path(path).parent_path());
    std::ofstream(path) << text;
}

/// As editors do that keep the old file until the new one is whole.
void save_by_renaming(const std::string& path, const std::string& text) {
    save(path + "~", text);
    fs::rename(path + "~", path);
}

std::string text_of(const std::string& path) {
    return DiskFileSystem().read(path).value_or("");
}

bool await(const std::function<bool()>& is_so) {
    const Clock::time_point end = Clock::now() + kPatience;
    while (!is_so()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

class Watch : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        around = ::mkdtemp(around.data());
        folder = around + "/set";
        save(folder + "/tiny.toml",
             "name = \"tiny\"\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n"
             "[features.fog]\nvalues = [\"none\", \"linear\"]\n");
        save(folder + "/tiny.vert", "void main() { gl_Position = vec4(0.0); }\n");
        save(folder + "/tiny.frag",
             "#include <fog>\nlayout(location = 0) out vec4 color;\nvoid main() { color = seen(); }\n");
        save(folder + "/fog/none.glsl", "vec4 seen() { return vec4(1.0); }\n");
        save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.5); }\n");
        start();
        application.emplace(socket());
        ASSERT_TRUE(await([&] { return programs.size() == 2 || take() >= 2; })) << text_of(folder + "/log");
    }
    void TearDown() override {
        stop(SIGTERM);
        fs::remove_all(around);
    }
    [[nodiscard]] std::string socket() const { return folder + "/reload"; }

    /// What it tells goes into the log, or into what is given.
    void start(int told = -1) {
        process = ::fork();
        if (process == 0) {
            const std::string out = folder + "/log";
            const rlimit limit{most_descriptors, most_descriptors};
            if (most_descriptors > 0) ::setrlimit(RLIMIT_NOFILE, &limit);
            if (told >= 0 ? ::dup2(told, STDERR_FILENO) < 0
                          : std::freopen(out.c_str(), "a", stderr) == nullptr)
                ::_exit(127);
            const std::string family = folder + "/tiny.toml";
            const std::string output = folder + "/out";
            ::execl(GOBO_PROGRAM, "gobo", "watch", family.c_str(), "--all", "-I", (folder + "/mine").c_str(),
                    "-o", output.c_str(), "--serve", socket().c_str(), "-j", "1",
                    GetParam()[0] == '\0' ? nullptr : GetParam(), nullptr);
            ::_exit(127);
        }
    }
    /// Its exit status.
    int stop(int signal) {
        if (process < 0) return -1;
        ::kill(process, signal);
        int status = 0;
        ::waitpid(process, &status, 0);
        process = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /// What the application takes between two frames.
    int take() {
        int count = 0;
        application->take([&](const ReloadedProgram& program) {
            programs[program.key] = program;
            ++count;
        });
        taken += count;
        return count;
    }
    [[nodiscard]] std::string fragment_of(const std::string& key) const {
        for (const ReloadedStage& stage : programs.at(key).stages)
            if (stage.kind == runtime::StageKind::fragment) return stage.text;
        return {};
    }
    /// Saves, and waits until the application has what it means.
    bool takes(const std::function<void()>& change, const std::string& key, const std::string& text) {
        const Clock::time_point start = Clock::now();
        change();
        const bool is_taken = await([&] {
            take();
            return fragment_of(key).find(text) != std::string::npos;
        });
        const auto taken_for = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
        RecordProperty("milliseconds", static_cast<int>(taken_for.count()));
        return is_taken;
    }

    std::string around = "/tmp/gobo_watch_XXXXXX";
    std::string folder;  ///< one below: others write into /tmp, which would be news
    pid_t process = -1;
    rlim_t most_descriptors = 0;  ///< that it may have; 0: as many as the system allows
    std::optional<Reload> application;
    std::map<std::string, ReloadedProgram> programs;
    int taken = 0;
};

TEST_P(Watch, HandsOnWhatIsSavedAndNothingElse) {
    EXPECT_THAT(fragment_of("default"), HasSubstr("vec4(1.0)"));
    taken = 0;
    EXPECT_TRUE(takes([&] { save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.25); }\n"); },
                      "fog=linear", "vec4(0.25)"));
    EXPECT_EQ(taken, 1) << "the other program has no such piece";
    EXPECT_TRUE(
        takes([&] { save_by_renaming(folder + "/fog/none.glsl", "vec4 seen() { return vec4(0.75); }\n"); },
              "default", "vec4(0.75)"));
    EXPECT_THAT(text_of(folder + "/out/tiny.hpp"), HasSubstr("vec4(0.75)"));
}

TEST_P(Watch, KeepsTheOldProgramsWhileThereAreErrors) {
    save(folder + "/fog/linear.glsl", "vec4 seen() { return missing; }\n");
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }))
        << text_of(folder + "/log");
    EXPECT_THAT(application->errors(), HasSubstr("fog/linear.glsl:1: error: 'missing' : undeclared"));
    EXPECT_THAT(fragment_of("fog=linear"), HasSubstr("vec4(0.5)"));
    EXPECT_THAT(text_of(folder + "/out/tiny.hpp"), HasSubstr("vec4(0.5)"));
    EXPECT_TRUE(await([&] {
        return text_of(folder + "/log").find("waiting for a change") != std::string::npos;
    })) << text_of(folder + "/log");
    EXPECT_TRUE(takes([&] { save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.125); }\n"); },
                      "fog=linear", "vec4(0.125)"));
    EXPECT_EQ(application->errors(), "");
}

TEST_P(Watch, SeesFilesThatComeAndGo) {
    EXPECT_TRUE(takes([&] { save(folder + "/mine/fog/linear.glsl", "vec4 seen() { return vec4(0.01); }\n"); },
                      "fog=linear", "vec4(0.01)"))
        << "a folder that was not there";
    EXPECT_TRUE(takes([&] { fs::remove(folder + "/mine/fog/linear.glsl"); }, "fog=linear", "vec4(0.5)"));
    fs::rename(folder + "/tiny.frag", folder + "/away");
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }));
    EXPECT_THAT(application->errors(), HasSubstr("tiny.frag"));
    fs::rename(folder + "/away", folder + "/tiny.frag");
    ASSERT_TRUE(await([&] { return take() >= 0 && application->errors().empty(); }));
}

TEST_P(Watch, MissesAFolderThatWasThere) {
    EXPECT_TRUE(takes([&] { save(folder + "/mine/fog/linear.glsl", "vec4 seen() { return vec4(0.01); }\n"); },
                      "fog=linear", "vec4(0.01)"));
    fs::rename(folder + "/mine", folder + "/away");
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }));
    EXPECT_THAT(application->errors(), HasSubstr("/mine' is no folder any more"));
    EXPECT_THAT(text_of(folder + "/out/tiny.hpp"), HasSubstr("vec4(0.01)"));
    fs::rename(folder + "/away", folder + "/mine");
    ASSERT_TRUE(await([&] { return take() >= 0 && application->errors().empty(); }));
}

TEST_P(Watch, SeesTheFileThatALinkLeadsTo) {
    const std::string elsewhere = around + "/kept/family.toml";
    std::string family = text_of(folder + "/tiny.toml");
    save(elsewhere, family);
    save(folder + "/other.frag",
         "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(0.03); }\n");
    save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.02); }\n");
    fs::create_symlink(elsewhere, folder + "/link");
    fs::rename(folder + "/link", folder + "/tiny.toml");
    ASSERT_TRUE(takes([] {}, "fog=linear", "vec4(0.02)"));
    // By then it waits: what is saved earlier is seen without being told.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    family.replace(family.find("tiny.frag"), 9, "other.frag");
    EXPECT_TRUE(takes([&] { save(elsewhere, family); }, "fog=linear", "vec4(0.03)"));
}

TEST_P(Watch, EndsWhenItIsAskedTo) {
    EXPECT_EQ(stop(SIGINT), 0) << text_of(folder + "/log");
    EXPECT_FALSE(fs::exists(socket()));
    // The application goes on, and finds the next one.
    take();
    EXPECT_FALSE(application->is_connected());
    start();
    ASSERT_TRUE(await([&] { return take() > 0; }));
    EXPECT_TRUE(application->is_connected());
}

TEST_P(Watch, EndsAmidABuildAndWritesNothing) {
    const std::string header = text_of(folder + "/out/tiny.hpp");
    save(folder + "/mine/fog/linear.glsl", "vec4 seen() { return vec4(ROWS, COLUMNS, 0.0, 0.0); }\n");
    save(folder + "/tiny.toml",
         "name = \"tiny\"\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n"
         "[features.fog]\nvalues = [\"none\", \"linear\"]\n"
         "[features]\nrows = { count = [0, 99], constant = \"ROWS\" }\n"
         "columns = { count = [0, 99], constant = \"COLUMNS\" }\n");  // 10,000 stages
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_EQ(stop(SIGTERM), 0) << text_of(folder + "/log");
    EXPECT_FALSE(fs::exists(socket()));
    EXPECT_EQ(text_of(folder + "/out/tiny.hpp"), header);
}

TEST(Reload, DoesNotWaitWhereNobodyTakesIt) {
    std::string folder = "/tmp/gobo_reload_XXXXXX";
    ASSERT_NE(::mkdtemp(folder.data()), nullptr);
    const std::string path = folder + "/socket";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    const int server = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ASSERT_EQ(::bind(server, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(server, 0), 0);
    const Reload first(path);  // waits to be taken
    const Reload second(path);
    EXPECT_TRUE(first.is_connected());
    EXPECT_FALSE(second.is_connected());
    ::close(server);
    fs::remove_all(folder);
}

TEST_P(Watch, MakesASocketAgainThatIsRemoved) {
    fs::remove(socket());
    EXPECT_TRUE(await([&] { return fs::exists(socket()); }));
    Reload late(socket());
    int count = 0;
    EXPECT_TRUE(await([&] {
        late.take([&](const ReloadedProgram&) { ++count; });
        return count == 2;
    }));
}

/// Clock ticks of processor time.
long ticks_of(pid_t process) {
    std::istringstream status(text_of("/proc/" + std::to_string(process) + "/stat"));
    std::string skipped;
    for (int i = 0; i < 13; ++i) status >> skipped;
    long user = 0;
    long system = 0;
    status >> user >> system;
    return user + system;
}

TEST_P(Watch, BuildsForMoreWhoListenThanItHasDescriptorsFor) {
    stop(SIGTERM);
    most_descriptors = 32;
    start();
    ASSERT_TRUE(await([&] { return fs::exists(socket()); }));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    socket().copy(address.sun_path, sizeof address.sun_path - 1);
    std::vector<int> silent;
    for (int i = 0; i < 40; ++i) {
        silent.push_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
        static_cast<void>(
            ::connect(silent.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.0625); }\n");
    EXPECT_TRUE(await([&] {
        return text_of(folder + "/out/tiny.hpp").find("vec4(0.0625)") != std::string::npos;
    })) << text_of(folder + "/log");
    EXPECT_THAT(text_of(folder + "/log"), Not(HasSubstr("open files")));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const long before = ticks_of(process);
    std::this_thread::sleep_for(std::chrono::seconds(1));
    EXPECT_LT(ticks_of(process) - before, 30) << "of 100, while nothing happens";
    for (const int client : silent) ::close(client);
    EXPECT_TRUE(await([&] { return take() > 0; })) << "whoever comes when they are gone is heard";
}

TEST_P(Watch, WritesAgainWhatIsRemoved) {
    fs::remove_all(folder + "/out");
    EXPECT_TRUE(await([&] { return fs::exists(folder + "/out/tiny.hpp"); })) << text_of(folder + "/log");
}

TEST_P(Watch, GoesOnWhereAPieceBecomesAPipe) {
    ASSERT_EQ(::mkfifo((folder + "/pipe").c_str(), 0600), 0);
    fs::rename(folder + "/pipe", folder + "/fog/linear.glsl");
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }));
    EXPECT_THAT(application->errors(), HasSubstr(folder + "/fog/linear.glsl: error: cannot be read: it is a "
                                                          "pipe that nobody writes to\n"));
    fs::remove(folder + "/fog/linear.glsl");
    EXPECT_TRUE(takes([&] { save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.0625); }\n"); },
                      "fog=linear", "vec4(0.0625)"));
}

TEST_P(Watch, NamesThePipeThatItReadsOnce) {
    const std::string piece = folder + "/fog/linear.glsl";
    const std::string text = text_of(piece);
    ASSERT_EQ(::mkfifo((folder + "/pipe").c_str(), 0600), 0);
    const int writer = ::open((folder + "/pipe").c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(::write(writer, text.data(), text.size()), std::ssize(text));
    fs::rename(folder + "/pipe", piece);
    int left = 1;  // it waits for more, or for an end
    ASSERT_TRUE(await([&] { return ::ioctl(writer, FIONREAD, &left) == 0 && left == 0; }));
    ::close(writer);
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }));
    EXPECT_EQ(application->errors(), piece +
                                         ": error: a file that is read only once cannot be watched\n"
                                         "  help: name files, not standard input or a pipe\n");
    save_by_renaming(piece, text);
    EXPECT_TRUE(await([&] { return take() >= 0 && application->errors().empty(); }));
}

TEST_P(Watch, WritesOnceThePlaceIsFree) {
    const std::string header = folder + "/out/tiny.hpp";
    std::error_code error;
    ASSERT_TRUE(await([&] {  // what was removed alone is written again at once
        fs::remove(header, error);
        return fs::create_directory(header, error);
    }));
    save(folder + "/fog/linear.glsl", "vec4 seen() { return vec4(0.0625); }\n");
    ASSERT_TRUE(await([&] { return take() >= 0 && !application->errors().empty(); }));
    EXPECT_EQ(application->errors(), header + ": error: cannot be written: Is a directory\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
    const std::string log = text_of(folder + "/log");
    EXPECT_EQ(log.find("Is a directory"), log.rfind("Is a directory")) << "told once\n" << log;
    fs::remove(header);
    EXPECT_TRUE(await([&] { return text_of(header).find("vec4(0.0625)") != std::string::npos; }))
        << text_of(folder + "/log");
    EXPECT_TRUE(await([&] { return take() >= 0 && application->errors().empty(); }));
}

TEST_P(Watch, EndsWhereNobodyReadsWhatItTells) {
    stop(SIGTERM);
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    start(pipe[1]);
    ::close(pipe[1]);
    std::array<char, 4096> told{};
    ASSERT_GT(::read(pipe[0], told.data(), told.size()), 0);
    ::close(pipe[0]);
    int status = 0;
    ASSERT_TRUE(await([&] { return ::waitpid(process, &status, WNOHANG) == process; }));
    process = -1;
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

INSTANTIATE_TEST_SUITE_P(Ways, Watch, testing::Values("", "--look"),
                         [](const auto& row) { return row.param[0] == '\0' ? "told" : "looks"; });

}  // namespace
}  // namespace gobo
