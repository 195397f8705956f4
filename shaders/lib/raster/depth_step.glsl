#pragma once

// Depth difference between a pixel and the next on the same surface: the smaller of the steps to both neighbours, since
// one of them may show another surface.
float stepOnSurface(float last, float here, float next)
{
    precise float forward = next - here, back = here - last;
    return abs(forward) < abs(back) ? forward : back;
}
