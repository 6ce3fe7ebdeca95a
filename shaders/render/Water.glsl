// Water between eye and object. Twin of engine/water/Water.h, which explains why it works on squares of display values. For
// vertex shaders: it changes slowly enough to be interpolated. Needs render/Output.glsl.
uniform vec3 eyeWorld;
uniform vec3 waterVeil[9];      // of infinitely deep water, by direction in the env frame: squares of the video's display values
uniform vec3 attenuation_perM;

// Computes, for the square of a display value, the share that arrives (left) and what the water adds (veil).
void throughWater(vec3 fromEyeWorld, mat3 envFromWorld, out vec3 left, out vec3 veil) {
    float distance_m = length(fromEyeWorld);
    vec3 d = envFromWorld * fromEyeWorld / max(distance_m, 1e-4);
    left = exp(-attenuation_perM * distance_m);
    vec3 sum = waterVeil[0] + waterVeil[1] * d.x + waterVeil[2] * d.y + waterVeil[3] * d.z + waterVeil[4] * (d.x * d.y) +
               waterVeil[5] * (d.y * d.z) + waterVeil[6] * (d.x * d.z) + waterVeil[7] * (d.y * d.y - 1.0 / 3.0) +
               waterVeil[8] * (d.x * d.x - d.z * d.z);
    vec3 shown = displayValue(radianceOfFrame(sqrt(max(sum, 0.0)))); // at this exposure and with this curve
    veil = shown * shown * (1.0 - left);
}
