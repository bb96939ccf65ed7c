// Hands the programs of a build to applications that run: <gobo/reload.hpp> takes them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "compose/composition.hpp"
#include "core/diagnostic.hpp"

namespace gobo {

/// Listens at a socket in the file system, for 16 of the user's own processes at a time. Messages are a line
/// "GOBO1 SIZE" and SIZE bytes of records:
///     "stage KIND SIZE\n" and the text, KIND as in StageKind;
///     "program SIZE COUNT NUMBER...\n" and the key, the numbers those of stages of this message, from 0;
///     "errors SIZE\n" and the text; none where the last state has none.
class ReloadServer {
  public:
    /// Fault::file where it cannot listen there. A socket that a dead server left is replaced.
    [[nodiscard]] static Result<std::unique_ptr<ReloadServer>> open(const std::string& path);
    ReloadServer(const ReloadServer&) = delete;
    ReloadServer& operator=(const ReloadServer&) = delete;
    /// Removes the socket.
    ~ReloadServer();

    /// Sends the programs of which a stage changed to whoever listens; all of them to those who come later.
    /// How many changed.
    std::size_t offer(const Family& family, const Composition& composition);
    void offer_errors(std::string_view errors);

    /// What to wait for, for poll(), and what to do with its answer.
    [[nodiscard]] std::vector<pollfd> descriptors() const;
    void serve(const std::vector<pollfd>& polled);
    /// Listens anew where the socket was removed.
    void restore_socket();

  private:
    struct Client {
        int socket;
        std::string unsent;
    };
    struct Stage {
        StageKind kind;
        std::string text;

        friend bool operator==(const Stage&, const Stage&) = default;
    };
    using Programs = std::map<std::string, std::vector<std::shared_ptr<const Stage>>>;  ///< by key

    ReloadServer(std::string path, int socket) : path_(std::move(path)), socket_(socket) {}
    [[nodiscard]] std::string message_of(const Programs& programs) const;
    void send(const std::string& message);
    static bool send_some(Client& client);

    std::string path_;
    int socket_;
    bool can_accept_ = true;  ///< as far as descriptors go
    std::vector<Client> clients_;
    Programs programs_;
    std::string errors_;
};

}  // namespace gobo
