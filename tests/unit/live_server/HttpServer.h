// An HTTP server on a loopback port that does what a test tells it, step by step, on the test's own thread:
// one connection at a time.
#pragma once

#include <arpa/inet.h>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

namespace shoal::media::test {

class HttpServer {
  public:
    HttpServer() {
        listening_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (bind(listening_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
            listen(listening_, 8) != 0 ||
            getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("no port to listen at");
        port_ = ntohs(address.sin_port);
    }
    ~HttpServer() {
        hangUp();
        close(listening_);
    }
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    std::string url(const std::string& path = "/live") const {
        return "http://127.0.0.1:" + std::to_string(port_) + path;
    }

    // Drops the last client and blocks until the next has connected and sent its request. asks: false for a
    // protocol in which clients send none.
    bool accept(bool asks = true) {
        hangUp();
        pollfd waiting{listening_, POLLIN, 0};
        if (poll(&waiting, 1, kPatience_ms) != 1) return false;
        client_ = accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC);
        if (client_ < 0) return false;
        const int yes = 1;
        setsockopt(client_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        ++accepted_;
        return !asks || !nextRequest().empty();
    }
    int accepted() const { return accepted_; }
    bool wasTried() const { // true if a client waits for accept()
        pollfd waiting{listening_, POLLIN, 0};
        return poll(&waiting, 1, 0) != 0;
    }
    const std::string& request() const { return request_; } // last request
    const std::string& nextRequest() {                      // of the same client; empty: none came
        request_.clear();
        while (!request_.ends_with("\r\n\r\n")) {
            char bytes[1024];
            pollfd asked{client_, POLLIN, 0};
            const ssize_t count =
                poll(&asked, 1, kPatience_ms) == 1 ? recv(client_, bytes, sizeof bytes, 0) : 0;
            if (count <= 0) {
                request_.clear();
                break;
            }
            request_.append(bytes, static_cast<size_t>(count));
        }
        return request_;
    }

    // Sends bytes to the client; false if it has gone.
    bool send(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t count = ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            bytes.remove_prefix(static_cast<size_t>(count));
        }
        return true;
    }
    bool beginPictures() { // sends the head of a stream of JPEG pictures
        return send("HTTP/1.1 200 OK\r\nConnection: close\r\n"
                    "Content-Type: multipart/x-mixed-replace; boundary=picture\r\n\r\n");
    }
    bool sendPicture(std::string_view jpeg) {
        return send("--picture\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                    std::to_string(jpeg.size()) + "\r\n\r\n" + std::string(jpeg) + "\r\n");
    }

    void cut() { // breaks the connection, as if a cable were cut
        const linger atOnce{1, 0};
        if (client_ >= 0) setsockopt(client_, SOL_SOCKET, SO_LINGER, &atOnce, sizeof atOnce);
        hangUp();
    }
    void hangUp() { // closes the connection properly
        if (client_ >= 0) close(client_);
        client_ = -1;
    }
    bool waitForLeave(int atMax_ms = kPatience_ms) { // false if the client is still there after that
        pollfd waiting{client_, POLLIN | POLLRDHUP, 0};
        if (poll(&waiting, 1, atMax_ms) != 1) return false;
        char byte;
        return recv(client_, &byte, 1, MSG_PEEK) <= 0;
    }

  private:
    static constexpr int kPatience_ms = 600'000; // ends what hangs

    int listening_ = -1, client_ = -1;
    uint16_t port_ = 0;
    int accepted_ = 0;
    std::string request_;
};

} // namespace shoal::media::test
