// An HTTP server on a loopback port that does what a test tells it, step by step, on the test's own thread:
// one connection at a time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shoal::media::test {

class HttpServer {
  public:
    HttpServer();
    ~HttpServer();
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    std::string url(const std::string& path = "/live") const;

    // Blocks until a client has connected and asked; drops the one before. False after 20 seconds.
    // asks: false for a protocol in which clients say nothing.
    bool accept(bool asks = true);
    int accepted() const { return accepted_; }
    bool wasTried() const; // somebody is connecting, whom accept() would take
    const std::string& request() const { return request_; } // the last
    const std::string& nextRequest();                       // of the same client; empty if none comes

    // Sends bytes to the client; false if it has gone.
    bool send(std::string_view bytes);
    bool beginPictures(); // the head of a stream of JPEG pictures
    bool sendPicture(std::string_view jpeg);

    void cut();                                // the connection, as a cable is cut
    void hangUp();                             // in good order
    bool waitForLeave(int atMax_ms = 600'000); // of the client; false if it is still there then

  private:
    int listening_ = -1, client_ = -1;
    uint16_t port_ = 0;
    int accepted_ = 0;
    std::string request_;
};

} // namespace shoal::media::test
