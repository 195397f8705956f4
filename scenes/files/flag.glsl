// A flag in the wind: its left edge is held, and waves run to the right and grow.
const float kWaves = 7.0;   // radians a metre
const float kHeight = 0.12; // metres, where it flies freely

void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)
{
    float phase = kWaves * positionOS.x - 6.0 * hook.wind * hook.timeSeconds + 1.5 * uv.y;
    float height = kHeight * uv.x * hook.wind;
    float slope = kHeight * hook.wind * (sin(phase) / 1.5 + uv.x * kWaves * cos(phase)); // over x, 1.5 m to u = 1
    float across = -1.5 * height * cos(phase);                                           // over y, 1 m from v = 1 to 0
    positionOS.z += height * sin(phase);
    normalOS = normalize(vec3(-slope, -across, 1.0));
}
