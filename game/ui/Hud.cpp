#include "game/ui/Hud.h"

#include "engine/math/Quantile.h"

#include <fmt/core.h>
#include <imgui/imgui.h>
// This header needs imgui.h before it.
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>

namespace shoal::app {

using namespace colour;

// Returns false while a menu covers the dive: then nothing may be drawn under the menu.
static bool isPlayed(const game::Snapshot& shown) {
    return !shown.paused && shown.phase == game::Phase::Diving;
}

struct ReadoutLine {
    std::string text;
    TextSize size;
    uint32_t tint;
};

// Draws lines of text on a panel at the upper edge; returns it. anchor: 0: x is its left side, 1: its right.
static Rectangle drawReadout(const Pen& pen, float x, float anchor, std::span<const ReadoutLine> lines) {
    const float margin = 0.6f * pen.line, gap = 0.2f * pen.line;
    glm::vec2 extent(0, -gap);
    for (const ReadoutLine& line : lines) {
        const glm::vec2 size = pen.extent(line.text, line.size);
        extent = {std::max(extent.x, size.x), extent.y + size.y + gap};
    }
    const glm::vec2 low(x - (extent.x + 2 * margin) * anchor, margin);
    const Rectangle area{low, low + extent + 2 * margin};
    pen.panel(area, anchor > 0 ? Edge::Right : Edge::Left);
    glm::vec2 at = low + margin + glm::vec2(extent.x * anchor, 0);
    for (const ReadoutLine& line : lines) {
        pen.text(at.x, at.y, anchor, line.size, line.tint, line.text);
        at.y += pen.fonts->pixels(line.size) + gap;
    }
    return area;
}

static void drawScore(const Pen& pen, const HudInfo& info) {
    const game::Snapshot& s = *info.snapshot;
    if (s.freeSwim) return; // no score in free swim
    const auto number = [&](float right, game::Text name, const std::string& value, uint32_t tint) {
        const ReadoutLine lines[] = {{pen.in(name), TextSize::Small, kGrey},
                                     {value, TextSize::Heading, tint}};
        return drawReadout(pen, right, 1, lines);
    };
    const int left = static_cast<int>(std::ceil(std::max(0.0f, s.timeLeft_s)));
    const float margin = 0.6f * pen.line;
    const Rectangle time = number(pen.size.x - margin, "Time", fmt::format("{}:{:02}", left / 60, left % 60),
                                  left <= 10 ? kGold : kWhite);
    number(time.low.x - 0.5f * margin, "Points", std::to_string(s.score), kWhite);
    std::vector<ReadoutLine> lines;
    for (const std::string& goal : info.goals)
        lines.push_back({goal, TextSize::Small, goal.starts_with("\u2605") ? kAccent : kWhite});
    std::string counts = pen.in("{} caught", s.caught);
    if (s.lost > 0) counts += "   " + pen.in("{} taken by the shark", s.lost);
    if (s.caught > 0 || s.lost > 0) lines.push_back({counts, TextSize::Small, kGrey});
    if (!lines.empty() && isPlayed(s)) drawReadout(pen, margin, 0, lines);
}

// Projects a place in the world to pixels; false behind the viewer.
static bool project(const Pen& pen, const render::View& view, const glm::vec3& world, ImVec2& out) {
    const glm::vec4 clip = view.clipFromWorld() * glm::vec4(world, 1);
    if (clip.w <= 0.01f) return false;
    out = ImVec2((clip.x / clip.w * 0.5f + 0.5f) * pen.size.x, (0.5f - clip.y / clip.w * 0.5f) * pen.size.y);
    return true;
}

// Strokes the path in a colour on a dark casing, so that it stands out before any picture: at least 3 to 1
// against the casing's 6 pixels at 720 lines.
static void strokeCased(const Pen& pen, uint32_t tint, float strength, float width_px, bool closed) {
    const auto faded = [&](uint32_t colour) {
        return (colour & 0xFFFFFF) |
               (static_cast<uint32_t>(static_cast<float>(colour >> 24) * strength) << 24);
    };
    const ImVector<ImVec2>& path = pen.list->_Path;
    const ImDrawFlags flags = closed ? ImDrawFlags_Closed : ImDrawFlags_None;
    pen.list->AddPolyline(path.Data, path.Size, faded(colour::kCasing), flags,
                          width_px + (closed ? 0.5f : 0.2f) * pen.line);
    pen.list->AddPolyline(path.Data, path.Size, faded(tint), flags, width_px);
    pen.list->PathClear();
}

// Draws a rim around an animal: closed around what a hand can take, in dashes around what is too far away.
static void drawRim(const Pen& pen, const render::View& view, const game::CreatureView& animal,
                    float strength, bool dashed) {
    const glm::vec3 half = animal.worldFromBody * glm::vec3(0, 0, 0.3f * animal.length);
    ImVec2 nose, tail, middle, above;
    const glm::vec3 up = view.worldFromEye * glm::vec3(0, 0.28f * animal.length, 0);
    if (!project(pen, view, animal.position + half, nose) ||
        !project(pen, view, animal.position - half, tail) || !project(pen, view, animal.position, middle) ||
        !project(pen, view, animal.position + up, above))
        return;
    const float radius = std::hypot(above.x - middle.x, above.y - middle.y) + 0.3f * pen.line;
    const float along = std::atan2(nose.y - tail.y, nose.x - tail.x);
    constexpr float kHalfTurn = 3.14159265f;
    const int segments = std::clamp(static_cast<int>(radius), 6, 24);
    if (!dashed) {
        pen.list->PathArcTo(nose, radius, along - kHalfTurn / 2, along + kHalfTurn / 2, segments);
        pen.list->PathArcTo(tail, radius, along + kHalfTurn / 2, along + 3 * kHalfTurn / 2, segments);
        return strokeCased(pen, colour::kGold, strength, 0.13f * pen.line, true);
    }
    for (int dash = 0; dash < 4; ++dash) {
        const float from = along + kHalfTurn * (0.5f * static_cast<float>(dash) + 0.12f);
        pen.list->PathArcTo(dash == 0 || dash == 3 ? nose : tail, radius, from, from + 0.26f * kHalfTurn, 6);
        strokeCased(pen, kWhite, strength, 0.09f * pen.line, false);
    }
}

// Marks what a hand can take, what is out of its reach, how long it has held its catch, and that it is about
// to frighten animals.
static void drawMarks(const Pen& pen, const HudInfo& info) {
    const game::Snapshot& s = *info.snapshot;
    for (const game::CreatureView& animal : s.creatures)
        if (animal.catchable > 0.05f) drawRim(pen, *info.view, animal, animal.catchable, false);
    constexpr float kTop = -1.5707963f, kTurn = 6.2831853f;
    for (const game::HandView& hand : s.hands) {
        if (hand.outOfReach >= 0 && hand.visible)
            drawRim(pen, *info.view, s.creatures[hand.outOfReach], 0.8f, true);
        ImVec2 at;
        if (!hand.visible || !project(pen, *info.view, hand.joints[0].position, at)) continue;
        const float radius = pen.line * 1.6f;
        if (hand.holds >= 0 && hand.holdProgress > 0) {
            pen.list->PathArcTo(at, radius, 0, kTurn, 48);
            pen.list->PathStroke(IM_COL32(0, 10, 20, 120), 0, pen.line * 0.32f);
            pen.list->PathArcTo(at, radius, kTop, kTop + kTurn * std::min(hand.holdProgress, 1.0f), 48);
            pen.list->PathStroke(kGold, 0, pen.line * 0.22f);
        }
        for (int wake = 0; wake < 3 && hand.haste > 0; ++wake) { // three arcs, as a wave before the hand
            const float from = kTurn * static_cast<float>(wake) / 3;
            pen.list->PathArcTo(at, radius * (1 + 0.25f * hand.haste), from, from + kTurn / 5, 12);
            strokeCased(pen, kOrange, hand.haste, 0.12f * pen.line, false);
        }
    }
}

// Darkens the edges in proportion to the view's turning speed, up to a limit.
static void drawVignette(const Pen& pen, float turning_radps) {
    constexpr float kFull_radps = 1.2f, kWidth = 0.3f; // share of the picture's size
    const float strength = std::min(turning_radps / kFull_radps, 1.0f);
    if (strength < 0.02f) return;
    const uint32_t dark = IM_COL32(0, 6, 10, static_cast<int>(235 * strength)), none = IM_COL32(0, 6, 10, 0);
    const ImVec2 low(0, 0), high(pen.size.x, pen.size.y);
    const float x = pen.size.x * kWidth, y = pen.size.y * kWidth;
    pen.list->AddRectFilledMultiColor(low, ImVec2(x, high.y), dark, none, none, dark);
    pen.list->AddRectFilledMultiColor(ImVec2(high.x - x, 0), high, none, dark, dark, none);
    pen.list->AddRectFilledMultiColor(low, ImVec2(high.x, y), dark, dark, none, none);
    pen.list->AddRectFilledMultiColor(ImVec2(0, high.y - y), high, none, none, dark, dark);
}

static void drawPopups(const Pen& pen, const HudInfo& info) {
    for (const Popup& popup : info.popups) {
        ImVec2 at;
        if (!project(pen, *info.view, popup.position, at)) continue;
        std::string text = fmt::format("+{} {}", popup.points, animalName(*popup.species, 1, pen.language));
        if (popup.combo > 1) text += fmt::format("  \u00d7{}", popup.combo);
        if (popup.length_m > 0)
            text += fmt::format("  {}, {}", lengthText(popup.length_m),
                                popup.mass_kg < 1 ? fmt::format("{:.0f} g", 1000 * popup.mass_kg)
                                                  : fmt::format("{:.1f} kg", popup.mass_kg));
        if (popup.isRecord) text += std::string("  ") + pen.in("Your largest");
        const float rise = 3 * pen.line * popup.age_s / Popup::kStay_s;
        const float lowest = pen.size.y - (2 + 1.6f * static_cast<float>(info.captions.size())) * pen.line;
        pen.label(at.x, std::clamp(at.y - 4.5f * pen.line - rise, pen.line, std::max(lowest, pen.line)),
                  TextSize::Body, kGold, text);
    }
}

// Draws captions of sounds; an arrow points to a sound that is out of view.
static void drawCaptions(const Pen& pen, const HudInfo& info) {
    constexpr std::array kSizes = {TextSize::Small, TextSize::Body, TextSize::Heading}; // by CaptionSize
    const TextSize size = kSizes[static_cast<size_t>(info.text.captionSize)];
    const float step = pen.fonts->pixels(size) * 1.55f;
    float y = pen.size.y - step - pen.line * 0.5f;
    for (const game::Caption& caption : info.captions) {
        if (caption.age_s < 0) continue;
        const glm::vec3 inView = glm::conjugate(info.view->worldFromEye) * caption.position;
        const bool placed = glm::dot(caption.position, caption.position) > 1e-4f;
        const float bearing = placed ? std::atan2(inView.x, -inView.z) : 0.0f;
        const float seen = std::atan(info.view->halfExtent().x);
        const std::string line = fmt::format("{}{}{}", bearing < -seen ? "\u2190 " : "", pen.in(caption.text),
                                             bearing > seen ? " \u2192" : "");
        pen.label(pen.size.x / 2, y, size, kWhite, line);
        y -= step;
    }
}

constexpr ImGuiWindowFlags kPanelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs;

// Draws a hand tracker's camera image at the lower left.
static void drawCamera(const Pen& pen, const Pictures::Picture& camera) {
    const float scale = std::min(1.0f, pen.size.y / 3 / camera.size.y);
    ImGui::SetNextWindowPos(ImVec2(12, pen.size.y - 12), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::Begin("Camera", nullptr, kPanelFlags);
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(camera.texture.name())),
                 ImVec2(scale * camera.size.x, scale * camera.size.y));
    ImGui::TextUnformatted(pen.in("What the webcam sees; it stays on this machine"));
    ImGui::End();
}

