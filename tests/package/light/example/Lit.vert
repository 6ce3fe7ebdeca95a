#version 330 core
in vec4 vertex, uv1; // uv1: tangent, and the bitangent's sign
in vec3 normal;
in vec2 uv0;
uniform mat4 clipFromModel;
out vec3 position, up; // the model stands where it lies: its space is the world's and the light's
out vec4 tangent;
out vec2 uv;
void main() {
    position = vertex.xyz, up = normal, tangent = uv1, uv = uv0;
    gl_Position = clipFromModel * vertex;
}
