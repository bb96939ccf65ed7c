#include "gobo/reload_server.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/file_error.hpp"
#include "family/key.hpp"

namespace gobo {
namespace {

/// Bytes that wait for an application which does not take them. It is let go then, and may come again.
constexpr std::size_t kMostUnsent = std::size_t{256} << 20;

/// Each takes a descriptor, and builds need some.
constexpr std::size_t kMostClients = 16;

/// Whether a program has the socket, of whatever kind.
bool is_served(const sockaddr_un& address) {
    const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const bool is = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ||
                    errno != ECONNREFUSED;
    ::close(probe);
    return is;
}

bool is_socket(const std::string& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 && S_ISSOCK(status.st_mode);
}

/// A new socket that listens at the address.
Result<int> listen_at(const sockaddr_un& address) {
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const mode_t mask = ::umask(0077);
    const bool is_bound = ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    const int error = errno;
    ::umask(mask);
    if (is_bound && ::listen(socket, 16) == 0) return socket;
    ::close(socket);
    return file_error(address.sun_path, "made a socket", is_bound ? errno : error);
}

sockaddr_un address_of(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    return address;
}

}  // namespace

Result<std::unique_ptr<ReloadServer>> ReloadServer::open(const std::string& path) {
    const sockaddr_un address = address_of(path);
    if (path.size() >= sizeof address.sun_path)
        return fail({.fault = Fault::file,
                     .place = {path},
                     .message = fmt::format("cannot be a socket: its name has more than {} bytes",
                                            sizeof address.sun_path - 1),
                     .help = "name one in a folder nearby, or in /tmp"});
    if (is_socket(path)) {
        if (is_served(address))
            return fail({.fault = Fault::file,
                         .place = {path},
                         .message = "a program listens there, such as another gobo watch",
                         .help = "name another socket, or end it"});
        ::unlink(path.c_str());
    } else if (struct stat status{}; ::lstat(path.c_str(), &status) == 0) {
        return fail({.fault = Fault::file,
                     .place = {path},
                     .message = "cannot be made a socket: something else is there",
                     .help = "name another path, or remove it"});
    }
    GOBO_TRY(const int socket, listen_at(address));
    return std::unique_ptr<ReloadServer>(new ReloadServer(path, socket));
}

void ReloadServer::restore_socket() {
    if (is_socket(path_)) return;
    const Result<int> socket = listen_at(address_of(path_));  // where it cannot, it is tried again
    if (!socket) return;
    ::close(std::exchange(socket_, *socket));
}

ReloadServer::~ReloadServer() {
    ::unlink(path_.c_str());
    ::close(socket_);
    for (const Client& client : clients_) ::close(client.socket);
}

std::string ReloadServer::message_of(const Programs& programs) const {
    std::map<const Stage*, std::size_t> numbers;
    std::string stages;
    std::string rows;
    for (const auto& [key, program] : programs) {
        std::string row = fmt::format("program {} {}", key.size(), program.size());
        for (const auto& stage : program) {
            const auto [at, is_new] = numbers.try_emplace(stage.get(), numbers.size());
            row += fmt::format(" {}", at->second);
            if (is_new)
                stages += fmt::format("stage {} {}\n{}", static_cast<int>(stage->kind), stage->text.size(),
                                      stage->text);
        }
        rows += row + "\n" + key;
    }
    const std::string content = stages + rows + fmt::format("errors {}\n{}", errors_.size(), errors_);
    return fmt::format("GOBO1 {}\n{}", content.size(), content);
}

std::size_t ReloadServer::offer(const Family& family, const Composition& composition) {
    std::vector<std::shared_ptr<const Stage>> stages;
    for (const gobo::Stage& stage : composition.stages)
        stages.push_back(std::make_shared<const Stage>(Stage{stage.kind, source_of(composition, stage)}));
    Programs changed;
    Programs all;
    for (const Permutation& permutation : composition.permutations) {
        std::vector<std::shared_ptr<const Stage>> program;
        for (const int number : permutation.stages.values)
            if (number >= 0) program.push_back(stages[static_cast<std::size_t>(number)]);
        std::string key = key_text(family, permutation.key);
        const auto before = programs_.find(key);
        const bool is_same = before != programs_.end() &&
                             std::ranges::equal(before->second, program,
                                                [](const auto& a, const auto& b) { return *a == *b; });
        if (!is_same) changed.emplace(key, program);
        all.emplace(std::move(key), std::move(program));
    }
    programs_ = std::move(all);
    errors_.clear();
    send(message_of(changed));
    return changed.size();
}

void ReloadServer::offer_errors(std::string_view errors) {
    errors_ = errors;
    send(message_of({}));
}

void ReloadServer::send(const std::string& message) {
    can_accept_ = true;
    for (Client& client : clients_) client.unsent += message;
    std::erase_if(clients_, [](Client& client) { return !send_some(client); });
}

/// False where the client is gone, or does not read.
bool ReloadServer::send_some(Client& client) {
    while (!client.unsent.empty()) {
        const ssize_t count =
            ::send(client.socket, client.unsent.data(), client.unsent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count < 0 && errno == EINTR) continue;
        const bool waits = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
        if (waits && client.unsent.size() <= kMostUnsent) return true;
        if (count < 0) {
            ::close(client.socket);
            return false;
        }
        client.unsent.erase(0, static_cast<std::size_t>(count));
    }
    return true;
}

std::vector<pollfd> ReloadServer::descriptors() const {
    std::vector<pollfd> all = {{can_accept_ ? socket_ : -1, POLLIN, 0}};
    for (const Client& client : clients_)
        all.push_back(
            {client.socket, static_cast<short>(client.unsent.empty() ? POLLIN : POLLIN | POLLOUT), 0});
    return all;
}

void ReloadServer::serve(const std::vector<pollfd>& polled) {
    const auto is_ready = [&](int socket) {
        return std::ranges::any_of(polled,
                                   [&](const pollfd& one) { return one.fd == socket && one.revents != 0; });
    };
    std::erase_if(clients_, [&](Client& client) {
        if (!is_ready(client.socket)) return false;
        char said = 0;  // an application says nothing: what can be read is its end
        const ssize_t count = ::recv(client.socket, &said, 1, MSG_DONTWAIT);
        const bool is_gone = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
        if (is_gone) ::close(client.socket);
        can_accept_ = can_accept_ || is_gone;
        return is_gone || !send_some(client);
    });
    if (!is_ready(socket_)) return;
    int come = -1;
    while ((come = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK)) >= 0) {
        Client client{come, clients_.size() < kMostClients ? message_of(programs_) : ""};
        if (client.unsent.empty())
            ::close(come);
        else if (send_some(client))
            clients_.push_back(std::move(client));
    }
    // It would be ready again at once, and no more accepted, until a descriptor is free.
    can_accept_ = errno != EMFILE && errno != ENFILE;
}

}  // namespace gobo
