#include "game/ui/Hud.h"

#include <epoxy/gl.h>
#include <fmt/core.h>
#include <imgui/imgui.h>
// After imgui.h, which they need.
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

namespace shoal::app {

namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"; // fonts-dejavu-core
constexpr float kFontPixels = 40; // of the atlas; text is scaled down from it

using namespace colour;

void drawScore(const Pen& pen, const HudInfo& info) {
    const game::Snapshot& s = *info.snapshot;
    const float margin = pen.line * 0.8f;
    pen.text(margin, margin * 0.7f, 0, 1.7f, kWhite, std::to_string(s.score));
    pen.text(margin, margin * 0.7f + pen.line * 1.8f, 0, 0.8f, kDim,
             s.lost ? fmt::format("{} caught   {} taken", s.caught, s.lost)
                    : fmt::format("{} caught", s.caught));
    const int left = static_cast<int>(std::ceil(std::max(0.0f, s.timeLeft_s)));
    const bool last = left <= 10;
    pen.text(pen.size.x - margin, margin * 0.7f, 1, last ? 2.0f : 1.5f, last ? kGold : kWhite,
             fmt::format("{}:{:02}", left / 60, left % 60));
}

// The place on the screen, pixels; false behind the viewer.
bool project(const Pen& pen, const render::View& view, const glm::vec3& world, ImVec2& out) {
    const glm::vec4 clip = view.clipFromWorld() * glm::vec4(world, 1);
    if (clip.w <= 0.01f) return false;
    out = ImVec2((clip.x / clip.w * 0.5f + 0.5f) * pen.size.x, (0.5f - clip.y / clip.w * 0.5f) * pen.size.y);
    return true;
}

void drawHold(const Pen& pen, const HudInfo& info) {
    for (const game::HandView& hand : info.snapshot->hands) {
        ImVec2 at;
        if (!hand.visible || hand.holds < 0 || hand.holdProgress <= 0 ||
            !project(pen, *info.view, hand.joints[0].position, at))
            continue;
        const float radius = pen.line * 1.6f;
        constexpr float kTop = -1.5707963f;
        pen.list->PathArcTo(at, radius, 0, 6.2831853f, 48);
        pen.list->PathStroke(IM_COL32(0, 10, 20, 120), 0, pen.line * 0.32f);
        pen.list->PathArcTo(at, radius, kTop, kTop + 6.2831853f * std::min(hand.holdProgress, 1.0f), 48);
        pen.list->PathStroke(kGold, 0, pen.line * 0.22f);
    }
}

// What sounds, and from where: an arrow leads to what the eye does not see.
void drawCaptions(const Pen& pen, const HudInfo& info) {
    float y = pen.size.y - pen.line * 1.9f;
    for (const game::Caption& caption : info.captions) {
        const float fade = std::clamp((game::kCaptionStay_s - caption.age_s) / 0.6f, 0.0f, 1.0f);
        const glm::vec3 inView = glm::conjugate(info.view->worldFromEye) * caption.position;
        const bool placed = glm::dot(caption.position, caption.position) > 1e-4f;
        const float bearing = placed ? std::atan2(inView.x, -inView.z) : 0.0f;
        const float seen = std::atan(info.view->halfExtent().x);
        const std::string line =
            fmt::format("{}{}{}", bearing < -seen ? "◀ " : "", caption.text, bearing > seen ? " ▶" : "");
        const glm::vec2 extent = pen.extent(line, 0.8f);
        const auto shade = static_cast<int>(120 * fade);
        pen.list->AddRectFilled(ImVec2(pen.size.x / 2 - extent.x / 2 - 10, y - 3),
                                ImVec2(pen.size.x / 2 + extent.x / 2 + 10, y + extent.y + 3),
                                IM_COL32(4, 18, 28, shade), 6);
        pen.text(pen.size.x / 2, y, 0.5f, 0.8f, IM_COL32(255, 255, 255, static_cast<int>(240 * fade)), line);
        y -= pen.line * 1.3f;
    }
}

void drawTimes(const HudInfo& info) {
    const Statistics& statistics = *info.statistics;
    const Environment& environment = *info.environment;
    ImGui::SetNextWindowPos(ImVec2(12, 110), ImGuiCond_Always);
    ImGui::SetNextWindowBgAlpha(0.7f);
    ImGui::Begin("Frame", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs);
    ImGui::SetWindowFontScale(0.4f);
    const std::span<const float> recent = statistics.frame_ms.last(120);
    std::vector<float> sorted(recent.begin(), recent.end());
    std::sort(sorted.begin(), sorted.end());
    ImGui::TextUnformatted(statistics.renderer.c_str());
    const auto write = [](fmt::string_view text, const auto&... values) {
        ImGui::TextUnformatted(fmt::vformat(text, fmt::make_format_args(values...)).c_str());
    };
    if (!sorted.empty())
        write("frame {:.1f} ms median, {:.1f} worst of 120", sorted[sorted.size() / 2], sorted.back());
    ImGui::PlotLines("##frames", recent.data(), static_cast<int>(recent.size()), 0, nullptr, 0, 50,
                     ImVec2(260, 50));
    write("light {:.1f} ms, decode {:.1f} ms (own thread)", environment.light_ms(), environment.decode_ms());
    write("upload {:.2f} ms, simulation {:.2f} ms", environment.upload_ms(), statistics.sim_ms);
    for (const gl::PassTimers::Time& time : info.passes)
        write("{} {:.2f} ms on the graphics side", time.pass, time.gpu_ms);
    write("draws {}, triangles {}", statistics.draws, statistics.triangles);
    write("drawn at {:.0f} % of the size, light every {} of the video's frames", 100 * info.quality.scale,
          info.quality.lightEvery);
    write("light: {}", environment.lightName());
    ImGui::End();
}

void drawText(const Pen& pen, const HudInfo& info) {
    drawScore(pen, info);
    if (!info.snapshot->paused) drawCaptions(pen, info);
    if (info.overlay) info.overlay(pen);
    const float x = pen.size.x / 2;
    if (info.showVolume)
        pen.text(x, pen.line, 0.5f, 1, kWhite, fmt::format("Sound {:.0f} %", info.volume * 100));
    if (!info.notice.empty()) pen.text(x, pen.line * 2.4f, 0.5f, 0.75f, kGold, info.notice);
    if (info.showTimes) drawTimes(info);
}

} // namespace

