// Random numbers by hashing, the same on every machine.
#pragma once

// Source: pcg3d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering".
uvec3 hashOf(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// In [0, 1).
vec2 unitOf(uvec2 bits)
{
    return vec2(bits >> 8) * (1.0 / 16777216.0);
}
