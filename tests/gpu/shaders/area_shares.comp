// What a clamped cosine that a matrix transforms sees of area lights; the normal is z. In: (middle from the point, type),
// LightShapeTexels' two, the three columns of the matrix. Out: (share, edges of the outline, 0, 0).
#include "lib/reflectance/reflectance.glsl"
#include "lib/light/light.glsl"
#include "lib/light/area_light.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 6u >= uint(inputs.length())) return;
    vec4 place = inputs[i * 6u];
    Outline outline = areaOutline(int(place.w), place.xyz, inputs[i * 6u + 1u], inputs[i * 6u + 2u]);
    mat3 cosineFromSurface = mat3(inputs[i * 6u + 3u].xyz, inputs[i * 6u + 4u].xyz, inputs[i * 6u + 5u].xyz);
    precise float perAbove = 1.0 / shareAbove(cosineFromSurface);
    float share = 0.0;
    if (outline.edges > 0) share = shareSeen(outline, AreaLobe(mat3(1.0), cosineFromSurface, perAbove));
    outputs[i] = vec4(share, float(outline.edges), 0.0, 0.0);
}
