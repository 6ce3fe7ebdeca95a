// One triangle over the whole picture, at the far plane.
uniform mat3 worldFromRay; // rotates and scales a ray (x, y, -1) of the image plane into the env frame
uniform vec2 rayScale;     // half the image plane's extent at distance 1
uniform vec2 rayShift;     // its centre, for eyes whose frustum is off axis
out vec3 ray;

void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2)) * 2.0 - 1.0;
    ray = worldFromRay * vec3(corner * rayScale + rayShift, -1.0);
    gl_Position = vec4(corner, 1.0, 1.0);
}
