#include "gobo/application.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <new>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/child_processes.hpp"
#include "core/shipped_files.hpp"
#include "core/text.hpp"
#include "core/write_together.hpp"
#include "gobo/kept_answers.hpp"
#include "gobo/machine_messages.hpp"

namespace gobo {
namespace {

/// A pipe without a reader and a file that grows beyond `ulimit -f` become errors of writing, not signals
/// that end the process. In the place of a stream that is closed stands one that cannot be used: else the
/// first file that is opened would be taken for it.
void prepare_process() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

/// What threads get, and what the first one must have, in bytes.
constexpr std::size_t kLeastStack = std::size_t{8} << 20;

/// Runs it on a stack of at least kLeastStack, whatever `ulimit -s` says. False where the system gives none.
bool run_with_stack(std::function<void()> work) {
    pthread_attr_t attributes;
    if (pthread_getattr_default_np(&attributes) != 0) return false;
    std::size_t size = 0;
    pthread_attr_getstacksize(&attributes, &size);
    if (size < kLeastStack) {
        pthread_attr_setstacksize(&attributes, kLeastStack);
        pthread_setattr_default_np(&attributes);
    }
    rlimit limit{};
    getrlimit(RLIMIT_STACK, &limit);
    if (limit.rlim_cur >= kLeastStack) {
        pthread_attr_destroy(&attributes);
        work();
        return true;
    }
    // Child processes go on with the stack of the thread that starts them.
    pthread_attr_setstacksize(&attributes, ChildLimits{}.stack);
    pthread_t thread{};
    const auto start = [](void* given) -> void* {
        (*static_cast<std::function<void()>*>(given))();
        return nullptr;
    };
    const int error = pthread_create(&thread, &attributes, start, &work);
    pthread_attr_destroy(&attributes);
    return error == 0 && pthread_join(thread, nullptr) == 0;
}

/// The machine's files, where --follow says so without a look at where links lead. What was read is not
/// written over.
class UserFiles final : public FileSystem {
  public:
    explicit UserFiles(const CommonOptions& options) : options_(options) {}
    [[nodiscard]] bool is_file(const std::string& path) const override { return disk_.is_file(path); }
    [[nodiscard]] Result<std::string> read(const std::string& path) const override {
        Result<std::string> content = disk_.read(path);
        const std::lock_guard lock(mutex_);
        if (content) read_.insert(path);
        return content;
    }
    [[nodiscard]] std::vector<std::string> files_below(const std::string& folder) const override {
        return disk_.files_below(folder);
    }
    Result<bool> write(const std::string& path, std::string_view content) override {
        GOBO_TRY_DO(spare({path}));
        return disk_.write(path, content);
    }
    /// An error where one of the files was read. A link in its place would be replaced, not followed.
    [[nodiscard]] Result<void> spare(const std::vector<std::string>& paths) const {
        using OnDisk = std::pair<dev_t, ino_t>;  // a file may have several names
        std::vector<std::pair<OnDisk, std::string>> there;
        struct stat found {};
        for (const std::string& path : paths)
            if (::lstat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode))
                there.push_back({{found.st_dev, found.st_ino}, path});
        if (there.empty()) return {};
        std::set<OnDisk> inputs;
        const std::lock_guard lock(mutex_);
        for (const std::string& input : read_)
            if (::stat(input.c_str(), &found) == 0) inputs.emplace(found.st_dev, found.st_ino);
        for (const auto& [place, path] : there)
            if (inputs.contains(place))
                return fail(Fault::usage, fmt::format("'{}' would be written over, but is read", path),
                            "name another file or folder for what is written");
        return {};
    }
    [[nodiscard]] std::string real_path(const std::string& path) const override {
        if (!options_.follow) return disk_.real_path(path);
        std::error_code error;
        const auto absolute = (std::filesystem::absolute(path, error) / "").lexically_normal().parent_path();
        return error ? path : absolute.generic_string();
    }

  private:
    const CommonOptions& options_;
    DiskFileSystem disk_;
    mutable std::mutex mutex_;
    mutable std::set<std::string> read_;
};

/// How messages are written. Asked before the options are read, so that what is wrong with them is written
/// so, too.
struct Messages {
    MessageFormat format = MessageFormat::text;
    bool color = false;

    explicit Messages(const std::vector<std::string>& arguments) : color(isatty(STDERR_FILENO) != 0) {
        const std::string colors = value_of("--color", arguments);
        if (colors == "always") color = true;
        if (colors == "never") color = false;
        const std::string named = value_of("--diagnostics", arguments);
        if (named == "json") format = MessageFormat::json;
        if (named == "sarif") format = MessageFormat::sarif;
    }

  private:
    /// The last one given.
    static std::string value_of(const std::string& option, const std::vector<std::string>& arguments) {
        std::string value;
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            if (arguments[i].starts_with(option + "=")) value = arguments[i].substr(option.size() + 1);
            if (i > 0 && arguments[i - 1] == option) value = arguments[i];
        }
        return value;
    }
};

int report(const Diagnostics& diagnostics, const Messages& messages, const std::string& program) {
    const int status = exit_status(diagnostics);
    std::string text;
    if (messages.format == MessageFormat::json) text = json_of(diagnostics, status);
    if (messages.format == MessageFormat::sarif) text = sarif_of(diagnostics, status, program);
    if (messages.format == MessageFormat::text) text = to_text(diagnostics, messages.color);
    std::fputs(text.c_str(), stderr);
    return status;
}

