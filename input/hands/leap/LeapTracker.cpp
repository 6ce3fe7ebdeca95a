#include "input/hands/HandTracker.h"

#include "input/hands/leap/LeapMessage.h"

#include <libwebsockets.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <thread>
#include <vector>

namespace shoal::hands {

namespace {

constexpr uint16_t kUnknownVersion = 1001; // the service's close code for a protocol it does not speak
// A ping after three silent seconds; after ten the connection counts as dead.
constexpr lws_retry_bo_t kLiveness = {nullptr, 0, 0, 3, 10, 0};

// All members but `stopping_` belong to the thread.
class LeapTracker final : public HandTracker {
  public:
    LeapTracker(const LeapOptions& options, const HandRig& rig)
        : HandTracker("Leap Motion"), options_(options),
          tracks_(rig, options.mount == LeapMount::Head ? kHeadMount : kDeskMount) {
        static const lws_protocols protocols[] = {
            {"leap",
             [](lws* wsi, lws_callback_reasons reason, void*, void* in, size_t length) {
                 auto* tracker = static_cast<LeapTracker*>(lws_context_user(lws_get_context(wsi)));
                 return tracker ? tracker->callback(wsi, reason, in, length) : 0;
             },
             0, 64 * 1024, 0, nullptr, 0},
            {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
        lws_set_log_level(0, nullptr);
        retry_.tracker = this;
        lws_context_creation_info info{};
        info.port = CONTEXT_PORT_NO_LISTEN;
        info.protocols = protocols;
        info.gid = info.uid = static_cast<decltype(info.gid)>(-1);
        info.user = this;
        // Ignores a proxy that the environment may name: the service is on this machine, or near it.
        info.http_proxy_address = "";
        context_ = lws_create_context(&info);
        setState(false, context_ ? "no service at " + address() : "no sockets are to be had");
        if (context_) thread_ = std::thread([this] { run(); });
    }
    ~LeapTracker() override {
        if (!context_) return;
        stopping_ = true;
        lws_cancel_service(context_);
        thread_.join();
        lws_context_destroy(context_);
    }

  private:
    std::string address() const { return options_.host + ":" + std::to_string(options_.port); }
    void setState(bool present, const std::string& words) { stream().setState({present, words}); }

    void connectIn(int64_t wait_us) {
        lws_sul_schedule(
            context_, 0, &retry_.timer,
            [](lws_sorted_usec_list_t* timer) { reinterpret_cast<Retry*>(timer)->tracker->connect(); },
            wait_us);
    }

    void connect() {
        const std::string path = "/v" + std::to_string(version_) + ".json", host = address();
        const std::string& given = options_.host;
        const std::string name = given.starts_with('[') ? given.substr(1, given.size() - 2) : given;
        lws_client_connect_info info{};
        info.context = context_;
        info.address = name.c_str();
        info.port = options_.port;
        info.path = path.c_str();
        info.host = info.origin = host.c_str();
        info.ietf_version_or_minus_one = -1;
        info.local_protocol_name = "leap";
        info.retry_and_idle_policy = &kLiveness;
        info.ssl_connection = LCCSCF_HTTP_NO_FOLLOW_REDIRECT; // a server on this port cannot redirect us
        info.pwsi = &socket_;
        greeted_ = false;
        tried_us_ = lws_now_usecs();
        closeCode_ = 0;
        message_.clear();
        unsent_.clear();
        device_.clear();
        lws_client_connect_via_info(&info); // a failure comes as LWS_CALLBACK_CLIENT_CONNECTION_ERROR
    }

    // Sends what the service expects, byte for byte, one message each.
    void sendSettings() {
        greeted_ = true;
        tracks_.connected();
        unsent_ = {"{\"background\":true}"};
        if (options_.mount == LeapMount::Head) unsent_.push_back("{\"optimizeHMD\":true}");
        unsent_.push_back("{\"focused\":true}");
        lws_callback_on_writable(socket_);
    }

    void receive(const char* bytes, size_t count) {
        if (lws_is_first_fragment(socket_)) message_.clear();
        // A message that is too long is cut to a byte too many, and so refused by readLeapMessage().
        message_.append(bytes, std::min(count, kLeapMessageBytes + 1 - message_.size()));
        if (lws_is_final_fragment(socket_) && lws_remaining_packet_payload(socket_) == 0) {
            if (!greeted_) sendSettings();
            handleMessage();
            message_.clear();
        }
    }

    void handleMessage() {
        const auto read = readLeapMessage(message_);
        if (!read) return;
        if (const auto* event = std::get_if<LeapDevice>(&*read))
            device_ = event->attached ? (event->type.empty() ? "device" : event->type) +
                                            (event->streaming ? " attached" : " attached but not streaming")
                                      : "no device attached";
        if (const auto* frame = std::get_if<LeapFrame>(&*read))
            stream().push(tracks_.frame(*frame, frame->time_us.value_or(lws_now_usecs())));
        const bool unplugged = device_ == "no device attached";
        setState(!unplugged, "protocol " + std::to_string(version_) + " at " + address() +
                                 (device_.empty() ? "" : ", " + device_));
    }

    void disconnected() {
        socket_ = nullptr;
        setState(false, "no service at " + address());
        if (stopping_) return;
        if (closeCode_ == kUnknownVersion && version_ > 1) {
            --version_;
            return connectIn(1);
        }
        version_ = kNewestLeapVersion;
        // A service that accepts and closes at once is tried only once in this time.
        connectIn(std::max<int64_t>(1, tried_us_ + int64_t{options_.retry_ms} * 1000 - lws_now_usecs()));
    }

    int callback(lws* wsi, lws_callback_reasons reason, void* in, size_t length) {
        if (reason == LWS_CALLBACK_CLIENT_RECEIVE) receive(static_cast<const char*>(in), length);
        if (reason == LWS_CALLBACK_CLIENT_WRITEABLE && !unsent_.empty()) {
            const size_t count = std::strlen(unsent_.front());
            std::array<unsigned char, LWS_PRE + 32> buffer;
            std::memcpy(buffer.data() + LWS_PRE, unsent_.front(), count);
            if (lws_write(wsi, buffer.data() + LWS_PRE, count, LWS_WRITE_TEXT) < 0) return -1;
            unsent_.erase(unsent_.begin());
            if (!unsent_.empty()) lws_callback_on_writable(wsi);
        }
        if (reason == LWS_CALLBACK_WS_PEER_INITIATED_CLOSE && length >= 2) {
            const auto* code = static_cast<const unsigned char*>(in);
            closeCode_ = static_cast<uint16_t>(code[0] << 8 | code[1]);
        }
        if (reason == LWS_CALLBACK_CLIENT_CONNECTION_ERROR || reason == LWS_CALLBACK_CLIENT_CLOSED)
            disconnected();
        return 0;
    }

    void run() {
        connectIn(1);
        while (!stopping_ && lws_service(context_, 0) >= 0) {
        }
    }

    LeapOptions options_;
    LeapTracks tracks_;
    std::atomic<bool> stopping_{false};

    lws_context* context_ = nullptr;
    lws* socket_ = nullptr;
    struct Retry {
        lws_sorted_usec_list_t timer{}; // first: the library hands back its address
        LeapTracker* tracker = nullptr;
    } retry_;
    int version_ = kNewestLeapVersion;
    bool greeted_ = false; // the service has sent a message on this connection
    int64_t tried_us_ = 0; // time of the last attempt to connect
    uint16_t closeCode_ = 0;
    std::vector<const char*> unsent_;
    std::string message_; // so far
    std::string device_;  // as the service describes it

    std::thread thread_; // last: it uses all of the above
};

} // namespace

std::unique_ptr<HandTracker> makeLeapTracker(const LeapOptions& options, const HandRig& rig) {
    return std::make_unique<LeapTracker>(options, rig);
}

} // namespace shoal::hands
