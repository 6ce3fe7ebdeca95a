#include "input/hands/leap/LeapHands.h"

#include "input/hands/leap/LeapTracks.h"

#include <libwebsockets.h>

#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

namespace shoal::hands {

namespace {

constexpr uint16_t kUnknownVersion = 1001; // the service's close code for a protocol it does not speak
// After three silent seconds a ping, after ten the connection is taken for dead.
constexpr lws_retry_bo_t kLiveness = {nullptr, 0, 0, 3, 10, 0};

int64_t now_us() {
    return std::chrono::duration_cast<std::chrono::microseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

} // namespace

// All but `stream` and `leaving` belongs to the thread.
struct LeapHands::State {
    LeapOptions options;
    LeapTracks tracks;
    HandStream stream;
    std::atomic<bool> leaving{false};

    lws_context* context = nullptr;
    lws* socket = nullptr;
    struct Retry {
        lws_sorted_usec_list_t timer{}; // first: the library hands back its address
        State* state = nullptr;
    } retry;
    int version = kNewestVersion;
    bool greeted = false; // the service has spoken on this connection
    bool framed = false;  // ...and told of hands, or of none
    uint16_t closeCode = 0;
    std::vector<const char*> unsent;
    std::string message; // so far
    bool tooLong = false;
    std::string device; // as the service tells it

    std::thread thread; // last: it uses all of the above

    State(const LeapOptions& o, const HandRig& rig)
        : options(o), tracks(rig, o.onHeadset ? kHeadMount : kDeskMount) {
        retry.state = this;
    }
    ~State() {
        if (!context) return;
        leaving = true;
        lws_cancel_service(context);
        if (thread.joinable()) thread.join();
        lws_context_destroy(context);
    }

    std::string place() const { return options.host + ":" + std::to_string(options.port); }
    void say(bool present, const std::string& words) { stream.setState({present, words, {}}); }