void Hud::DestroyContext::operator()(ImGuiContext* context) const {
    ImGui::SetCurrentContext(context);
    if (ImGui::GetIO().BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(context);
}

Result<Hud> Hud::make() {
    Hud hud;
    hud.context_.reset(ImGui::CreateContext());
    ImGui::SetCurrentContext(hud.context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    static constexpr ImWchar kRanges[] = {0x20, 0xFF, 0x25B6, 0x25C0, 0};
    if (std::filesystem::exists(kFontFile))
        hud.font_ = io.Fonts->AddFontFromFileTTF(kFontFile, kFontPixels, nullptr, kRanges);
    if (!hud.font_) {
        ImFontConfig config;
        config.SizePixels = 26;
        hud.font_ = io.Fonts->AddFontDefault(&config);
    }
    if (!ImGui_ImplOpenGL3_Init("#version 330 core") || !ImGui_ImplOpenGL3_CreateDeviceObjects())
        return Error{"", "the on-screen display could not be set up"};
    io.Fonts->ClearTexData(); // on the graphics side from now on
    return hud;
}

void Hud::draw(const HudInfo& info, glm::ivec2 size) {
    ImGui::SetCurrentContext(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(size.x), static_cast<float>(size.y));
    io.DeltaTime = 1.0f / 60; // nothing here moves by itself
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    // Lines of text that would fill the picture; a headset shows fewer pixels.
    const float lines = info.audience == Audience::HeadsetPlayer ? 22 : 30;
    const Pen pen{ImGui::GetBackgroundDrawList(), font_, size,
                  std::clamp(static_cast<float>(std::min(size.y, size.x * 9 / 16)) / lines, 9.0f, 60.0f),
                  info.audience};
    if (info.part != HudPart::Panel) drawHold(pen, info);
    if (info.part != HudPart::Marks) drawText(pen, info);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace shoal::app
