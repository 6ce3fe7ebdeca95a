// Paints a texel of the frame with the layer of objects in its direction; display values, premultiplied by coverage. FILMED: as
// the video's camera would show them, see engine/render/EquirectComposite.h.
uniform sampler2D layer;
uniform vec2 rayScale; // half extent of the layer's image plane at distance 1
uniform vec2 rayShift; // its centre
uniform sampler2D frame; // without objects
uniform sampler2D shadowsLeft; // SHADED: factor for the frame
noperspective in vec3 eyeRay;
out vec4 colour;

// Returns the background of the objects.
vec3 frameTexel() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 texel = texelFetch(frame, at, 0).rgb;
#ifdef SHADED
    texel *= textureLod(shadowsLeft, gl_FragCoord.xy / vec2(textureSize(frame, 0)), 0.0).rgb;
#endif
    return texel;
}

vec4 seen(vec3 ray) {
    vec2 place = (ray.xy / max(-ray.z, 1e-4) - rayShift) / rayScale; // in the layer, -1 to 1
    float inside = step(max(abs(place.x), abs(place.y)), 1.0);
    return inside * textureLod(layer, 0.5 * place + 0.5, 0.0);
}

#ifdef FILMED
noperspective in vec3 scatteredLight;
uniform float glare; // share of the light that is scattered
uniform vec3 black, range;
uniform sampler2D grain;
uniform ivec2 grainShift;
uniform float perGrain;
uniform float fineNoise[8], coarseNoise[8]; // standard deviation by luma
uniform vec2 shares; // 1: pairs of texels across (x) or down (y) share one colour

float luma(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
    vec4 c = seen(eyeRay);
    // Fragments are shaded in squares of 2 x 2, aligned with the codec's: two derivatives give the mean.
    vec2 aside = shares * (0.5 - mod(floor(gl_FragCoord.xy), 2.0));
    vec4 square = c + aside.x * dFdx(c) + aside.y * dFdy(c);
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 behind = frameTexel();
    if (c.a < 0.002) {
        colour = vec4(behind, 1.0);
        return;
    }
    vec3 own = c.rgb / c.a;
    if (square.a > 0.01) own = max(luma(own) + (square.rgb - luma(square.rgb)) / square.a, 0.0);
    own = black + range * own;
    vec3 light = mix(own * own, scatteredLight, glare);
    vec3 shown = sqrt(mix(behind * behind, light, c.a));
    vec2 grains = (2.0 * texelFetch(grain, (at + grainShift) & 255, 0).rg - 1.0) * perGrain;
    float band = clamp(8.0 * luma(shown) - 0.5, 0.0, 6.999);
    int below = int(band);
    vec2 deviation = mix(vec2(fineNoise[below], coarseNoise[below]), vec2(fineNoise[below + 1], coarseNoise[below + 1]),
                         band - float(below));
    shown += c.a * dot(grains, deviation);
    colour = vec4(shown, 1.0);
}
#else
void main() {
    vec4 c = seen(eyeRay);
    colour = vec4(c.rgb + (1.0 - c.a) * frameTexel(), 1.0);
}
#endif