static void drawTimes(const Pen& pen, const HudInfo& info) {
    const Statistics& statistics = *info.statistics;
    const Environment& environment = *info.environment;
    // At the right, beside the menus.
    const ImVec2 corner(ImGui::GetIO().DisplaySize.x - 12, 110);
    ImGui::SetNextWindowPos(corner, ImGuiCond_Always, ImVec2(1, 0));
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::Begin("Frame", nullptr, kPanelFlags);
    const Series& all = statistics.frame_ms;
    const std::vector<float> recent(all.end() - std::min<ptrdiff_t>(120, std::ssize(all)), all.end());
    std::vector<float> times = recent;
    ImGui::TextUnformatted(statistics.renderer.c_str());
    const auto write = [&](game::Text text, const auto&... values) {
        ImGui::TextUnformatted(pen.in(text, values...).c_str());
    };
    const auto ms = [](double time_ms, int places = 1) { return fmt::format("{:.{}f}", time_ms, places); };
    if (!times.empty())
        write("frame {} ms median, {} worst of 120", ms(math::median(times)), ms(math::quantile(times, 1)));
    ImGui::PlotLines("##frames", recent.data(), static_cast<int>(recent.size()), 0, nullptr, 0, 50,
                     ImVec2(260, 50));
    write("light {} ms, decode {} ms (own thread)", ms(environment.player().light_ms()),
          ms(environment.player().decode_ms()));
    write("upload {} ms, simulation {} ms", ms(environment.upload_ms(), 2), ms(statistics.sim_ms, 2));
    for (const gl::PassTimers::Time& time : info.passes)
        write("{} {} ms on the graphics side", game::translated(time.pass, pen.language), ms(time.gpu_ms, 2));
    write("draws {}, triangles {}", statistics.draws, statistics.triangles);
    write("drawn at {} % of the size, light every {} of the video’s frames",
          std::lround(100 * info.quality.scale), info.quality.lightEvery);
    write("light: {}", pen.in(environment.lightName()));
    ImGui::End();
}

