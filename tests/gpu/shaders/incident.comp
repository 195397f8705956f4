// What lights send to points. In: (position, index of the light).
// Out: (intensity, 1 when the light reaches), (direction, 0).
#include "lib/light.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    Incident incident;
    bool reaches = incidentLight(int(inputs[i].w), inputs[i].xyz, incident);
    outputs[i * 2u] = reaches ? vec4(incident.intensity, 1.0) : vec4(0.0);
    outputs[i * 2u + 1u] = vec4(reaches ? incident.toLightLS : vec3(0.0), 0.0);
}
