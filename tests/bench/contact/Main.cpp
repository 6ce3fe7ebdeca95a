// Processor time of a tick of forty fish, user's share alone: without hands, with two hands that swing and
// close among them, and with all forty piled into two fists again every half second.
#include "game/rules/Dive.h"
#include "input/hands/MouseHands.h"
#include "tests/playthrough/Play.h"

#include <sys/resource.h>

#include <cmath>
#include <cstdio>

using namespace shoal;
using namespace shoal::game;

namespace {

enum class Case { NoHands, Swinging, Piled };

double user_s() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

void measure(const char* name, Case what, const DiveFiles& files, const hands::HandRig& rig) {
    constexpr int kTicks = 24'000, kCycle = 240;
    DiveFile dive = files.dive;
    dive.shark.species = -1;
    dive.schools = {dive.schools.at(0)};
    dive.schools[0].count = 40;
    dive.duration_s = 1e6f;
    Dive world(files.species, dive, 3);
    std::vector<TickInput> inputs(kCycle);
    for (int i = 0; i < kCycle; ++i)
        for (int h = 0; h < 2; ++h) {
            const float aside = 0.1f + 0.6f * std::fabs(static_cast<float>(i - kCycle / 2)) / (0.5f * kCycle);
            const glm::vec3 at = what == Case::Piled ? glm::vec3(0, -0.1f, -0.6f)
                                                     : glm::vec3(h == 1 ? aside : -aside, -0.1f, -0.75f);
            const float closed = what == Case::Piled || i % 60 >= 30 ? 1.0f : 0.0f;
            inputs[i].hands[h] =
                hands::reachingHand(rig, h == 0 ? hands::Side::Left : hands::Side::Right, at, closed);
            inputs[i].hands[h].tracked = what != Case::NoHands;
        }
    Random random(3, 1);
    std::vector<Event> events;
    size_t contacts = 0;
    const double begun = user_s();
    for (int tick = 0; tick < kTicks; ++tick) {
        if (what == Case::Piled && tick % 60 == 0)
            for (Fish& f : world.state().fish) {
                f.position = {random.between(-0.04f, 0.04f), -0.1f + random.between(-0.04f, 0.04f),
                              -0.6f + random.between(-0.04f, 0.04f)};
                f.push = f.velocity = glm::vec3(0);
                f.speed = 0;
            }
        events.clear();
        world.step(inputs[tick % kCycle], events);
        contacts += world.state().contacts.size();
    }
    std::printf("%-10s %7.2f us a tick, %6.1f contacts\n", name, (user_s() - begun) / kTicks * 1e6,
                static_cast<double>(contacts) / kTicks);
}

} // namespace

int main() {
    const auto files = loadDiveFiles("reef");
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    if (!files || !rig) {
        std::fprintf(stderr, "%s\n", (files ? rig.error() : files.error()).message().c_str());
        return 1;
    }
    measure("no hands", Case::NoHands, *files, *rig);
    measure("swinging", Case::Swinging, *files, *rig);
    measure("piled", Case::Piled, *files, *rig);
}