static void drawText(const Pen& pen, const HudInfo& info) {
    if (info.inDive) {
        drawScore(pen, info);
        if (isPlayed(*info.snapshot)) drawCaptions(pen, info);
    }
    if (info.overlay) info.overlay(pen);
    const float x = pen.size.x / 2;
    if (info.volume)
        pen.label(x, pen.line * 2.6f, TextSize::Body, kWhite,
                  pen.in("Sound {} %", std::lround(*info.volume * 100)));
    if (info.notice) pen.label(x, pen.line * 0.7f, TextSize::Small, kGold, info.notice->in(pen.language));
    if (info.finger)
        pen.list->AddCircleFilled(ImVec2(info.finger->x, info.finger->y), 0.4f * pen.line, kGold);
    if (info.statistics) drawTimes(pen, info);
    if (info.statistics && info.camera) drawCamera(pen, *info.camera);
}

void Hud::destroy(ImGuiContext* context) {
    ImGui::SetCurrentContext(context);
    if (ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context);
}

Result<Hud> Hud::make() {
    Hud hud;
    hud.context_.reset(ImGui::CreateContext());
    ImGui::SetCurrentContext(hud.context_.get());
    ImGui::GetIO().IniFilename = nullptr;
    if (!ImGui_ImplOpenGL3_Init("#version 330 core") || !ImGui_ImplOpenGL3_CreateDeviceObjects())
        return Error{"", "the on-screen display could not be set up"};
    return hud;
}

