// A shallow reef in sunlight, seen in every direction from a diver's place, as a camera would film it. Everything moves in
// whole numbers of cycles a loop, so the last frame leads into the first.
#include "light/LatLong.glsl"

uniform float turn;        // 0 to 1 through the loop
uniform float frameNumber; // seeds the sensor's noise
uniform bool linearOut;    // true radiance instead of the camera's picture
in vec2 uv;
out vec4 colour;

const float kSurface = 7.5; // metres above the eye
const float kFloor = -2.4;
// Towards the sun, under water: 62 degrees high in the air is 69 below the surface (Snell).
const vec3 kSun = normalize(vec3(-0.30, 0.93, -0.22));
const vec3 kSunAir = normalize(vec3(-0.40, 0.87, -0.29));
// Per metre: what water takes from a beam, by red, green and blue; of a clear coastal sea, red the most.
const vec3 kExtinction = vec3(0.22, 0.120, 0.098);
const vec3 kAbsorbDown = vec3(0.115, 0.050, 0.042);

uint hash(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    return v.x;
}
float unit(ivec3 cell) { return float(hash(uvec3(cell + 32768)) >> 8) / 16777216.0; }

float noise(vec3 p) {
    ivec3 c = ivec3(floor(p));
    vec3 f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    float a = mix(unit(c), unit(c + ivec3(1, 0, 0)), f.x), b = mix(unit(c + ivec3(0, 1, 0)), unit(c + ivec3(1, 1, 0)), f.x);
    float d = mix(unit(c + ivec3(0, 0, 1)), unit(c + ivec3(1, 0, 1)), f.x);
    float e = mix(unit(c + ivec3(0, 1, 1)), unit(c + ivec3(1, 1, 1)), f.x);
    return mix(mix(a, b, f.y), mix(d, e, f.y), f.z);
}

float fbm(vec3 p) { return 0.55 * noise(p) + 0.28 * noise(p * 2.1 + 7.3) + 0.17 * noise(p * 4.3 + 1.7); }

// Waves: a sum of sines. Gradient in xy, and the second derivatives xx, zz, xz for the caustics.
void waves(vec2 p, float scale, out vec2 slope, out vec3 bend) {
    slope = vec2(0.0);
    bend = vec3(0.0);
    for (int i = 0; i < 9; ++i) {
        float fi = float(i);
        float angle = fi * 2.39996 + 0.4;
        float k = scale * (0.55 + 0.42 * fi);
        vec2 dir = vec2(cos(angle), sin(angle)) * k;
        float cycles = floor(sqrt(k) * 3.2) + 1.0; // deep water: frequency goes with the root of the wave number
        float phase = dot(dir, p) - turn * 6.2831853 * cycles + fi * 1.7;
        float height = 0.055 / (k * (1.0 + 0.25 * fi));
        float s = sin(phase), c = cos(phase);
        slope += height * c * dir;
        bend -= height * s * vec3(dir.x * dir.x, dir.y * dir.y, dir.x * dir.y);
    }
}

// Sunlight gathered by the waves above a point, 1 on average: the inverse of how much a bundle of rays has been spread.
float caustic(vec3 p, float sharpness) {
    vec2 at = p.xz + kSun.xz / kSun.y * (kSurface - p.y);
    vec2 warp;
    vec3 unused;
    waves(at * 0.37 + 3.1, 1.0, warp, unused);
    vec2 slope;
    vec3 h;
    waves(at + warp * 2.0, 3.4, slope, h);
    float depth = sharpness;
    float area = (1.0 + depth * h.x) * (1.0 + depth * h.y) - depth * depth * h.z * h.z;
    return min(1.0 / (abs(area) + 0.20), 4.0) * 0.85;
}

float smin(float a, float b, float k) {
    float h = max(k - abs(a - b), 0.0) / k;
    return min(a, b) - h * h * k * 0.25;
}

float sand(vec2 p) {
    float swell = 0.55 * noise(vec3(p * 0.22, 3.0)) - 0.3;
    float ripple = sin(p.x * 5.5 + p.y * 2.2 + 3.0 * noise(vec3(p * 0.6, 9.0))) * 0.016;
    return kFloor + swell + ripple;
}

// What is hit: 0 sand, 1 rock, 2 and above kinds of coral.
float kind;

