// What a layer of objects shows in the direction of a texel of the frame; display values, premultiplied by coverage.
#include "light/LatLong.glsl"

uniform sampler2D layer;
uniform mat3 eyeFromEnv;
uniform vec2 rayScale; // half the layer's image plane's extent at distance 1
uniform vec2 rayShift; // its centre
noperspective in vec2 mapUv;
out vec4 colour;

void main() {
    float longitude = (mapUv.x - 0.5) * 2.0 * kPi, latitude = (0.5 - mapUv.y) * kPi;
    float ring = cos(latitude);
    vec3 ray = eyeFromEnv * vec3(ring * sin(longitude), sin(latitude), -ring * cos(longitude));
    vec2 place = (ray.xy / max(-ray.z, 1e-4) - rayShift) / rayScale; // in the layer, -1 to 1
    float inside = step(max(abs(place.x), abs(place.y)), 1.0);
    colour = inside * textureLod(layer, 0.5 * place + 0.5, 0.0);
}
