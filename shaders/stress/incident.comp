// Irradiance of lights at points. In: (position, light index). Out: (irradiance at normal incidence, 1 if the light
// reaches the point), (direction, 0).
#include "records.glsl"
#include "lib/light/light.glsl"

void main()
{
    int record = recordIndex(1);
    if (record < 0) return;
    Incident incident;
    bool reaches = incidentLight(int(inputs[record].w), inputs[record].xyz, incident);
    outputs[record * 2] = reaches ? vec4(incident.irradiance, 1.0) : vec4(0.0);
    outputs[record * 2 + 1] = vec4(reaches ? incident.toLightLS : vec3(0.0), 0.0);
}