float scene(vec3 p, bool fine) {
    float d = (p.y - sand(p.xz)) * 0.8;
    kind = 0.0;
    // A reef wall to the right and behind, rising towards the surface.
    float face = 4.6 - p.x * 0.93 + p.z * 0.36;
    float wall = face + 2.6 * (fbm(p * 0.33) - 0.5) + 0.28 * (p.y - kFloor);
    if (fine) wall += 0.5 * (fbm(p * 1.6) - 0.5);
    wall = max(wall, p.y - 2.2 - 2.2 * noise(vec3(p.xz * 0.4, 1.0)));
    if (wall * 0.6 < d) { d = wall * 0.6; kind = 1.0; }
    // Boulders and coral heads, one to a cell.
    vec2 cell = floor(p.xz / 2.7);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            ivec2 c = ivec2(cell) + ivec2(i, j);
            float u = unit(ivec3(c, 1));
            vec2 middle = (vec2(c) + 0.25 + 0.5 * vec2(unit(ivec3(c, 2)), unit(ivec3(c, 3)))) * 2.7;
            float away = length(middle);
            if (u > 0.80 || away < 2.0) continue;
            float radius = 0.34 + 0.85 * unit(ivec3(c, 4)) * smoothstep(1.0, 4.5, away);
            vec3 q = p - vec3(middle.x, sand(middle) - 0.1, middle.y);
            float bound = length(q) - radius * 1.8;
            if (bound > 0.35) { d = min(d, bound); continue; }
            float sort = unit(ivec3(c, 5));
            float body;
            float k = 1.0;
            if (sort < 0.42) { // boulder
                body = length(q / vec3(1.15, 0.75, 1.0)) - radius;
                body += 0.55 * radius * (fbm(p * 1.5 / radius + u * 40.0) - 0.5);
                if (fine) body += 0.06 * (noise(p * 11.0) - 0.5);
            } else if (sort < 0.66) { // massive coral: a knobbly dome
                body = length(q / vec3(1.0, 0.85, 1.0)) - radius * 0.85;
                float groove = noise(p * 9.0 / (0.5 + radius)) ;
                body -= 0.10 * radius * (1.0 - abs(2.0 * groove - 1.0));
                k = 2.0 + floor(unit(ivec3(c, 6)) * 3.0);
            } else if (sort < 0.85) { // table coral on a stem
                vec3 t = q - vec3(0.0, radius * 0.95, 0.0);
                float plate = max(length(t.xz) - radius * (1.2 + 0.25 * noise(p * 3.0)), abs(t.y + 0.10 * length(t.xz)) - 0.045);
                body = smin(plate, max(length(q.xz) - 0.16 * radius - 0.1, q.y - radius), 0.2);
                if (fine) body += 0.05 * (noise(p * 17.0) - 0.5);
                k = 2.0 + floor(unit(ivec3(c, 6)) * 3.0);
            } else { // branching coral: a dome eaten by a lattice
                float dome = length(q / vec3(1.0, 0.8, 1.0)) - radius * 0.9;
                vec3 g = p * (7.5 / (0.6 + radius)) + 0.8 * noise(p * 4.0);
                float branches = dot(sin(g), cos(g.yzx)) * 0.085 * (0.6 + radius);
                body = max(dome, branches);
                k = 2.0 + floor(unit(ivec3(c, 6)) * 3.0);
            }
            body *= 0.6;
            if (body < d) { d = body; kind = k; }
        }
    // Sea whips that sway.
    vec2 whip = floor(p.xz / 1.15);
    if (p.y < kFloor + 1.8) {
        ivec2 c = ivec2(whip);
        if (unit(ivec3(c, 11)) < 0.16 && length((vec2(c) + 0.5) * 1.15) > 2.0) {
            vec2 foot = (vec2(c) + 0.35 + 0.3 * vec2(unit(ivec3(c, 12)), unit(ivec3(c, 13)))) * 1.15;
            float tall = 0.5 + 0.7 * unit(ivec3(c, 14));
            float up = clamp(p.y - sand(foot), 0.0, tall);
            float sway = sin(turn * 6.2831853 * 2.0 + float(c.x) + up * 1.5) * 0.10 + 0.06;
            for (int b = 0; b < 3; ++b) {
                vec2 lean = vec2(cos(float(b) * 2.1 + float(c.y)), sin(float(b) * 2.1 + float(c.y))) * 0.20;
                vec2 axis = foot + lean * up + vec2(sway, 0.4 * sway) * up * up;
                float stalk = (length(vec3(p.x - axis.x, max(p.y - sand(foot) - tall, 0.0), p.z - axis.y)) - 0.022) * 0.7;
                if (stalk < d) { d = stalk; kind = 5.0; }
            }
        }
    }
    return d;
}

vec3 normalAt(vec3 p) {
    const float e = 0.006;
    float d = scene(p, true);
    return normalize(vec3(scene(p + vec3(e, 0, 0), true), scene(p + vec3(0, e, 0), true), scene(p + vec3(0, 0, e), true)) - d);
}

