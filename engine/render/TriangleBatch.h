// Draws triangles that are new in every frame, and one over the whole picture.
#pragma once

#include "engine/gl/Objects.h"

#include <glm/vec2.hpp>

#include <initializer_list>
#include <vector>

namespace shoal::render {

class TriangleBatch {
  public:
    struct Attribute {
        GLuint location;
        GLint floats;
    };
    // attributes: of one vertex, in their order in memory.
    static TriangleBatch make(std::initializer_list<Attribute> attributes);
    static TriangleBatch make(); // for vertices that are glm::vec2 in a plane

    enum class DepthTest { Off, On };
    // Draws with the program in use; three vertices a triangle, in either winding order.
    template <class Vertex> void draw(const std::vector<Vertex>& vertices, DepthTest test = DepthTest::Off) {
        draw(vertices.data(), sizeof(Vertex), vertices.size(), test);
    }

  private:
    void draw(const void* vertices, size_t stride, size_t count, DepthTest test);

    gl::VertexArray vertexArray_;
    gl::Buffer vertices_;
};

// Appends two triangles that make a rectangle.
void addRectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& corners);

// One triangle that covers the viewport. Pairs with shaders/render/WholePicture.glsl.
class WholePicture {
  public:
    // Draws with the program in use; depth is 0.5 everywhere, tested and blended as the caller has set.
    void draw() const {
        glDisable(GL_CULL_FACE);
        glBindVertexArray(noAttributes_.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
    }

  private:
    // The shader makes the corners, but OpenGL requires that a vertex array is bound.
    gl::VertexArray noAttributes_ = gl::VertexArray::make();
};

} // namespace shoal::render
