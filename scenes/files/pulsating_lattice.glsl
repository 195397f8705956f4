// A wave of light that runs over the lattice, and cools what it leaves.
void hookSurface(inout HookedSurface surface, HookInputs inputs)
{
    float phase = 6.2831853 * (hook.turnsASecond * hook.timeSeconds - fract(float(inputs.instance) * 0.05));
    float crest = pow(0.5 + 0.5 * cos(phase), 8.0);
    float rings = 0.5 + 0.5 * cos(40.0 * inputs.positionOS.y - phase);
    surface.color = mix(surface.color, surface.color * vec3(0.6, 0.8, 1.0), 1.0 - crest);
    surface.emission += hook.glow * crest * rings * vec3(1.0, 0.35, 0.1);
    surface.alpha = mix(surface.alpha, 0.5 * surface.alpha, crest);
}
