// Matte light of an object away from the film's camera: the light at the camera, plus the difference at the object
// (engine/depth/LightBeside.h), as factors of the harmonics of bands 0 to 2 in math::shBasis()'s order. Needs
// light/Environment.glsl.
uniform vec3 lightBeside[9];

vec3 diffuseRadianceBeside(vec3 n) {
    vec3 camera = diffuseRadiance(n);
    vec3 beyond = lightBeside[0] + lightBeside[1] * n.y + lightBeside[2] * n.z + lightBeside[3] * n.x + lightBeside[4] * (n.x * n.y) +
                  lightBeside[5] * (n.y * n.z) + lightBeside[6] * (3.0 * n.z * n.z - 1.0) + lightBeside[7] * (n.x * n.z) +
                  lightBeside[8] * (n.x * n.x - n.y * n.y);
    return max(camera + beyond, 0.1 * camera); // so few harmonics may sum to less than zero
}
