// The sounds of the game: which file each one is, and how loud. Their order is that of the audio's clips.
#pragma once

#include <array>
#include <cstddef>

namespace shoal::game {

enum class Sound {
    BedOpen, // the sea's background in open water, and in a tunnel
    BedTunnel,
    FishPassSmall,
    FishPassLarge,
    Touch,
    Catch,
    Struggle,
    Release,
    Escape,
    Startle,
    Miss,
    SharkNear,
    SharkBite,
    SharkBump,
    Bubbles,
    Countdown,
    DiveStart,
    DiveOver,
};

// Whether a table has one row for each value of an enumeration, in its order.
template <class Rows, class Row, class E> constexpr bool oneRowEach(const Rows& rows, E Row::*key, E last) {
    for (size_t i = 0; i < rows.size(); ++i)
        if (rows[i].*key != static_cast<E>(i)) return false;
    return rows.size() == static_cast<size_t>(last) + 1;
}

struct SoundRow {
    Sound sound;
    const char* file; // in content/sounds, without .flac
    float gain;       // 0 to 1, at the loudness it was mastered to
};
constexpr std::array kSounds = std::to_array<SoundRow>({
    {Sound::BedOpen, "bed_open", 0.45f},
    {Sound::BedTunnel, "bed_tunnel", 0.5f},
    {Sound::FishPassSmall, "fish_pass_small", 0.8f},
    {Sound::FishPassLarge, "fish_pass_large", 1},
    {Sound::Touch, "touch", 1},
    {Sound::Catch, "catch", 1},
    {Sound::Struggle, "struggle", 0.8f},
    {Sound::Release, "release", 0.9f},
    {Sound::Escape, "escape", 1},
    {Sound::Startle, "startle", 0.8f},
    {Sound::Miss, "miss", 0.9f},
    {Sound::SharkNear, "shark_near", 1},
    {Sound::SharkBite, "shark_bite", 1},
    {Sound::SharkBump, "shark_bump", 1},
    {Sound::Bubbles, "bubbles", 0.3f},
    {Sound::Countdown, "countdown", 0.8f},
    {Sound::DiveStart, "dive_start", 0.8f},
    {Sound::DiveOver, "dive_over", 1},
});
static_assert(oneRowEach(kSounds, &SoundRow::sound, Sound::DiveOver));

constexpr const SoundRow& rowOf(Sound sound) { return kSounds[static_cast<size_t>(sound)]; }

} // namespace shoal::game
