/* Light for objects from 360-degree video, for any engine: a lat-long frame in, textures and look-up
   constants out, just as the installed shaders sample them. README.md, installed beside the shaders, is the
   manual.

   Frames: +Y up. Row 0 of a frame is straight up, its centre column looks along -Z, columns grow to the
   right.

   Light: linear radiance, Rec. 709 primaries. A white video pixel is 11.8 (README.md, "The formula") unless
   SHOAL_LIGHT_FRAMES says otherwise. Maps hold 0 to 65504: SHOAL_LIGHT_SCALED_MAPS.

   Threads: different makers and lights may be used on different threads at once. One maker: one thread at a
   time. One light: any number of readers, or one shoalLightMake() that writes it.

   Errors: functions that can fail return a status; shoalLightError() says why. Nothing throws.

   Version: within a major version structs keep their layout and functions their meaning; what is new comes as
   new functions and new values of enumerations. */
#ifndef SHOAL_LIGHT_H
#define SHOAL_LIGHT_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define SHOAL_LIGHT_API __attribute__((visibility("default")))
#else
#define SHOAL_LIGHT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ShoalLightStatus {
    SHOAL_LIGHT_OK = 0,
    SHOAL_LIGHT_BAD_ARGUMENT = 1,
    SHOAL_LIGHT_OUT_OF_MEMORY = 2
} ShoalLightStatus;

/* The calling thread's last failure as one sentence without a full stop; "" before the first. Valid until the
   thread's next failure. */
SHOAL_LIGHT_API const char* shoalLightError(void);

/* Returns the version of the linked library, "MAJOR.MINOR.PATCH". */
SHOAL_LIGHT_API const char* shoalLightVersion(void);

/* ---- A frame ---- */

typedef enum ShoalLightFormat {
    /* 8 bits a channel, coded for a display, as video decoders give them. Alpha is ignored. The two formats
       with three bytes a pixel are read in place; pixels with alpha are copied first. */
    SHOAL_LIGHT_BGR8 = 0, /* OpenCV's order */
    SHOAL_LIGHT_RGB8 = 1,
    SHOAL_LIGHT_BGRA8 = 2,
    SHOAL_LIGHT_RGBA8 = 3,
    /* 32-bit floats: linear radiance, of an HDR picture. NaN and negative values become 0, infinity becomes
       65504, other values above 10^9 become 10^9. */
    SHOAL_LIGHT_RGB32F = 4,
    SHOAL_LIGHT_RGBA32F = 5
} ShoalLightFormat;

/* A view of the caller's pixels: the whole sphere, or one eye's rectangle of a stereo frame. */
typedef struct ShoalLightFrame {
    const void* pixels;    /* the top left pixel */
    int32_t width, height; /* pixels, 2 to 16384; any shape is taken as the whole sphere */
    ptrdiff_t rowBytes;    /* from one row to the next; 0: no gaps; negative: bottom row is stored first */
    int32_t format;        /* a ShoalLightFormat */
} ShoalLightFrame;

/* ---- Making light ---- */

typedef enum ShoalLightQuality {
    SHOAL_LIGHT_VIDEO = 0, /* as accurate as 8 bits a channel need */
    /* for stills, whose sun may be 10^5 times as bright as the shade: texels a quarter as wide */
    SHOAL_LIGHT_STILL = 1
} ShoalLightQuality;

typedef struct ShoalLightOptions {
    int32_t quality; /* a ShoalLightQuality */
    /* Perceptual roughness (glTF's) of the smoothest surface that will be lit, 0 to 1; smoother surfaces
       look as rough as this. Below 0.1 mirror maps are made too; with widestMirror^2 / 2 texels. */
    float leastRoughness;
    /* Width in texels of the widest mirror map, 256 to 8192; rounded down to a power of two. Filtered maps
       are never wider. */
    int32_t widestMirror;
} ShoalLightOptions;

/* Returns the defaults: SHOAL_LIGHT_VIDEO, roughness 0.25, mirrors of 512. */
SHOAL_LIGHT_API ShoalLightOptions shoalLightDefaults(void);

typedef struct ShoalLightMaker ShoalLightMaker; /* keeps filter kernels and buffers between frames */
typedef struct ShoalLight ShoalLight;           /* the light made from one frame */

/* options: NULL for the defaults. *maker is NULL after a failure. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMakerCreate(const ShoalLightOptions* options,
                                                       ShoalLightMaker** maker);
SHOAL_LIGHT_API void shoalLightMakerDestroy(ShoalLightMaker* maker); /* NULL: nothing */

typedef enum ShoalLightSetting {
    SHOAL_LIGHT_FRAMES = 0, /* a ShoalLightFrames, of the 8-bit formats; SHOAL_LIGHT_THESIS unless set */
    /* 0: maps are clamped to 65504. 1: if a light is brighter than that, all its maps are divided by its
       shoalLightScale(); shaders then need #define SCALED_LIGHT and uniform float lightScale. */
    SHOAL_LIGHT_SCALED_MAPS = 1,
    SHOAL_LIGHT_FIND_SOURCES = 2 /* 1: find sources for shoalLightSources(); 0: do not */
} ShoalLightSetting;

