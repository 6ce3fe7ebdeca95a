#include "input/hands/leap/LeapTracks.h"

namespace shoal::hands {

// Old services do not tell: then a hand stays what it was, shows it by its thumb, or stands on that side.
Side LeapTracks::sideOf(const PartialHand& hand, const LeapFrame& seen) const {
    if (hand.side) return *hand.side;
    if (hand.identity == identity_[0]) return Side::Left;
    if (hand.identity == identity_[1]) return Side::Right;
    if (const auto shown = completer_.sideOfTips(hand)) return *shown;
    for (const PartialHand& other : seen.hands)
        if (other.identity != hand.identity) return hand.palm.x < other.palm.x ? Side::Left : Side::Right;
    const float viewerX = (mount_.viewerFromDevice * hand.palm).x;
    return viewerX < 0 ? Side::Left : Side::Right;
}

HandFrame LeapTracks::frame(const LeapFrame& seen, int64_t time_us) {
    HandFrame frame;
    frame.time_us = time_us;
    std::array<int64_t, 2> found{-1, -1};
    for (const PartialHand& hand : seen.hands) {
        const Side side = sideOf(hand, seen);
        const size_t i = side == Side::Left ? 0 : 1;
        // Of two hands said to be the same, the one that was there before, then the surer one.
        const bool known = hand.identity == identity_[i];
        if (frame.hands[i].tracked && (found[i] == identity_[i] ||
                                       (!known && hand.confidence.value_or(1) <= frame.hands[i].confidence)))
            continue;
        frame.hands[i] = completer_.complete(hand, side);
        frame.hands[i].time_us = time_us;
        mount_.apply(frame.hands[i]);
        found[i] = hand.identity;
        frame.identity[i] = (connection_ << 40) + hand.identity;
    }
    identity_ = found;
    return frame;
}

} // namespace shoal::hands
