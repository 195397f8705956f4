#pragma once

// How depths grow from a pixel to the next on the surface that it shows: the smaller of the steps to its neighbours, of
// which one may show something else.
float stepOnSurface(float last, float here, float next)
{
    precise float forward = next - here, back = here - last;
    return abs(forward) < abs(back) ? forward : back;
}
