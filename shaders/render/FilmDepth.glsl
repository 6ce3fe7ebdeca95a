// Hides objects behind nearer parts of the film. Needs light/LatLong.glsl. Twin of engine/depth/DepthMap.h.
#include "render/Attributes.glsl"

uniform sampler2D filmDepth;  // inverse distance from the film's camera, lat-long; 1 is 1 / FILM_NEAREST_M
uniform vec3 eyeInFilm;       // env frame, metres from the film's camera; 0: the film is shown infinitely far

float filmInverse(vec3 dirEnv) { return textureLod(filmDepth, latLongFromDirection(dirEnv), 0.0).r * (1.0 / FILM_NEAREST_M); }

// Returns the inverse distance from the eye to the film's surface along a ray; 0: infinitely far. Method: see
// depth::filmDirectionSeen(); behind a depth edge it returns the last surface found before the edge.
float inverseAlong(vec3 dirEnv) {
    float eye2 = dot(eyeInFilm, eyeInFilm);
    if (eye2 == 0.0) return filmInverse(dirEnv);
    float along = dot(eyeInFilm, dirEnv), eye = sqrt(eye2), found = FILM_FOUND_RAD / eye;
    float inverse = 1.0 / FILM_NEAREST_M, before = 0.0;
    bool passed = false;
    for (int step = 0; step < FILM_MAX_STEPS; ++step) {
        float d = filmInverse(normalize(dirEnv + eyeInFilm * inverse));
        float met = d / (sqrt(1.0 + d * d * (along * along - eye2)) - along * d);
        if (abs(met - inverse) <= found) return met;
        if (passed) return before;
        passed = met > FILM_PASSED * inverse + found; // then once more, in case a step went past the surface
        if (!passed) before = met;
        inverse = passed ? met : max(met, inverse - FILM_STEP_RAD / eye);
    }
    return before;
}

// Returns by how much a place's inverse distance from the eye exceeds the film's there: negative where the film hides it.
float inverseBeforeFilm(vec3 fromEyeEnv) {
    float away = length(fromEyeEnv);
    return 1.0 / away - inverseAlong(fromEyeEnv / away);
}
