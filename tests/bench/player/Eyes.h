// A person's sight of a dive on a screen: projected positions and apparent sizes without depth, delayed by
// the reaction time.
#pragma once

#include "game/rules/Snapshot.h"

#include <glm/vec2.hpp>

#include <deque>
#include <vector>

namespace shoal::player {

// The screen: 1280x720 at 65 degrees vertically, a person's before it. Positions in pixels from its middle,
// +x right, +y up.
constexpr glm::vec2 kHalfScreen_px(640, 360);
constexpr float kTanHalfFov = 0.63707026f;                  // of 32.5 degrees
constexpr float kFocal_px = kHalfScreen_px.y / kTanHalfFov; // 565: a degree is 10 pixels
constexpr float kDegree_px = 9.86f;

constexpr float kReaction_s = 0.25f; // from the picture to the hand's response

struct SeenFish {
    int id = -1; // stays the same while eyes follow the fish
    int species = 0;
    glm::vec2 at_px{0};
    float size_px = 0;   // its length's, if it were seen from the side: people allow for the way it turns
    bool marked = false; // highlighted: can be caught now
    bool prey = false;   // no shark, whale or jellyfish
    bool held = false;
    float distance_m = 0; // for those who see with two eyes and reach with a hand of their own
};

struct Sight {
    double time_s = 0;
    std::vector<SeenFish> fish;
    glm::vec2 hand_px{0};
    float handSize_px = 0;    // a hand is 19 cm long
    float handDistance_m = 0; // as SeenFish::distance_m
    bool holds = false;
};

class Eyes {
  public:
    // Takes what the screen shows now; call it once a frame. isPrey: by species.
    void look(const game::Snapshot& shown, const std::vector<bool>& isPrey, double time_s);

    // Returns the sight that the person has understood by now, that of kReaction_s ago.
    const Sight& now() const { return sights_.front(); }
    // Returns the fish's velocity on the screen in now(), pixels a second; zero if it has just appeared.
    glm::vec2 velocity_px(int id) const;

  private:
    std::deque<Sight> sights_; // the oldest first
    Sight before_;             // some frames before now(), to see motion
};

const SeenFish* find(const Sight&, int id);

} // namespace shoal::player
