// Which lights a pixel visits, always in ascending index order, so that every technique adds the same terms in the same order.
// LIGHT_CURSOR selects the list: ALL visits every light of the frame.
#pragma once
#include "lib/camera.glsl"

struct LightCursor {
    int next;
    int end;
};

LightCursor lightCursor(vec2 pixel, vec3 positionLS)
{
    return LightCursor(0, int(frame.lights.x));
}

bool nextLight(inout LightCursor cursor, out int light)
{
    light = cursor.next;
    cursor.next += 1;
    return light < cursor.end;
}
