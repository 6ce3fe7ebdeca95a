// Tests of the player with a fake feed and a simulated clock, so that no test waits for real time.
#include "engine/media/live/LivePlayer.h"
#include "tests/unit/media/TestFiles.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace shoal::media {
namespace {

// A live feed whose pictures a test sends. A player may keep it beyond the end of its test.
class FakeFeed final : public LiveFeed {
  public:
    FakeFeed() : LiveFeed("fake:0", "stream") {}

    // Sends a grey picture, whose number numberOf() reads back.
    void send(int number, double arrived_s = 0) {
        change([&] { events_.push_back({number, arrived_s, {}}); });
    }
    void breakOff(std::string why) {
        change([&] { events_.push_back({.broken = std::move(why)}); });
    }
    void refuse(std::string why) { // open() fails with this message until it is empty
        change([&] { refusal_ = std::move(why); });
    }
    void block(bool deaf) { // blocks open() and read(); deaf: an interruption does not end that
        change([&] { blocked_ = true, deaf_ = deaf; });
    }
    void unblock() {
        change([&] { blocked_ = false; });
    }
    int opened() const {
        const std::lock_guard lock(mutex_);
        return opened_;
    }

    Status open() override {
        std::unique_lock lock(mutex_);
        ++opened_;
        wait(lock, [&] { return !blocked_; });
        if (!refusal_.empty()) return Error{"", refusal_};
        return Done{};
    }
    Result<int64_t> read(ImageRgb8& bgr, VideoFrame& frame) override {
        std::unique_lock lock(mutex_);
        wait(lock, [&] { return !blocked_ && !events_.empty(); });
        if (events_.empty()) return Error{"", "was interrupted"};
        const Event event = events_.front();
        events_.pop_front();
        if (!event.broken.empty()) return Error{"", event.broken};
        bgr.fit(64, 32);
        std::fill(bgr.pixels.begin(), bgr.pixels.end(),
                  static_cast<uint8_t>(kFirstGrey + kGreyStep * event.number));
        frame.arrived_s = event.arrived_s;
        frame.decode_ms = 1;
        return 0;
    }
    void interrupt() override {
        change([&] { interrupted_ = true; });
    }

  private:
    struct Event {
        int number = 0;
        double arrived_s = 0;
        std::string broken;
    };
    template <class Change> void change(Change&& change) {
        const std::lock_guard lock(mutex_);
        change();
        changed_.notify_all();
    }
    template <class Ready> void wait(std::unique_lock<std::mutex>& lock, Ready&& ready) {
        changed_.wait(lock, [&] { return ready() || (interrupted_ && !(blocked_ && deaf_)); });
    }

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Event> events_;
    std::string refusal_;
    bool blocked_ = false, deaf_ = false, interrupted_ = false;
    int opened_ = 0;
};

struct Played {
    std::shared_ptr<FakeFeed> fake = std::make_shared<FakeFeed>();
    std::atomic<double> now_s{100};
    std::optional<LivePlayer> player;

