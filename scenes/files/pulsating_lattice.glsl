// The lattice breathes: slow waves of swelling and light run from its middle outwards.
const float kTurn = 6.2831853;

// 0 to 1 and back; `place` is a delay in turns.
float breath(float place)
{
    return 0.5 - 0.5 * cos(kTurn * (hook.breathsASecond * hook.timeSeconds - place));
}

// All objects of a shape share one mesh, so they swell together.
void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv)
{
    positionOS *= 1.0 + hook.swell * (2.0 * breath(0.0) - 1.0);
}

void hookSurface(inout HookedSurface surface, HookInputs inputs)
{
    // The instances after the floor are rows of 16 objects, so the index gives the cell.
    int number = inputs.instance - 1;
    vec2 cell = vec2(float(number % 16), float(number / 16)) - 7.5;
    float late = 0.09 * length(cell);
    float crest = breath(late);
    crest *= crest * crest;
    vec3 hue = mix(vec3(0.05, 0.45, 1.0), vec3(0.75, 0.12, 0.7), smoothstep(0.0, 0.5, late));
    hue = mix(hue, vec3(1.0, 0.42, 0.08), smoothstep(0.4, 0.9, late)); // blue, violet, amber
    float band = 0.35 + 0.65 * smoothstep(-1.0, 1.0, sin(9.0 * inputs.positionOS.y));
    surface.color = mix(surface.color, 0.8 * hue, 0.75);
    surface.emission += hook.glow * crest * band * hue;
    surface.alpha = mix(surface.alpha, 0.6 * surface.alpha, crest);
}
