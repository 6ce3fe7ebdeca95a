// The dive of the playthroughs, and hands to put into it.
#pragma once

#include "game/rules/Dive.h"
#include "game/rules/FishBehaviour.h"
#include "game/rules/Grasping.h"
#include "game/rules/Swimmer.h"
#include "input/hands/MouseHands.h"
#include "tests/Test.h"
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"

namespace shoal::game {

inline const DiveFiles& cove() {
    static const DiveFiles files =
        tests::valueOf(loadDiveFiles((dataRoot() / "tests/playthrough/dive/cove.toml").string()));
    return files;
}

using tests::rig;

inline constexpr glm::vec3 kPlace(0, -0.1f, -0.6f); // within easy reach

// Returns a hand with this grasp centre. The player looks along -Z, so viewer's frame and world agree.
inline hands::HandPose handAt(glm::vec3 grasp, float closed = 0, int side = 1) {
    return hands::reachingHand(rig(), side == 0 ? hands::Side::Left : hands::Side::Right, grasp, closed);
}

template <EventKind K> int count(const Events& events) {
    return static_cast<int>(std::ranges::count(events, K, &Event::kind));
}

template <EventKind K> const Event* first(const Events& events) {
    const auto found = std::ranges::find(events, K, &Event::kind);
    return found == events.end() ? nullptr : &*found;
}

// A dive whose state is open to tests, with the input of its next ticks and all events.
struct OpenDive : Dive {
    using Dive::Dive, Dive::step;
    TickInput input;
    Events events;
    std::vector<Fish>& fish = state().fish;
    Shark& shark = state().shark;
    Hands& hands = state().hands;
    const Score& score = state().score;

    void startle(int id, glm::vec3 from) {
        game::startle(fish[id], id, from, context(), state().random, events);
    }
    void step(int ticks = 1) {
        for (int i = 0; i < ticks; ++i) step(input, events);
    }
    void run(float seconds) { step(static_cast<int>(seconds * 120)); }
    Snapshot shown() const {
        Snapshot now;
        snapshot(now);
        return now;
    }
};

// Returns the cove's dive without its shark.
inline DiveFile calmCove() {
    DiveFile file = cove().dive;
    file.shark.species = -1;
    return file;
}

// A dive with one resting fish 0.6 m ahead, to test rules one at a time.
struct OneFish {
    struct Setting {
        bool shark = false;
        DiveRules rules{};
        std::function<void(DiveFile&)> change{};
    };
    OpenDive world;
    TickInput& input = world.input;
    Events& events = world.events;
    std::vector<uint64_t> eventTicks; // when each occurred

    OneFish() : OneFish(Setting{}) {}
    explicit OneFish(const Setting& setting) : world(cove().species, lonely(setting), 5, setting.rules) {
        rest();
    }

    static DiveFile lonely(const Setting& setting) {
        DiveFile file = cove().dive;
        const auto clownfish = std::ranges::find_if(
            file.schools, [](const School& s) { return cove().species[s.species].name == "clownfish"; });
        file.schools = {*clownfish};
        file.schools[0].count = 1;
        if (!setting.shark) file.shark.species = -1;
        if (setting.change) setting.change(file);
        return file;
    }

    Fish& fish() { return world.fish[0]; }
    // Places the fish here and stops its movement.
    void rest(glm::vec3 at = kPlace) {
        fish().position = at;
        fish().size = 1; // as its species' file says
        fish().forward = {1, 0, 0};
        fish().speed = fish().route.cruise_mps = 0;
        fish().push = fish().velocity = glm::vec3(0);
        fish().route.wander = fish().route.wanderGoal = glm::vec3(0);
        fish().route.radius = std::sqrt(at.x * at.x + at.z * at.z);
        fish().route.height = at.y;
    }
    void step(int ticks = 1) {
        for (int i = 0; i < ticks; ++i) {
            world.step();
            eventTicks.resize(events.size(), world.state().totalTicks);
        }
    }
    // Tick of the first event of that kind, 0 if there is none.
    template <EventKind K> uint64_t tickOfFirst() const {
        const Event* event = first<K>(events);
        return event ? eventTicks[static_cast<size_t>(event - events.data())] : 0;
    }
    // Brings the right hand to a place for a tick.
    void hand(glm::vec3 at, float closed = 0) {
        input.hands[1] = handAt(at, closed);
        step();
    }
    // Closes the right hand at a place, and waits.
    void close(glm::vec3 at, int ticks = 30) {
        moveGrip(at, 0, 1);
        step(ticks);
    }
    // Opens the right hand around the resting fish and closes it there.
    void closeOn(float closed = 1) {
        moveGrip(kPlace, 0, 0);
        rest();
        moveGrip(kPlace, 0, closed);
    }
    // Calls closeOn(), after which the hand must hold the fish.
    void takeFish(float closed = 1) {
        closeOn(closed);
        ASSERT_EQ(held(), 0);
        ASSERT_EQ(count<EventKind::Grab>(events), 1);
    }
    // Shows the hand, open, at a place and the fish, resting, at another.
    void show(glm::vec3 at, glm::vec3 fishAt, int ticks = 30) {
        for (int i = 0; i < ticks; ++i) {
            rest(fishAt);
            hand(at);
        }
    }
    int held() const { return world.hands[1].grasp.holds; }
    bool took() const { return count<EventKind::Grab>(events) > 0; }
    Snapshot shown() const { return world.shown(); }
    // Closes (or opens) the right hand over 0.12 s at a place.
    void moveGrip(glm::vec3 at, float from, float to) {
        for (int i = 1; i <= 15; ++i) hand(at, from + (to - from) * static_cast<float>(i) / 15);
    }
};

// Returns a synthetic space. distance_m: float(glm::vec3 dir, double time_s), positive.
template <class Distance>
std::shared_ptr<const FilmSpace> madeSpace(double length_s, int steps, const Distance& distance_m) {
    std::vector<uint16_t> surface_mm;
    for (int step = 0; step < steps; ++step)
        for (int cell = 0; cell < FilmSpace::kCells; ++cell)
            surface_mm.push_back(static_cast<uint16_t>(
                1000 * std::min(distance_m(FilmSpace::directionOf(cell), step * length_s / steps),
                                FilmSpace::kFar_m)));
    return std::make_shared<const FilmSpace>(length_s, std::move(surface_mm));
}

// Returns the distance from a school's middle to the fish farthest from it, body lengths.
inline float spreadOf(const OpenDive& dive, int school) {
    glm::vec3 middle(0);
    float count = 0, farthest_m = 0, length_m = 1;
    for (const Fish& fish : dive.fish)
        if (fish.school == school) middle += fish.position, ++count;
    for (const Fish& fish : dive.fish)
        if (fish.school == school) {
            farthest_m = std::max(farthest_m, glm::distance(fish.position, middle / count));
            length_m = cove().species[fish.species].length_m;
        }
    return farthest_m / length_m;
}

} // namespace shoal::game
