// tinygltf is header-only: this source holds its implementation. Pictures are passed through undecoded, so
// neither stb_image nor stb_image_write is built in.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
