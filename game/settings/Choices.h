// Enumerated settings, each with the one table of its names on the command line and in the settings file.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/render/View.h"
#include "game/rules/DiveRules.h"
#include "input/hands/HandTracker.h"

namespace shoal::app {

enum class Tone { Auto, Aces, Linear };

// Method of ambient occlusion within a body and between bodies.
enum class Occlusion {
    Off,
    Ellipsoids,
    Ollfb,       // one body at rest: rays through its layered fragment buffers (engine/occlusion/Ollfb.h)
    OllfbThesis, // the same as the thesis does it
};

enum class StereoOutput { None, SideBySide };
enum class QualityControl { Auto, Fixed };
enum class WaterChoice { Auto, On, Off };
enum class ShadowChoice { On, Off };
enum class FilmChoice { Auto, Best, Small };
enum class Skin { Light, Medium, Dark, Glove };
enum class HandSourceKind { Auto, Mouse, Leap, Webcam, OpenXr, Script, Replay };
enum class Handedness { Right, Left };
enum class Closing { Hold, Toggle }; // how a button closes the hand
enum class Turning { Smooth, Snap };
enum class Posture { Auto, Seated, Standing }; // Auto: from the height of the eyes that the headset measures
enum class CaptionSize { Small, Medium, Large };
enum class LanguageChoice { Auto, English, German, French }; // Auto: the system's
enum class Start { Auto, Title, Dive };
enum class Background { Environment, None };
enum class LightFormat { Pfm, Exr, Hdr };

} // namespace shoal::app

namespace shoal {

template <> inline constexpr std::array kEnumNames<app::Tone> = {"auto", "aces", "linear"};
template <> inline constexpr std::array kEnumNames<render::Glossy> = {"ggx", "phong36"};
template <> inline constexpr std::array kEnumNames<light::DiffuseMethod> = {"default", "thesis"};
template <> inline constexpr std::array kEnumNames<light::FrameRadiance> = {"auto", "thesis", "linear"};
template <>
inline constexpr std::array kEnumNames<app::Occlusion> = {"off", "ellipsoids", "ollfb", "ollfb-thesis"};
template <>
inline constexpr std::array kEnumNames<render::Composition> = {"background", "plain", "resolution", "texels",
                                                               "camera"};
template <>
inline constexpr std::array kEnumNames<render::SkippedPass> = {
    "none", "background", "objects", "particles", "shadows", "depth", "bounce", "overlay"};
template <>
inline constexpr std::array kEnumNames<render::ShownQuantity> = {"light",     "normals", "roughness",
                                                                 "occlusion", "diffuse", "depth"};
template <> inline constexpr std::array kEnumNames<render::Backend> = {"auto", "opengl", "software"};
template <> inline constexpr std::array kEnumNames<app::StereoOutput> = {"none", "sbs"};
template <> inline constexpr std::array kEnumNames<app::QualityControl> = {"auto", "fixed"};
template <> inline constexpr std::array kEnumNames<app::WaterChoice> = {"auto", "on", "off"};
template <> inline constexpr std::array kEnumNames<app::ShadowChoice> = {"on", "off"};
template <> inline constexpr std::array kEnumNames<app::FilmChoice> = {"auto", "best", "small"};
// Variants of the hands' models
template <> inline constexpr std::array kEnumNames<app::Skin> = {"light", "medium", "dark", "glove"};
template <>
inline constexpr std::array kEnumNames<app::HandSourceKind> = {"auto",   "mouse",  "leap",  "webcam",
                                                               "openxr", "script", "replay"};
template <> inline constexpr std::array kEnumNames<app::Handedness> = {"right", "left"};
template <> inline constexpr std::array kEnumNames<app::Closing> = {"hold", "toggle"};
template <> inline constexpr std::array kEnumNames<app::Turning> = {"smooth", "snap"};
template <> inline constexpr std::array kEnumNames<app::Posture> = {"auto", "seated", "standing"};
template <> inline constexpr std::array kEnumNames<app::CaptionSize> = {"small", "medium", "large"};
template <>
inline constexpr std::array kEnumNames<app::LanguageChoice> = {"auto", "english", "german", "french"};
template <> inline constexpr std::array kEnumNames<app::Start> = {"auto", "title", "dive"};
template <> inline constexpr std::array kEnumNames<hands::LeapMount> = {"desk", "head"};
template <> inline constexpr std::array kEnumNames<app::Background> = {"env", "none"};
// Also the files' extensions
template <> inline constexpr std::array kEnumNames<app::LightFormat> = {"pfm", "exr", "hdr"};

} // namespace shoal
