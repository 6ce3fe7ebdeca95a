// A stand-in for the Leap / Ultraleap service: a real WebSocket server on a loopback port.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace shoal::hands::test {

class Server {
  public:
    // port 0: any free one. newest: a client that asks for a newer version is closed with 1001.
    explicit Server(int port = 0, int newest = 6);
    ~Server(); // cuts connections, as a stopped service does

    int port() const;

    // Sends messages to the client in order; without a client they wait for one.
    void say(std::string message);
    void say(const std::vector<std::string>& messages);
    void sayBinary(std::string bytes);
    void drop();               // cuts the connection once all that was said before has been sent
    void close(uint16_t code); // likewise, by a closing handshake

    // Blocks until the condition holds; false after ten minutes.
    bool waitForPaths(size_t count);
    bool waitForHeard(size_t count);
    bool waitUntilSent(); // waits for all messages of say()

    std::vector<std::string> paths() const; // requested paths, one for each connection
    std::vector<std::string> heard() const; // messages from the client

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace shoal::hands::test
