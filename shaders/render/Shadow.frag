in vec3 factor;
out vec4 colour;

#ifdef COVERED
uniform sampler2D cover;
uniform vec2 coverScale, coverShift; // from pixels
#endif

void main() {
    colour = vec4(factor, 1.0);
#ifdef COVERED
    colour.rgb = mix(factor, vec3(1.0), textureLod(cover, gl_FragCoord.xy * coverScale + coverShift, 0.0).a);
#endif
}