// Light that the water itself sends from a direction, far away: bright towards the surface and the sun, dark below.
vec3 waterGlow(vec3 dir) {
    vec3 deep = vec3(0.004, 0.022, 0.055), level = vec3(0.012, 0.085, 0.190), high = vec3(0.045, 0.235, 0.400);
    float up = dir.y;
    vec3 glow = up < 0.0 ? mix(level, deep, smoothstep(0.0, -0.85, up)) : mix(level, high, smoothstep(0.0, 0.85, up));
    float s = max(dot(dir, kSun), 0.0);
    return glow * (1.0 + 0.9 * pow(s, 3.0) + 1.6 * pow(s, 14.0));
}

vec3 sky(vec3 dir) {
    float s = max(dot(dir, kSunAir), 0.0);
    vec3 blue = mix(vec3(0.85, 0.95, 1.05), vec3(0.34, 0.56, 0.95), smoothstep(0.0, 0.7, dir.y));
    float cloud = smoothstep(0.52, 0.75, fbm(vec3(dir.xz / (0.25 + dir.y) * 1.3, 4.0)));
    blue = mix(blue, vec3(1.25), 0.6 * cloud);
    return 1.5 * blue + vec3(1.0, 0.93, 0.80) * (400.0 * smoothstep(0.9975, 0.9992, s) + 9.0 * pow(s, 60.0));
}

vec3 surfaceFromBelow(vec3 eye, vec3 dir, out float distance_m) {
    distance_m = (kSurface - eye.y) / dir.y;
    vec3 p = eye + dir * distance_m;
    vec2 slope, fine;
    vec3 unused;
    waves(p.xz, 0.85, slope, unused);
    waves(p.xz * 1.7 + 5.0, 1.9, fine, unused);
    float calm = 1.0 / (1.0 + distance_m * 0.035); // far waves average out
    vec3 n = normalize(vec3((slope + 0.5 * fine) * calm, -1.0).xzy);
    vec3 out_ = refract(dir, n, 1.333);
    vec3 mirrored = reflect(dir, n);
    vec3 below = waterGlow(vec3(mirrored.x, min(mirrored.y, -0.02), mirrored.z)) * 1.15;
    if (dot(out_, out_) < 0.5) return below;
    float ci = -dot(dir, n), ct = abs(dot(out_, n));
    float rs = (1.333 * ci - ct) / (1.333 * ci + ct), rp = (ci - 1.333 * ct) / (ci + 1.333 * ct);
    float fresnel = clamp(0.5 * (rs * rs + rp * rp), 0.0, 1.0);
    return mix(sky(normalize(out_)) * 0.95, below, fresnel);
}

vec3 albedo(vec3 p, vec3 n) {
    float patchy = fbm(p * 2.3);
    if (kind < 0.5) return mix(vec3(0.36, 0.31, 0.22), vec3(0.50, 0.45, 0.35), noise(p * 3.0)) * (0.86 + 0.22 * noise(p * 60.0));
    vec3 rock = mix(vec3(0.17, 0.145, 0.11), vec3(0.36, 0.30, 0.24), patchy);
    rock = mix(rock, vec3(0.42, 0.16, 0.23), smoothstep(0.56, 0.70, noise(p * 2.9 + 11.0)));        // coralline algae
    rock = mix(rock, vec3(0.20, 0.27, 0.09), smoothstep(0.50, 0.75, noise(p * 1.7 + 30.0)) * 0.8 * max(n.y, 0.0)); // turf
    rock = mix(rock, vec3(0.70, 0.36, 0.10), smoothstep(0.72, 0.78, noise(p * 4.1 + 50.0)) * 0.8);  // sponges
    if (kind < 1.5) return rock;
    vec3 tint = kind < 2.5 ? vec3(0.55, 0.40, 0.17) : kind < 3.5 ? vec3(0.42, 0.24, 0.42) : kind < 4.5 ? vec3(0.62, 0.52, 0.32) : vec3(0.55, 0.16, 0.12);
    return tint * (0.65 + 0.6 * patchy);
}

// Shafts: how much gathered sunlight lies along the ray, against the average of 1.
float shafts(vec3 eye, vec3 dir, float reach) {
    float sum = 0.0, weight = 0.0;
    float jitter = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    for (int i = 0; i < 10; ++i) {
        float t = min(reach, 14.0) * (float(i) + jitter) / 10.0;
        vec3 p = eye + dir * t;
        if (p.y > kSurface) break;
        float w = exp(-0.16 * t);
        vec2 at = p.xz + kSun.xz / kSun.y * (kSurface - p.y);
        vec2 slope;
        vec3 h;
        waves(at * 0.75, 0.9, slope, h);
        float gathered = 1.0 / (abs((1.0 + 3.0 * h.x) * (1.0 + 3.0 * h.y)) + 0.35);
        sum += w * min(gathered, 3.0);
        weight += w;
    }
    return sum / max(weight, 1e-3);
}

