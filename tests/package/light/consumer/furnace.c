/* Each function once, of a light that is known: that in a white sphere. Exits 1 with what was wrong. */
#include <ShoalLight.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 256, HEIGHT = 128 };

static int failures = 0;

static void near(const char* what, double value, double wanted, double tolerance) {
    if (fabs(value - wanted) <= tolerance) return;
    fprintf(stderr, "%s is %.6f instead of %.6f\n", what, value, wanted);
    ++failures;
}

static void must(ShoalLightStatus status) {
    if (status == SHOAL_LIGHT_OK) return;
    fprintf(stderr, "%s\n", shoalLightError());
    exit(1);
}

int main(void) {
    static float pixels[4 * WIDTH * HEIGHT];
    const float up[3] = {0, 1, 0};
    float radiance[3], table[2 * 16 * 16];
    ShoalLightFrame frame = {pixels, WIDTH, HEIGHT, 0, SHOAL_LIGHT_RGBA32F};
    ShoalLightOptions options = shoalLightDefaults();
    ShoalLightMaker* maker;
    ShoalLight* light;
    ShoalLightMaps maps;
    ShoalLightSource source;

    must(shoalLightMakerCreate(&options, &maker));
    must(shoalLightMakerSet(maker, SHOAL_LIGHT_FIND_SOURCES, 0));
    must(shoalLightCreate(&light));
    for (int i = 0; i < 4 * WIDTH * HEIGHT; ++i) pixels[i] = 1;
    must(shoalLightMake(maker, &frame, light));
    shoalLightDiffuse(light, up, radiance);
    near("matte light", radiance[1], 1, 1e-4);
    shoalLightGlossy(light, up, 0.3f, radiance);
    near("what a glossy surface shows", radiance[0], 1, 1e-4);
    shoalLightDisplayFromRadiance(radiance, radiance);
    shoalLightRadianceFromDisplay(radiance, radiance);
    near("light, displayed and back", radiance[2], 1, 1e-3);
    shoalLightMaps(light, &maps); /* 1 as a half float is 0x3c00, a unit more or less 0.05 % */
    near("a half float of the light map", maps.lightMap.rgba[0], 0x3c00, 1);
    near("the maps' scale", shoalLightScale(light), 1, 0);
    near("sources", shoalLightSources(light, &source, 1), 0, 0);
    must(shoalLightSurfaceTable(16, table));
    near("a smooth surface's white albedo", table[2 * 15] + table[2 * 15 + 1], 1, 0.01);

    frame.width = 1;
    near("a frame of one column", shoalLightMake(maker, &frame, light), SHOAL_LIGHT_BAD_ARGUMENT, 0);
    near("the word in the reason", strstr(shoalLightError(), "width") != NULL, 1, 0);
    near("the library's version", shoalLightVersion()[0], '1', 0);
    shoalLightDestroy(light);
    shoalLightMakerDestroy(maker);
    return failures > 0;
}
