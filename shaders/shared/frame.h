#pragma once
// Constants of a view (a camera with an image size) and of its lights. Positions are in lighting space (LS). Lighting
// space has world or view axes, by FrameSettings::space; its origin lies on the view axis: at the eye, or in the middle
// of the visible surfaces if all are far away, so that fp32 positions keep their precision. The CPU transforms normals,
// lights and rays to it in double precision, and shaders do not depend on its axes. Vertices always pass through
// relative world space (RWS), world axes at that origin: rounding in another space would move them by a bit, and pixels
// at edges would show another triangle.
#include "interop.h"

SHARED_BEGIN

struct ViewConstants {
    mat4 clipFromLS;
    mat4 clipFromRWS;
    mat4 worldFromLS;    // rotation only, so also RWS from LS; the identity if LS is RWS
    vec4 eyeLS;          // xyz eye; w view depth of the origin of lighting space, in metres
    vec4 rayDxLS;        // step of one pixel to the right across the view axis, in metres: at one metre ahead of the
                         // eye (orthographic: at any depth)
    vec4 rayDyLS;        // the same upwards
    vec4 forwardLS;      // unit; w is 1 for an orthographic camera, else 0
    vec4 aheadFromDepth; // metres ahead of the origin of lighting space = (x + y depth) / (z + w depth)
    vec4 background;     // radiance where nothing is drawn; a is 0, the coverage
    vec4 rayFromPixel;   // the ray of pixel p lies x (p.x - z) to the right and y (p.y - w) up, in metres, at one metre
                         // ahead of the eye (orthographic: at any depth); window coordinates, lower-left origin
    vec4 depthKey;       // x bias of depth keys (light_lists.h); y metres from depth 0 to 1 if depth is (nearly) linear
                         // in the distance, else 0; w fraction of a pixel by which the rasteriser snaps vertices before
                         // it computes depths, z the same in metres, at one metre ahead of the eye (orthographic: at
                         // any depth)
    uvec4 sizePixels;    // x width, y height of the image; z samples per pixel, 0 if unset
};

// Rows (vec4) of the structs. On Mesa's software rasterisers passes/fullscreen.vert outputs all of them to the fragment
// shader: their vertex shaders may have 32 outputs; OpenGL 4.5 guarantees 16.
#define VIEW_CONSTANT_ROWS 21
#define LIGHTING_CONSTANT_ROWS 3

struct LightingConstants {
    uvec4 lights;   // x number of lights, y light shown by views of a single light, z number of unbounded lights, w
                    // words of a bitmask over the lights
    uvec4 tileGrid; // x columns, y rows of tiles; z height of the image in pixels; w log2 of a tile's side in pixels
    uvec4 slices;   // x shift of the finest depth slices (light_lists.h); y number of shadow-casting lights, which come
                    // first
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == VIEW_CONSTANT_ROWS * sizeof(vec4));
static_assert(sizeof(LightingConstants) == LIGHTING_CONSTANT_ROWS * sizeof(vec4));
static_assert(VIEW_CONSTANT_ROWS + LIGHTING_CONSTANT_ROWS < 32, "a place is gl_Position's");
#endif

SHARED_END
