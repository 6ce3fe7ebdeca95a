// Everything that the future depends on, field by field: what is missing here may differ unnoticed.
#include "game/World.h"

namespace shoal::game {

namespace {

void add(Hash& hash, const glm::vec3& v) {
    hash.add(v.x);
    hash.add(v.y);
    hash.add(v.z);
}

void add(Hash& hash, const glm::quat& q) {
    hash.add(q.w);
    hash.add(q.x);
    hash.add(q.y);
    hash.add(q.z);
}

void add(Hash& hash, const Gait& gait) {
    hash.add(gait.motion);
    hash.add(gait.before);
    hash.add(gait.blend);
    hash.add(gait.phase_s);
}

void add(Hash& hash, const BodyShape& s) {
    for (float v : {s.beats, s.amplitude, s.bendLeft, s.bendUp, s.finsDown}) hash.add(v);
}

void add(Hash& hash, const Fish& f) {
    hash.add(f.species);
    hash.add(f.school);
    hash.add(f.leader);
    for (const glm::vec3& v : {f.position, f.forward, f.spin, f.push, f.parting, f.velocity, f.wander,
                               f.wanderGoal, f.flee, f.palmOffset, f.slide})
        add(hash, v);
    for (const glm::quat& q : {f.worldFromBody, f.palmFromBody, f.palmFromBodyGoal}) add(hash, q);
    for (float v : {f.bank, f.speed, f.radius, f.height, f.cruise, f.sense, f.pace, f.dart_s, f.flight_s,
                    f.flightSide, f.frightRest_s, f.struggle_s, f.nervous_s, f.uncatchable_s, f.held_s,
                    f.slid_m, f.struggle, f.loose_s})
        hash.add(v);
    hash.add(f.wanderTicks);
    hash.add(f.routeTicks);
    hash.add(f.coasting);
    hash.add(f.struggling);
    hash.add(f.unopposed);
    hash.add(f.mind);
    hash.add(f.heldBy);
    hash.add(f.counted);
    for (const auto& hand : f.touchedUntil)
        for (uint32_t until : hand) hash.add(until);
    add(hash, f.gait);
    add(hash, f.shape);
}

void add(Hash& hash, const Shark& s) {
    hash.add(s.present);
    hash.add(s.species);
    for (const glm::vec3& v : {s.position, s.forward, s.spin, s.velocity}) add(hash, v);
    add(hash, s.worldFromBody);
    for (float v :
         {s.bank, s.speed, s.sense, s.mind_s, s.visit_s, s.interest, s.bumpRest_s, s.aimed_s, s.threatRest_s})
        hash.add(v);
    hash.add(s.mind);
    hash.add(s.nextVisit);
    hash.add(s.prey);
    hash.add(s.mouth);
    hash.add(s.watched);
    add(hash, s.gait);
    add(hash, s.shape);
}

void add(Hash& hash, const hands::Joint& joint) {
    add(hash, joint.position);
    add(hash, joint.orientation);
    hash.add(joint.radius);
}

void add(Hash& hash, const Hand& hand) {
    hash.add(hand.visible);
    hash.add(hand.known);
    hash.add(hand.untrackedTicks);
    hash.add(hand.lastGood.grip);
    for (const hands::Joint& joint : hand.lastGood.joints) add(hash, joint);
    for (const hands::Joint& joint : hand.joints) add(hash, joint);
    for (const glm::vec3& v : hand.velocities) add(hash, v);
    for (const glm::vec3& v : {hand.grasp, hand.velocity, hand.calmVelocity, hand.calmAcceleration})
        add(hash, v);
    hash.add(hand.solid);
    hash.add(hand.grip);
    hash.add(hand.firmest);
    hash.add(hand.closed);
    hash.add(hand.window);
    hash.add(hand.holds);
    hash.add(hand.encloses);
}

void add(Hash& hash, const physics::Contact& c) {
    hash.add(c.body);
    hash.add(c.group);
    hash.add(c.tag);
    hash.add(c.lasting);
    add(hash, c.normal);
    hash.add(c.depth);
}

} // namespace

uint64_t World::hash() const {
    Hash all;
    all.add(seed);
    all.add(random.state());
    all.add(tick);
    all.add(totalTicks);
    all.add(phase);
    all.add(begun);
    all.add(paused);
    all.add(restartHeld);
    for (int count : {score, caught, lost}) all.add(count);
    add(all, worldFromView);
    add(all, headWorld);
    for (const Hand& hand : hands) add(all, hand);
    for (const Fish& f : fish) add(all, f);
    add(all, shark);
    for (const physics::Contact& contact : contacts) add(all, contact);
    return all.value();
}

} // namespace shoal::game
