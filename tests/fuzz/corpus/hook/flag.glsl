#define WAVE(x) sin(6.0 * (x))
const float kHeight = 0.1; // metres
/* both functions */
void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)
{
    positionOS.z += kHeight * uv.x * WAVE(positionOS.x - hook.timeSeconds);
    normalOS = normalize(normalOS);
}
#if 1
void hookSurface(inout HookedSurface surface, HookInputs inputs)
{
    for (int i = 0; i < 4; ++i) surface.color *= 0.9;
    if (inputs.uv.x > 0.5) surface.emission = vec3(0.1);
}
#endif
