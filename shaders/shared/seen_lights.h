#pragma once
// The surfaces of area lights as pictures show them (passes/SeenLightsPass.h): a record each, in a buffer texture.
#include "interop.h"

#define SEEN_LIGHT_TEXELS 9

SHARED_BEGIN

struct SeenLightTexels {
    vec4 window;     // around its picture, in normalised device coordinates: xy the least, zw the most
    vec4 radiance;   // rgb colour x intensity; w of a flat light the sides it is seen from, and its picture
                     // (light_pictures.h)
    vec4 middle;     // xyz position LS in metres; w type, LIGHT_<NAME> in shaders
    vec4 along;      // xyz unit LS: a rectangle's width, a disk's radius, a tube's axis, a polygon's x; w half of it in
                     // metres, the radius, half of its length; of a polygon how many corners
    vec4 across;     // xyz unit LS, of what is flat: along x across points where it shines; w half the height, the
                     // radius, or how far a polygon's farthest corner is
    vec4 corners[4]; // of a polygon, metres: xy one and zw the next
};

#ifdef __cplusplus
static_assert(sizeof(SeenLightTexels) == SEEN_LIGHT_TEXELS * sizeof(vec4));
#endif

SHARED_END
