/* Light that is known: of a white sphere, of a white half, of a white video. Exits 1 with what was wrong. */
#include <ShoalLight.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 256, HEIGHT = 128 };

static int failures = 0;

static void near(const char* what, double value, double wanted, double tolerance) {
    printf("%s: %.6f (%.6f)\n", what, value, wanted);
    if (!(fabs(value - wanted) <= tolerance)) {
        fprintf(stderr, "%s is %.6f instead of %.6f\n", what, value, wanted);
        ++failures;
    }
}

static void must(ShoalLightStatus status) {
    if (status == SHOAL_LIGHT_OK) return;
    fprintf(stderr, "%s\n", shoalLightError());
    exit(1);
}

static double irradiance(const ShoalLight* light, float x, float y, float z) {
    const float normal[3] = {x, y, z};
    float radiance[3];
    shoalLightDiffuse(light, normal, radiance);
    return 3.14159265358979 * radiance[1];
}

int main(void) {
    static float pixels[HEIGHT][WIDTH][4];
    static unsigned char white[HEIGHT][WIDTH][3];
    const float up[3] = {0, 1, 0};
    float radiance[3], table[2 * 16 * 16];
    ShoalLightFrame frame = {pixels, WIDTH, HEIGHT, 0, SHOAL_LIGHT_RGBA32F};
    ShoalLightOptions options = shoalLightDefaults();
    ShoalLightMaker* maker;
    ShoalLight* light;
    ShoalLightMaps maps;

    options.leastRoughness = 0;
    must(shoalLightMakerCreate(&options, &maker));
    must(shoalLightCreate(&light));

    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            for (int c = 0; c < 4; ++c) pixels[y][x][c] = 1;
    must(shoalLightMake(maker, &frame, light));
    near("irradiance in a white furnace", irradiance(light, 0.6f, 0.0f, 0.8f), 3.14159265, 1e-4);
    for (int k = 0; k <= 10; ++k) {
        shoalLightGlossy(light, up, (float)k / 10, radiance);
        near("what mirrors of any roughness show of it", radiance[0], 1, 1e-4);
    }
    shoalLightMaps(light, &maps);
    near("maps down to a roughness of 0.1", maps.mapCount, 17, 0);
    near("mirrors", maps.mirrorLevels >= 1 && maps.mirrorLevels <= 5, 1, 0);
    for (int i = 0; i < 4;
         ++i) /* of the first map: 1 as a half float is 0x3c00, a unit more or less 0.05 % */
        near("a half float of the light map", maps.lightMap.rgba[i], 0x3c00, 1);

    /* A surface whose normal leans from the pole of a white half sphere by t has pi (1 + cos t) / 2. */
    memset(pixels[HEIGHT / 2], 0, sizeof pixels / 2);
    must(shoalLightMake(maker, &frame, light));
    near("irradiance below a white half", irradiance(light, 0, 1, 0), 3.14159265, 0.01);
    near("irradiance beside a white half", irradiance(light, 1, 0, 0), 1.57079633, 0.01);
    near("irradiance above a white half", irradiance(light, 0, -1, 0), 0, 0.01);

    memset(white, 255, sizeof white);
    frame.pixels = white;
    frame.format = SHOAL_LIGHT_BGR8;
    must(shoalLightMake(maker, &frame, light));
    near("irradiance in a white video", irradiance(light, 0, 0, -1), 11.8 * 3.14159265, 11.8e-3);

    must(shoalLightSurfaceTable(16, table));
    near("a smooth surface's white albedo", table[2 * 15] + table[2 * 15 + 1], 1, 0.01);

    frame.width = 1;
    near("the status of a frame of one column", shoalLightMake(maker, &frame, light),
         SHOAL_LIGHT_BAD_ARGUMENT, 0);
    near("a reason is given", strstr(shoalLightError(), "width") != NULL, 1, 0);
    near("the light is as it was", irradiance(light, 0, 0, -1), 11.8 * 3.14159265, 11.8e-3);

    shoalLightDestroy(light);
    shoalLightMakerDestroy(maker);
    return failures > 0;
}
