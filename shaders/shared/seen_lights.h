#pragma once
// Records of the visible surfaces of area lights (passes/SeenLightsPass.h), in a buffer texture.
#include "interop.h"

#define SEEN_LIGHT_TEXELS 9

SHARED_BEGIN

struct SeenLightTexels {
    vec4 window;     // screen bounds in normalised device coordinates: xy minimum, zw maximum
    vec4 radiance;   // rgb colour x intensity; w of a flat light its emitting sides and light texture
                     // (light_pictures.h)
    vec4 middle;     // xyz position LS in metres; w type, LIGHT_<NAME> in shaders
    vec4 along;      // xyz unit LS: axis along a rectangle's width, a disk's radius, a tube's axis, a polygon's x axis;
                     // w half width, radius or half length in metres; number of corners of a polygon
    vec4 across;     // xyz unit LS, flat lights: along x across points to the emitting side; w half height, radius, or
                     // distance of a polygon's farthest corner, in metres
    vec4 corners[4]; // corners of a polygon in metres: xy one and zw the next
};

#ifdef __cplusplus
static_assert(sizeof(SeenLightTexels) == SEEN_LIGHT_TEXELS * sizeof(vec4));
#endif

SHARED_END
