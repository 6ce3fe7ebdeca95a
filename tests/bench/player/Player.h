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
#include "tests/bench/player/Eyes.h"

#include <glm/vec3.hpp>

#include <map>

namespace shoal::player {

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
    double end_s() const { return end_s_; }
    void start(glm::vec3 from, glm::vec3 to, double now_s, float length_s);

  private:
    glm::vec3 from_{0}, to_{0};
    double begin_s_ = 0, end_s_ = 0;
};

enum class Doing { Looking, Waiting, Chasing, Holding, Resting };
constexpr size_t kDoings = 5;

class Player {
  public:
    // arm_m: reach of tracked hands from the eyes; a mouse's hand gets as far as the help with reach takes
    // it.
    Player(Skill, Device, float arm_m, uint64_t seed, const game::SpeciesTable&);

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
    void lookForAnother(double time_s);
    void startMoving(glm::vec3 goal, float width, double time_s);
    glm::vec3 goalFor(const SeenFish&, float ahead_s) const;
    float judgedDistance_m(const SeenFish&) const;
    float gauss();

    Skill skill_;
    Device device_;
    float arm_m_;
    Random random_;
    std::vector<bool> isPrey_;
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