float snow(vec3 dir) {
    float light = 0.0;
    for (int shell = 0; shell < 3; ++shell) {
        float r = 5.0 + 5.0 * float(shell);
        float a = turn * 6.2831853;
        vec3 p = dir * r + vec3(0.30 * sin(a), 0.22 * sin(a + 1.0), 0.25 * cos(a)) * (1.0 + float(shell));
        ivec3 c = ivec3(floor(p));
        if (unit(c + 77 * (shell + 1)) > 0.22) continue;
        vec3 at = 0.3 + 0.4 * vec3(unit(c + 100), unit(c + 200), unit(c + 300));
        float d = length(cross(fract(p) - at, dir));
        float size = 0.012 + 0.030 * unit(c + 400);
        light += smoothstep(size, size * 0.35, d) * (0.25 + 0.5 * unit(c + 500)) / (1.0 + float(shell));
    }
    return light;
}

vec3 radiance(vec3 eye, vec3 dir) {
    float t = 0.05, d = 0.0;
    bool hit = false;
    const float kFar = 26.0;
    for (int i = 0; i < 90; ++i) {
        vec3 p = eye + dir * t;
        if (dir.y > 0.0 && p.y > 5.0) break;
        d = scene(p, t < 7.0);
        if (d < 0.0012 * t + 0.001) { hit = true; break; }
        t += max(d, 0.004);
        if (t > kFar) break;
    }
    vec3 seen = vec3(0.0);
    float distance_m = 60.0;
    if (hit) {
        vec3 p = eye + dir * t;
        float what = kind;
        vec3 n = normalAt(p);
        kind = what;
        vec3 base = albedo(p, n);
        float open = clamp(0.5 + 0.5 * scene(p + n * 0.30, false) / 0.30, 0.15, 1.0) *
                     clamp(0.55 + 0.45 * scene(p + n * 0.9, false) / 0.9, 0.25, 1.0);
        float shadow = 1.0;
        for (int i = 0; i < 9; ++i) {
            float s = 0.10 + 0.20 * float(i) * float(i + 2) * 0.22;
            shadow = min(shadow, 0.5 + 0.5 * scene(p + kSun * s, false) / (0.05 + 0.11 * s));
        }
        shadow = smoothstep(0.0, 1.0, clamp(shadow, 0.0, 1.0));
        vec3 down = exp(-kAbsorbDown * (kSurface - p.y));
        float focus = mix(caustic(p, 2.3), 1.0, smoothstep(4.0, 16.0, t) * 0.7);
        vec3 sunlight = vec3(2.5, 2.4, 2.2) * down * focus * shadow * max(dot(n, kSun), 0.0);
        vec3 ambient = (0.55 * waterGlow(vec3(0, 1, 0)) * (0.5 + 0.5 * n.y) + 0.45 * waterGlow(normalize(vec3(n.x, 0.1, n.z))) +
                        0.12 * vec3(0.35, 0.33, 0.24) * (0.5 - 0.5 * n.y)) * open;
        seen = base * (sunlight / 1.9 + 2.2 * ambient);
        distance_m = t;
    } else if (dir.y > 0.02) {
        seen = surfaceFromBelow(eye, dir, distance_m);
    }
    vec3 through = exp(-kExtinction * min(distance_m, 60.0) * (dir.y > 0.0 && !hit ? 0.55 : 1.0));
    float rays = shafts(eye, dir, distance_m);
    float towards = max(dot(dir, kSun), 0.0);
    vec3 glow = waterGlow(dir) * mix(1.0, rays, 0.16 + 0.45 * towards * towards);
    return seen * through + glow * (1.0 - through) + waterGlow(vec3(0, 1, 0)) * snow(dir) * 0.5;
}

void main() {
    vec2 at = uv;
    float longitude = (at.x - 0.5) * 2.0 * kPi, latitude = (0.5 - at.y) * kPi;
    vec3 dir = vec3(cos(latitude) * sin(longitude), sin(latitude), -cos(latitude) * cos(longitude));
    float a = turn * 6.2831853;
    vec3 eye = vec3(0.10 * sin(a), 0.05 * sin(2.0 * a), 0.10 * cos(a) - 0.10); // the diver's drift
    vec3 lin = radiance(eye, dir);
    if (linearOut) {
        colour = vec4(lin, 1.0);
        return;
    }
    // The camera: underwater white balance, a soft shoulder that still clips at the sun, coding, noise.
    vec3 c = lin * vec3(1.75, 1.0, 0.98) * 1.2;
    c = mix(vec3(dot(c, vec3(0.2126, 0.7152, 0.0722))), c, 1.08);
    c = max(c, 0.0);
    c = c * (1.0 + 0.12 * c) / (1.0 + 0.62 * c);
    c = mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
    ivec3 seed = ivec3(ivec2(gl_FragCoord.xy), int(frameNumber));
    float grain = unit(seed) + unit(seed + ivec3(0, 0, 9999)) - 1.0;
    colour = vec4(clamp(c + grain * 0.010, 0.0, 1.0), 1.0);
}
