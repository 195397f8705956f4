#pragma once
// The constants of a view, which is a camera with a picture of some size, and of its lights. Positions
// are in lighting space (LS). Lighting space has the axes of the world or of the view, as FrameSettings::space says,
// and its origin on the view axis: at the eye, or in the middle of the visible surfaces where all of them are far away,
// so that fp32 keeps the digits of positions. The CPU transforms normals, lights and rays to it in double precision,
// and shaders do not depend on its axes. Vertices pass through relative world space (RWS), the world's axes at that
// origin, with either lighting space: rounding in another space would move them by a bit, and pixels at edges would
// show another triangle.
#include "interop.h"

SHARED_BEGIN

struct ViewConstants {
    mat4 clipFromLS;
    mat4 clipFromRWS;
    mat4 worldFromLS;    // rotation only, of world axes, so also RWS from LS; the unit matrix where LS is RWS
    vec4 eyeLS;          // xyz the eye; w the view depth of the origin of lighting space, in metres
    vec4 rayDxLS;        // step of one pixel to the right across the view axis, in metres: a metre ahead of the eye, or
                         // (orthographic) anywhere
    vec4 rayDyLS;        // the same upwards
    vec4 forwardLS;      // unit; w is 1 for an orthographic camera, else 0
    vec4 aheadFromDepth; // metres ahead of the origin of lighting space = (x + y depth) / (z + w depth)
    vec4 background;     // radiance where nothing is drawn; a is 0, the coverage
    vec4 rayFromPixel;   // a pixel p sees x (p.x - z) to the right and y (p.y - w) up, in metres: a metre ahead of the
                         // eye, or (orthographic) anywhere; window coordinates, lower-left origin
    vec4 depthKey;       // x bias of depth keys (light_lists.h); y metres from depth 0 to 1 where depth is even in the
                         // distance or nearly so, else 0; w by how much of a pixel a rasteriser moves vertices before
                         // it finds depths, z the same in metres: a metre ahead of the eye, or (orthographic) anywhere
    uvec4 sizePixels;    // x width, y height of the picture; z samples of a pixel, 0 where nobody has said
};

// vec4 that the structs take. passes/fullscreen.vert hands all of them to the fragments where the driver is one of
// Mesa's software rasterisers, which let a vertex shader write 32; OpenGL 4.5 guarantees 16.
#define VIEW_CONSTANT_ROWS 21
#define LIGHTING_CONSTANT_ROWS 3

struct LightingConstants {
    uvec4 lights;   // x number of lights, y index of the one that views of one light show, z those that reach
                    // everywhere, w words of a bitmask over the lights
    uvec4 tileGrid; // x columns, y rows of tiles; z height of the picture in pixels; w log2 of a tile's side in pixels
    uvec4 slices; // x shift of the finest depth slices (light_lists.h); y number of lights that casters may hide, which
                  // come first
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == VIEW_CONSTANT_ROWS * sizeof(vec4));
static_assert(sizeof(LightingConstants) == LIGHTING_CONSTANT_ROWS * sizeof(vec4));
static_assert(VIEW_CONSTANT_ROWS + LIGHTING_CONSTANT_ROWS < 32, "a place is gl_Position's");
#endif

SHARED_END
