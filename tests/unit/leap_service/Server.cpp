#include "tests/unit/leap_service/Server.h"

#include <libwebsockets.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace shoal::hands::test {

namespace {

struct Command {
    enum class Do { Text, Binary, Drop, Close } what = Do::Text;
    std::string bytes;
    uint16_t code = 0;
};

} // namespace

struct Server::State {
    lws_context* context = nullptr;
    lws* client = nullptr;
    int port = 0, newest = 6;
    int heardHere = 0; // on this connection
    std::atomic<bool> leaving{false};
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<Command> commands;
    std::vector<std::string> paths, heard;
    std::thread thread;

    void command(Command c) {
        {
            const std::lock_guard lock(mutex);
            commands.push_back(std::move(c));
        }
        lws_cancel_service(context);
    }

    template <class Holds> bool waitFor(Holds holds) {
        std::unique_lock lock(mutex);
        return changed.wait_for(lock, std::chrono::minutes(10), holds);
    }

    int established(lws* wsi) {
        char path[64] = {};
        lws_hdr_copy(wsi, path, sizeof path, WSI_TOKEN_GET_URI);
        int version = 0;
        std::sscanf(path, "/v%d.json", &version);
        const std::lock_guard lock(mutex);
        paths.push_back(path);
        changed.notify_all();
        if (version > newest || version < 1) {
            lws_close_reason(wsi, static_cast<lws_close_status>(1001), nullptr, 0);
            return -1;
        }
        client = wsi;
        heardHere = 0;
        commands.push_front(
            {Command::Do::Text,
             "{\"serviceVersion\":\"2.3.1+33747\",\"version\":" + std::to_string(version) + "}", 0});
        lws_callback_on_writable(wsi);
        return 0;
    }

    int writeable(lws* wsi) {
        const std::lock_guard lock(mutex);
        if (commands.empty() || wsi != client) return 0;
        // A socket closed with something unread takes with it what is still on its way to the client: the
        // kernel resets the connection. Both of the client's messages first.
        const bool ends =
            commands.front().what == Command::Do::Drop || commands.front().what == Command::Do::Close;
        if (ends && heardHere < 2) return 0;
        const Command next = std::move(commands.front());
        commands.pop_front();
        changed.notify_all();
        if (next.what == Command::Do::Drop) {
            client = nullptr;
            lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
            return 0;
        }
        if (next.what == Command::Do::Close) {
            client = nullptr;
            lws_close_reason(wsi, static_cast<lws_close_status>(next.code), nullptr, 0);
            return -1;
        }
        std::vector<unsigned char> buffer(LWS_PRE + next.bytes.size());
        std::memcpy(buffer.data() + LWS_PRE, next.bytes.data(), next.bytes.size());
        lws_write(wsi, buffer.data() + LWS_PRE, next.bytes.size(),
                  next.what == Command::Do::Text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY);
        if (!commands.empty()) lws_callback_on_writable(wsi);
        return 0;
    }

    int called(lws* wsi, lws_callback_reasons reason, void* in, size_t length) {
        switch (reason) {
        case LWS_CALLBACK_ESTABLISHED:
            return established(wsi);
        case LWS_CALLBACK_SERVER_WRITEABLE:
            return writeable(wsi);
        case LWS_CALLBACK_RECEIVE: {
            const std::lock_guard lock(mutex);
            heard.emplace_back(static_cast<const char*>(in), length);
            if (++heardHere == 2) lws_callback_on_writable(wsi);
            changed.notify_all();
            break;
        }
        case LWS_CALLBACK_CLOSED:
            if (wsi == client) client = nullptr;
            break;
        case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
            if (client) lws_callback_on_writable(client);
            break;
        default:
            break;
        }
        return 0;
    }
};

Server::Server(int port, int newest) : state_(std::make_unique<State>()) {
    static const lws_protocols protocols[] = {
        {"leap",
         [](lws* wsi, lws_callback_reasons reason, void*, void* in, size_t length) {
             auto* state = static_cast<State*>(lws_context_user(lws_get_context(wsi)));
             return state ? state->called(wsi, reason, in, length) : 0;
         },
         0, 4096, 0, nullptr, 0},
        {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    info.port = port;
    info.iface = "127.0.0.1";
    info.protocols = protocols;
    info.gid = info.uid = static_cast<decltype(info.gid)>(-1);
    info.user = state_.get();
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_ALLOW_LISTEN_SHARE;
    state_->newest = newest;
    state_->context = lws_create_context(&info);
    lws_vhost* host = state_->context ? lws_create_vhost(state_->context, &info) : nullptr;
    if (!host) throw std::runtime_error("no loopback port to listen on");
    state_->port = lws_get_vhost_listen_port(host);
    state_->thread = std::thread([s = state_.get()] {
        while (!s->leaving && lws_service(s->context, 0) >= 0) {
        }
    });
}

Server::~Server() {
    state_->leaving = true;
    lws_cancel_service(state_->context);
    state_->thread.join();
    lws_context_destroy(state_->context);
}

int Server::port() const { return state_->port; }
void Server::say(std::string message) { state_->command({Command::Do::Text, std::move(message), 0}); }
void Server::say(const std::vector<std::string>& messages) {
    for (const std::string& message : messages) say(message);
}
void Server::sayBinary(std::string bytes) { state_->command({Command::Do::Binary, std::move(bytes), 0}); }
void Server::drop() { state_->command({Command::Do::Drop, {}, 0}); }
void Server::close(uint16_t code) { state_->command({Command::Do::Close, {}, code}); }

bool Server::waitForPaths(size_t count) {
    return state_->waitFor([&] { return state_->paths.size() >= count; });
}
bool Server::waitForHeard(size_t count) {
    return state_->waitFor([&] { return state_->heard.size() >= count; });
}
bool Server::waitUntilSent() {
    return state_->waitFor([&] { return state_->commands.empty(); });
}
std::vector<std::string> Server::paths() const {
    const std::lock_guard lock(state_->mutex);
    return state_->paths;
}
std::vector<std::string> Server::heard() const {
    const std::lock_guard lock(state_->mutex);
    return state_->heard;
}

} // namespace shoal::hands::test
