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

    // Drops the last client and blocks until the next has connected and sent its request. False after 20
    // seconds. asks: false for a protocol in which clients send none.
    bool accept(bool asks = true);
    int accepted() const { return accepted_; }
    bool wasTried() const;                                  // true if a client waits for accept()
    const std::string& request() const { return request_; } // last request
    const std::string& nextRequest();                       // of the same client; empty: none came

    // Sends bytes to the client; false if it has gone.
    bool send(std::string_view bytes);
    bool beginPictures(); // sends the head of a stream of JPEG pictures
    bool sendPicture(std::string_view jpeg);

    void cut();                                // breaks the connection, as if a cable were cut
    void hangUp();                             // closes the connection properly
    bool waitForLeave(int atMax_ms = 600'000); // false if the client is still there after that

  private:
    int listening_ = -1, client_ = -1;
    uint16_t port_ = 0;
    int accepted_ = 0;
    std::string request_;
};

} // namespace shoal::media::test
