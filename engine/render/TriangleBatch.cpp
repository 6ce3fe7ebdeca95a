#include "engine/render/TriangleBatch.h"

#include "shaders/render/Attributes.glsl"

namespace shoal::render {

TriangleBatch TriangleBatch::make() {
    TriangleBatch corners;
    corners.vertexArray_ = gl::VertexArray::make();
    corners.vertices_ = gl::Buffer::make();
    glBindVertexArray(corners.vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, corners.vertices_.name());
    gl::setAttribute(ATTRIBUTE_POSITION, 2, sizeof(glm::vec2), 0);
    glBindVertexArray(0);
    return corners;
}

void TriangleBatch::draw(std::span<const glm::vec2> corners) {
    glBindVertexArray(vertexArray_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
                 GL_STREAM_DRAW);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    glBindVertexArray(0);
}

void TriangleBatch::drawOver(std::span<const glm::vec2> corners) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    draw(corners);
    glDisable(GL_BLEND);
}

void addRectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& corners) {
    for (const glm::vec2 corner :
         {low, {high.x, low.y}, {low.x, high.y}, {low.x, high.y}, {high.x, low.y}, high})
        corners.push_back(corner);
}

} // namespace shoal::render