    void run();
    void connect();
    void connectIn(int64_t wait_us);
    void greet();
    void received(const char* bytes, size_t count);
    void understood();
    void gone();
    int called(lws* wsi, lws_callback_reasons reason, void* in, size_t length);
};

void LeapHands::State::connectIn(int64_t wait_us) {
    lws_sul_schedule(
        context, 0, &retry.timer,
        [](lws_sorted_usec_list_t* timer) { reinterpret_cast<Retry*>(timer)->state->connect(); }, wait_us);
}

void LeapHands::State::connect() {
    const std::string path = "/v" + std::to_string(version) + ".json", host = place();
    lws_client_connect_info info{};
    info.context = context;
    info.address = options.host.c_str();
    info.port = options.port;
    info.path = path.c_str();
    info.host = info.origin = host.c_str();
    info.ietf_version_or_minus_one = -1;
    info.local_protocol_name = "leap";
    info.retry_and_idle_policy = &kLiveness;
    info.pwsi = &socket;
    greeted = framed = tooLong = false;
    closeCode = 0;
    message.clear();
    unsent.clear();
    device.clear();
    lws_client_connect_via_info(&info); // a failure comes as LWS_CALLBACK_CLIENT_CONNECTION_ERROR
}

// What the service wants to hear, byte for byte, one message each.
void LeapHands::State::greet() {
    greeted = true;
    tracks.connected();
    unsent = {"{\"background\":true}"};
    if (options.onHeadset) unsent.push_back("{\"optimizeHMD\":true}");
    unsent.push_back("{\"focused\":true}");
    lws_callback_on_writable(socket);
}

void LeapHands::State::received(const char* bytes, size_t count) {
    if (lws_is_first_fragment(socket)) {
        message.clear();
        tooLong = false;
    }
    tooLong |= message.size() + count > kLeapMessageBytes;
    if (tooLong)
        message.clear();
    else
        message.append(bytes, count);
    if (lws_is_final_fragment(socket) && lws_remaining_packet_payload(socket) == 0) {
        if (!greeted) greet();
        if (!tooLong) understood();
        message.clear();
    }
}

void LeapHands::State::understood() {
    const auto read = readLeapMessage(message);
    if (!read) return; // rubbish: the next message may be better
    if (const auto* event = std::get_if<LeapDevice>(&*read))
        device = event->attached ? (event->type.empty() ? "device" : event->type) +
                                       (event->streaming ? " attached" : " attached but not streaming")
                                 : "no device attached";
    if (const auto* frame = std::get_if<LeapFrame>(&*read)) {
        framed = true;
        stream.push(tracks.frame(*frame, frame->time_us.value_or(now_us())));
    }
    const bool unplugged = device == "no device attached";
    say(!unplugged,
        "protocol " + std::to_string(version) + " at " + place() + (device.empty() ? "" : ", " + device));
}

void LeapHands::State::gone() {
    socket = nullptr;
    // To everybody else the hands are lost from now on; frames still on their way are not thrown away.
    say(false, "no service at " + place());
    if (leaving) return;
    if (closeCode == kUnknownVersion && version > 1) {
        --version;
        connectIn(1);
        return;
    }
    version = kNewestVersion;
    connectIn(framed ? 1 : kRetry_ms * 1000);
}

int LeapHands::State::called(lws* wsi, lws_callback_reasons reason, void* in, size_t length) {
    switch (reason) {
    case LWS_CALLBACK_CLIENT_RECEIVE:
        received(static_cast<const char*>(in), length);
        break;
    case LWS_CALLBACK_CLIENT_WRITEABLE:
        if (!unsent.empty()) {
            const size_t count = std::strlen(unsent.front());
            std::array<unsigned char, LWS_PRE + 32> buffer;
            std::memcpy(buffer.data() + LWS_PRE, unsent.front(), count);
            if (lws_write(wsi, buffer.data() + LWS_PRE, count, LWS_WRITE_TEXT) < 0) return -1;
            unsent.erase(unsent.begin());
            if (!unsent.empty()) lws_callback_on_writable(wsi);
        }
        break;
    case LWS_CALLBACK_WS_PEER_INITIATED_CLOSE:
        if (length >= 2) {
            const auto* code = static_cast<const unsigned char*>(in);
            closeCode = static_cast<uint16_t>(code[0] << 8 | code[1]);
        }
        break;
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
    case LWS_CALLBACK_CLIENT_CLOSED:
        gone();
        break;
    default:
        break;
    }
    return 0;
}

void LeapHands::State::run() {
    connectIn(1);
    while (!leaving && lws_service(context, 0) >= 0) {
    }
}

LeapHands::LeapHands(const LeapOptions& options, const HandRig& rig)
    : state_(std::make_unique<State>(options, rig)) {
    static const lws_protocols protocols[] = {
        {"leap",
         [](lws* wsi, lws_callback_reasons reason, void*, void* in, size_t length) {
             auto* state = static_cast<State*>(lws_context_user(lws_get_context(wsi)));
             return state ? state->called(wsi, reason, in, length) : 0;
         },
         0, 64 * 1024, 0, nullptr, 0},
        {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
    lws_set_log_level(0, nullptr);
    lws_context_creation_info info{};
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.protocols = protocols;
    info.gid = info.uid = static_cast<decltype(info.gid)>(-1);
    info.user = state_.get();
    // No way through a proxy that the environment may name: the service is on this machine, or near it.
    info.http_proxy_address = "";
    state_->context = lws_create_context(&info);
    state_->say(false, "no service at " + state_->place());
    if (!state_->context) {
        state_->say(false, "no sockets are to be had");
        return;
    }
    state_->thread = std::thread([s = state_.get()] { s->run(); });
}

LeapHands::LeapHands(LeapHands&&) noexcept = default;
LeapHands& LeapHands::operator=(LeapHands&&) noexcept = default;

LeapHands::~LeapHands() = default;

HandStream& LeapHands::stream() { return state_->stream; }

} // namespace shoal::hands
