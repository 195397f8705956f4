// A triangle that covers the window, by vertex index alone. With FLAT_CONSTANTS it outputs the constants of the view
// and its lights to the fragments.
#ifdef FLAT_CONSTANTS
#undef FLAT_CONSTANTS
#include "lib/surface/camera.glsl"
layout(location = 0) flat out ViewConstants flatView;
layout(location = VIEW_CONSTANT_ROWS) flat out LightingConstants flatLighting;
#define HANDS_CONSTANTS_OVER
#endif

void main()
{
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
#ifdef HANDS_CONSTANTS_OVER
    flatView = view;
    flatLighting = lighting;
#endif
}
