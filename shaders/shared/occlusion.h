#pragma once
// Bits that store the fraction of environment light that reaches a surface (encodeOpen() of lib/surface/surface.glsl).

#define OPEN_BITS 8