Pen Hud::beginFrame(Audience audience, bool hasText, const TextSettings& text, glm::ivec2 size) {
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
    io.DeltaTime = 1.0f / 60; // ImGui animates nothing here
    // Number of text lines that fill the picture's height; fewer in a headset, which shows fewer pixels.
    const float lines = audience == Audience::HeadsetPlayer ? 22 : 30;
    const float height = static_cast<float>(std::min(size.y, size.x * 9 / 16)) / lines * text.scale;
    float line = std::round(std::clamp(height, 11.0f, 90.0f));
    // The onlookers' window uses the panel's fonts; other sizes would be rasterised again in every frame.
    if (audience == Audience::Onlooker && fonts_.ready())
        line = fonts_.pixels(TextSize::Body);
    else if (hasText || !fonts_.ready())
        fonts_.fit(line);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    return {ImGui::GetBackgroundDrawList(), &fonts_,           size,      line, audience,
            text.shownLanguage(),           text.highContrast, &pictures_};
}

void Hud::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Hud::draw(const HudInfo& info, glm::ivec2 size) {
    Pen pen = beginFrame(info.audience, info.part != HudPart::Marks, info.text, size);
    pen.camera = info.camera;
    if (info.part != HudPart::Panel) {
        if (info.vignette > 0) drawVignette(pen, info.vignette);
        if (info.inDive) drawMarks(pen, info);
        drawPopups(pen, info);
    }
    if (info.part != HudPart::Marks) drawText(pen, info);
    endFrame();
}

void Hud::drawNotice(const game::Notice& notice, const TextSettings& text, glm::ivec2 size) {
    const Pen pen = beginFrame(Audience::WindowPlayer, true, text, size);
    pen.label(pen.size.x / 2, pen.size.y - 2 * pen.line, TextSize::Small, kWhite, notice.in(pen.language));
    endFrame();
}

void Hud::drawLoading(float progress, const TextSettings& text, glm::ivec2 size) {
    const Pen pen = beginFrame(Audience::WindowPlayer, true, text, size);
    const float y = pen.size.y * 0.72f;
    const Rectangle said = pen.label(pen.size.x / 2, y, TextSize::Body, kWhite, pen.in("Loading"));
    const float half = 7 * pen.line, top = said.high.y + 0.5f * pen.line, bottom = top + 0.25f * pen.line;
    const Rectangle track{{pen.size.x / 2 - half, top}, {pen.size.x / 2 + half, bottom}};
    pen.fill(track, kPanel);
    if (progress >= 0)
        pen.fill({track.low, {track.low.x + 2 * half * std::clamp(progress, 0.02f, 1.0f), bottom}}, kAccent);
    const Rectangle name = pen.label(pen.size.x / 2, pen.size.y * 0.36f, TextSize::Display, kWhite, "Shoal");
    pen.rule({name.low.x, name.high.y + 0.6f * pen.line}, name.high.x - name.low.x, true);
    endFrame();
}

} // namespace shoal::app
