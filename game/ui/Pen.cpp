#include "game/ui/Pen.h"

#include "engine/core/Log.h"

#include <imgui/imgui.h>
#include <stb_image.h>
// This header needs imgui.h before it.
#include <imgui/backends/imgui_impl_opengl3.h>

#include <cfloat>
#include <memory>

namespace shoal::app {

// Western European letters, punctuation, and the signs of captions and menus: those of content/make/fonts.
constexpr ImWchar kRanges[] = {0x20,   0x17F,  0x2010, 0x203A, 0x20AC, 0x20AC, 0x2190, 0x2193,
                               0x25A0, 0x25CF, 0x2605, 0x2606, 0x2713, 0x2713, 0};
constexpr std::array kFontFiles = {"text.otf", "heading.otf"};
constexpr float kMinPixels = 11; // letters smaller than this run into one another

static ImVec2 imVec(glm::vec2 v) { return {v.x, v.y}; }

void Fonts::fit(float line_px) {
    std::array<float, kTextScale.size()> pixels;
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = std::max(std::round(line_px * kTextScale[i]), kMinPixels);
    if (pixels == pixels_ && fonts_[0]) return;
    pixels_ = pixels;
    for (size_t i = 0; i < files_.size() && files_[i].empty(); ++i) {
        auto bytes = readFile(dataRoot() / "content/fonts" / kFontFiles[i], 1u << 20);
        if (!bytes) log::warn("{}; text is drawn with a small built-in font", bytes.error().message());
        if (bytes) files_[i] = std::move(*bytes);
    }
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
    for (size_t i = 0; i < pixels.size(); ++i) {
        ImFontConfig config;
        config.SizePixels = pixels[i];
        config.OversampleH = config.OversampleV = 1; // texels lie on pixels
        config.PixelSnapH = true;
        config.FontDataOwnedByAtlas = false;
        auto& file = files_[i < static_cast<size_t>(TextSize::Heading) ? 0 : 1];
        fonts_[i] = file.empty() ? atlas.AddFontDefault(&config)
                                 : atlas.AddFontFromMemoryTTF(file.data(), static_cast<int>(file.size()),
                                                              pixels[i], &config, kRanges);
    }
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    // Letters are white: one channel serves, where ImGui's own upload has four.
    uint8_t* coverage = nullptr;
    glm::ivec2 size;
    atlas.GetTexDataAsAlpha8(&coverage, &size.x, &size.y);
    texture_ = gl::makeTexture(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, size.x, size.y, 0, GL_RED, GL_UNSIGNED_BYTE, coverage);
    constexpr std::array<GLint, 4> kFromRed = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, kFromRed.data());
    atlas.SetTexID(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(texture_.name())));
    atlas.ClearTexData(); // the GPU has a copy
}

Result<ImageRgba8> readSmallPicture(const Path& file) {
    const auto bytes = readFile(file, 1u << 20);
    if (!bytes) return bytes.error();
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes->data(), static_cast<int>(bytes->size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels) return Error{file, "is not a picture that can be read"};
    ImageRgba8 image(width, height);
    std::copy_n(pixels.get(), image.pixels.size(), image.pixels.begin());
    return image;
}

void Pictures::Picture::show(const ImageRgba8& image) {
    if (!texture) texture = gl::makeTexture(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    size = {image.width, image.height};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.pixels.data());
}

const Pictures::Picture& Pictures::get(const std::string& file) {
    const auto [entry, isNew] = read_.try_emplace(file);
    Picture& picture = entry->second;
    if (!isNew) return picture;
    const auto image = readSmallPicture(dataRoot() / "content" / file);
    if (!image) {
        log::warn("{}", image.error().message());
        return picture;
    }
    picture.show(*image);
    return picture;
}

glm::vec2 Pen::extent(std::string_view text, TextSize textSize, float width) const {
    const ImVec2 extent = fonts->at(textSize)->CalcTextSizeA(fonts->pixels(textSize), FLT_MAX, width,
                                                             text.data(), text.data() + text.size());
    return {std::ceil(extent.x), extent.y};
}

void Pen::text(float x, float y, float anchor, TextSize textSize, uint32_t colour,
               std::string_view text) const {
    x -= extent(text, textSize).x * anchor;
    // Text starts at whole pixels, so that glyphs are shown as rasterised, without filtering.
    list->AddText(fonts->at(textSize), fonts->pixels(textSize), ImVec2(std::round(x), std::round(y)), colour,
                  text.data(), text.data() + text.size());
}

float Pen::paragraph(float x, float y, float width, TextSize textSize, uint32_t colour,
                     std::string_view text) const {
    list->AddText(fonts->at(textSize), fonts->pixels(textSize), ImVec2(std::round(x), std::round(y)), colour,
                  text.data(), text.data() + text.size(), width);
    return extent(text, textSize, width).y;
}

Rectangle Pen::label(float x, float y, TextSize textSize, uint32_t colour, std::string_view content) const {
    const glm::vec2 margin(line * 0.5f, line * 0.18f);
    // The label stays within the picture.
    const float widest = size.x - 2 * margin.x;
    const glm::vec2 extents = extent(content, textSize, widest);
    const float left =
        std::clamp(x - extents.x / 2, margin.x, std::max(margin.x, size.x - margin.x - extents.x));
    const Rectangle area{glm::vec2(left, y) - margin, glm::vec2(left, y) + extents + margin};
    panel(area);
    paragraph(left, y, widest, textSize, colour, content);
    return area;
}

void Pen::fill(const Rectangle& area, uint32_t colour) const {
    list->AddRectFilled(imVec(area.low), imVec(area.high), colour);
}

void Pen::panel(const Rectangle& area, Edge edge) const {
    static constexpr std::array<ImDrawFlags, 4> kRounded = {
        ImDrawFlags_RoundCornersAll, ImDrawFlags_RoundCornersRight, ImDrawFlags_RoundCornersBottom,
        ImDrawFlags_RoundCornersLeft}; // by Edge
    list->AddRectFilled(imVec(area.low), imVec(area.high), highContrast ? colour::kSolid : colour::kPanel,
                        0.2f * line, kRounded[static_cast<size_t>(edge)]);
    Rectangle side = area;
    if (edge == Edge::Left) side.high.x = side.low.x + stroke();
    if (edge == Edge::Top) side.high.y = side.low.y + stroke();
    if (edge == Edge::Right) side.low.x = side.high.x - stroke();
    if (edge != Edge::None) fill(side, colour::kAccent);
}

void Pen::rule(glm::vec2 from, float width, bool waves) const {
    for (float x = 0; x <= width; x += 0.15f * line) {
        const float phase = 6.2831853f * x / (2 * line);
        list->PathLineTo(imVec(from + glm::vec2(x, waves ? 0.14f * line * std::sin(phase) : 0.0f)));
    }
    list->PathStroke(colour::kAccent, 0, stroke());
}

void Pen::picture(const Rectangle& area, const Pictures::Picture& shown) const {
    if (!shown.texture) return;
    const glm::vec2 room = area.high - area.low, middle = (area.low + area.high) / 2.0f;
    const glm::vec2 half = shown.size * std::min(room.x / shown.size.x, room.y / shown.size.y) / 2.0f;
    list->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(shown.texture.name())),
                   imVec(middle - half), imVec(middle + half));
}

} // namespace shoal::app