/// A full disk shows when the stream is flushed.
Result<void> write_output(const std::string& text) {
    const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (is_written && std::fflush(stdout) == 0) return {};
    return fail(Fault::file, fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

/// Replaces this process by gobo-lab with the same arguments, as git and cargo do: the one beside this
/// program, else the first in PATH. Returns only where there is none or it cannot be run.
void become_lab(const std::vector<std::string>& arguments) {
    std::vector<char*> passed = {const_cast<char*>("gobo-lab")};
    for (const std::string& argument : arguments) passed.push_back(const_cast<char*>(argument.c_str()));
    passed.push_back(nullptr);
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) execv((program.parent_path() / "gobo-lab").c_str(), passed.data());
    execvp("gobo-lab", passed.data());
}

/// What is searched for must be there: a folder whose name is misspelt holds nothing.
Result<void> refuse_absent_folders(const CommonOptions& options) {
    const auto is_absent = [](const std::string& folder) {
        std::error_code error;
        return !std::filesystem::is_directory(folder, error);
    };
    for (const std::string& folder : options.include_folders)
        if (is_absent(folder))
            return fail(Fault::file, fmt::format("-I '{}' is no folder", folder),
                        "name one that holds pieces, or leave it out");
    if (!options.library.empty() && is_absent(options.library))
        return fail(Fault::file, fmt::format("--library '{}' is no folder", options.library),
                    "name one that 'gobo library -o FOLDER' has written, or leave it out");
    return {};
}

Result<Outcome> answer(const Application& application, const World& world,
                       const std::vector<std::string>& arguments) {
    const bool completes = arguments.size() > 1 && arguments.front() == "complete";
    const std::string name = arguments.empty() ? "" : arguments[completes ? 1 : 0];
    for (const Command& command : application.commands)
        if (command.title.name == name && !command.run)
            return fail(Fault::needs_lab, fmt::format("'gobo {}' needs gobo-lab", name));
    if (completes)
        return Outcome{
            completions(application, {arguments.begin() + 1, arguments.end()}, shipped_families(world))};
    if (name == "manual") return Outcome{manual_page(application)};
    GOBO_TRY(const CommandLine line, read_command_line(application, arguments));
    if (line.command == nullptr) return Outcome{line.text};
    // While gobo watches, folders come and go.
    if (line.command->title.name != "watch") GOBO_TRY_DO(refuse_absent_folders(world.options));
    Diagnostics warnings;
    World chosen = world;
    chosen.given = line.given;
    GOBO_TRY(Outcome outcome, run_with_cache(*line.command, chosen, application.name, arguments, warnings));
    append(outcome.diagnostics, warnings);
    std::vector<std::string> paths;
    for (const OutputFile& file : outcome.files) paths.push_back(file.path);
    GOBO_TRY_DO(world.refuse_inputs(paths));
    return with_files_written(std::move(outcome));
}

int run(Application application, const std::vector<std::string>& arguments, const Messages& messages) {
    CommonOptions options;
    for (Command& command : application.commands)
        if (command.run) command.groups.push_back(common_options(options));
    UserFiles disk(options);
    MemoryFileSystem shipped(shipped_files());
    const auto tell = [&](const Outcome& told) {
        const bool is_text = messages.format == MessageFormat::text;
        // Only what is so now is to be seen.
        if (is_text && isatty(STDERR_FILENO) != 0) std::fputs("\033[H\033[2J", stderr);
        report(told.diagnostics, messages, application.name);
        if (is_text && !options.quiet) std::fputs((printable(told.summary) + "\n").c_str(), stderr);
        std::fflush(stderr);
    };
    const auto spare = [&](const std::vector<std::string>& paths) { return disk.spare(paths); };
    auto outcome = answer(application,
                          {disk, shipped, options, application.measure, nullptr, tell, {}, spare}, arguments);
    if (!outcome) {
        for (Diagnostic& error : outcome.error()) {
            if (error.fault != Fault::needs_lab) continue;
            become_lab(arguments);
            error.message += ", which is neither beside gobo nor in PATH";
            error.help =
                "install the package gobo-lab, or build it: cmake --build --preset release --target "
                "gobo-lab" +
                error.help;
        }
        return report(outcome.error(), messages, application.name);
    }
    if (const auto written = write_output(outcome->output); !written)
        append(outcome->diagnostics, written.error());
    const int status = report(outcome->diagnostics, messages, application.name);
    if (!outcome->summary.empty() && !options.quiet && messages.format == MessageFormat::text)
        std::fputs((printable(outcome->summary) + "\n").c_str(), stderr);
    return status;
}

}  // namespace

Result<Outcome> with_files_written(Outcome outcome) {
    std::vector<std::string> notes;
    if (outcome.compiled >= 0)
        notes.push_back(
            fmt::format("{} {} compiled", outcome.compiled, outcome.compiled == 1 ? "stage" : "stages"));
    if (!outcome.files.empty()) {
        std::vector<NewFile> files;
        for (const OutputFile& file : outcome.files) files.push_back({file.path, file.content});
        GOBO_TRY(const bool is_changed, write_together(files));
        if (!is_changed) notes.emplace_back("unchanged");
    }
    if (!notes.empty()) outcome.summary += fmt::format(" ({})", join(notes, ", "));
    return outcome;
}

int run_application(const Application& application, int count, char** arguments) {
    prepare_process();
    const std::vector<std::string> words(arguments + 1, arguments + count);
    const Messages messages(words);
    const auto report_fault = [&](Fault fault, std::string message) {
        return report(fail(fault, std::move(message)).value(), messages, application.name);
    };
    int status = 0;
    const auto run_here = [&] {
        try {
            status = run(application, words, messages);
        } catch (const std::bad_alloc&) {
            status = report_fault(Fault::file, "the system gives no more memory");
        } catch (const std::exception& error) {
            status = report_fault(Fault::internal, fmt::format("internal fault: {}", error.what()));
        }
    };
    if (!run_with_stack(run_here))
        status = report_fault(Fault::file, "the system gives no memory for a stack");
    return status;
}

}  // namespace gobo
