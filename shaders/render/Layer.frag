// Scales up a picture of objects; display values, premultiplied by how much of the texel they cover.
// FILMED: as the video's camera would have it, see engine/render/LayerLook.h. GRAINY: with its noise. SHARES_COLOUR:
// squares of texels have one colour, as codecs keep it.
uniform sampler2D layer;
noperspective in vec2 layerUv;
out vec4 colour;

#ifdef FILMED
uniform vec2 tap; // of the layer's extent
uniform vec3 black, range;
#ifdef GRAINY
uniform sampler2D grain;
uniform vec2 grainScale, grainShift;
uniform float perGrain;
uniform float fineNoise[8], coarseNoise[8]; // standard deviation by luma
#endif
#ifdef SHARES_COLOUR
uniform vec2 colours; // how many squares in the picture
#endif

float luma(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec4 around(vec2 uv) {
    vec2 other = vec2(tap.x, -tap.y);
    return 0.25 * (textureLod(layer, uv + tap, 0.0) + textureLod(layer, uv - tap, 0.0) +
                   textureLod(layer, uv + other, 0.0) + textureLod(layer, uv - other, 0.0));
}
#endif

void main() {
#ifdef FILMED
    vec4 c = around(layerUv);
#ifdef SHARES_COLOUR
    // Copied, as decoders do.
    vec4 square = textureLod(layer, (floor(layerUv * colours) + 0.5) / colours, 0.0);
    vec3 hue = square.rgb - luma(square.rgb);
    if (square.a > 0.01) c.rgb = luma(c.rgb) + hue * (c.a / square.a);
#endif
#ifdef GRAINY
    vec2 grains = (2.0 * texture(grain, layerUv * grainScale + grainShift).rg - 1.0) * perGrain;
    float band = clamp(8.0 * luma(c.rgb) / max(c.a, 1e-3) - 0.5, 0.0, 6.999);
    int below = int(band);
    float share = band - float(below);
    vec2 deviation = mix(vec2(fineNoise[below], coarseNoise[below]), vec2(fineNoise[below + 1], coarseNoise[below + 1]), share);
    c.rgb += c.a * dot(grains, deviation);
#endif
    colour = vec4(black * c.a + range * c.rgb, c.a);
#else
    colour = textureLod(layer, layerUv, 0.0);
#endif
}
