#include "content/make/depth/PairScale.h"
#include "content/make/depth/RelativePose.h"
#include "tests/Test.h"

#include <random>

namespace shoal::depth {
namespace {

constexpr int kStep = 4;

std::vector<PairMotion> motionsOf(const std::vector<double>& baselines) {
    std::vector<PairMotion> motions(baselines.size());
    for (size_t t = 0; t < motions.size(); ++t) {
        motions[t].parallax_rad = 0.02;
        if (t < kStep) continue;
        motions[t].logRatio = std::log(baselines[t] / baselines[t - kStep]);
        motions[t].ratioWeight = 1;
    }
    return motions;
}

double spread(const std::vector<double>& found, const std::vector<double>& truth) {
    double least = 1e9, most = 0;
    for (size_t t = 0; t < found.size(); ++t)
        least = std::min(least, found[t] / truth[t]), most = std::max(most, found[t] / truth[t]);
    return most / least;
}

glm::dvec3 atFrame(int t) { return {0.1 * t, 0.02 * t * t, 0}; }
glm::dmat3 turnedAt(int t) { return glm::mat3_cast(glm::angleAxis(0.05 * t, glm::dvec3(0, 1, 0))); }

// The camera gets slower, to half its pace, over the whole film: each pair knows its ratio to the one before.
// A slope s where s0 is true costs 4 s^2 for the equality of neighbours and (4 s - 4 s0)^2 for the ratios: it
// is least at s = 0.8 s0. A fifth of the change over the film, 0.69, is not found.
TEST(PairScale, ASlowChangeIsFollowedOverHundredsOfFrames) {
    std::vector<double> truth;
    for (int t = 0; t < 600; ++t) truth.push_back(std::exp(-0.69 * t / 600));
    EXPECT_LT(spread(linkBaselines(motionsOf(truth), kStep), truth), std::exp(0.2 * 0.69 + 0.01));
}

// A wrong ratio would shift all that follows it by its logarithm, 0.69; weighted by Cauchy less than a tenth.
TEST(PairScale, OneWrongRatioCountsLittle) {
    const std::vector<double> truth(100, 1.0);
    auto motions = motionsOf(truth);
    motions[50].logRatio = std::log(2.0);
    EXPECT_LT(spread(linkBaselines(motions, kStep), truth), 1.07);
}

TEST(PairScale, APoseFarFromItsNeighboursIsReplacedAndAGapFilled) {
    auto motions = motionsOf(std::vector<double>(20, 1.0));
    for (PairMotion& each : motions) each.towards = {1, 0, 0};
    motions[7].towards = {0, 0, 1};
    motions[12].parallax_rad = 0;
    repairMotion(motions);
    for (const PairMotion& each : motions) {
        EXPECT_GT(each.parallax_rad, 0);
        EXPECT_EQ(each.towards, glm::dvec3(1, 0, 0));
    }
}

TEST(PairScale, TheChainOfPosesGoesBothWaysAndEndsAtAGap) {
    std::vector<PairMotion> motions(20);
    std::vector<double> baselines;
    for (int t = 0; t < 20; ++t) {
        const glm::dvec3 by = atFrame(t + kStep) - atFrame(t);
        baselines.push_back(glm::length(by));
        motions[static_cast<size_t>(t)].parallax_rad = 0.02;
        motions[static_cast<size_t>(t)].towards = glm::normalize(turnedAt(t) * by);
        motions[static_cast<size_t>(t)].secondFromFirst = turnedAt(t + kStep) * glm::transpose(turnedAt(t));
    }
    for (const int pairs : {-2, -1, 1, 2}) {
        const int t = 9, there = t + pairs * kStep;
        const auto pose = tests::valueOf(poseAlongChain(motions, baselines, t, pairs, kStep));
        EXPECT_LT(glm::length(pose.at - turnedAt(t) * (atFrame(there) - atFrame(t))), 1e-12);
        const glm::dvec3 dir = glm::normalize(glm::dvec3(1, 2, 3));
        EXPECT_LT(glm::length(pose.fromReference * dir - turnedAt(there) * glm::transpose(turnedAt(t)) * dir),
                  1e-12);
    }
    EXPECT_FALSE(poseAlongChain(motions, baselines, 9, 3, kStep)) << "the film ends";
    EXPECT_FALSE(poseAlongChain(motions, baselines, 9, -3, kStep)) << "the film begins later";
    motions[13].parallax_rad = 0;
    EXPECT_TRUE(poseAlongChain(motions, baselines, 9, 1, kStep));
    EXPECT_FALSE(poseAlongChain(motions, baselines, 9, 2, kStep));
}

const glm::dmat3 kTurned = glm::mat3_cast(glm::angleAxis(0.12, glm::normalize(glm::dvec3(0.2, 1, -0.3))));

glm::dvec3 anyDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// Points all around, 1 to 10 m away, seen before and after the camera has moved by `moved` metres and turned;
// a share of them goes its own way, as animals do.
std::vector<Correspondence> seen(const glm::dvec3& moved, double noise_rad, double animals) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    std::vector<Correspondence> points;
    for (int i = 0; i < 800; ++i) {
        const glm::dvec3 first = anyDirection(random);
        glm::dvec3 at = first * (1 + 9 * uniform(random)) - moved;
        if (uniform(random) < animals) at += 0.3 * anyDirection(random);
        points.push_back(
            {first, glm::normalize(kTurned * glm::normalize(at) + noise_rad * anyDirection(random))});
    }
    return points;
}

double angleBetween(const glm::dmat3& a, const glm::dmat3& b) {
    const glm::dmat3 off = a * glm::transpose(b);
    return std::acos(std::clamp((off[0][0] + off[1][1] + off[2][2] - 1) / 2, -1.0, 1.0));
}

TEST(RelativePose, ExactDirectionsGiveTheMovementAndTheDistances) {
    for (const glm::dvec3 axis : {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                  glm::normalize(glm::dvec3(-0.3, 0.2, 0.8))}) {
        const auto points = seen(0.2 * axis, 0, 0);
        const RelativePose pose = relativePose(points);
        ASSERT_TRUE(isTranslation(pose));
        EXPECT_LT(glm::length(pose.towards - axis), 1e-4);
        EXPECT_LT(angleBetween(pose.secondFromFirst, kTurned), 1e-5);
        for (const Correspondence& p : points) {
            const Triangulated t = triangulate(pose, p);
            if (t.sinToMovement < 0.2) continue;
            // The law of sines, from the directions and the true movement.
            const glm::dvec3 back = glm::transpose(kTurned) * p.second;
            const double inverse =
                glm::length(glm::cross(p.first, back)) / glm::length(glm::cross(back, axis));
            EXPECT_NEAR(t.inverse, inverse, 1e-3 * inverse + 1e-5);
        }
    }
}

// A third of the points moves otherwise; with a noise of half a milliradian, 530 points determine the
// direction of a movement that turns points by 40 milliradians to about 0.5 / 40 / sqrt(530 / 5), a
// milliradian: ten times.
TEST(RelativePose, AnimalsCountLittle) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.6, 0.1, -0.7));
    EXPECT_LT(glm::length(relativePose(seen(0.2 * axis, 5e-4, 0.33)).towards - axis), 0.012);
}

TEST(RelativePose, ACameraThatOnlyTurnsHasNotMoved) {
    EXPECT_FALSE(isTranslation(relativePose(seen({0, 0, 0}, 5e-4, 0))));
    EXPECT_FALSE(isTranslation(relativePose(seen({0, 0, 0}, 5e-4, 0.33))));
}

TEST(RelativePose, InvertedIsThePoseOfExchangedFrames) {
    const auto points = seen({0.1, 0, -0.2}, 0, 0);
    const RelativePose pose = relativePose(points), back = inverted(pose);
    for (const Correspondence& p : points) {
        const double there = triangulate(pose, p).parallax_rad;
        EXPECT_NEAR(triangulate(back, {p.second, p.first}).parallax_rad, there, 1e-9);
    }
}

} // namespace
} // namespace shoal::depth
