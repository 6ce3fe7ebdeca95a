// Rows of conditions that make hands hard to find, and measurements of how well they are found, for tests and
// the bench.
#pragma once

#include "HandClip.h"
#include "input/hands/webcam/landmarks/LandmarkFinder.h"

namespace shoal::hands::test {

enum class Trouble {
    None,
    Backlight,   // a window behind hands that get little light themselves
    Sleeves,     // striped sleeves that cover half of the palm
    SkinWall,    // a wall of the hands' colour behind them
    Crossing,    // the left hand passes in front of the right
    SwayingFace, // the player's face sways, with skin-coloured clothes
};

struct Row {
    const char* name;
    Behind behind = Behind::Room;
    float distance_m = 0.5f;
    bool left = false, right = true; // which hands are there
    bool face = false;               // shows the player's face and skin-coloured clothes
    int blur_px = 0;                 // of motion
    float light = 1;                 // factor on the camera's light; noise stays the same
    float turn = 0.25f;              // amplitude of the hands' turning, radians
    float size = 1;                  // of the hands, as a multiple of the rig's
    Trouble trouble = Trouble::None;
};

// Returns all rows; only the last is without hands.
const std::vector<Row>& rows();

double medianOf(std::vector<double> values); // 1e9 of none

struct RowResult {
    int shown = 0, found = 0;    // hands; found: those with the palm within 60 mm, across, of a true one
    int otherSide = 0;           // found hands that were taken for the other hand
    int phantoms = 0;            // hands found where none is
    std::vector<double> tips_mm; // errors of fingertips relative to the wrist
    // Ratios of the wrist's distance as the finder estimates it, for a hand of the rig's size, to its true
    // distance.
    std::vector<double> wristRatio;
    std::vector<double> ms; // for each picture
    double tipMedian_mm() const { return medianOf(tips_mm); }
    // Median error of the wrist's distance, %, once the size of the hands is known.
    double wristOff_percent(double knownSize) const;
};

// pictures: at 30 a second.
RowResult measure(HandClip& clip, const HandRig& rig, const Row& row, int pictures, LandmarkFinder& finder);

// Returns the size that HandSizing measures of a hand of that size, held open where it asks for it; 0: none.
float measuredSize(HandClip& clip, const HandRig& rig, float size, LandmarkFinder& finder);

constexpr int kRowWidth = 640, kRowHeight = 480; // of pictures

} // namespace shoal::hands::test
