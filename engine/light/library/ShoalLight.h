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
    /* 8 bits a channel, coded for a display, as video decoders give them. Alpha is not looked at. The two of
       three bytes a pixel are read where they lie; the others are copied first. */
    SHOAL_LIGHT_BGR8 = 0, /* OpenCV's order */
    SHOAL_LIGHT_RGB8 = 1,
    SHOAL_LIGHT_BGRA8 = 2,
    SHOAL_LIGHT_RGBA8 = 3,
    /* 32-bit floats: linear radiance, of an HDR picture. NaN and negative values become 0, infinite ones
       65504, those above 10^9 that. */
    SHOAL_LIGHT_RGB32F = 4,
    SHOAL_LIGHT_RGBA32F = 5
} ShoalLightFormat;

/* The whole sphere, or one eye's rectangle of a stereo frame. */
typedef struct ShoalLightFrame {
    const void* pixels;    /* the top left pixel */
    int32_t width, height; /* pixels, 2 to 16384; any shape is taken as the whole sphere */
    ptrdiff_t rowBytes;    /* from one row to the next; 0: without a gap; below 0: rows from the bottom */
    int32_t format;        /* a ShoalLightFormat */
} ShoalLightFrame;

/* ---- Making light ---- */

typedef enum ShoalLightQuality {
    SHOAL_LIGHT_VIDEO = 0, /* as accurate as 8 bits a channel need */
    /* For surrounds made once, whose sun may be 10^5 times their shade: texels a quarter as wide. */
    SHOAL_LIGHT_STILL = 1
} ShoalLightQuality;

typedef struct ShoalLightOptions {
    int32_t quality; /* a ShoalLightQuality */
    /* Perceptual roughness (glTF's) of the smoothest surface that will be lit, 0 to 1; smoother ones
       look as rough. Below 0.1 mirrors are made too, which cost an upload of widestMirror^2 / 2 texels. */
    float leastRoughness;
    /* Texels around the widest picture that a mirror shows, 256 to 8192; rounded down to a power of two.
       Filtered maps are never wider. */
    int32_t widestMirror;
} ShoalLightOptions;

/* Video, 0.25, 512. */
SHOAL_LIGHT_API ShoalLightOptions shoalLightDefaults(void);

typedef struct ShoalLightMaker ShoalLightMaker; /* keeps kernels and scratch between frames */
typedef struct ShoalLight ShoalLight;           /* what one frame gives */

/* options: NULL for the defaults. *maker is NULL after a failure. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMakerCreate(const ShoalLightOptions* options,
                                                       ShoalLightMaker** maker);
SHOAL_LIGHT_API void shoalLightMakerDestroy(ShoalLightMaker* maker); /* NULL: nothing */

typedef enum ShoalLightSetting {
    SHOAL_LIGHT_FRAMES = 0, /* a ShoalLightFrames, of the 8-bit formats; SHOAL_LIGHT_THESIS unless set */
    /* 0: maps are cut at 65504. 1: a light with more than that has all its maps divided by its
       shoalLightScale(), and shaders want #define SCALED_LIGHT and uniform float lightScale. */
    SHOAL_LIGHT_SCALED_MAPS = 1,
    SHOAL_LIGHT_FIND_SOURCES = 2 /* 1: shoalLightSources() has some; 0: it has none */
} ShoalLightSetting;

typedef enum ShoalLightFrames {
    SHOAL_LIGHT_THESIS = 0, /* "The formula" of README.md */
    SHOAL_LIGHT_SRGB = 1,   /* decoded sRGB: white is 1 */
    /* The same, with how bright the light was that the camera clipped, estimated by what the ground sends
       back. */
    SHOAL_LIGHT_SRGB_UNCLIPPED = 2
} ShoalLightFrames;

/* Before the first frame, or between frames; the next frame makes its tables anew. Since 1.1. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMakerSet(ShoalLightMaker* maker, int32_t setting, int32_t value);

/* A light is empty until it is made: no maps, and black. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightCreate(ShoalLight** light);
SHOAL_LIGHT_API void shoalLightDestroy(ShoalLight* light); /* NULL: nothing */

