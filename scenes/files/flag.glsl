// A striped flag in the wind: its left edge is held, and waves run to the right and grow.
const float kWaves = 7.0;   // radians per metre
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

// 1 from `edge` on, smoothly: a step would alias, and rounding would decide pixels at the edge.
float from(float edge, float x)
{
    return smoothstep(edge - 0.004, edge + 0.004, x);
}

// Seven stripes, and a plum canton with a sun.
void hookSurface(inout HookedSurface surface, HookInputs inputs)
{
    const vec3 kCream = vec3(0.82, 0.77, 0.66), kPlum = vec3(0.13, 0.015, 0.08), kGold = vec3(0.85, 0.5, 0.06);
    vec2 place = vec2(1.5 * inputs.uv.x, inputs.uv.y); // metres, v runs down
    vec3 color = mix(kCream, surface.color, smoothstep(0.47, 0.53, abs(mod(7.0 * place.y - 0.5, 2.0) - 1.0)));
    float quarter = (1.0 - from(0.62, place.x)) * (1.0 - from(4.0 / 7.0, place.y));
    color = mix(color, kPlum, quarter);
    vec2 arm = place - vec2(0.31, 2.0 / 7.0);
    float reach = length(arm), turn = 12.0 * atan(arm.y, arm.x);
    float sun = 1.0 - from(0.1, reach);
    float ray = from(0.12, reach) * (1.0 - from(0.2, reach)) * smoothstep(0.2, 0.5, cos(turn));
    surface.color = mix(color, kGold, quarter * max(sun, ray));
}
