// Contact model of hands and the bodies that swim among them: its method, sources and constants.
//
// A hand is 24 kinematic capsules, one for each bone, which follow the joints that a device tracks; nothing
// stops them. A body (a fish) is one capsule with a velocity of its own. A tick has five steps.
//
// 1. First touch (Capsule.h), by conservative advancement: Mirtich 1996, "Impulse-based Dynamic Simulation of
//    Rigid Body Systems", 2.3. The gap between two convex shapes, along the line of their nearest points,
//    shrinks no faster than the fastest pair of end points closes along it, so time may advance by the gap
//    over that speed. Gap and line have closed forms for capsules (Ericson 2005, "Real-Time Collision
//    Detection", 5.1.9), so nothing is missed at any speed.
// 2. Lasting touch (Contact.h). A contact keeps the side on which it began while the bone sinks in, as
//    the god-object of Zilles and Salisbury 1995, "A constraint-based god-object method for haptic display":
//    the depth keeps growing past the body's axis, and the push never flips. A pair that overlaps at first is
//    pushed apart along the line of nearest points, or across both axes where these cross.
// 3. Pushing (Contact.h). A bone is infinitely heavy and does not bounce: a body leaves a contact with
//    the bone's speed. Contacts that contradict one another (a fish between two hands) are balanced by
//    regularised projected Gauss-Seidel (Catto 2005, "Iterative Dynamics with Temporal Coherence"). A
//    velocity used for one tick only (a split impulse) separates overlaps, so that they add no energy.
// 4. Wrapping (Grip.h). Fingers that close around a body are straightened, then bent knuckle by knuckle
//    until they rest on it, as the underactuated fingers of grippers close (Birglen, Laliberte and Gosselin
//    2008, "Underactuated Robotic Hands"). The farther the tracked finger has gone on, the harder it presses.
// 5. Gripping (Grip.h). Each contact can push along its normal with up to its pressing force, and across by
//    Coulomb friction. A body is held while the convex set of the forces that all contacts together can exert
//    contains the force that its struggle, the water's drag and the hand's acceleration need; without these
//    that is force closure (Nguyen 1988, "Constructing Force-Closure Grasps"). The margin is the distance of
//    that force from the set's boundary, the worst case over all directions as in Ferrari and Canny 1992,
//    "Planning Optimal Grasps". If it is negative, the body slides in the direction in which contacts cannot
//    stop it. Torques are ignored: a hand touches with a dozen bones.
#pragma once

namespace shoal::physics {

// clang-format off

// -- Touching ---------------------------------------------------------------------------------------------
constexpr float kTouchGap_m        = 1e-4f;   // surfaces this near touch
constexpr int   kAdvances          = 24;      // steps of conservative advancement; 3 are usual
constexpr float kLift_m            = 0.0015f; // a lasting contact ends when the gap exceeds this
constexpr float kTeleport_m        = 1.5f;    // a bone that goes farther in a tick was teleported
constexpr float kCrossed_m         = 1e-5f;   // axes this near cross
constexpr float kCoreShare         = 0.3f;    // share of both radii: axes this near do not renew normals
constexpr float kNormalTurn_rad    = 0.2f;    // greatest turn of a lasting contact's normal in a tick

// -- Pushing ----------------------------------------------------------------------------------------------
constexpr int   kSweeps            = 10;      // iterations of Gauss-Seidel over a body's contacts
constexpr float kSoftness          = 0.05f;   // regularisation: a lone bone gives 1 / 1.05 of its speed
constexpr float kOpenHandPush      = 0.6f;    // share of its speed with which an open hand pushes
constexpr float kPartRate_Hz       = 12;      // speed that parts an overlap, by its depth...
constexpr float kPartMax_mps      = 0.45f;   // ...and its maximum
constexpr float kPartSlop_m        = 0.001f;  // overlap that is not separated

// -- Gripping ---------------------------------------------------------------------------------------------
constexpr float kEnclosed_m        = 0.03f;   // greatest radius for closing fingers; thicker flesh yields
constexpr float kStiffness_Npm     = 250;     // stiffness of the flesh under a finger's bone...
constexpr float kForceMax_N       = 4;       // ...and its greatest force
constexpr float kPalmStiffness_Npm = 2000;    // stiffness of the palm, which holds against the fingers...
constexpr float kPalmForce_N       = 10;      // ...and its greatest force, for each bone
constexpr float kFriction          = 0.45f;   // wet skin on scales
constexpr float kFirm_N            = 0.3f;    // Hold::margin_N at which a grip begins
constexpr float kFirmer            = 0.01f;   // growth of the grip (0 to 1) that shows a closing hand
constexpr float kDrawRate_Hz       = 20;      // speed, by distance, at which closing fingers draw a body...
constexpr float kDrawMax_mps      = 1.5f;    // ...into the palm, and its maximum
constexpr float kEase              = 0.2f;    // share of the way to its goal that a finger moves in a tick
constexpr float kSettle_s          = 0.15f;   // time in which a body comes to lie across the palm

// -- Struggling and slipping ------------------------------------------------------------------------------
constexpr float kDensity_kgpm3     = 420;     // mass by capsule volume, of which a fish fills two fifths
constexpr float kStruggle_mps2     = 9;       // thrust of a fresh fish, by its mass
constexpr float kBeat_radps        = 25;      // angular frequency of its tail beat
constexpr float kTires_Hz          = 0.5f;    // thrust lost a second, as a share...
constexpr float kTiredOut          = 0.25f;   // ...and the share that remains
constexpr float kWater_kgpm3       = 1025;    // sea water
constexpr float kDragShape         = 0.25f;   // drag coefficient of a fish enclosed by a hand
constexpr float kSlideMax_mps     = 1.5f;    // greatest speed of a fish that slides out of a hand
constexpr float kSlideGrip         = 0.7f;    // share of a slide's speed that each tick of a firm grip leaves
constexpr float kSlideOut_m        = 0.05f;   // distance of sliding after which it is free
constexpr int   kUnopposed         = 8;       // ticks without force closure after which it is free
constexpr float kLoose_s           = 0.4f;    // time in which fingers do not push a body that they let go

// clang-format on

} // namespace shoal::physics
