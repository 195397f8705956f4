#pragma once
// Shadow maps: depths of the casters nearest to a light, reverse-Z, 0 where there are none. Each face of a light is a
// square picture of its own in one atlas (frame::ShadowedLight says how many a light has).
// The records of faces lie behind the lights' texels (light.h), those of a light one after the other.
#include "interop.h"

// frame::ShadowFilter.
#define SHADOW_FILTER_HARD 1
#define SHADOW_FILTER_PCF 2
#define SHADOW_FILTER_PCSS 3

#define SHADOW_FACE_TEXELS 4

// The widest penumbra that pcss looks up: the side of a face is so many of its radius.
#define SHADOW_PENUMBRA_PARTS 8

SHARED_BEGIN

// Texels around the part of a face that points are looked up in: for taps that reach so far, or (isPenumbra) as far as
// the widest penumbra, but at most a quarter of the side.
SHARED_FUNCTION float shadowBorderTexels(float sideTexels, float tapTexels, bool isPenumbra) {
    return isPenumbra ? sideTexels / float(SHADOW_PENUMBRA_PARTS) : min(tapTexels, 0.25f * sideTexels);
}

// With P a position in world axes from the origin of lighting space (frame.h), and x, y, z the scalar products of
// (P, 1) with the three rows, z is the distance ahead of the light in metres. A point light sees P at the texel
// place.xy + place.z (x, y) / z of the atlas, with depth place.w / z. A directional light sees it at place.xy + place.z
// (x, y), with depth 1 + place.w z.
struct ShadowFaceTexels {
    vec4 right;   // its direction, divided by half the width of the face in metres, a metre ahead of the light or
                  // (directional) anywhere; w the product with the origin
    vec4 up;      // the same
    vec4 forward; // unit
    vec4 place;   // xy the middle of the face in texels of the atlas; z half its side in texels; w the near end in
                  // metres, or (directional) minus the reciprocal of the depths' range
};

// A face as the view `shadow_atlas` shows it.
struct ShownFaceConstants {
    vec4 picture; // xy the lower-left corner of the face's strip in pixels of the picture; z texels for a pixel; w the
                  // strip's first column of texels
    vec4 face;    // xy its lower-left corner and z its side, in texels of the atlas; w its number in its light, from 1
    vec4 depths;  // x the near end as a share of the light's reach, or (directional) 0
};

SHARED_END
