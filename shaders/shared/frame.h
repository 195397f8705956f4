#pragma once
// What every pass of a frame knows: the camera, in lighting space (LS). Lighting space is world space moved to the eye,
// or view space, as FrameSettings::space says; the CPU puts normals, lights and rays into it in double precision, and
// shaders do not know which it is. Vertices pass through world axes at the eye (ES) whatever lighting space is: rounded
// in another space they would lie elsewhere by a bit, and pixels at edges would show another triangle.
#include "interop.h"

SHARED_BEGIN

struct FrameConstants {
    mat4 clipFromLS;
    mat4 clipFromES;
    mat4 worldFromLS; // rotation only, of world axes, so also ES from LS; the unit matrix where LS is ES
    vec4 rayOriginLS; // ray through pixel p: rayOrigin + p.x rayDx + p.y rayDy, window coordinates, lower-left origin
    vec4 rayDxLS;     // perspective: a direction of length 1 along forward; orthographic: a point of the image plane
    vec4 rayDyLS;
    vec4 forwardLS;        // unit; w is 1 for an orthographic camera, else 0
    vec4 depthToViewDepth; // view depth in metres = (x + y depth) / (z + w depth)
    vec4 background;       // radiance where nothing is drawn; a is 0, the coverage
    uvec4 lights;          // x number of lights, y index of the one that the D, G and F views show, z those that reach
                           // everywhere, w words of a bitmask over the lights
    vec4 lensVS; // a pixel p sees x + y p.x to the right and z + w p.y up, in metres: a metre ahead, or (orthographic)
                 // anywhere
    uvec4 tileGrid; // x columns, y rows of tiles; z height of the picture in pixels; w log2 of a tile's side in pixels
    vec4 depthKey;  // x bias of depth keys (light_lists.h), y shift of the finest depth slices
    uvec4 sizePixels; // x width, y height of the picture
};

SHARED_END
