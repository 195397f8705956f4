// Reflection of a viewer straight above a surface at a sampled microfacet. In: (point of the unit square, alphas along x
// and y). Out: (direction, 0); the normal is z and the tangent x.
#include "lib/reflectance/visible_facets.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    const vec3 kAbove = vec3(0.0, 0.0, 1.0);
    outputs[i] = vec4(visibleReflection(inputs[i].xy, inputs[i].zw, kAbove, kAbove, vec3(1.0, 0.0, 0.0)), 0.0);
}
