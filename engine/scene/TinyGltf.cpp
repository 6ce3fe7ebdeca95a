#include <nlohmann/json.hpp>

#include <fstream> // which tinygltf needs for writing, but includes only with TINYGLTF_NO_FS unset

#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_IMPLEMENTATION
#pragma GCC diagnostic ignored "-Wunused-function" // functions that only the left-out file access uses
#include "engine/scene/Gltf.h"
