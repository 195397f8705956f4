#pragma once
// The share of an environment's light that arrives at a surface (encodeOpen() of lib/surface/surface.glsl).

#define OPEN_BITS 8
