#pragma once
// Outputs of a pixel: the values of VIEW in shading shaders, the same as of frame::DebugView.
#include "interop.h"

#define VIEW_FINAL 0
#define VIEW_DIFFUSE 1
#define VIEW_NORMAL_TEXEL 2
#define VIEW_NORMAL 3
#define VIEW_DISTRIBUTION 4
#define VIEW_GEOMETRY 5
#define VIEW_FRESNEL 6
#define VIEW_DEPTH 7
#define VIEW_LIGHTS 8
#define VIEW_IDS 9
#define VIEW_NORMAL_VIEW 10
#define VIEW_NORMAL_OBJECT 11
#define VIEW_SHADOW 12
#define VIEW_CASCADES 13
#define VIEW_MOVED_TOO_FAR 14
#define VIEW_OVERDRAW 15
#define VIEW_FAULTS 16
#define VIEW_SHADOW_ATLAS 17
#define VIEW_STORED 18 // the first of the debug views of stored G-buffer channels
