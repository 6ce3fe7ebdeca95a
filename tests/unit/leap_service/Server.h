// A stand-in for the Leap / Ultraleap service: a real WebSocket server on a loopback port.
#pragma once

#include <libwebsockets.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace shoal::hands::test {

class Server {
  public:
    // port 0: any free one. newest: a client that asks for a newer version is closed with 1001.
    explicit Server(int port = 0, int newest = 6) : newest_(newest) {
        static const lws_protocols protocols[] = {
            {"leap",
             [](lws* wsi, lws_callback_reasons reason, void*, void* in, size_t length) {
                 auto* server = static_cast<Server*>(lws_context_user(lws_get_context(wsi)));
                 return server ? server->called(wsi, reason, in, length) : 0;
             },
             0, 4096, 0, nullptr, 0},
            {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
        lws_set_log_level(0, nullptr);
        lws_context_creation_info info{};
        info.port = port;
        info.iface = "127.0.0.1";
        info.protocols = protocols;
        info.gid = info.uid = static_cast<decltype(info.gid)>(-1);
        info.user = this;
        info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_ALLOW_LISTEN_SHARE;
        context_ = lws_create_context(&info);
        lws_vhost* host = context_ ? lws_create_vhost(context_, &info) : nullptr;
        if (!host) throw std::runtime_error("no loopback port to listen on");
        port_ = lws_get_vhost_listen_port(host);
        thread_ = std::thread([this] {
            while (!leaving_ && lws_service(context_, 0) >= 0) {
            }
        });
    }
    ~Server() { // cuts connections, as a stopped service does
        leaving_ = true;
        lws_cancel_service(context_);
        thread_.join();
        lws_context_destroy(context_);
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    int port() const { return port_; }

    // Sends messages to the client in order; without a client they wait for one.
    void say(std::string message) { command({Command::Do::Text, std::move(message), 0}); }
    void say(const std::vector<std::string>& messages) {
        for (const std::string& message : messages) say(message);
    }
    void sayBinary(std::string bytes) { command({Command::Do::Binary, std::move(bytes), 0}); }
    // Cuts the connection once all that was said before has been sent; close(): by a closing handshake.
    void drop() { command({Command::Do::Drop, {}, 0}); }
    void close(uint16_t code) { command({Command::Do::Close, {}, code}); }

    // Blocks until the condition holds; false after ten minutes.
    bool waitForPaths(size_t count) {
        return waitFor([&] { return paths_.size() >= count; });
    }
    bool waitForHeard(size_t count) {
        return waitFor([&] { return heard_.size() >= count; });
    }
    bool waitUntilSent() { // all messages of say()
        return waitFor([&] { return commands_.empty(); });
    }

    std::vector<std::string> paths() const { // requested paths, one for each connection
        const std::lock_guard lock(mutex_);
        return paths_;
    }
    std::vector<std::string> heard() const { // messages from the client
        const std::lock_guard lock(mutex_);
        return heard_;
    }

  private:
    struct Command {
        enum class Do { Text, Binary, Drop, Close } what = Do::Text;
        std::string bytes;
        uint16_t code = 0;
    };

    void command(Command c) {
        {
            const std::lock_guard lock(mutex_);
            commands_.push_back(std::move(c));
        }
        lws_cancel_service(context_);
    }

    template <class Holds> bool waitFor(Holds holds) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::minutes(10), holds);
    }

    int established(lws* wsi) {
        char path[64] = {};
        lws_hdr_copy(wsi, path, sizeof path, WSI_TOKEN_GET_URI);
        int version = 0;
        std::sscanf(path, "/v%d.json", &version);
        const std::lock_guard lock(mutex_);
        paths_.push_back(path);
        changed_.notify_all();
        if (version > newest_ || version < 1) {
            lws_close_reason(wsi, static_cast<lws_close_status>(1001), nullptr, 0);
            return -1;
        }
        client_ = wsi;
        heardHere_ = 0;
        commands_.push_front(
            {Command::Do::Text,
             "{\"serviceVersion\":\"2.3.1+33747\",\"version\":" + std::to_string(version) + "}", 0});
        lws_callback_on_writable(wsi);
        return 0;
    }

    int writeable(lws* wsi) {
        const std::lock_guard lock(mutex_);
        if (commands_.empty() || wsi != client_) return 0;
        // A socket closed with something unread takes with it what is still on its way to the client: the
        // kernel resets the connection. Both of the client's messages first.
        const bool ends =
            commands_.front().what == Command::Do::Drop || commands_.front().what == Command::Do::Close;
        if (ends && heardHere_ < 2) return 0;
        const Command next = std::move(commands_.front());
        commands_.pop_front();
        changed_.notify_all();
        if (next.what == Command::Do::Drop) {
            client_ = nullptr;
            lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
            return 0;
        }
        if (next.what == Command::Do::Close) {
            client_ = nullptr;
            lws_close_reason(wsi, static_cast<lws_close_status>(next.code), nullptr, 0);
            return -1;
        }
        std::vector<unsigned char> buffer(LWS_PRE + next.bytes.size());
        std::memcpy(buffer.data() + LWS_PRE, next.bytes.data(), next.bytes.size());
        lws_write(wsi, buffer.data() + LWS_PRE, next.bytes.size(),
                  next.what == Command::Do::Text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY);
        if (!commands_.empty()) lws_callback_on_writable(wsi);
        return 0;
    }

    int called(lws* wsi, lws_callback_reasons reason, void* in, size_t length) {
        switch (reason) {
        case LWS_CALLBACK_ESTABLISHED:
            return established(wsi);
        case LWS_CALLBACK_SERVER_WRITEABLE:
            return writeable(wsi);
        case LWS_CALLBACK_RECEIVE: {
            const std::lock_guard lock(mutex_);
            heard_.emplace_back(static_cast<const char*>(in), length);
            if (++heardHere_ == 2) lws_callback_on_writable(wsi);
            changed_.notify_all();
            break;
        }
        case LWS_CALLBACK_CLOSED:
            if (wsi == client_) client_ = nullptr;
            break;
        case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
            if (client_) lws_callback_on_writable(client_);
            break;
        default:
            break;
        }
        return 0;
    }

    lws_context* context_ = nullptr;
    lws* client_ = nullptr;
    int port_ = 0, newest_;
    int heardHere_ = 0; // on this connection
    std::atomic<bool> leaving_{false};
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Command> commands_;
    std::vector<std::string> paths_, heard_;
    std::thread thread_;
};

} // namespace shoal::hands::test
