#pragma once
#include "b.glsl"
int a;
