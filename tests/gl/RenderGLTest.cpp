// The background lies where the map has it; matte and mirror spheres show the video's own colours.
#include "Spheres.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/math/Brdf.h"
#include "engine/math/Colour.h"
#include "engine/render/BackgroundPass.h"

namespace shoal {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

class RenderGL : public WithContext {};

// A colour that turns smoothly with direction, so that bilinear reading adds next to nothing.
glm::vec3 smoothColour(const glm::vec3& dir) { return 0.5f + 0.4f * dir; }

ImageRgb8 smoothSurround(int width) {
    ImageRgb8 frame(width, width / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 colour = smoothColour(texelDirection(x, y, width, frame.height));
            for (int c = 0; c < 3; ++c)
                frame.at(x, y)[c] = static_cast<uint8_t>(std::lround(colour[c] * 255));
        }
    return frame;
}

// Tests that draw by OpenGL and, on processors that can, in software.
class RenderGLBackground : public RenderGL, public testing::WithParamInterface<render::Backend> {};
INSTANTIATE_TEST_SUITE_P(From, RenderGLBackground,
                         testing::Values(render::Backend::Software, render::Backend::OpenGL),
                         [](const auto& spec) {
                             return spec.param == render::Backend::Software ? "Memory" : "Texture";
                         });

// The environment is turned to the right by a quarter: ahead lies what the map has to the left, along -X.
TEST_P(RenderGLBackground, ShowsTheMapWhereItLies) {
    const glm::mat3 envFromWorld(glm::mat3_cast(glm::angleAxis(kPi / 2, glm::vec3(0, 1, 0))));
    auto pass = tests::valueOf(render::BackgroundPass::make(GetParam(), false));
    const Lit lit(smoothSurround(512));
    const gl::Target target(96, 64, 1);
    // Ahead, behind (the seam), both poles, and askew.
    for (const glm::vec3 ahead : {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0),
                                  glm::vec3(0, -1, 0), glm::vec3(1, 1, 1), glm::vec3(-1, -0.3f, 0.2f)}) {
        const render::View view{.worldFromEye = looking(ahead), .verticalFov = 1.7f, .aspect = 1.5f};
        fill(target);
        ASSERT_TRUE(pass->draw(
            {.environment = lit.environment, .envFromWorld = envFromWorld, .view = view, .canvas = target},
            nullptr));
        const ImageRgba8 picture = target.read();
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const glm::vec3 dir = glm::normalize(rayThrough(view, x, y, {96, 64}));
                const glm::vec3 expected = smoothColour(envFromWorld * dir) * 255.0f;
                // Half a step of rounding into the frame and half out of it; the pole's texel row adds the
                // cap's bend, 0.4 * 255 * (pi / 512) = 0.6.
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(picture.at(x, y)[c], expected[c], 1.7f)
                        << x << "," << y << " looking " << ahead.x;
            }
    }
}

// A marked sphere is lighter than the light makes it, most so at its rim, in the dark as in bright light, and
// alike where light comes by the pixel and by the vertex (heightPixels, lean).
TEST_F(RenderGL, HighlightLightensMostAtTheRim) {
    constexpr int kPixels = 64;
    for (const uint8_t grey : {uint8_t(8), uint8_t(128), uint8_t(230)})
        for (const render::Detail detail : {render::Detail::Full, render::Detail::Lean}) {
            const bool lean = detail == render::Detail::Lean;
            const Lit lit(uniformFrame(grey, grey, grey));
            const render::View view{
                .eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1, .heightPixels = lean ? kPixels : 0};
            const ImageRgba8 picture = drawSphere(sphere(0, 0.5f), lit.environment, view, kPixels,
                                                  {.detail = detail, .highlight = 1});
            for (int x = kPixels / 2; x < kPixels; ++x) {
                // The ray meets the unit sphere at t: its normal there is the place itself.
                const float across = (2 * (static_cast<float>(x) + 0.5f) / kPixels - 1) * view.halfExtent().x;
                const glm::vec3 ray = glm::normalize(glm::vec3(across, 0, -1));
                const float half = -3 * ray.z, rest = half * half - 8;
                if (rest < 0.05f) continue; // the outline, where a pixel spans much of the rim
                const glm::vec3 normal = glm::vec3(0, 0, 3) + (half - std::sqrt(rest)) * ray;
                const float edge = 1 - glm::dot(normal, -ray);
                const float share = 0.24f + edge * (0.25f + 0.45f * edge * edge);
                // A pixel beside the middle row; by the vertex, a chord of the curve, which lies above it:
                // over a rim of 24 triangles to the circle by a tenth of the display at most.
                const auto plain = static_cast<float>(grey);
                const float lightest = std::min(1.9f * plain + 0.12f * 255, 255.0f);
                EXPECT_NEAR(picture.at(x, kPixels / 2)[0], glm::mix(plain, lightest, share), lean ? 24 : 4)
                    << x << " grey " << int(grey) << (lean ? " lean" : "");
            }
        }
}