/* Fills light, whatever it held. The first frame of a size makes tables (0.02 s to 2 s); after that nothing
   is allocated for a light that was made before. frame's pixels are not looked at after the return. After a
   failure light is as it was, or, out of memory, empty. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightMake(ShoalLightMaker* maker, const ShoalLightFrame* frame,
                                                ShoalLight* light);

/* ---- For shaders: shaders/light/Environment.glsl ---- */

/* Rows from the top, four half floats a texel, alpha 1, no gaps. NULL, 0, 0 where there is none. */
typedef struct ShoalLightTexture {
    const uint16_t* rgba;
    int32_t width, height;
} ShoalLightTexture;

/* Names are those of Environment.glsl's uniforms. Pointers are valid until the light is made anew or
 * destroyed. */
typedef struct ShoalLightMaps {
    /* sampler2D lightMap: linear, no mipmaps, clamped. */
    ShoalLightTexture lightMap;
    const float* lightPlaces; /* vec4 lightPlaces[17]: 4 mapCount floats */
    int32_t mapCount;         /* float smoothestMap = mapCount - 1; 1 to 17 */
    /* Only where leastRoughness is below 0.1 (#define MIRRORS); else mirrorLevels is 0.
       sampler2D radianceMap: these are its mipmaps, all there are; trilinear, wrapping in u, clamped in v. */
    int32_t mirrorLevels;             /* int mirrorLevels; 0 to 5 */
    const ShoalLightTexture* mirrors; /* mirrorLevels, widest first */
    const float* mirrorRoughness;     /* float mirrorRoughness[6]: mirrorLevels + 1 floats */
} ShoalLightMaps;

SHOAL_LIGHT_API void shoalLightMaps(const ShoalLight* light, ShoalLightMaps* maps);

/* Returns radiance by the maps' values: 1, or more with SHOAL_LIGHT_SCALED_MAPS. Since 1.1. */
SHOAL_LIGHT_API float shoalLightScale(const ShoalLight* light);

/* A sun, a window, a lamp: what casts shadows. */
typedef struct ShoalLightSource {
    float direction[3];  /* towards it, unit length */
    float radius;        /* radians: of a disc of even radiance as widely spread */
    float irradiance[3]; /* on a plane that faces it, beyond what comes without it; the maps have it too */
    float share;         /* of the luminance of all that falls on that plane, 0 to 1 */
} ShoalLightSource;

/* The strongest first, at most room of them (never more than 3). Returns how many. Since 1.1. */
SHOAL_LIGHT_API int32_t shoalLightSources(const ShoalLight* light, ShoalLightSource* sources, int32_t room);

/* sampler2D dfgTable of shaders/light/Surface.glsl, the same for all light: size x size texels of two floats;
   linear, no mipmaps, clamped. size: 2 to 1024, 64 is enough. scaleBias: room for 2 size^2 floats. Takes 0.1
   ms a row of 64. */
SHOAL_LIGHT_API ShoalLightStatus shoalLightSurfaceTable(int32_t size, float* scaleBias);

/* ---- Without a shader: vertices, probes, tests ---- */

/* Radiance leaving a white matte surface: irradiance / pi. normal: unit length. */
SHOAL_LIGHT_API void shoalLightDiffuse(const ShoalLight* light, const float normal[3], float radiance[3]);

/* Radiance around the mirrored direction, filtered by a GGX lobe. direction: unit length; roughness:
 * perceptual. */
SHOAL_LIGHT_API void shoalLightGlossy(const ShoalLight* light, const float direction[3], float roughness,
                                      float radiance[3]);

/* The thesis' decoding of 8-bit formats, and its inverse (shaders/light/ToneCurve.glsl): values 0 to 1. */
SHOAL_LIGHT_API void shoalLightRadianceFromDisplay(const float display[3], float radiance[3]);
SHOAL_LIGHT_API void shoalLightDisplayFromRadiance(const float radiance[3], float display[3]);

#ifdef __cplusplus
}
#endif

#endif
