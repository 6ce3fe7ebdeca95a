// Binding points of the storage buffers; included by C++ too.
#define OCCLUSION_STARTS 0
#define OCCLUSION_LAYERS 1
#define OCCLUSION_VIEWS 2
#define OCCLUSION_ROWS 3
#define OCCLUSION_AXES 4
#define OCCLUSION_RAYS 5