TEST_F(RenderGL, WhiteMatteSphereInAUniformVideoHasTheVideosValue) {
    for (const auto& [r, g, b] :
         {std::array<uint8_t, 3>{20, 20, 20}, {128, 128, 128}, {200, 180, 40}, {255, 255, 255}})
        for (const float roughness : {0.0f, 0.5f, 1.0f}) {
            const Lit lit(uniformFrame(r, g, b));
            const ImageRgba8 picture =
                drawSphere(sphere(0, roughness), lit.environment,
                           {.eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1}, 64);
            SCOPED_TRACE(roughness);
            // One step of the display; half floats hold radiance to 1 in 2048.
            expectColour(picture, {r, g, b, 255}, 1);
        }
}

// Light is doubled from all sides, and then as much is added from the right as well: seen from ahead, the
// matte light of a normal n is 1, 2, and 2 + cos(n, right) times the camera's. A white dielectric sends back
// at least nine tenths of it in this way, the rest is the camera's in its gloss.
TEST_F(RenderGL, LightBesideTheCameraIsAddedToMatteLight) {
    const float camera = math::linearOfByte()[100];
    const Lit lit(uniformFrame(100, 100, 100), light::FrameRadiance::Linear);
    depth::LightHarmonics beside{};
    beside[0] = glm::vec3(camera / 0.282095f);
    const float toTheRight = camera / (0.488603f * 2 / 3);
    for (const bool uneven : {false, true})
        for (const render::Detail detail : {render::Detail::Full, render::Detail::Lean}) {
            beside[3] = glm::vec3(uneven ? toTheRight : 0);
            const ImageRgba8 picture = drawSphere(
                sphere(0, 1), lit.environment, {.eyeWorld = {0, 0, 40}, .verticalFov = 0.055f, .aspect = 1},
                64, {.detail = detail, .frames = render::FrameCoding::Srgb, .beside = &beside});
            for (int x = 8; x < 56; x += 4) {
                const float right = (static_cast<float>(x) + 0.5f - 32) / 32 * 40 * std::tan(0.0275f);
                const float more = (1 + (uneven ? right : 0)) * camera;
                const float seen = math::linearOfByte()[picture.at(x, 32)[0]];
                EXPECT_LT(seen, camera + more + 0.01f) << x << uneven;
                EXPECT_GT(seen, camera + 0.9f * more - 0.01f) << x << uneven;
            }
        }
}

