// Matte light of an object away from the film's camera: the light at the camera, plus the difference at the object
// (engine/depth/LightDifference.h), as factors of the harmonics of bands 0 to 2 in math::shBasis()'s order. Needs
// light/Environment.glsl.
uniform vec3 lightDifference[9];

vec3 diffuseRadianceAtObject(vec3 n) {
    vec3 camera = diffuseRadiance(n);
    vec3 beyond = lightDifference[0] + lightDifference[1] * n.y + lightDifference[2] * n.z + lightDifference[3] * n.x +
                  lightDifference[4] * (n.x * n.y) + lightDifference[5] * (n.y * n.z) +
                  lightDifference[6] * (3.0 * n.z * n.z - 1.0) + lightDifference[7] * (n.x * n.z) +
                  lightDifference[8] * (n.x * n.x - n.y * n.y);
    return max(camera + beyond, 0.1 * camera); // so few harmonics may sum to less than zero
}
