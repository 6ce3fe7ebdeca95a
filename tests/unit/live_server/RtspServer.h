// A server of as much of RTSP (RFC 2326) as a player needs: one client, pictures over the same connection.
#pragma once

#include "tests/unit/live_server/HttpServer.h"

#include <vector>

namespace shoal::media::test {

class RtspServer {
  public:
    explicit RtspServer(std::string description) : description_(std::move(description)) {}

    std::string url() const;

    // Blocks until a client has been through all questions and is waiting for pictures; drops the one before.
    bool accept();
    int accepted() const { return server_.accepted(); }

    // RTP and RTCP packets; false if the client has gone.
    bool send(const std::vector<std::string>& packets);
    void cut() { server_.cut(); }

  private:
    HttpServer server_; // whose requests look the same
    std::string description_;
};

} // namespace shoal::media::test
