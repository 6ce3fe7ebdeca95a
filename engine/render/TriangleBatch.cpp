#include "engine/render/TriangleBatch.h"

#include "shaders/render/Attributes.glsl"

#include <algorithm>

namespace shoal::render {

TriangleBatch TriangleBatch::make(std::initializer_list<Attribute> attributes) {
    TriangleBatch batch;
    batch.vertexArray_ = gl::VertexArray::make();
    batch.vertices_ = gl::Buffer::make();
    glBindVertexArray(batch.vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, batch.vertices_.name());
    size_t stride = 0, offset = 0;
    for (const Attribute& each : attributes) stride += static_cast<size_t>(each.floats) * sizeof(float);
    for (const Attribute& each : attributes) {
        gl::setAttribute(each.location, each.floats, stride, offset);
        offset += static_cast<size_t>(each.floats) * sizeof(float);
    }
    glBindVertexArray(0);
    return batch;
}

TriangleBatch TriangleBatch::make() { return make({{ATTRIBUTE_POSITION, 2}}); }

void TriangleBatch::draw(const void* vertices, size_t stride, size_t count, DepthTest test) {
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * stride), vertices, GL_STREAM_DRAW);
    gl::setEnabled(GL_DEPTH_TEST, test == DepthTest::On);
    glDisable(GL_CULL_FACE);
    // Draws are short: llvmpipe cuts longer ones between the triangles of a rectangle.
    constexpr size_t kAtOnce = 960;
    for (size_t first = 0; first < count; first += kAtOnce)
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(first),
                     static_cast<GLsizei>(std::min(kAtOnce, count - first)));
    glBindVertexArray(0);
}

void addRectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& corners) {
    for (const glm::vec2 corner :
         {low, {high.x, low.y}, {low.x, high.y}, {low.x, high.y}, {high.x, low.y}, high})
        corners.push_back(corner);
}

} // namespace shoal::render
