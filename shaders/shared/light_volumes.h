#pragma once
// Vertex counts of the volumes that LightVolumesPass draws (lib/light/light_volume.glsl), by vertex number alone.

// Corners of the polygons that enclose circles: an octagon around a circle has 1.055 times its area.
#define LIGHT_VOLUME_SIDES 8

// A fan: the outline of a sphere.
#define LIGHT_VOLUME_SPHERE_VERTICES (3 * (LIGHT_VOLUME_SIDES - 2))

// A cap at either end and two bands around the axis: the hull of a spot light.
#define LIGHT_VOLUME_CONE_VERTICES (3 * (2 * (LIGHT_VOLUME_SIDES - 2) + 4 * LIGHT_VOLUME_SIDES))
