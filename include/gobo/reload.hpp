// Takes changed programs from `gobo watch --serve` while the application runs:
//
//     gobo::Reload reload("/tmp/game.reload");
//     ...
//     reload.take([&](const gobo::ReloadedProgram& changed) {          // between two frames
//         const auto program = gobo::gl::build_program(permutation_of(changed.key), changed.stages, gl);
//         if (program) replace(changed.key, program.id);                // else the old one stays
//     });
//
// It works where GOBO_RELOAD is defined, as in builds for development. Without it there is a Reload that does
// nothing and is compiled to nothing. It needs the sockets of a Unix.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gobo/permutation.hpp>

#ifdef GOBO_RELOAD
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#endif

namespace gobo {

/// The whole text of a stage.
struct ReloadedStage {
    runtime::StageKind kind = runtime::StageKind::vertex;
    std::string text;
};

/// A program of which a stage changed.
struct ReloadedProgram {
    std::string key;  ///< as key_text() of the generated header
    std::vector<ReloadedStage> stages;
};

#ifdef GOBO_RELOAD

/// Connects when there is someone to connect to, also later and again. Not for several threads at once.
class Reload {
  public:
    /// The socket that --serve names.
    explicit Reload(std::string path) : path_(std::move(path)) { connect(); }
    Reload(const Reload&) = delete;
    Reload& operator=(const Reload&) = delete;
    ~Reload() { close(); }

    [[nodiscard]] bool is_connected() const { return socket_ >= 0; }

    /// Calls `callback(const ReloadedProgram&)` for each program that changed since; right after connecting
    /// for all that the watched build has. Never waits.
    template <class Callback>
    void take(Callback&& callback) {
        receive();
        std::map<std::string, ReloadedProgram> changed;  // by key: of several changes the last one
        for (std::string message; next_message(message);) read(message, changed);
        for (const auto& entry : changed) callback(entry.second);
    }

    /// What is wrong with the files as they are now; empty where nothing is. The programs stay what they
    /// were.
    [[nodiscard]] const std::string& errors() const { return errors_; }

  private:
    using Clock = std::chrono::steady_clock;

    void connect() {
        sockaddr_un address = {};
        if (path_.empty() || path_.size() >= sizeof address.sun_path) return;
        if (Clock::now() < next_try_) return;
        next_try_ = Clock::now() + std::chrono::milliseconds(500);
        const int made = ::socket(AF_UNIX, SOCK_STREAM, 0);
        if (made < 0) return;
        ::fcntl(made, F_SETFD, FD_CLOEXEC);
        ::fcntl(made, F_SETFL, O_NONBLOCK);  // a server that is stopped takes nobody
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, path_.data(), path_.size());
        if (::connect(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
            socket_ = made;
        else
            ::close(made);
    }

    void close() {
        if (socket_ >= 0) ::close(socket_);
        socket_ = -1;
        received_.clear();
    }

    void receive() {
        if (socket_ < 0) connect();
        while (socket_ >= 0) {
            char buffer[65536];
            const ssize_t count = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
            if (count > 0) {
                received_.append(buffer, static_cast<std::size_t>(count));
            } else {
                is_at_end_ = true;  // what came before it still counts
                ::close(socket_);
                socket_ = -1;
            }
        }
    }

    /// Takes the first whole message off what was received.
    bool next_message(std::string& message) {
        const std::size_t line = received_.find('\n');
        if (line != std::string::npos) {
            std::string_view head = std::string_view(received_).substr(0, line);
            std::size_t size = 0;
            if (word(head) != "GOBO1" || !number(head, size)) {
                close();  // nobody that speaks this
                return false;
            }
            if (received_.size() - line - 1 >= size) {
                message = received_.substr(line + 1, size);
                received_.erase(0, line + 1 + size);
                return true;
            }
        }
        if (is_at_end_) {
            received_.clear();
            is_at_end_ = false;
        }
        return false;
    }

    static std::string_view word(std::string_view& line) {
        const std::size_t end = line.find(' ');
        const std::string_view found = line.substr(0, end);
        line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
        return found;
    }
    static bool number(std::string_view& line, std::size_t& value) {
        const std::string digits(word(line));
        if (digits.empty() || digits.size() > 10 ||
            digits.find_first_not_of("0123456789") != std::string::npos)
            return false;
        value = static_cast<std::size_t>(std::strtoull(digits.c_str(), nullptr, 10));
        return true;
    }

    /// Reads the records of a message; a damaged one ends it.
    void read(std::string_view message, std::map<std::string, ReloadedProgram>& changed) {
        std::vector<ReloadedStage> stages;
        while (!message.empty()) {
            std::string_view line = message.substr(0, message.find('\n'));
            if (line.size() == message.size()) return;
            message.remove_prefix(line.size() + 1);
            const std::string_view record = word(line);
            std::size_t kind = 0;
            std::size_t size = 0;
            if (record == "stage" && (!number(line, kind) || kind > 5)) return;
            if (!number(line, size) || size > message.size()) return;
            const std::string text(message.substr(0, size));
            message.remove_prefix(size);
            if (record == "stage") stages.push_back({static_cast<runtime::StageKind>(kind), text});
            if (record == "errors") errors_ = text;
            if (record != "program") continue;
            ReloadedProgram program{text, {}};
            std::size_t count = 0;
            if (!number(line, count)) return;
            for (std::size_t at = 0; count > 0; --count) {
                if (!number(line, at) || at >= stages.size()) return;
                program.stages.push_back(stages[at]);
            }
            changed[text] = std::move(program);
        }
    }

    std::string path_;
    int socket_ = -1;
    bool is_at_end_ = false;
    Clock::time_point next_try_ = {};
    std::string received_;
    std::string errors_;
};

#else

/// Does nothing.
class Reload {
  public:
    explicit Reload(std::string_view) {}
    [[nodiscard]] static constexpr bool is_connected() { return false; }
    template <class Callback>
    static constexpr void take(Callback&&) {}
    [[nodiscard]] static std::string errors() { return {}; }
};

#endif

}  // namespace gobo
