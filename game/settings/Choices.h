// Enumerated settings, each with the one table of its names on the command line and in the settings file.
#pragma once

#include "engine/core/EnumNames.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/light/InverseToneMap.h"
#include "engine/render/View.h"
#include "game/rules/DiveFile.h"
#include "input/hands/HandTracker.h"

#include <array>

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

template <> struct EnumNames<app::Tone> { static constexpr std::array kNames = {"auto", "aces", "linear"}; };
template <> struct EnumNames<render::Glossy> { static constexpr std::array kNames = {"ggx", "phong36"}; };
template <> struct EnumNames<light::DiffuseMethod> {
    static constexpr std::array kNames = {"default", "thesis"};
};
template <> struct EnumNames<light::FrameRadiance> {
    static constexpr std::array kNames = {"auto", "thesis", "linear"};
};
template <> struct EnumNames<app::Occlusion> {
    static constexpr std::array kNames = {"off", "ellipsoids", "ollfb", "ollfb-thesis"};
};
template <> struct EnumNames<render::Composition> {
    static constexpr std::array kNames = {"background", "plain", "resolution", "texels", "camera"};
};
template <> struct EnumNames<render::SkippedPass> {
    static constexpr std::array kNames = {"none",    "background", "objects", "particles",
                                          "shadows", "depth",      "bounce",  "overlay"};
};
template <> struct EnumNames<render::ShownQuantity> {
    static constexpr std::array kNames = {"light", "normals", "roughness", "occlusion", "diffuse", "depth"};
};
template <> struct EnumNames<render::Backend> {
    static constexpr std::array kNames = {"auto", "opengl", "software"};
};
template <> struct EnumNames<app::StereoOutput> { static constexpr std::array kNames = {"none", "sbs"}; };
template <> struct EnumNames<app::QualityControl> { static constexpr std::array kNames = {"auto", "fixed"}; };
template <> struct EnumNames<app::WaterChoice> {
    static constexpr std::array kNames = {"auto", "on", "off"};
};
template <> struct EnumNames<app::ShadowChoice> { static constexpr std::array kNames = {"on", "off"}; };
template <> struct EnumNames<app::FilmChoice> {
    static constexpr std::array kNames = {"auto", "best", "small"};
};
template <> struct EnumNames<app::Skin> { // variants of the hands' models
    static constexpr std::array kNames = {"light", "medium", "dark", "glove"};
};
template <> struct EnumNames<app::HandSourceKind> {
    static constexpr std::array kNames = {"auto", "mouse", "leap", "webcam", "openxr", "script", "replay"};
};
template <> struct EnumNames<app::Handedness> { static constexpr std::array kNames = {"right", "left"}; };
template <> struct EnumNames<app::Closing> { static constexpr std::array kNames = {"hold", "toggle"}; };
template <> struct EnumNames<app::Turning> { static constexpr std::array kNames = {"smooth", "snap"}; };
template <> struct EnumNames<app::Posture> {
    static constexpr std::array kNames = {"auto", "seated", "standing"};
};
template <> struct EnumNames<app::CaptionSize> {
    static constexpr std::array kNames = {"small", "medium", "large"};
};
template <> struct EnumNames<app::LanguageChoice> {
    static constexpr std::array kNames = {"auto", "english", "german", "french"};
};
template <> struct EnumNames<app::Start> { static constexpr std::array kNames = {"auto", "title", "dive"}; };
template <> struct EnumNames<hands::LeapMount> { static constexpr std::array kNames = {"desk", "head"}; };
template <> struct EnumNames<app::Background> { static constexpr std::array kNames = {"env", "none"}; };
template <> struct EnumNames<app::LightFormat> { // also the files' extensions
    static constexpr std::array kNames = {"pfm", "exr", "hdr"};
};

} // namespace shoal