    explicit Played(bool begins = true) {
        if (begins) begin(options());
    }
    LiveOptions options() {
        return {.retryFirst_s = 0, .retryMax_s = 0, .now_s = [this] { return now_s.load(); }};
    }
    // Plays, with picture 0 shown.
    void begin(LiveOptions with) {
        fake->send(0, now_s);
        player.emplace(tests::valueOf(LivePlayer::open(fake, std::move(with))));
    }
    int shown() { return numberOf(player->newest()->pixelsBgr); }
    void untilMade(int64_t count) {
        while (player->counts().made < count) std::this_thread::yield();
    }
};

TEST(LivePlayer, ABurstShowsItsNewestAndCountsTheRest) {
    Played p;
    for (int i = 1; i <= 5; ++i) p.fake->send(i);
    p.untilMade(6);
    EXPECT_EQ(p.shown(), 5);
    EXPECT_EQ(p.shown(), 5);
    const LiveCounts counts = p.player->counts();
    EXPECT_EQ(counts.shown, 2);
    EXPECT_EQ(counts.skipped, 4);
    EXPECT_EQ(p.player->newest()->index, 5);
}

TEST(LivePlayer, TheShownFrameStaysUntouchedWhileOthersCome) {
    Played p;
    const VideoFrame* shown = p.player->newest();
    for (int i = 1; i < 40; ++i) p.fake->send(i);
    p.untilMade(40);
    EXPECT_EQ(numberOf(shown->pixelsBgr), 0);
    EXPECT_EQ(p.shown(), 39);
}

TEST(LivePlayer, PrepareSeesTheSlotThatIsShownAndMemoryStaysFlat) {
    Played p(false);
    std::array<int, kFrameSlots> prepared{};
    std::set<const uint8_t*> memory;
    LiveOptions options = p.options();
    options.prepare = [&](const VideoFrame& frame) {
        prepared.at(frame.slot) = numberOf(frame.pixelsBgr);
        memory.insert(frame.pixelsBgr.pixels.data());
    };
    p.begin(std::move(options));
    for (int i = 1; i < 500; ++i) {
        p.fake->send(i % 50);
        p.untilMade(i + 1);
        if (i % 3 == 0) {
            EXPECT_EQ(prepared.at(p.player->newest()->slot), i % 50);
        }
        if (i % 100 == 0) p.fake->breakOff("broke");
    }
    EXPECT_LE(memory.size(), kFrameSlots);
}

TEST(LivePlayer, StoppedItKeepsItsPictureSaysSoAndComesBack) {
    Played p;
    EXPECT_EQ(p.shown(), 0);
    EXPECT_EQ(p.player->notice(), "");
    p.now_s = p.now_s + 0.9;
    p.shown();
    EXPECT_EQ(p.player->state(), LiveState::Playing);
    p.now_s = p.now_s + 0.2;
    EXPECT_EQ(p.shown(), 0);
    EXPECT_EQ(p.player->state(), LiveState::Stopped);
    EXPECT_EQ(p.player->notice(), "The stream has stopped; showing its last picture");
    p.now_s = p.now_s + 1000;
    EXPECT_EQ(p.shown(), 0);
    p.fake->send(3, p.now_s);
    p.untilMade(2);
    EXPECT_EQ(p.shown(), 3);
    EXPECT_EQ(p.player->state(), LiveState::Playing);
    EXPECT_EQ(p.player->notice(), "");
    EXPECT_EQ(p.player->counts().stops, 1);
    EXPECT_EQ(p.player->counts().losses, 0);
    EXPECT_EQ(p.fake->opened(), 1);
}

TEST(LivePlayer, LostItSaysWhyAndOpensAnewUntilItIsBack) {
    Played p;
    p.fake->refuse("cannot be reached");
    p.fake->breakOff("was cut");
    while (p.fake->opened() < 5) std::this_thread::yield();
    EXPECT_EQ(p.shown(), 0);
    EXPECT_EQ(p.player->state(), LiveState::Lost);
    EXPECT_NE(p.player->notice().find("showing its last picture"), std::string::npos);
    while (p.player->notice().find("cannot be reached") == std::string::npos) p.shown();
    p.fake->refuse("");
    p.fake->send(7);
    p.untilMade(2);
    EXPECT_EQ(p.shown(), 7);
    EXPECT_EQ(p.player->state(), LiveState::Playing);
    EXPECT_EQ(p.player->notice(), "");
    EXPECT_EQ(p.player->counts().losses, 1) << "one loss, however often it was tried";
    EXPECT_EQ(p.player->counts().stops, 1);
}

TEST(LivePlayer, TellsInHowManyOfTheDisplaysPicturesAFrameWasShown) {
    Played p;
    const auto call = [&](double at_s) {
        p.now_s = at_s;
        p.player->newest();
    };
    call(200.00);
    p.fake->send(1, 200.01); // arrives after that call, and is ready before the next
    p.untilMade(2);
    call(200.02);
    EXPECT_EQ(p.player->displayFrames(), 1);
    call(200.04); // 2 has arrived by then, but takes a while
    call(200.06);
    p.fake->send(2, 200.03);
    p.untilMade(3);
    call(200.08);
    EXPECT_EQ(p.player->displayFrames(), 3);
    EXPECT_NEAR(p.player->age_s(), 0.05, 1e-9);
}

TEST(LivePlayer, OpeningFailsWithTheReason) {
    Played p(false);
    p.fake->refuse("cannot be reached");
    EXPECT_EQ(tests::errorOf(LivePlayer::open(p.fake, p.options())).message(), "fake:0: cannot be reached");
    LiveOptions impatient = p.options();
    impatient.firstPicture_s = 0;
    const auto silent = std::make_shared<FakeFeed>();
    EXPECT_EQ(tests::errorOf(LivePlayer::open(silent, std::move(impatient))).reason, "no picture has come");
}

// Nobody waits for a feed that hangs: neither while it opens nor while it reads, heard or not.
TEST(LivePlayer, ItCanBeLeftWhileTheFeedHangs) {
    for (const bool deaf : {false, true}) {
        const auto opening = std::make_shared<FakeFeed>();
        opening->block(deaf);
        EXPECT_FALSE(LivePlayer::open(opening, {}, [] { return false; }));
        opening->unblock();

        Played p;
        p.fake->block(deaf);
        p.player.reset();
        p.fake->unblock();
    }
}

} // namespace
} // namespace shoal::media
