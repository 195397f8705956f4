#version 450 core
#pragma once
#include "a.glsl"
#include "lib/b.glsl" // c
#ifdef __cplusplus
#include <vector>
#else
#include "b.glsl"
#endif
/* #include "x" */ #define A \
#include
void main() {}
