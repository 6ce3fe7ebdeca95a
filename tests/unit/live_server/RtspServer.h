// A server of the part of RTSP (RFC 2326) that a player needs: one client, pictures over the same connection.
#pragma once

#include "tests/unit/live_server/HttpServer.h"

#include <vector>

namespace shoal::media::test {

class RtspServer {
  public:
    explicit RtspServer(std::string description) : description_(std::move(description)) {}

    std::string url() const;

    // Drops the last client and blocks until the next has sent all requests and waits for pictures.
    bool accept();
    int accepted() const { return server_.accepted(); }

    // Sends RTP and RTCP packets; false if the client has gone.
    bool send(const std::vector<std::string>& packets);
    void cut() { server_.cut(); }

  private:
    HttpServer server_; // reads requests, which have the same form
    std::string description_;
};

} // namespace shoal::media::test
