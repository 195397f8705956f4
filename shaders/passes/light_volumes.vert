// One instance per light: the triangles of its volume.
#include "lib/light/light_volume.glsl"

layout(location = 0) flat out int light;

void main()
{
    light = gl_InstanceID;
    gl_Position = lightVolumeVertex(gl_InstanceID, gl_VertexID);
}
