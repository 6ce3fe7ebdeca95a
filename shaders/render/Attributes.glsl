// Attribute locations and binding points; included by GLSL and by C++, so there is one list.
#define ATTRIBUTE_POSITION 0
#define ATTRIBUTE_NORMAL 1
#define ATTRIBUTE_TANGENT 2
#define ATTRIBUTE_UV0 3
#define ATTRIBUTE_UV1 4
#define ATTRIBUTE_COLOUR 5
#define ATTRIBUTE_JOINTS 6
#define ATTRIBUTE_WEIGHTS 7
#define ATTRIBUTE_SELF_OCCLUSION 8
#define ATTRIBUTE_SELF_OCCLUSION_BESIDE_OWN 9
#define BLOCK_JOINTS 0
#define BLOCK_OCCLUDERS 1
#define UNIT_LIGHT 0
#define UNIT_DFG 1
#define UNIT_BASE_COLOUR 2
#define UNIT_METALLIC_ROUGHNESS 3
#define UNIT_NORMAL 4
#define UNIT_OCCLUSION 5
#define UNIT_EMISSIVE 6
#define UNIT_RADIANCE 7
#define UNIT_FILM_DEPTH 8
#define UNIT_SPECULAR 9
#define UNIT_SPECULAR_COLOUR 10
#define UNIT_COAT 11
#define UNIT_COAT_ROUGHNESS 12
#define UNIT_FRAME 0
#define UNIT_SHADOWS 1
#define MAX_JOINTS 256
#define MAX_OTHERS 24 // occluders: parts of other bodies
#define MAX_OCCLUDERS 48
// Constants for searching the map of distances, shared by engine/depth/DepthMap.cpp and render/FilmDepth.glsl.
#define FILM_NEAREST_M 0.6
#define FILM_MAX_STEPS 16
#define FILM_STEP_RAD 0.06
#define FILM_FOUND_RAD 1.5e-3
#define FILM_PASSED 1.25
