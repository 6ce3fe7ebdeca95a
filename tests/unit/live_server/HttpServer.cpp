#include "tests/unit/live_server/HttpServer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace shoal::media::test {

namespace {
constexpr int kPatience_ms = 600'000; // ends what hangs
}

HttpServer::HttpServer() {
    listening_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listening_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listening_, 8) != 0 ||
        getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
        throw std::runtime_error("no port to listen at");
    port_ = ntohs(address.sin_port);
}

HttpServer::~HttpServer() {
    hangUp();
    close(listening_);
}

std::string HttpServer::url(const std::string& path) const {
    return "http://127.0.0.1:" + std::to_string(port_) + path;
}

bool HttpServer::accept(bool asks) {
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

bool HttpServer::wasTried() const {
    pollfd waiting{listening_, POLLIN, 0};
    return poll(&waiting, 1, 0) != 0;
}

const std::string& HttpServer::nextRequest() {
    request_.clear();
    while (!request_.ends_with("\r\n\r\n")) {
        char bytes[1024];
        pollfd asked{client_, POLLIN, 0};
        const ssize_t count = poll(&asked, 1, kPatience_ms) == 1 ? recv(client_, bytes, sizeof bytes, 0) : 0;
        if (count <= 0) {
            request_.clear();
            break;
        }
        request_.append(bytes, static_cast<size_t>(count));
    }
    return request_;
}

bool HttpServer::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        bytes.remove_prefix(static_cast<size_t>(count));
    }
    return true;
}

bool HttpServer::beginPictures() {
    return send("HTTP/1.1 200 OK\r\nConnection: close\r\n"
                "Content-Type: multipart/x-mixed-replace; boundary=picture\r\n\r\n");
}

bool HttpServer::sendPicture(std::string_view jpeg) {
    return send("--picture\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) +
                "\r\n\r\n" + std::string(jpeg) + "\r\n");
}

void HttpServer::cut() {
    const linger atOnce{1, 0};
    if (client_ >= 0) setsockopt(client_, SOL_SOCKET, SO_LINGER, &atOnce, sizeof atOnce);
    hangUp();
}

void HttpServer::hangUp() {
    if (client_ >= 0) close(client_);
    client_ = -1;
}

bool HttpServer::waitForLeave(int atMax_ms) {
    pollfd waiting{client_, POLLIN | POLLRDHUP, 0};
    if (poll(&waiting, 1, atMax_ms) != 1) return false;
    char byte;
    return recv(client_, &byte, 1, MSG_PEEK) <= 0;
}

} // namespace shoal::media::test
