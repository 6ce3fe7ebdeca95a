// The graphics card answers as the processor does.
#include "engine/gl/Program.h"
#include "engine/occlusion/gpu/LayersGpu.h"
#include "engine/render/TriangleBatch.h"
#include "shaders/occlusion/Bindings.glsl"
#include "tests/baselines/occlusion/OllfbThesis.h"
#include "tests/baselines/occlusion/TracedOllfb.h"
#include "tests/gl/Spheres.h"
#include "tests/unit/occlusion/Bodies.h"

namespace shoal::occlusion {
namespace {

// A ray in the shader's memory layout.
struct RayGpu {
    glm::vec3 origin{0};
    float nearest = 0;
    glm::vec3 direction{0};
    float unused = 0;
};
static_assert(sizeof(RayGpu) == 32);

// Traces many rays at once on the graphics card, one for each pixel of a picture of floats.
struct TracePass {
    static gl::Program load(const std::vector<std::string>& features) {
        return tests::valueOf(gl::Program::load("../tests/gl/occlusion/Trace", features, kStorageGlsl));
    }
    const gl::Program thesis = load({"THESIS"}), cured = load({});

    // Traces as the methods' trace() does, body frame. Waits for the answers.
    std::vector<std::optional<Hit>> trace(const LayersGpu& layers, std::span<const RayGpu> rays) const {
        constexpr int kWidth = 256;
        const int count = static_cast<int>(rays.size());
        const int height = std::max(1, (count + kWidth - 1) / kWidth);
        const auto asked = tests::valueOf(storageBuffer(rays.data(), rays.size_bytes()));
        const gl::Texture answers = gl::Texture::make();
        glBindTexture(GL_TEXTURE_2D, answers.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWidth, height, 0, GL_RGBA, GL_FLOAT, nullptr);
        const gl::Framebuffer picture = gl::Framebuffer::make();
        glBindFramebuffer(GL_FRAMEBUFFER, picture.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, answers.name(), 0);
        EXPECT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
        glViewport(0, 0, kWidth, height);
        glDisable(GL_DEPTH_TEST), glDisable(GL_BLEND), glDisable(GL_SCISSOR_TEST);
        const gl::Program& program = layers.method() == LayerMethod::Thesis ? thesis : cured;
        program.use();
        layers.bind(program);
        program.set("width", kWidth);
        program.set("rayCount", count);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, OCCLUSION_RAYS, asked.name());
        render::WholePicture().draw();
        std::vector<glm::vec4> pixels(static_cast<size_t>(kWidth) * static_cast<size_t>(height));
        glReadPixels(0, 0, kWidth, height, GL_RGBA, GL_FLOAT, pixels.data());
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        std::vector<std::optional<Hit>> hits(rays.size());
        for (size_t i = 0; i < hits.size(); ++i)
            if (pixels[i].x >= 0)
                hits[i] = Hit{pixels[i].x, glm::vec3(pixels[i].y, pixels[i].z, pixels[i].w)};
        return hits;
    }
};

class LayersGL : public WithContext {
  protected:
    void setUpInContext() override {
        if (Status can = canKeepLayers(); !can) GTEST_SKIP() << can.error().message();
    }
};

std::vector<RayGpu> someRays(const Body& body, int count) {
    Random random(9);
    std::vector<RayGpu> rays;
    const Sphere sphere = boundingSphere(body.mesh());
    for (int i = 0; i < count; ++i) {
        const Ray ray = i % 2 ? chord(random, sphere) : reflection(random, body);
        rays.push_back({ray.origin, 0.01f * sphere.radius, ray.direction});
    }
    return rays;
}

// Shares of rays that hit by one method alone, and whose distances or normals differ.
struct Difference {
    double met = 0, distance = 0, normal = 0;
};
template <class Method>
Difference compare(const Method& method, std::span<const RayGpu> rays,
                   std::span<const std::optional<Hit>> hits, float tolerance) {
    Difference difference;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto expected = method.trace(rays[i].origin, rays[i].direction, rays[i].nearest);
        difference.met += expected.has_value() != hits[i].has_value();
        if (!expected || !hits[i]) continue;
        difference.distance += std::abs(expected->distance - hits[i]->distance) > tolerance;
        difference.normal += glm::distance(expected->normal, hits[i]->normal) > 0.01f;
    }
    const auto all = static_cast<double>(rays.size());
    return {difference.met / all, difference.distance / all, difference.normal / all};
}

TEST_F(LayersGL, CardAnswersRaysAsTheProcessorDoes) {
    const TracePass pass;
    for (const Body& body : {torus(1, 0.4f, 48, 24), bunny()}) {
        const std::vector<RayGpu> rays = someRays(body, 6000);
        const float radius = boundingSphere(body.mesh()).radius;
        const OllfbThesis::Options options{.cells = 3, .resolution = 64};
        const auto thesis = tests::valueOf(OllfbThesis::make(body.mesh(), options));
        const auto thesisGpu = tests::valueOf(LayersGpu::upload(thesis));
        const auto steps = pass.trace(thesisGpu, rays);
        const Difference a = compare(thesis, rays, steps, 0.01f * radius);
        const auto cured = tests::valueOf(TracedOllfb::make(body.mesh(), {.views = 54}));
        const auto curedGpu = tests::valueOf(LayersGpu::upload(cured));
        const auto planes = pass.trace(curedGpu, rays);
        const Difference b = compare(cured, rays, planes, 1e-3f * radius);
        size_t met = 0;
        for (const auto& hit : planes) met += hit.has_value();
        EXPECT_GT(met, 1000u); // half of the rays leave the surface
        EXPECT_LE(a.met, 0.005);
        EXPECT_LE(a.distance, 0.02);
        // Cured: the same layers, rounded in another order; rays on the border of two cells or views.
        EXPECT_LE(b.met, 0.002);
        EXPECT_LE(b.distance, 0.005);
        EXPECT_LE(b.normal, 0.01);
    }
}

TEST_F(LayersGL, SheetsAreMetFromBothSides) {
    const TracePass pass;
    const Body body = oneTriangle();
    const auto cured = TracedOllfb::make(body.mesh());
    const auto gpu = tests::valueOf(LayersGpu::upload(*cured));
    const std::vector<RayGpu> rays = {
        {{0, 0, 2}, 0, {0, 0, -1}}, {{0, 0, -2}, 0, {0, 0, 1}}, {{0.9f, 0.9f, 2}, 0, {0, 0, -1}}};
    const auto hits = pass.trace(gpu, rays);
    for (int k = 0; k < 2; ++k) {
        ASSERT_TRUE(hits[static_cast<size_t>(k)]);
        EXPECT_NEAR(hits[static_cast<size_t>(k)]->distance, 2, 0.01f);
        EXPECT_GT(hits[static_cast<size_t>(k)]->normal.z * (k ? -1.0f : 1.0f), 0.99f);
    }
    EXPECT_FALSE(hits[2]);
}

TEST_F(LayersGL, BrokenBodiesAreRefusedAndEmptyOnesAreNot) {
    Body body = torus(1, 0.4f, 12, 6);
    body.positions[3].x = NAN;
    const Body nothing;
    for (const LayerMethod method : {LayerMethod::Ollfb, LayerMethod::Thesis}) {
        EXPECT_THAT(tests::errorOf(LayersGpu::make(body.mesh(), method)).reason,
                    testing::HasSubstr("infinitely large"));
        const auto empty = tests::valueOf(LayersGpu::make(nothing.mesh(), method));
    }
}

} // namespace
} // namespace shoal::occlusion
