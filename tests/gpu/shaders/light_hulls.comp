// Hulls of spot lights. In: (apex, radius), (axis, cosine of the outer angle), (margin, -). Out: clip coordinates of
// all corners, then (margin with which a light of this position and radius is drawn, 1 if it is vast in the image, -).
#include "lib/light/light_volume.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 3u >= uint(inputs.length())) return;
    vec4 apex = inputs[i * 3u], axis = inputs[i * 3u + 1u];
    float margin = inputs[i * 3u + 2u].x;
    uint first = i * uint(LIGHT_VOLUME_CONE_VERTICES + 1);
    for (int vertex = 0; vertex < LIGHT_VOLUME_CONE_VERTICES; ++vertex)
        outputs[first + uint(vertex)] = coneVertex(vertex, apex.xyz, axis.xyz, axis.w, apex.w, margin);
    outputs[first + uint(LIGHT_VOLUME_CONE_VERTICES)] =
        vec4(volumeMargin(apex.xyz, apex.w), isVastInPicture(apex.w) ? 1.0 : 0.0, 0.0, 0.0);
}