// With lean detail a small sphere is lit by the vertex: even light stays even, in smooth nobody can tell.
TEST_F(RenderGL, LightByTheVertexIsTheLightByThePixel) {
    constexpr int kSize = 64; // the sphere's radius is 24 pixels
    const render::View view{.eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1, .heightPixels = kSize};
    for (const bool smooth : {false, true})
        for (const float metallic : {0.0f, 1.0f})
            for (const float roughness : {0.2f, 0.5f, 1.0f}) {
                const ImageRgb8 video = smooth ? smoothSurround(512) : uniformFrame(200, 180, 40);
                const Lit lit(video);
                const scene::Model model = sphere(metallic, roughness);
                const ImageRgba8 pixel = drawSphere(model, lit.environment, view, kSize);
                const ImageRgba8 vertex =
                    drawSphere(model, lit.environment, view, kSize, {.detail = render::Detail::Lean});
                int covered = 0;
                double sum = 0;
                for (int y = 0; y < kSize; ++y)
                    for (int x = 0; x < kSize; ++x) {
                        if (!pixel.at(x, y)[3] || !vertex.at(x, y)[3]) continue;
                        ++covered;
                        for (int c = 0; c < 3; ++c) {
                            const int apart = std::abs(pixel.at(x, y)[c] - vertex.at(x, y)[c]);
                            sum += apart;
                            // A step of rounding each. In a smooth video, away from the limb, where Fresnel's
                            // share and the mirrored direction race within a triangle.
                            const bool limb = std::hypot(x - 31.5, y - 31.5) > 18;
                            if (!smooth || !limb) {
                                ASSERT_LE(apart, smooth ? 20 : 2) << x << "," << y << " metallic " << metallic
                                                                  << " roughness " << roughness;
                            }
                        }
                    }
                ASSERT_GT(covered, 1000);
                // Measured 1.9 to 2.6, and 5.0 for metal of roughness 0.2: the nearest of the glossy maps,
                // and triangles of ten pixels.
                EXPECT_LE(sum / (3 * covered), metallic == 1 && roughness < 0.3f ? 7 : 4)
                    << "metallic " << metallic << " roughness " << roughness;
            }
}

// Factor, vertex colour and map multiply, each map by its own texture coordinates, and what glows is added,
// whether light comes by the pixel or by the vertex: as if the products were the material's.
TEST_F(RenderGL, ColoursAndMapsMultiplyWhereverLightComes) {
    constexpr int kSize = 64;
    const render::View view{.eyeWorld = {0, 0, 3}, .verticalFov = 0.9f, .aspect = 1, .heightPixels = kSize};
    const Lit lit(uniformFrame(120, 100, 90));
    const glm::vec4 colour(0.9f, 0.5f, 0.7f, 1);
    const glm::vec3 glow(0.3f, 0.1f, 0.2f);
    constexpr uint8_t kLeft = 200, kRight = 120;

    scene::Model plain = sphere(0, 0.6f);
    plain.materials[0].baseColourLin = {0.8f, 0.7f, 0.6f, 1};
    scene::Model coloured = plain;
    plain.materials[0].baseColourLin *= colour * glm::vec4(glm::vec3(std::pow(kLeft / 255.0f, 2.2f)), 1);
    ImageRgba8 halves(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            std::fill_n(halves.at(x, y), 3, x < 4 ? kLeft : kRight);
            halves.at(x, y)[3] = 255;
        }
    scene::Primitive& primitive = coloured.meshes[0].primitives[0];
    const size_t vertices = primitive.positions.size();
    primitive.coloursLin.assign(vertices, colour);
    primitive.texCoords[0].assign(vertices, {0.8f, 0.5f});
    primitive.texCoords[1].assign(vertices, {0.2f, 0.5f});
    coloured.images.push_back(halves);
    coloured.textures.push_back({.image = 0});
    coloured.materials[0].baseColour = {0, 1};
    for (const bool map : {false, true}) {
        coloured.materials[0].emissiveLin = glow;
        if (map) coloured.materials[0].emissive = {0, 0};
        plain.materials[0].emissiveLin = glow * (map ? math::linearFromSrgb(kRight / 255.0f) : 1.0f);
        for (const auto detail : {render::Detail::Full, render::Detail::Lean}) {
            const ImageRgba8 a =
                drawSphere(plain, lit.environment, view, kSize, {.exposure_ev = 0.5f, .detail = detail});
            const ImageRgba8 b =
                drawSphere(coloured, lit.environment, view, kSize, {.exposure_ev = 0.5f, .detail = detail});
            for (int y = 24; y < 40; ++y)
                for (int x = 24; x < 40; ++x)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(a.at(x, y)[c], b.at(x, y)[c], 1) << x << "," << y << (map ? " map" : "");
            EXPECT_GT(a.at(32, 32)[0], 40);
            EXPECT_LT(a.at(32, 32)[0], 250);
        }
    }
}

