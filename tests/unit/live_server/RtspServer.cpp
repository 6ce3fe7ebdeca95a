#include "tests/unit/live_server/RtspServer.h"

namespace shoal::media::test {

namespace {

// The value of a header's line, or nothing.
std::string header(const std::string& request, const std::string& name) {
    const size_t at = request.find("\r\n" + name + ": ");
    if (at == std::string::npos) return "";
    const size_t from = at + name.size() + 4;
    return request.substr(from, request.find("\r\n", from) - from);
}

} // namespace

std::string RtspServer::url() const { return "rtsp" + server_.url().substr(4); }

bool RtspServer::accept() {
    if (!server_.accept()) return false;
    for (std::string request = server_.request();; request = server_.nextRequest()) {
        if (request.empty()) return false;
        std::string answer = "RTSP/1.0 200 OK\r\nCSeq: " + header(request, "CSeq") + "\r\nSession: 1\r\n",
                    body;
        if (request.starts_with("OPTIONS")) answer += "Public: DESCRIBE, SETUP, PLAY, TEARDOWN\r\n";
        if (request.starts_with("DESCRIBE")) {
            body = description_ + "a=control:track\r\n";
            answer += "Content-Type: application/sdp\r\nContent-Base: " + url() + "/\r\n";
        }
        if (request.starts_with("SETUP")) answer += "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\n";
        if (!body.empty()) answer += "Content-Length: " + std::to_string(body.size()) + "\r\n";
        if (!server_.send(answer + "\r\n" + body)) return false;
        if (request.starts_with("PLAY")) return true;
    }
}

bool RtspServer::send(const std::vector<std::string>& packets) {
    for (const std::string& packet : packets) {
        // RTCP's kinds of packets are 200 and above: RFC 5761.
        const bool control = packet.size() > 1 && static_cast<uint8_t>(packet[1]) >= 200 &&
                             static_cast<uint8_t>(packet[1]) < 212;
        const char head[4] = {'$', control ? '\1' : '\0', static_cast<char>(packet.size() >> 8),
                              static_cast<char>(packet.size() & 0xff)};
        if (!server_.send(std::string(head, 4) + packet)) return false;
    }
    return true;
}

} // namespace shoal::media::test
