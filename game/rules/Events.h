// What happens in a dive, for sound, captions, haptics and playthroughs: one struct for each kind of event,
// with the fields that it has. Its name, sound, caption and haptic pulse are its row in
// game/feedback/EventTable.h. World frame, metres, metres a second. Plain data.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <variant>
#include <vector>

namespace shoal::game {

namespace events {

// Fields that several events have: creature, an id of Snapshot::creatures; hand, 0 left and 1 right; part,
// hands::Finger or hands::kPalmPart; closing_mps, how fast the two came together.

struct Touch { // a finger or palm meets a fish
    int creature = -1, hand = 0, part = 0;
    float closing_mps = 0;
    glm::vec3 position{0};
};
struct Startle { // a fish flees; once per fright
    int creature = -1;
    glm::vec3 position{0};
};
struct Grab { // a hand closes on a fish
    int creature = -1, hand = 0;
    glm::vec3 position{0};
};
struct Catch { // held long enough: it counts
    int creature = -1, hand = 0;
    glm::vec3 position{0};
};
struct Release { // let go after a catch
    int creature = -1, hand = 0;
    glm::vec3 position{0};
};
struct Escape { // let go, or slipped out, before it counted
    int creature = -1, hand = 0;
    glm::vec3 position{0};
};
struct Miss { // a hand closed on nothing
    int hand = 0;
    glm::vec3 position{0};
};
struct SharkNear { // the shark turns towards the player
    int creature = -1;
    glm::vec3 position{0};
};
struct SharkBump { // the shark hits a hand
    int creature = -1, hand = 0, part = 0;
    float closing_mps = 0;
    glm::vec3 position{0};
};
struct SharkSteal { // the shark takes a fish out of a hand
    int creature = -1, hand = 0;
    glm::vec3 position{0};
};
struct DiveStart {};
struct DiveOver {};

} // namespace events

struct Event {
    uint64_t tick = 0;
    std::variant<events::Touch, events::Startle, events::Grab, events::Catch, events::Release, events::Escape,
                 events::Miss, events::SharkNear, events::SharkBump, events::SharkSteal, events::DiveStart,
                 events::DiveOver>
        what;
};

template <class E> bool is(const Event& event) { return std::holds_alternative<E>(event.what); }
template <class E> const E* as(const Event& event) { return std::get_if<E>(&event.what); }

// Appends the events of one tick to a list.
class EventSink {
  public:
    EventSink(uint64_t tick, std::vector<Event>& out) : tick_(tick), out_(out) {}
    template <class E> void emit(const E& what) { out_.push_back({tick_, what}); }

  private:
    uint64_t tick_;
    std::vector<Event>& out_;
};

} // namespace shoal::game