// How a frame's values are taken, and how what is lit by it is displayed.
constexpr std::array kCodings = {
    std::pair(light::FrameRadiance::Thesis, render::FrameCoding::Thesis),
    std::pair(light::FrameRadiance::Linear, render::FrameCoding::Srgb),
    std::pair(light::FrameRadiance::Auto, render::FrameCoding::Srgb),
};

TEST_F(RenderGL, MirrorShowsTheVideosOwnColours) {
    const ImageRgb8 frame = smoothSurround(512);
    for (const auto& [radiance, coding] : kCodings) {
        const Lit lit(frame, radiance);
        for (const glm::vec3 eye :
             {glm::vec3(0, 0, 3), glm::vec3(0, 0, -3), glm::vec3(2, 2, -1), glm::vec3(-1, -2.5f, 0.5f)}) {
            const render::View view{
                .eyeWorld = eye, .worldFromEye = looking(-eye), .verticalFov = 0.1f, .aspect = 1};
            const ImageRgba8 picture = drawSphere(sphere(1, 0), lit.environment, view, 9, {.frames = coding});
            // The middle of the sphere reflects the view ray back to the eye.
            const glm::vec3 expected = smoothColour(glm::normalize(eye)) * 255.0f;
            // 1/255 asked for, and half a step of rounding in the frame.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 1.5f) << eye.x << " " << eye.y;
        }
    }
}

// The light above was brighter than white: a mirror shows it as the camera did, the ground gets more.
TEST_F(RenderGL, ClippedLightIsWhiteInAMirrorAndMoreThanThatOnTheGround) {
    ImageRgb8 frame = uniformFrame(120, 120, 120);
    for (int y = 0; y < 6; ++y) std::fill_n(frame.at(0, y), 3 * frame.width, uint8_t{255});
    const glm::vec3 eye(0, 3, 0.01f);
    const render::View view{.eyeWorld = eye, .worldFromEye = looking(-eye), .verticalFov = 0.1f, .aspect = 1};
    std::array<int, 2> matte{};
    for (const auto radiance : {light::FrameRadiance::Linear, light::FrameRadiance::Auto}) {
        const Lit lit(frame, radiance);
        const auto drawn = [&](float metallic, float roughness, float ev) {
            return drawSphere(sphere(metallic, roughness), lit.environment, view, 9,
                              {.exposure_ev = ev, .frames = render::FrameCoding::Srgb})
                .at(4, 4)[1];
        };
        EXPECT_EQ(drawn(1, 0, 0), 255);
        matte[radiance == light::FrameRadiance::Auto] = drawn(0, 1, -3);
    }
    EXPECT_GT(matte[1], matte[0] + 5);
}

// Half floats end at 65504: what is brighter reaches matte and mirroring surfaces all the same.
TEST_F(RenderGL, LightBeyondHalfFloatsIsScaled) {
    constexpr float kRadiance = 1 << 20;
    ImageRgbF even(512, 256);
    std::fill(even.pixels.begin(), even.pixels.end(), kRadiance);
    light::EnvironmentLight made;
    light::LightMaker({.baseWidth = 512, .minRoughness = 0.1f}).makeFromHdr(even, made);
    light::PackedLight packed;
    light::packLight(made, light::MirrorMaps::Mirrors, packed, light::TooBright::Scale);
    render::EnvironmentGpu environment;
    environment.uploadLight(packed);
    const render::View view{.eyeWorld = {0, 0, 3}, .verticalFov = 0.1f, .aspect = 1};
    for (const float metallic : {0.0f, 1.0f}) {
        const ImageRgba8 picture =
            drawSphere(sphere(metallic, metallic == 1 ? 0.0f : 1.0f), environment, view, 9,
                       {.exposure_ev = -22, .frames = render::FrameCoding::Srgb});
        EXPECT_NEAR(picture.at(4, 4)[1], 255 * math::srgbFromLinear(0.25f), 1.5f) << metallic;
    }
}

