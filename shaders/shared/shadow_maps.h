#pragma once
// Shadow maps: depths of the casters nearest to a light, reverse-Z, 0 where there are none. Each face of a light is a
// square image in one atlas (frame::ShadowedLight gives the number of faces). The records of faces follow the lights'
// texels (light.h), those of a light in sequence.
#include "interop.h"

// frame::ShadowFilter.
#define SHADOW_FILTER_HARD 1
#define SHADOW_FILTER_PCF 2
#define SHADOW_FILTER_PCSS 3

#define SHADOW_FACE_TEXELS 4

// Maximum radius of a penumbra for pcss: the side of a face divided by this.
#define SHADOW_PENUMBRA_PARTS 8

SHARED_BEGIN

// Border in texels around the part of a face in which points are looked up: the filter radius `tapTexels`, at most a
// quarter of the side, or (isPenumbra) the maximum radius of a penumbra.
SHARED_FUNCTION float shadowBorderTexels(float sideTexels, float tapTexels, bool isPenumbra) {
    return isPenumbra ? sideTexels / float(SHADOW_PENUMBRA_PARTS) : min(tapTexels, 0.25f * sideTexels);
}

// A face of a shadow map. With P a position in RWS (frame.h), and x, y, z the scalar products of (P, 1) with the three
// rows, z is the distance ahead of the light in metres. A positional light projects P to the texel place.xy + place.z
// (x, y) / z of the atlas, with depth place.w / z. A directional light projects it to place.xy + place.z (x, y), with
// depth 1 + place.w z.
struct ShadowFaceTexels {
    vec4 right;   // xyz direction, divided by half the width of the face in metres, at one metre ahead of the light
                  // (directional: at any distance); w offset by the origin
    vec4 up;      // the same
    vec4 forward; // unit
    vec4 place;   // xy centre of the face in texels of the atlas; z half its side in texels; w near distance in metres
                  // (directional: minus the reciprocal of the depth range)
};

// A face as displayed by the view `shadow_atlas`.
struct ShownFaceConstants {
    vec4 picture; // xy lower-left corner of the face's strip in pixels of the image; z texels per pixel; w first column
                  // of texels of the strip
    vec4 face;    // xy lower-left corner and z side, in texels of the atlas; w number within its light, from 1
    vec4 depths;  // x near distance relative to the light's range (directional: 0)
};

SHARED_END
