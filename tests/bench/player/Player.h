// A model of a person who plays: chooses a fish on the screen, points at it, closes the hand when it looks
// right, holds on, and tires of a chase.
//
// Pointing goes by submovements as people's does: each takes the time of Fitts' law (Fitts 1954, "The
// information capacity of the human motor system"; the constants are those of a mouse, Soukoreff & MacKenzie
// 2004, "Towards a standard for pointing device evaluation"), has the speed of least jerk (Flash & Hogan
// 1985) and ends beside its aim by a share of the way that it went (Meyer et al. 1988, "Optimality in human
// motor performance").
#pragma once

#include "engine/core/Random.h"
#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <deque>
#include <map>
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
    bool prey = false;   // a fish, no shark, whale or jellyfish
    bool mussel = false;
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

// A person's sight of a dive on a screen: projected positions and apparent sizes without depth, delayed by
// the reaction time.
class Eyes {
  public:
    // Takes what the screen shows now; call it once a frame.
    void look(const game::Snapshot& shown, const game::SpeciesTable& species, double time_s);

    // Returns the sight that the person has understood by now, that of kReaction_s ago.
    const Sight& now() const { return sights_.front(); }
    // Returns the fish's velocity on the screen in now(), pixels a second; zero if it has just appeared.
    glm::vec2 velocity_px(int id) const;

  private:
    std::deque<Sight> sights_; // the oldest first
    Sight before_;             // some frames before now(), to see motion
};

// A novice follows the tutorial: aim at a fish, wait for the highlight, close and hold; move slowly; wait in
// a fish's way. The practised also lead the fish, and know how large each kind is.
enum class Skill { Novice, Practised };
enum class Device { Mouse, Hands };

// The person's actions in a frame.
struct Action {
    glm::vec2 cursor_px{0}; // of the mouse
    glm::vec3 grasp{0};     // place of the hand, viewer's frame, metres
    bool close = false;
    float turn_radps = 0; // of the head, to the right
};

// A movement of the pointer or the hand, in pixels or metres.
class Movement {
  public:
    glm::vec3 at(double time_s) const;
    bool over(double time_s) const { return time_s >= end_s_; }
    void start(glm::vec3 from, glm::vec3 to, double now_s, float length_s);

  private:
    glm::vec3 from_{0}, to_{0};
    double begin_s_ = 0, end_s_ = 0;
};

enum class Doing { Looking, Waiting, Chasing, Holding, Resting };
constexpr size_t kDoings = 5;

float gauss(Random& random); // of mean 0 and deviation 1

class Player {
  public:
    // arm_m: reach of tracked hands from the eyes; a mouse's hand gets as far as the help with reach takes
    // it. cracksMussels: where few fish are about, it cracks a mussel to draw them.
    Player(Skill, Device, float arm_m, uint64_t seed, const game::SpeciesTable&, bool cracksMussels = false);

    Action frame(const game::Snapshot& shown, double time_s);

    Doing doing() const { return doing_; }

  private:
    void look(double time_s);
    void wait(double time_s);
    void close(double time_s);
    void chase(double time_s);
    void hold(double time_s);
    void point(const SeenFish&, double time_s);
    bool looksRight(const SeenFish&, double time_s);
    int choose(double time_s) const;
    void giveUp(double time_s);
    void begin(Doing, double time_s);
    void startMoving(glm::vec3 goal, float width, double time_s);
    glm::vec3 goalFor(const SeenFish&, float ahead_s) const;
    float judgedDistance_m(const SeenFish&) const;

    Skill skill_;
    Device device_;
    float arm_m_;
    Random random_;
    const game::SpeciesTable& species_;
    bool cracksMussels_;
    double nextMussel_s_ = 0;
    std::vector<float> length_m_; // believed length of each species
    Eyes eyes_;
    Movement movement_;
    Doing doing_ = Doing::Looking;
    double since_s_ = 0;     // when it began to do that
    double idleUntil_s_ = 1; // takes a look at the place first
    double turnUntil_s_ = 0;
    float turn_ = 1; // side it turns to
    int target_ = -1;
    double rightSince_s_ = -1; // time since which the fish looks right; -1: it does not
    float holdFor_s_ = 0;
    bool close_ = false;
    float misjudged_m_ = 0;         // error of the target's distance, with tracked hands
    double judged_s_ = 0;           // when that was last corrected
    std::map<int, double> tiredOf_; // fish, until when
};

} // namespace shoal::player