// Bright caps: red overhead, green across the seam, blue to the right.
ImageRgb8 capsFrame(int width) {
    ImageRgb8 frame(width, width / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 dir = texelDirection(x, y, width, frame.height);
            const glm::vec3 along(dir.y, dir.z, dir.x);
            for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = along[c] > 0.8f ? 230 : 60;
        }
    return frame;
}

// The shader looks the light up as lookUpGlossy() does, on levels and between them, at seam and pole too. A
// white metal seen head on reflects the lobe; what it loses between its facets comes back matte.
TEST_F(RenderGL, MetalShowsTheLightThatWasMade) {
    const ImageRgb8 frame = capsFrame(512);
    const light::EnvironmentLight made = lightMadeOf(frame);
    const Lit lit(frame);
    for (const float roughness : {0.08f, 0.1f, 0.13f, 0.31f, 0.55f, 0.65f, 0.95f, 1.0f})
        for (const glm::vec3 eye : {glm::vec3(0, 3, 0.01f), glm::vec3(0.02f, 0.5f, 3), glm::vec3(3, 0, 0),
                                    glm::vec3(2, 2, -1), glm::vec3(-1, -2.5f, 0.5f)}) {
            const render::View view{
                .eyeWorld = eye, .worldFromEye = looking(-eye), .verticalFov = 0.1f, .aspect = 1};
            const ImageRgba8 picture = drawSphere(sphere(1, roughness), lit.environment, view, 9);
            const glm::vec3 dir = glm::normalize(eye);
            const math::Dfg dfg = math::dfg(1, static_cast<double>(roughness));
            const auto kept = static_cast<float>(dfg.scale + dfg.bias);
            const glm::vec3 radiance = kept * light::lookUpGlossy(made, dir, roughness) +
                                       (1 - kept) * light::lookUp(made.diffuse, dir);
            const glm::vec3 expected = light::displayFromRadiance(radiance) * 255.0f;
            // Rounding, and the sphere's 96 facets around, which look up to a fiftieth of a radian elsewhere.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 2.5f)
                    << "roughness " << roughness << " from " << eye.x << " " << eye.y << " " << eye.z;
        }
}

// A white matte ball in an even video, at exposure 0 its own value.
TEST_F(RenderGL, ExposureChangesObjectAndBackgroundAlike) {
    const ImageRgb8 frame = uniformFrame(90, 120, 60);
    auto background = tests::valueOf(render::BackgroundPass::make(render::Backend::OpenGL, false));
    for (const auto& [radiance, coding] : kCodings) {
        const Lit lit(frame, radiance);
        for (const float ev : {-1.5f, 0.0f, 0.7f, 3.0f}) {
            const render::View view{.eyeWorld = {0, 0, 3}, .verticalFov = 0.1f, .aspect = 1};
            const ImageRgba8 object =
                drawSphere(sphere(0, 1), lit.environment, view, 9, {.exposure_ev = ev, .frames = coding});
            const gl::Target target(9, 9, 1);
            fill(target);
            ASSERT_TRUE(background->draw({.environment = lit.environment,
                                          .view = view,
                                          .exposure = {.exposure_ev = ev, .frames = coding},
                                          .canvas = target},
                                         nullptr));
            const ImageRgba8 behind = target.read();
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(object.at(4, 4)[c], behind.at(4, 4)[c], 1) << ev;
                if (ev == 0) {
                    EXPECT_EQ(behind.at(4, 4)[c], frame.pixels[static_cast<size_t>(c)]);
                }
            }
        }
    }
}

} // namespace
} // namespace shoal