typedef enum ShoalLightFrames {
    SHOAL_LIGHT_THESIS = 0, /* "The formula" of README.md */
    SHOAL_LIGHT_SRGB = 1,   /* decoded sRGB: white is 1 */
    /* SHOAL_LIGHT_SRGB with an estimate of the clipped light's true radiance, made from the light that the
       ground reflects. */
    SHOAL_LIGHT_SRGB_UNCLIPPED = 2
} ShoalLightFrames;

/* Changes a setting between frames; SHOAL_LIGHT_FRAMES makes the next frame's tables anew. Since 1.1. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMakerSet(ShoalLightMaker* maker, int32_t setting, int32_t value);

/* Creates an empty light. Until shoalLightMake() fills it, it is black and has no maps. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightCreate(ShoalLight** light);
SHOAL_LIGHT_API void shoalLightDestroy(ShoalLight* light); /* NULL: nothing */

/* Makes the light of a frame and replaces what light held. The first frame of a size makes tables (0.02 s to
   2 s); after that nothing is allocated for a light that was made before. The frame's pixels are not used
   after the return. A failure leaves light unchanged, or, if memory ran out, empty. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMake(ShoalLightMaker* maker, const ShoalLightFrame* frame,
                                                ShoalLight* light);

/* ---- For shaders: shaders/light/Environment.glsl ---- */

/* A texture: rows from the top, four half floats a texel, alpha 1, no gaps. Without one: NULL, 0, 0. */
typedef struct ShoalLightTexture {
    const uint16_t* rgba;
    int32_t width, height;
} ShoalLightTexture;

/* The maps and constants of a light, named as Environment.glsl's uniforms. Pointers are valid until the light
 * is made anew or destroyed. */
typedef struct ShoalLightMaps {
    /* sampler2D lightMap: linear, no mipmaps, clamped. */
    ShoalLightTexture lightMap;
    const float* lightPlaces; /* vec4 lightPlaces[17]: 4 mapCount floats */
    int32_t mapCount;         /* float smoothestMap = mapCount - 1; 1 to 17 */
    /* sampler2D radianceMap, only if leastRoughness is below 0.1 (#define MIRRORS); else mirrorLevels is 0.
       mirrors are all of its mipmaps; trilinear, wrapping in u, clamped in v. */
    int32_t mirrorLevels;             /* int mirrorLevels; 0 to 5 */
    const ShoalLightTexture* mirrors; /* mirrorLevels, widest first */
    const float* mirrorRoughness;     /* float mirrorRoughness[6]: mirrorLevels + 1 floats */
} ShoalLightMaps;

SHOAL_LIGHT_API void shoalLightMaps(const ShoalLight* light, ShoalLightMaps* maps);

/* Returns the factor from map values to radiance: 1, or more with SHOAL_LIGHT_SCALED_MAPS. Since 1.1. */
SHOAL_LIGHT_API float shoalLightScale(const ShoalLight* light);

/* A light source that casts shadows, such as a sun, a window or a lamp. */
typedef struct ShoalLightSource {
    float direction[3];  /* towards it, unit length */
    float radius;        /* angular radius in radians, of a uniform disc with the same spread */
    float irradiance[3]; /* of this source alone, on a plane that faces it; the maps include it */
    float share;         /* its share of the luminance of all light on that plane, 0 to 1 */
} ShoalLightSource;

/* Writes at most room sources (never more than 3), strongest first. Returns their number. Since 1.1. */
SHOAL_LIGHT_API int32_t shoalLightSources(const ShoalLight* light, ShoalLightSource* sources, int32_t room);

/* Makes sampler2D dfgTable of shaders/light/Surface.glsl, which is the same for every light: size x size
   texels of two floats; linear, no mipmaps, clamped. size: 2 to 1024, 64 is enough. scaleBias: room for 2
   size^2 floats. A row of 64 texels takes 0.1 ms. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightSurfaceTable(int32_t size, float* scaleBias);

/* ---- Without a shader: vertices, probes, tests ---- */

/* Computes the radiance that a white matte surface reflects: irradiance / pi. normal: unit length. */
SHOAL_LIGHT_API void shoalLightDiffuse(const ShoalLight* light, const float normal[3], float radiance[3]);

/* Computes the radiance filtered by a GGX lobe around a direction. direction: the mirrored view, unit length;
 * roughness: perceptual. */
SHOAL_LIGHT_API void shoalLightGlossy(const ShoalLight* light, const float direction[3], float roughness,
                                      float radiance[3]);

/* Decodes 8-bit formats by the thesis' curve, and back (shaders/light/ToneCurve.glsl). display: 0 to 1. */
SHOAL_LIGHT_API void shoalLightRadianceFromDisplay(const float display[3], float radiance[3]);
SHOAL_LIGHT_API void shoalLightDisplayFromRadiance(const float radiance[3], float display[3]);

#ifdef __cplusplus
}
#endif

#endif
